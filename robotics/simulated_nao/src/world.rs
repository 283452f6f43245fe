//! The simulated world at one moment: the robot's body, its motors and cameras, and the ball.

mod imperfections;
mod inertial;
mod motor_boards;
mod power;
mod sensors;
mod sonar;
mod touch;
mod way;

use std::sync::Arc;
use std::time::Duration;

use framework::Timestamp;
use kinematics::cameras::{
    FOCAL_LENGTH, IMAGE_SIZE, OPTICAL_CENTER, camera_to_head, optical_to_camera,
};
use kinematics::forward_kinematics;
use kinematics::links::LinkName;
use nalgebra::{Isometry3, Point2, Point3, Vector2};
use types::camera::{CameraPosition, Intrinsics};
use types::motor_commands::MotorCommands;
use types::sensor_data::{RobotConfiguration, SensorData, Touch};

use self::imperfections::Imperfections;
use self::inertial::InertialUnit;
use self::motor_boards::MotorBoards;
use self::power::Power;
pub(crate) use self::sonar::NO_ECHO;
use self::way::Way;
use crate::camera::{Exposure, OwnBody};
use crate::field::Field;
use crate::physics::{Body, Disturbance, Dynamic, Kinematic, Physics, STEP, Situation, Start};
use crate::posture;
use crate::scene::{self, ImageSettings, Robot, RobotSettings};
use crate::settings::{PhysicsChoice, Press, Settings};

/// From exposure to the arrival of the image.
pub(crate) const IMAGE_LATENCY: Duration = Duration::from_millis(25);

/// Everything that moves, at the time `now`.
pub(crate) struct World {
    pub(crate) field: Arc<Field>,
    now: Timestamp,
    physics: Box<dyn Physics>,
    /// When the last step of the physics was.
    stepped: Timestamp,
    way: Way,
    inertial: InertialUnit,
    imperfections: Imperfections,
    motors: MotorBoards,
    power: Power,
    presses: Vec<Press>,
    configuration: RobotConfiguration,
    others: Vec<RobotSettings>,
    /// The others where they are now.
    robots: Arc<[Robot]>,
    images: ImageSettings,
}

impl World {
    pub(crate) fn new(settings: &Settings) -> Self {
        let situation = situation(settings);
        let physics: Box<dyn Physics> = match settings.physics {
            PhysicsChoice::Dynamic => Box::new(Dynamic::new(&situation)),
            PhysicsChoice::Kinematic => Box::new(Kinematic::new(&situation)),
        };
        let joints = posture::sitting();
        Self {
            field: Arc::default(),
            now: Timestamp::ZERO,
            stepped: Timestamp::ZERO,
            way: Way::new(place(&physics.bodies()[0])),
            inertial: InertialUnit::default(),
            imperfections: Imperfections::new(&settings.imperfections),
            motors: MotorBoards::new(&joints),
            power: Power::new(),
            presses: settings.buttons.clone(),
            configuration: settings.configuration(),
            others: settings.robots.clone(),
            robots: robots(&settings.robots, physics.bystanders()),
            images: settings.images,
            physics,
        }
    }

    pub(crate) fn now(&self) -> Timestamp {
        self.now
    }

    pub(crate) fn body(&self) -> &Body {
        &self.physics.bodies()[0]
    }

    /// What the motors were told last.
    pub(crate) fn commands(&self) -> &MotorCommands {
        self.motors.commands()
    }

    pub(crate) fn ball(&self) -> Option<Point3<f64>> {
        self.physics.ball().map(|ball| ball.position)
    }

    /// How far the robot has gone over the floor, m.
    pub(crate) fn walked(&self) -> f64 {
        self.way.length()
    }

    pub(crate) fn robots(&self) -> &[Robot] {
        &self.robots
    }

    /// What the robot can run into: the middle of each obstacle in the field frame and its radius, m.
    pub(crate) fn obstacles(&self) -> impl Iterator<Item = (Point2<f64>, f64)> + Clone {
        scene::obstacles(&self.robots)
    }

    /// Lets time pass; a time that is over already changes nothing.
    pub(crate) fn advance_to(&mut self, time: Timestamp) {
        if time <= self.now {
            return;
        }
        // On a grid of its own, so that the body does not depend on who looks at it when.
        while self.stepped + STEP <= time {
            self.stepped = self.stepped + STEP;
            let mut commands = self.motors.at(self.stepped);
            self.imperfections
                .push(&mut commands, &self.physics.bodies()[0].joints);
            self.physics.step(&[commands]);
            self.inertial.measure(&self.physics.bodies()[0]);
        }
        if has_moved(&self.robots, self.physics.bystanders()) {
            self.robots = robots(&self.others, self.physics.bystanders());
        }
        self.power
            .advance(time - self.now, &self.motors.commands().stiffnesses);
        self.now = time;
        self.way.go(time, place(self.body()));
    }

    /// Leaves out the time until `time`: nothing moves.
    pub(crate) fn skip_to(&mut self, time: Timestamp) {
        self.now = self.now.max(time);
        self.stepped = self.stepped.max(time);
    }

    /// Does to the world what no motor does.
    pub(crate) fn disturb(&mut self, disturbance: &Disturbance) {
        self.physics.disturb(disturbance);
        if let Disturbance::Kidnap { robot: 0, .. } = disturbance {
            let place = place(self.body());
            self.way.carry(place);
        }
    }

    /// Somebody presses a button.
    pub(crate) fn press(&mut self, press: Press) {
        self.presses.push(press);
    }

    /// Tells the motors what to do from now on.
    pub(crate) fn command(&mut self, commands: MotorCommands) {
        if let Some(commands) = self.imperfections.delay(commands) {
            self.motors
                .command(commands, &self.physics.bodies()[0].joints, self.now);
        }
    }

    /// Reads all sensors of the body.
    pub(crate) fn sample(&mut self) -> SensorData {
        let inertial = self.inertial.take(&self.physics.bodies()[0]);
        let (body, commands) = (self.body(), self.commands());
        let stiffnesses = commands.stiffnesses;
        let mut sensors = SensorData {
            currents: power::currents(&body.joints, commands),
            temperatures: self.power.temperatures(),
            status: self.power.status(),
            touch: self.touch(),
            sonar: sonar::echoes(&body.torso_to_field, self.obstacles()),
            battery: self.power.battery(&stiffnesses),
            ..sensors::sample(body, inertial, stiffnesses, self.configuration)
        };
        self.imperfections.spoil(&mut sensors);
        sensors
    }

    /// Everything that is pressed now.
    pub(crate) fn touch(&self) -> Touch {
        touch::touch(&self.presses, self.now)
    }

    /// Takes what an image of one camera depends on.
    pub(crate) fn expose(&self, camera: CameraPosition, number: u64) -> Exposure {
        Exposure {
            number,
            captured_at: self.now,
            ready_at: self.now + IMAGE_LATENCY,
            camera_to_field: self.camera_to_field(camera),
            ground_to_field: self.body().ground_to_field().cast(),
            intrinsics: intrinsics(),
            ball: self.ball().map(|ball| ball.cast()),
            robots: Arc::clone(&self.robots),
            body: Some(OwnBody {
                joints: self.body().joints.map(|angle| angle as f32),
                torso_to_field: self.body().torso_to_field.cast(),
            }),
            images: self.images,
        }
    }

    fn camera_to_field(&self, camera: CameraPosition) -> Isometry3<f32> {
        let body = self.body();
        let head = forward_kinematics(&body.joints).link(LinkName::Head);
        let camera_to_field =
            body.torso_to_field * head * camera_to_head::<f64>(camera) * optical_to_camera::<f64>();
        camera_to_field.cast()
    }
}

/// Nearer than this, m, a bystander is where it was: a body at rest trembles less.
const STILL: f64 = 1e-4;

/// Midway between its soles, in the field frame, m.
fn place(body: &Body) -> Point2<f64> {
    body.ground_to_field().translation.vector.xy().into()
}

/// What the settings put on the field; the robot sits and waits.
fn situation(settings: &Settings) -> Situation {
    let others = settings.robots.iter();
    Situation {
        robots: vec![Start {
            joints: posture::sitting(),
            pose: settings.robot_pose,
        }],
        bystanders: others.map(RobotSettings::start).collect(),
        ball: settings.ball_position(),
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
    use super::*;

    fn sample(robot_pose: [f64; 3], millis: u64) -> SensorData {
        let settings = Settings {
            robot_pose,
            ..Settings::default()
        };
        let mut world = World::new(&settings);
        world.advance_to(Timestamp::ZERO + Duration::from_millis(millis));
        world.sample()
    }

    #[test]
    fn the_sensors_hear_a_goal_post_and_feel_the_chest_button() {
        let sensors = sample([4.0, 0.8, 0.0], 600);
        for distance in [sensors.sonar.left, sensors.sonar.right] {
            assert!((0.4..0.52).contains(&distance), "{distance}");
        }
        assert!(sensors.touch.chest_button);
        let sensors = sample([0.0, 0.0, 0.0], 800);
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
            let start = f64::from(world.sample().positions.left_hip_roll);
            let mut commands = *world.commands();
            commands.stiffnesses = types::joints::Joints::filled(1.0);
            commands.positions.left_hip_roll += 0.03;
            let states = (1..=4).map(|tick| {
                world.advance_to(Timestamp::ZERO + Duration::from_millis(12 * tick));
                let position = f64::from(world.sample().positions.left_hip_roll);
                world.command(commands);
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
                world.sample().inertial.gyroscope.y
            });
            samples.collect::<Vec<_>>()
        };
        assert!(readings(None).iter().all(|turn| turn.abs() < 1e-6));
        let noisy = readings(Some(1));
        assert_eq!(noisy, readings(Some(1)));
        assert_ne!(noisy, readings(Some(2)));
        let mean = noisy.iter().sum::<f32>() / 400.0;
        let deviation = noisy.iter().map(|turn| (turn - mean).powi(2)).sum::<f32>() / 400.0;
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
        let before = world.sample();
        assert_eq!(before.currents.head_yaw, 0.0);
        let mut commands = *world.commands();
        commands.stiffnesses = types::joints::Joints::filled(1.0);
        world.command(commands);
        world.advance_to(Timestamp::ZERO + Duration::from_secs(60));
        let after = world.sample();
        assert!(after.battery.charge < before.battery.charge);
        assert!(after.battery.current < before.battery.current);
        assert!(after.temperatures.head_yaw > before.temperatures.head_yaw);
        assert!(after.currents.head_yaw > 0.0);
        assert_eq!(after.status.head_yaw, 0);
    }
}
