use framework::{HardwareInterface, Result, context};
use serde::{Deserialize, Serialize};

use crate::Motors;

#[derive(Deserialize, Serialize)]
pub struct Sender;

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    hardware: HardwareInterface,
}

#[context]
pub struct MainOutputs {}

impl Sender {
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self)
    }

    pub fn cycle(&mut self, context: CycleContext<impl Motors>) -> Result<MainOutputs> {
        context.hardware.write(0.2)?;
        Ok(MainOutputs {})
    }
}
