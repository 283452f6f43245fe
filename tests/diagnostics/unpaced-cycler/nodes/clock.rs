use framework::{HardwareInterface, MainOutput, Result, context};
use serde::{Deserialize, Serialize};

use crate::Beats;

#[derive(Deserialize, Serialize)]
pub struct Clock;

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    hardware: HardwareInterface,
}

#[context]
pub struct MainOutputs {
    beats: MainOutput<u32>,
}

impl Clock {
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self)
    }

    pub fn cycle(&mut self, context: CycleContext<impl Beats>) -> Result<MainOutputs> {
        Ok(MainOutputs { beats: context.hardware.wait()?.into() })
    }
}
