//! Waits for the next sample of the motors.

use framework::{CaptureTime, HardwareInterface, MainOutput, Result, context};
use serde::{Deserialize, Serialize};

use crate::interfaces::BodyInterface;
use crate::types::Body;

/// Has nothing to remember.
#[derive(Debug, Deserialize, Serialize)]
pub struct BodyReceiver {}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    hardware_interface: HardwareInterface,
}

#[context]
pub struct MainOutputs {
    body: MainOutput<Body>,
    captured_at: CaptureTime,
}

impl BodyReceiver {
    /// Never fails.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self {})
    }

    /// The cycle is about the moment of the sample.
    pub fn cycle(&mut self, context: CycleContext<impl BodyInterface>) -> Result<MainOutputs> {
        let (at, body) = context.hardware_interface.read_body()?;
        Ok(MainOutputs {
            body: body.into(),
            captured_at: at.into(),
        })
    }
}
