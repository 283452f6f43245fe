//! Tells the motors this cycle's speeds, and never some that nobody decided on.

use framework::{HardwareInterface, RequiredInput, Result, context};
use serde::{Deserialize, Serialize};

use crate::interfaces::Motors;
use crate::types::Speeds;

/// Keeps nothing between cycles.
#[derive(Debug, Deserialize, Serialize)]
pub struct MotorSender {}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    hardware_interface: HardwareInterface,
    speeds: RequiredInput<Option<Speeds>, "speeds?">,
}

#[context]
pub struct MainOutputs {}

impl MotorSender {
    /// Nothing to prepare.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self {})
    }

    /// Called only where there are speeds.
    pub fn cycle(&mut self, context: CycleContext<impl Motors>) -> Result<MainOutputs> {
        context.hardware_interface.write_speeds(*context.speeds)?;
        Ok(MainOutputs {})
    }
}
