//! Waits for the next horn.

use framework::{CaptureTime, HardwareInterface, MainOutput, Result, context};
use serde::{Deserialize, Serialize};

use crate::interfaces::EarInterface;
use crate::types::Echo;

/// Has nothing to remember.
#[derive(Debug, Deserialize, Serialize)]
pub struct Ear {}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    hardware_interface: HardwareInterface,
}

#[context]
pub struct MainOutputs {
    echo: MainOutput<Echo>,
    heard_at: CaptureTime,
}

impl Ear {
    /// Never fails.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self {})
    }

    /// The cycle is about the moment of the horn.
    pub fn cycle(&mut self, context: CycleContext<impl EarInterface>) -> Result<MainOutputs> {
        let (at, echo) = context.hardware_interface.read_echo()?;
        Ok(MainOutputs {
            echo: echo.into(),
            heard_at: at.into(),
        })
    }
}
