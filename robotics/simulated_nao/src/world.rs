//! The simulated world at one moment: the robot's body, its motors and cameras, and the ball.

mod motor_boards;
mod sensors;

use std::sync::Arc;
use std::time::Duration;

use framework::Timestamp;
use kinematics::cameras::{
    FOCAL_LENGTH, IMAGE_SIZE, OPTICAL_CENTER, camera_to_head, optical_to_camera,
};
use kinematics::forward_kinematics;
use kinematics::links::LinkName;
use nalgebra::{Isometry3, Point3, UnitQuaternion, Vector2, Vector3};
use types::camera::{CameraPosition, Intrinsics};
use types::motor_commands::MotorCommands;
use types::sensor_data::{RobotConfiguration, SensorData};

use self::motor_boards::MotorBoards;
use crate::camera::Exposure;
use crate::field::{BALL_RADIUS, Field};
use crate::physics::{Body, Kinematic, Physics};
use crate::posture;
use crate::settings::Settings;

/// From exposure to the arrival of the image.
pub(crate) const IMAGE_LATENCY: Duration = Duration::from_millis(25);

/// Everything that moves, at the time `now`.
pub(crate) struct World {
    pub(crate) field: Arc<Field>,
    now: Timestamp,
    physics: Box<dyn Physics>,
    motors: MotorBoards,
    configuration: RobotConfiguration,
    /// Centre of the ball in the field frame.
    ball: Option<Point3<f64>>,
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
            configuration: settings.configuration(),
            ball: settings
                .ball_position()
                .map(|[x, y]| Point3::new(x, y, radius)),
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

    /// Lets time pass; a time that is over already changes nothing.
    pub(crate) fn advance_to(&mut self, time: Timestamp) {
        if time > self.now {
            self.physics.advance(time - self.now, &self.motors.at(time));
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
        let stiffnesses = self.commands().stiffnesses;
        sensors::sample(self.body(), gyroscope, stiffnesses, self.configuration)
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
