use framework::{HardwareInterface, RequiredInput, Result, context};
use serde::{Deserialize, Serialize};

use crate::Motors;

#[derive(Deserialize, Serialize)]
pub struct Sender;

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    hardware: HardwareInterface,
    speed: RequiredInput<Option<f32>, "speed?">,
}

#[context]
pub struct MainOutputs {}

impl Sender {
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self)
    }

    pub fn cycle(&mut self, context: CycleContext<impl Motors>) -> Result<MainOutputs> {
        context.hardware.write(*context.speed)?;
        Ok(MainOutputs {})
    }
}
