//! The simulated world at one moment: the robot's body, its motors and cameras, and the ball.

mod motor_boards;
mod power;
mod sensors;
mod sonar;
mod touch;

use std::sync::Arc;
use std::time::Duration;

use framework::Timestamp;
use kinematics::cameras::{
    FOCAL_LENGTH, IMAGE_SIZE, OPTICAL_CENTER, camera_to_head, optical_to_camera,
};
use kinematics::forward_kinematics;
use kinematics::links::LinkName;
use nalgebra::{Isometry3, Point2, Point3, UnitQuaternion, Vector2, Vector3};
use types::camera::{CameraPosition, Intrinsics};
use types::motor_commands::MotorCommands;
use types::sensor_data::{RobotConfiguration, SensorData, Touch};

use self::motor_boards::MotorBoards;
use self::power::Power;
pub(crate) use self::sonar::NO_ECHO;
use crate::camera::{Exposure, OwnBody};
use crate::field::{BALL_RADIUS, Field};
use crate::physics::{Body, Kinematic, Physics};
use crate::posture;
use crate::scene::{self, ImageSettings, Robot};
use crate::settings::{Press, Settings};

/// From exposure to the arrival of the image.
pub(crate) const IMAGE_LATENCY: Duration = Duration::from_millis(25);

/// Everything that moves, at the time `now`.
pub(crate) struct World {
    pub(crate) field: Arc<Field>,
    now: Timestamp,
    physics: Box<dyn Physics>,
    motors: MotorBoards,
    power: Power,
    presses: Vec<Press>,
    configuration: RobotConfiguration,
    /// Centre of the ball in the field frame.
    ball: Option<Point3<f64>>,
    /// The others; they stand still.
    robots: Arc<[Robot]>,
    images: ImageSettings,
    /// When the sensors were read last, and how the torso was turned then.
    last_sample: (Timestamp, UnitQuaternion<f64>),
}

impl World {
    pub(crate) fn new(settings: &Settings) -> Self {
        let physics = Kinematic::new(posture::sitting(), settings.robot_pose);
        let body = *physics.body();
        let radius = f64::from(BALL_RADIUS);
        Self {
            field: Arc::default(),
            now: Timestamp::ZERO,
            physics: Box::new(physics),
            motors: MotorBoards::new(&body.joints),
            power: Power::new(),
            presses: settings.buttons.clone(),
            configuration: settings.configuration(),
            ball: settings
                .ball_position()
                .map(|[x, y]| Point3::new(x, y, radius)),
            robots: settings.robots.iter().map(Robot::from).collect(),
            images: settings.images,
            last_sample: (Timestamp::ZERO, body.torso_to_field.rotation),
        }
    }

    pub(crate) fn now(&self) -> Timestamp {
        self.now
    }

    pub(crate) fn body(&self) -> &Body {
        self.physics.body()
    }

    /// What the motors were told last.
    pub(crate) fn commands(&self) -> &MotorCommands {
        self.motors.commands()
    }

    pub(crate) fn ball(&self) -> Option<Point3<f64>> {
        self.ball
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
        if time > self.now {
            let duration = time - self.now;
            self.physics.advance(duration, &self.motors.at(time));
            self.power
                .advance(duration, &self.motors.commands().stiffnesses);
            self.now = time;
        }
    }

    /// Tells the motors what to do from now on.
    pub(crate) fn command(&mut self, commands: MotorCommands) {
        self.motors
            .command(commands, &self.physics.body().joints, self.now);
    }

    /// Reads all sensors of the body.
    pub(crate) fn sample(&mut self) -> SensorData {
        let rotation = self.body().torso_to_field.rotation;
        let (time, before) = self.last_sample;
        let seconds = (self.now - time).as_secs_f64();
        let gyroscope = if seconds > 0.0 {
            (before.inverse() * rotation).scaled_axis() / seconds
        } else {
            Vector3::zeros()
        };
        self.last_sample = (self.now, rotation);
        let (body, commands) = (self.body(), self.commands());
        let stiffnesses = commands.stiffnesses;
        SensorData {
            currents: power::currents(&body.joints, commands),
            temperatures: self.power.temperatures(),
            status: self.power.status(),
            touch: self.touch(),
            sonar: sonar::echoes(&body.torso_to_field, self.obstacles()),
            battery: self.power.battery(&stiffnesses),
            ..sensors::sample(body, gyroscope, stiffnesses, self.configuration)
        }
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
            ball: self.ball.map(|ball| ball.cast()),
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
    fn a_stiff_robot_runs_down() {
        let mut world = World::new(&Settings::default());
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
