//! What nodes ask of the hardware, be it a room in memory or a rover on the floor.

use framework::{Result, Timestamp};

use crate::types::{Rolled, Scan, Speeds};

/// Looks around.
pub trait Lidar {
    /// Waits for the next turn, writes it into `scan`, and says when it was taken.
    fn read_scan(&self, scan: &mut Scan) -> Result<Timestamp>;
}

/// Feels the wheels.
pub trait Encoders {
    /// Waits for the next sample: when it was taken, and how far the wheels rolled since the one before.
    fn read_wheels(&self) -> Result<(Timestamp, Rolled)>;
}

/// Turns the wheels.
pub trait Motors {
    /// The speeds to reach.
    fn write_speeds(&self, speeds: Speeds) -> Result<()>;
}
