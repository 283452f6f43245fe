//! A setup node without outputs: it only waits. Its name is that of a function of generated code.

use framework::{CyclerState, HardwareInterface, Result, context};
use serde::{Deserialize, Serialize};

use crate::interfaces::MetronomeInterface;

#[derive(Deserialize, Serialize)]
pub struct Setup;

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    hardware_interface: HardwareInterface,
    beat: CyclerState<u64, "beat">,
}

#[context]
pub struct MainOutputs {}

impl Setup {
    pub fn new(_: CreationContext) -> Result<Self> {
        Ok(Self)
    }

    pub fn cycle(&mut self, context: CycleContext<impl MetronomeInterface>) -> Result<MainOutputs> {
        *context.beat = context.hardware_interface.read_beat()?;
        Ok(MainOutputs {})
    }
}
