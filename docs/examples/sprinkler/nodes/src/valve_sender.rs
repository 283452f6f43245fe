//! Moves the valve, and never as nobody decided.

use framework::{HardwareInterface, RequiredInput, Result, context};
use serde::{Deserialize, Serialize};

use crate::Valve;

/// Keeps nothing between cycles.
#[derive(Debug, Deserialize, Serialize)]
pub struct ValveSender {}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    hardware_interface: HardwareInterface,
    valve: RequiredInput<Option<bool>, "valve?">,
}

#[context]
pub struct MainOutputs {}

impl ValveSender {
    /// Nothing to prepare.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self {})
    }

    /// Called only where somebody decided.
    pub fn cycle(&mut self, context: CycleContext<impl Valve>) -> Result<MainOutputs> {
        context.hardware_interface.write_valve(*context.valve)?;
        Ok(MainOutputs {})
    }
}
