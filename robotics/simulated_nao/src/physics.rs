//! The seam to physics: what moves the robot's body when its motors are told to turn.

mod kinematic;

pub use kinematic::Kinematic;

use std::time::Duration;

use nalgebra::{Isometry3, Point3};
use types::feet::Feet;
use types::joints::Joints;
use types::motor_commands::MotorCommands;

/// Moves the body through time. The same calls give the same bits.
pub trait Physics: Send {
    /// Lets `duration` pass while the motors are driven to `commands`.
    fn advance(&mut self, duration: Duration, commands: &MotorCommands) -> &Body;

    /// The body as the last `advance` left it.
    fn body(&self) -> &Body;
}

/// The state of the robot's body.
#[derive(Clone, Copy, Debug)]
pub struct Body {
    /// Angles in rad; hands from 0 to 1.
    pub joints: Joints<f64>,
    /// From the torso frame to the field frame.
    pub torso_to_field: Isometry3<f64>,
    /// From the sole frames to the field frame.
    pub soles_to_field: Feet<Isometry3<f64>>,
    /// Centre of mass in the field frame, m.
    pub center_of_mass: Point3<f64>,
    /// Vertical forces on the resistors front left, front right, rear left, rear right, in N.
    pub contact_forces: Feet<[f64; 4]>,
}

impl Body {
    /// The ground frame in the field frame: on the floor midway between the soles, x along the
    /// heading of the torso.
    pub fn ground_to_field(&self) -> Isometry3<f64> {
        let Feet { left, right } = &self.soles_to_field;
        let middle = (left.translation.vector + right.translation.vector) / 2.0;
        planar(middle.x, middle.y, heading(&self.torso_to_field))
    }
}

/// A pose on the floor.
pub(crate) fn planar(x: f64, y: f64, heading: f64) -> Isometry3<f64> {
    Isometry3::new(
        nalgebra::Vector3::new(x, y, 0.0),
        nalgebra::Vector3::z() * heading,
    )
}

/// The direction of a frame's x axis on the floor, in rad.
pub(crate) fn heading(pose: &Isometry3<f64>) -> f64 {
    let forward = pose.rotation * nalgebra::Vector3::x();
    forward.y.atan2(forward.x)
}
