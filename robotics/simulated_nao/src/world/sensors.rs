//! What the sensors of a body report.
//!
//! Without noise: a test that compares with the truth shows the error of what it tests.

use kinematics::inertial::GRAVITY;
use nalgebra::Vector3;
use types::joints::Joints;
use types::sensor_data::{Battery, InertialMeasurement, RobotConfiguration, SensorData, Sonar};

use crate::physics::Body;

/// Temperature of all motors, °C.
const TEMPERATURE: f32 = 38.0;
/// What the sonars report where nothing reflects, m.
const NO_ECHO: f32 = 5.0;
/// A full battery in use, as the published recording of a V6 has it.
const BATTERY: Battery = Battery {
    charge: 0.99,
    status: -32_552.0,
    current: -1.2,
    temperature: 36.0,
};

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
        temperatures: Joints::filled(TEMPERATURE),
        inertial: InertialMeasurement {
            gyroscope: gyroscope.cast(),
            accelerometer: upwards.cast(),
            roll: roll as f32,
            pitch: pitch as f32,
        },
        force_sensitive_resistors: body
            .contact_forces
            .map(|forces| forces.map(|force| (force / GRAVITY) as f32)),
        sonar: Sonar {
            left: NO_ECHO,
            right: NO_ECHO,
        },
        battery: BATTERY,
        configuration,
        ..SensorData::default()
    }
}
