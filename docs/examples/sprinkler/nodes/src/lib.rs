//! The nodes of a sprinkler, and what they ask of the hardware.

use framework::{Result, Timestamp};

pub mod rain_mean;
pub mod rain_receiver;
pub mod soil_receiver;
pub mod thirst;
pub mod valve_choice;
pub mod valve_sender;

/// Looks at the sky.
pub trait RainGauge {
    /// Waits for the next measurement: when it was taken, and the rain in mm/h.
    fn read_rain(&self) -> Result<(Timestamp, f32)>;
}

/// Feels the soil.
pub trait SoilProbe {
    /// Waits for the next measurement: when it was taken, and the moisture between 0 and 1.
    fn read_moisture(&self) -> Result<(Timestamp, f32)>;
}

/// Lets water through.
pub trait Valve {
    /// Opens or closes it.
    fn write_valve(&self, is_open: bool) -> Result<()>;
}
