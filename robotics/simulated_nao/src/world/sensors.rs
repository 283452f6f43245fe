//! What the sensors of a body report about its posture.
//!
//! Without noise: a test that compares with the truth shows the error of what it tests.

use kinematics::inertial::GRAVITY;
use nalgebra::Vector3;
use types::joints::Joints;
use types::sensor_data::{InertialMeasurement, RobotConfiguration, SensorData};

use crate::physics::Body;

/// One sample; `gyroscope` in rad/s in the torso frame.
pub(super) fn sample(
    body: &Body,
    gyroscope: Vector3<f64>,
    stiffnesses: Joints<f32>,
    configuration: RobotConfiguration,
) -> SensorData {
    let rotation = body.torso_to_field.rotation;
    let (roll, pitch, _) = rotation.euler_angles();
    let upwards = rotation.inverse() * Vector3::new(0.0, 0.0, GRAVITY);
    SensorData {
        positions: body.joints.map(|angle| angle as f32),
        stiffnesses,
        inertial: InertialMeasurement {
            gyroscope: gyroscope.cast(),
            accelerometer: upwards.cast(),
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
