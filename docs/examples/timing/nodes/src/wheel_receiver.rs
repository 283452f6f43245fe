//! Waits for the next sample of the wheels.

use framework::{CaptureTime, HardwareInterface, MainOutput, Result, context};
use serde::{Deserialize, Serialize};

use crate::interfaces::Odometer;
use crate::types::Measurement;

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
    measurement: MainOutput<Measurement>,
    captured_at: CaptureTime,
}

impl WheelReceiver {
    /// Nothing to prepare.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self {})
    }

    /// The cycle is about the moment of the sample.
    pub fn cycle(&mut self, context: CycleContext<impl Odometer>) -> Result<MainOutputs> {
        let (captured_at, distance) = context.hardware_interface.read_wheels()?;
        Ok(MainOutputs {
            measurement: Measurement::Moved(distance).into(),
            captured_at: captured_at.into(),
        })
    }
}
