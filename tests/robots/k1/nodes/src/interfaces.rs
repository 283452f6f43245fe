//! What the nodes ask of a K1.

use framework::{Result, Timestamp};

use crate::types::{Body, MotorCommands};

/// Reads motors and trunk.
pub trait BodyInterface {
    /// Waits for the next sample and says when it was taken.
    fn read_body(&self) -> Result<(Timestamp, Body)>;
}

/// Commands the motors.
pub trait MotorInterface {
    /// Tells all motors what to do.
    fn write_motors(&self, commands: &MotorCommands) -> Result<()>;
}
