//! Waits for the next sample of the encoders: this cycle is about it.

use framework::{CaptureTime, HardwareInterface, MainOutput, Result, context};
use serde::{Deserialize, Serialize};

use crate::interfaces::Encoders;
use crate::types::Rolled;

/// Keeps nothing between cycles.
#[derive(Debug, Deserialize, Serialize)]
pub struct WheelReceiver {}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    hardware_interface: HardwareInterface,
}

#[context]
pub struct MainOutputs {
    rolled: MainOutput<Rolled>,
    captured_at: CaptureTime,
}

impl WheelReceiver {
    /// Nothing to prepare.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self {})
    }

    /// Blocks until the sample is there.
    pub fn cycle(&mut self, context: CycleContext<impl Encoders>) -> Result<MainOutputs> {
        let (captured_at, rolled) = context.hardware_interface.read_wheels()?;
        Ok(MainOutputs {
            rolled: rolled.into(),
            captured_at: captured_at.into(),
        })
    }
}
