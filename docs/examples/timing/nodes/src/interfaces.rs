//! What nodes ask of the hardware.

use framework::{Result, Timestamp};

/// Looks at the mark at the end of the rail.
pub trait Camera {
    /// Waits for the next image: when it was exposed, and the metres to the mark that it shows.
    fn read_image(&self) -> Result<(Timestamp, f32)>;
}

/// Feels the wheels.
pub trait Odometer {
    /// Waits for the next sample: when it was taken, and the metres that the wheels rolled since the one before.
    fn read_wheels(&self) -> Result<(Timestamp, f32)>;
}

/// Hears a team mate.
pub trait Radio {
    /// Waits for the next message: when it came, and where the team mate sees the robot, metres from the start.
    fn read_message(&self) -> Result<(Timestamp, f32)>;
}

/// Says when it is time to decide something.
pub trait Pace {
    /// Waits for that moment.
    fn read_pace(&self) -> Result<Timestamp>;
}

/// Stands for a long computation.
pub trait Effort {
    /// Takes so many seconds; in lockstep the manifest's `lockstep_duration` does.
    fn take(&self, seconds: f32) -> Result<()>;
}

/// Shows people what happens.
pub trait Console {
    /// One line.
    fn print(&self, line: &str) -> Result<()>;
}
