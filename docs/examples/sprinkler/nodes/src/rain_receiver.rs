//! Waits for the next measurement of the rain.

use framework::{CaptureTime, HardwareInterface, MainOutput, Result, context};
use serde::{Deserialize, Serialize};

use crate::RainGauge;

/// Keeps nothing between cycles.
#[derive(Debug, Deserialize, Serialize)]
pub struct RainReceiver {}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    hardware_interface: HardwareInterface,
}

#[context]
pub struct MainOutputs {
    /// mm/h.
    rain: MainOutput<f32>,
    captured_at: CaptureTime,
}

impl RainReceiver {
    /// Nothing to prepare.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self {})
    }

    /// Blocks until it is there.
    pub fn cycle(&mut self, context: CycleContext<impl RainGauge>) -> Result<MainOutputs> {
        let (captured_at, rain) = context.hardware_interface.read_rain()?;
        Ok(MainOutputs {
            rain: rain.into(),
            captured_at: captured_at.into(),
        })
    }
}
