//! What the sensors of a body report about its posture.
//!
//! Without noise: a test that compares with the truth shows the error of what it tests.

use kinematics::inertial::GRAVITY;
use types::joints::Joints;
use types::sensor_data::{InertialMeasurement, RobotConfiguration, SensorData};

use super::inertial::Inertial;
use crate::physics::Body;

/// One sample.
pub(super) fn sample(
    body: &Body,
    inertial: Inertial,
    stiffnesses: Joints<f32>,
    configuration: RobotConfiguration,
) -> SensorData {
    let rotation = body.torso_to_field.rotation;
    let (roll, pitch, _) = rotation.euler_angles();
    SensorData {
        positions: body.joints.map(|angle| angle as f32),
        stiffnesses,
        inertial: InertialMeasurement {
            gyroscope: inertial.angular_velocity.cast(),
            accelerometer: inertial.proper_acceleration.cast(),
            roll: roll as f32,
            pitch: pitch as f32,
        },
        force_sensitive_resistors: body
            .contact_forces
            .map(|forces| forces.map(|force| (force / GRAVITY) as f32)),
        configuration,
        ..SensorData::default()
    }
}
