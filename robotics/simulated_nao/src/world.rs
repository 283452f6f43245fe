//! The simulated world at one moment: the robots' bodies, their motors and cameras, and the ball.

mod contacts;
mod game;
mod imperfections;
mod inertial;
mod inhabitant;
mod motor_boards;
mod power;
mod progress;
mod sensors;
mod sonar;
mod stillness;
mod touch;
mod way;

use std::sync::Arc;
use std::time::Duration;

use framework::{Error, Result, Timestamp};
use kinematics::cameras::{
    FOCAL_LENGTH, IMAGE_SIZE, OPTICAL_CENTER, camera_to_head, optical_to_camera,
};
use kinematics::forward_kinematics;
use kinematics::links::LinkName;
use nalgebra::{Isometry3, Point2, Point3, UnitQuaternion, Vector2};
use types::camera::{CameraPosition, Intrinsics};
use types::motor_commands::MotorCommands;
use types::sensor_data::{SensorData, Touch};

use self::game::Game;
use self::inhabitant::Inhabitant;
pub(crate) use self::sonar::NO_ECHO;
use crate::camera::{Exposure, OwnBody};
use crate::field::Field;
use crate::physics::{Body, Disturbance, Dynamic, Kinematic, Physics, STEP, Situation, Start};
use crate::posture;
use crate::scene::{self, Robot, RobotSettings, Team};
use crate::settings::{PhysicsChoice, Press, Settings};

/// From exposure to the arrival of the image.
pub(crate) const IMAGE_LATENCY: Duration = Duration::from_millis(25);

/// Everything that moves, at the time `now`.
pub(crate) struct World {
    pub(crate) field: Arc<Field>,
    now: Timestamp,
    situation: Situation,
    choice: PhysicsChoice,
    physics: Box<dyn Physics>,
    /// When the last step of the physics was.
    stepped: Timestamp,
    inhabitants: Vec<Inhabitant>,
    bystanders: Vec<RobotSettings>,
    /// Where they are now.
    statues: Arc<[Robot]>,
    game: Option<Game>,
    whistles: Vec<f64>,
    /// How many messages the own team and the other one have sent.
    messages: [u32; 2],
}

impl World {
    pub(crate) fn new(settings: &Settings) -> Self {
        let situation = situation(settings);
        let physics = physics(settings.physics, &situation);
        let statues = robots(&settings.robots, physics.bystanders());
        Self {
            field: Arc::default(),
            now: Timestamp::ZERO,
            stepped: Timestamp::ZERO,
            situation,
            choice: settings.physics,
            inhabitants: vec![Inhabitant::new(
                settings,
                &physics.bodies()[0],
                Arc::clone(&statues),
            )],
            bystanders: settings.robots.clone(),
            statues,
            physics,
            game: Game::new(&settings.game),
            whistles: Vec::new(),
            messages: [0; 2],
        }
    }

    /// Takes one more robot in, before time begins; its place.
    ///
    /// # Errors
    /// Where the field is full.
    pub(crate) fn join(&mut self, settings: &Settings) -> Result<usize> {
        let place = self.inhabitants.len();
        if place + self.bystanders.len() > scene::MOST_ROBOTS {
            return Err(Error::new(format!(
                "the field holds at most {} robots",
                scene::MOST_ROBOTS + 1
            )));
        }
        self.situation.robots.push(start(settings));
        self.physics = physics(self.choice, &self.situation);
        let body = &self.physics.bodies()[place];
        self.inhabitants
            .push(Inhabitant::new(settings, body, Arc::clone(&self.statues)));
        self.look_around();
        Ok(place)
    }

    /// How many robots with programs there are.
    pub(crate) fn robot_count(&self) -> usize {
        self.inhabitants.len()
    }

    pub(crate) fn now(&self) -> Timestamp {
        self.now
    }

    pub(crate) fn body(&self, robot: usize) -> &Body {
        &self.physics.bodies()[robot]
    }

    /// What the motors were told last.
    pub(crate) fn commands(&self, robot: usize) -> &MotorCommands {
        self.inhabitants[robot].motors.commands()
    }

    pub(crate) fn ball(&self) -> Option<Point3<f64>> {
        self.physics.ball().map(|ball| ball.position)
    }

    /// Whose it is.
    pub(crate) fn team(&self, robot: usize) -> Team {
        self.inhabitants[robot].team
    }

    /// How far a robot has gone over the floor, m.
    pub(crate) fn walked(&self, robot: usize) -> f64 {
        self.inhabitants[robot].way.length()
    }

    /// For how long a robot has been stuck, s.
    pub(crate) fn stuck(&self, robot: usize) -> f64 {
        self.inhabitants[robot].progress.stuck()
    }

    /// For how long a robot has stood still, s.
    pub(crate) fn still(&self, robot: usize) -> f64 {
        self.inhabitants[robot].stillness.seconds()
    }

    /// How often the feet of any robot have come to the ball.
    pub(crate) fn ball_contacts(&self) -> u64 {
        let contacts = self.inhabitants.iter().map(|robot| robot.contacts.count());
        contacts.sum()
    }

    /// The others.
    pub(crate) fn robots(&self, robot: usize) -> &[Robot] {
        &self.inhabitants[robot].others
    }

    /// What the robot can run into: the middle of each obstacle in the field frame and its radius, m.
    pub(crate) fn obstacles(
        &self,
        robot: usize,
    ) -> impl Iterator<Item = (Point2<f64>, f64)> + Clone {
        scene::obstacles(self.robots(robot))
    }

    /// Lets time pass; a time that is over already changes nothing.
    pub(crate) fn advance_to(&mut self, time: Timestamp) {
        if time <= self.now {
            return;
        }
        // On a grid of its own, so that the bodies do not depend on who looks at them when.
        while self.stepped + STEP <= time {
            self.stepped = self.stepped + STEP;
            let bodies = self.physics.bodies().iter();
            let commands: Vec<_> = bodies
                .zip(&self.inhabitants)
                .map(|(body, inhabitant)| inhabitant.push(body, self.stepped))
                .collect();
            self.physics.step(&commands);
            self.hold();
            for (body, inhabitant) in self.physics.bodies().iter().zip(&mut self.inhabitants) {
                inhabitant.inertial.measure(body);
            }
            self.referee_looks();
        }
        self.look_around();
        for inhabitant in &mut self.inhabitants {
            let stiffnesses = inhabitant.motors.commands().stiffnesses;
            inhabitant.power.advance(time - self.now, &stiffnesses);
        }
        self.now = time;
        let ball = self.ball().map(|ball| ball.xy());
        for (body, inhabitant) in self.physics.bodies().iter().zip(&mut self.inhabitants) {
            inhabitant.way.go(time, body);
            inhabitant.progress.go(time, body);
            inhabitant.stillness.go(time, body);
            let soles = [body.soles_to_field.left, body.soles_to_field.right];
            let soles = soles.map(|sole| sole.translation.vector.xy().into());
            inhabitant.contacts.look(ball, soles);
        }
    }

    /// Shows everybody where the others are.
    fn look_around(&mut self) {
        let have_moved = has_moved(&self.statues, self.physics.bystanders());
        if have_moved {
            self.statues = robots(&self.bystanders, self.physics.bystanders());
        }
        if let [only] = &mut self.inhabitants[..] {
            if have_moved {
                only.others = Arc::clone(&self.statues);
            }
            return;
        }
        let figures = self.physics.bodies().iter().zip(&self.inhabitants);
        let figures: Vec<_> = figures
            .map(|(body, inhabitant)| inhabitant.figure(body))
            .collect();
        for (place, inhabitant) in self.inhabitants.iter_mut().enumerate() {
            let others = (0..figures.len()).filter(|other| *other != place);
            let others = others.map(|other| figures[other].clone());
            inhabitant.others = self.statues.iter().cloned().chain(others).collect();
        }
    }

    /// Leaves out the time until `time`: nothing moves.
    pub(crate) fn skip_to(&mut self, time: Timestamp) {
        self.now = self.now.max(time);
        self.stepped = self.stepped.max(time);
    }

    /// Does to the world what no motor does.
    pub(crate) fn disturb(&mut self, disturbance: &Disturbance) {
        self.physics.disturb(disturbance);
        if let Disturbance::Kidnap { robot, .. } | Disturbance::Hold { robot, .. } = disturbance
            && let Some(inhabitant) = self.inhabitants.get_mut(*robot)
        {
            inhabitant.way.carry(&self.physics.bodies()[*robot]);
        }
    }

    /// Somebody presses a button.
    pub(crate) fn press(&mut self, robot: usize, press: Press) {
        self.inhabitants[robot].presses.push(press);
    }

    /// Tells the motors what to do from now on.
    pub(crate) fn command(&mut self, robot: usize, commands: MotorCommands) {
        let joints = self.physics.bodies()[robot].joints;
        self.inhabitants[robot].command(commands, &joints, self.now);
    }

    /// Reads all sensors of a body.
    pub(crate) fn sample(&mut self, robot: usize) -> SensorData {
        let body = &self.physics.bodies()[robot];
        let obstacles = scene::obstacles(&self.inhabitants[robot].others);
        let sonar = sonar::echoes(&body.torso_to_field, obstacles);
        self.inhabitants[robot].sample(body, sonar, self.now)
    }

    /// Everything that is pressed now.
    pub(crate) fn touch(&self, robot: usize) -> Touch {
        touch::touch(&self.inhabitants[robot].presses, self.now)
    }

    /// Takes what an image of one camera depends on.
    pub(crate) fn expose(&self, robot: usize, camera: CameraPosition, number: u64) -> Exposure {
        let body = self.body(robot);
        Exposure {
            number,
            captured_at: self.now,
            ready_at: self.now + IMAGE_LATENCY,
            camera_to_field: camera_to_field(body, camera),
            ground_to_field: body.ground_to_field().cast(),
            intrinsics: intrinsics(),
            ball: self.ball().map(|ball| ball.cast()),
            ball_turn: UnitQuaternion::identity(),
            robots: Arc::clone(&self.inhabitants[robot].others),
            body: Some(OwnBody {
                joints: body.joints.map(|angle| angle as f32),
                torso_to_field: body.torso_to_field.cast(),
            }),
            images: self.inhabitants[robot].images,
        }
    }
}

fn camera_to_field(body: &Body, camera: CameraPosition) -> Isometry3<f32> {
    let head = forward_kinematics(&body.joints).link(LinkName::Head);
    let camera_to_field =
        body.torso_to_field * head * camera_to_head::<f64>(camera) * optical_to_camera::<f64>();
    camera_to_field.cast()
}

/// Nearer than this, m, a bystander is where it was: a body at rest trembles less.
const STILL: f64 = 1e-4;

fn physics(choice: PhysicsChoice, situation: &Situation) -> Box<dyn Physics> {
    match choice {
        PhysicsChoice::Dynamic => Box::new(Dynamic::new(situation)),
        PhysicsChoice::Kinematic => Box::new(Kinematic::new(situation)),
    }
}

/// What the settings put on the field.
fn situation(settings: &Settings) -> Situation {
    let others = settings.robots.iter();
    Situation {
        robots: vec![start(settings)],
        bystanders: others.map(RobotSettings::start).collect(),
        ball: settings.ball_position(),
        carpet_friction: settings.carpet_friction,
    }
}

/// A robot sits and waits.
fn start(settings: &Settings) -> Start {
    Start {
        joints: posture::sitting(),
        pose: settings.robot_pose,
    }
}

fn robots(settings: &[RobotSettings], torsos_to_field: &[Isometry3<f64>]) -> Arc<[Robot]> {
    let robots = settings.iter().zip(torsos_to_field);
    robots
        .map(|(settings, torso_to_field)| Robot::new(settings, torso_to_field))
        .collect()
}

fn has_moved(robots: &[Robot], torsos_to_field: &[Isometry3<f64>]) -> bool {
    robots.iter().zip(torsos_to_field).any(|(robot, torso)| {
        let is_at = &robot.torso_to_field;
        let moved = (is_at.translation.vector - torso.translation.vector).norm();
        // A metre away from the torso a turn moves as much.
        moved > STILL || is_at.rotation.angle_to(&torso.rotation) > STILL
    })
}

fn intrinsics() -> Intrinsics {
    let size = Vector2::from(IMAGE_SIZE.map(f64::from));
    Intrinsics {
        focal: Vector2::from(FOCAL_LENGTH).component_mul(&size).cast(),
        center: Vector2::from(OPTICAL_CENTER).component_mul(&size).cast(),
    }
}

#[cfg(test)]
mod tests {
    use framework::math;

    use super::*;

    fn sample(robot_pose: [f64; 3], millis: u64) -> SensorData {
        let settings = Settings {
            robot_pose,
            ..Settings::default()
        };
        let mut world = World::new(&settings);
        world.advance_to(Timestamp::ZERO + Duration::from_millis(millis));
        world.sample(0)
    }

    #[test]
    fn the_sensors_hear_a_goal_post_and_feel_the_chest_button() {
        let sensors = sample([4.0, 0.8, 0.0], 600);
        for distance in [sensors.sonar.left, sensors.sonar.right] {
            assert!((0.4..0.52).contains(&distance), "{distance}");
        }
        assert!(sensors.touch.chest_button);
        let sensors = sample([0.0, 0.0, 0.0], 2600);
        assert_eq!(
            (sensors.sonar.left, sensors.sonar.right),
            (NO_ECHO, NO_ECHO)
        );
        assert!(!sensors.touch.chest_button);
    }

    #[test]
    fn a_late_command_is_obeyed_late_and_a_joint_with_play_stops_short() {
        let turned = |imperfections: crate::settings::Imperfections| {
            let mut world = World::new(&Settings {
                physics: PhysicsChoice::Kinematic,
                imperfections,
                ..Settings::default()
            });
            let start = f64::from(world.sample(0).positions.left_hip_roll);
            let mut commands = *world.commands(0);
            commands.stiffnesses = types::joints::Joints::filled(1.0);
            commands.positions.left_hip_roll += 0.03;
            let states = (1..=4).map(|tick| {
                world.advance_to(Timestamp::ZERO + Duration::from_millis(12 * tick));
                let position = f64::from(world.sample(0).positions.left_hip_roll);
                world.command(0, commands);
                position - start
            });
            states.collect::<Vec<_>>()
        };
        let ideal = turned(crate::settings::Imperfections::default());
        assert!(
            ideal[0].abs() < 1e-6 && (ideal[1] - 0.03).abs() < 1e-4,
            "{ideal:?}"
        );
        let late = turned(crate::settings::Imperfections {
            command_delay: 1,
            ..Default::default()
        });
        assert!(
            late[1].abs() < 1e-6 && (late[2] - 0.03).abs() < 1e-4,
            "{late:?}"
        );
        let loose = turned(crate::settings::Imperfections {
            backlash: 0.02,
            ..Default::default()
        });
        assert!((loose[3] - 0.02).abs() < 1e-4, "{loose:?}");
    }

    #[test]
    fn sensors_are_as_wrong_as_their_seed_says() {
        let readings = |seed: Option<u64>| {
            let imperfections = seed.map(crate::settings::Imperfections::of_a_nao);
            let mut world = World::new(&Settings {
                physics: PhysicsChoice::Kinematic,
                imperfections: imperfections.unwrap_or_default(),
                ..Settings::default()
            });
            let samples = (1..=400).map(|tick| {
                world.advance_to(Timestamp::ZERO + Duration::from_millis(12 * tick));
                world.sample(0).inertial.gyroscope.y
            });
            samples.collect::<Vec<_>>()
        };
        assert!(readings(None).iter().all(|turn| turn.abs() < 1e-6));
        let noisy = readings(Some(1));
        assert_eq!(noisy, readings(Some(1)));
        assert_ne!(noisy, readings(Some(2)));
        let mean = noisy.iter().sum::<f32>() / 400.0;
        let deviation = noisy
            .iter()
            .map(|turn| math::powi(turn - mean, 2))
            .sum::<f32>()
            / 400.0;
        // One standard deviation of the gyroscope's y axis, and its bias.
        assert!((deviation.sqrt() - 0.0055).abs() < 0.001, "{deviation}");
        assert!(mean.abs() > 1e-3 && mean.abs() < 0.035, "{mean}");
    }

    #[test]
    fn a_stiff_robot_runs_down() {
        let mut world = World::new(&Settings {
            // A minute passes.
            physics: PhysicsChoice::Kinematic,
            ..Settings::default()
        });
        let before = world.sample(0);
        assert_eq!(before.currents.head_yaw, 0.0);
        let mut commands = *world.commands(0);
        commands.stiffnesses = types::joints::Joints::filled(1.0);
        world.command(0, commands);
        world.advance_to(Timestamp::ZERO + Duration::from_secs(60));
        let after = world.sample(0);
        assert!(after.battery.charge < before.battery.charge);
        assert!(after.battery.current < before.battery.current);
        assert!(after.temperatures.head_yaw > before.temperatures.head_yaw);
        assert!(after.currents.head_yaw > 0.0);
        assert_eq!(after.status.head_yaw, 0);
    }
}
