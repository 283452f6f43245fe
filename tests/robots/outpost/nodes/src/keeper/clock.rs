//! Waits for the next stroke of the clock.

use framework::{CaptureTime, HardwareInterface, Result, context};
use serde::{Deserialize, Serialize};

use crate::interfaces::ClockInterface;

/// Has nothing to remember.
#[derive(Debug, Deserialize, Serialize)]
pub struct Clock {}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    hardware_interface: HardwareInterface,
}

#[context]
pub struct MainOutputs {
    struck_at: CaptureTime,
}

impl Clock {
    /// Never fails.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self {})
    }

    /// The cycle is about the moment of the stroke.
    pub fn cycle(&mut self, context: CycleContext<impl ClockInterface>) -> Result<MainOutputs> {
        let at = context.hardware_interface.read_stroke()?;
        Ok(MainOutputs {
            struck_at: at.into(),
        })
    }
}
