//! What the nodes ask of their hardware.

use framework::{Result, Timestamp};

use crate::types::Echo;

/// Hears horns of ships; no hardware of the outpost has it.
pub trait EarInterface {
    /// Waits for the next horn and says when it was heard.
    fn read_echo(&self) -> Result<(Timestamp, Echo)>;
}

/// Strikes at a steady pace.
pub trait ClockInterface {
    /// Waits for the next stroke and says when it was.
    fn read_stroke(&self) -> Result<Timestamp>;
}
