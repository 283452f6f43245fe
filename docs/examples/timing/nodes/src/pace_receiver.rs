//! Waits until it is time to know where the robot is.

use framework::{CaptureTime, HardwareInterface, Result, context};
use serde::{Deserialize, Serialize};

use crate::interfaces::Pace;

/// Keeps nothing between cycles.
#[derive(Debug, Deserialize, Serialize)]
pub struct PaceReceiver {}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    hardware_interface: HardwareInterface,
}

#[context]
pub struct MainOutputs {
    captured_at: CaptureTime,
}

impl PaceReceiver {
    /// Nothing to prepare.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self {})
    }

    /// That moment is t0 of the cycle.
    pub fn cycle(&mut self, context: CycleContext<impl Pace>) -> Result<MainOutputs> {
        let captured_at = context.hardware_interface.read_pace()?;
        Ok(MainOutputs {
            captured_at: captured_at.into(),
        })
    }
}
