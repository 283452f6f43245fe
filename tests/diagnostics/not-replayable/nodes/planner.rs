use framework::{HardwareInterface, MainOutput, Result, context};
use serde::{Deserialize, Serialize};

use crate::Sensors;

#[derive(Deserialize, Serialize)]
pub struct Planner;

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    hardware: HardwareInterface,
}

#[context]
pub struct MainOutputs {
    speed: MainOutput<Option<f32>>,
}

impl Planner {
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self)
    }

    pub fn cycle(&mut self, context: CycleContext<impl Sensors>) -> Result<MainOutputs> {
        Ok(MainOutputs { speed: Some(context.hardware.read()?).into() })
    }
}
