use framework::{MainOutput, Parameter, Result, context};
use serde::{Deserialize, Serialize};

#[derive(Deserialize, Serialize)]
pub struct Planner;

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    speed: Parameter<f32, "planner.speed">,
}

#[context]
pub struct MainOutputs {
    speed: MainOutput<Option<f32>>,
}

impl Planner {
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self)
    }

    pub fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs> {
        Ok(MainOutputs { speed: Some(*context.speed).into() })
    }
}
