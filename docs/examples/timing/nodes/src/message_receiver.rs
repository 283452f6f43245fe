//! Waits for the next message of a team mate.

use framework::{CaptureTime, HardwareInterface, MainOutput, Result, context};
use serde::{Deserialize, Serialize};

use crate::interfaces::Radio;
use crate::types::Measurement;

/// Keeps nothing between cycles.
#[derive(Debug, Deserialize, Serialize)]
pub struct MessageReceiver {}

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

impl MessageReceiver {
    /// Nothing to prepare.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self {})
    }

    /// The cycle is about the moment when the message came.
    pub fn cycle(&mut self, context: CycleContext<impl Radio>) -> Result<MainOutputs> {
        let (captured_at, position) = context.hardware_interface.read_message()?;
        Ok(MainOutputs {
            measurement: Measurement::Told(position).into(),
            captured_at: captured_at.into(),
        })
    }
}
