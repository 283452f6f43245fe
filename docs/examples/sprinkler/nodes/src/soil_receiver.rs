//! Waits for the next measurement of the soil.

use framework::{CaptureTime, HardwareInterface, MainOutput, Result, context};
use serde::{Deserialize, Serialize};

use crate::SoilProbe;

/// Keeps nothing between cycles.
#[derive(Debug, Deserialize, Serialize)]
pub struct SoilReceiver {}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    hardware_interface: HardwareInterface,
}

#[context]
pub struct MainOutputs {
    /// Between 0 (dust) and 1 (mud).
    moisture: MainOutput<f32>,
    captured_at: CaptureTime,
}

impl SoilReceiver {
    /// Nothing to prepare.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self {})
    }

    /// Blocks until it is there.
    pub fn cycle(&mut self, context: CycleContext<impl SoilProbe>) -> Result<MainOutputs> {
        let (captured_at, moisture) = context.hardware_interface.read_moisture()?;
        Ok(MainOutputs {
            moisture: moisture.into(),
            captured_at: captured_at.into(),
        })
    }
}
