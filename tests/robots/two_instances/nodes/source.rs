use framework::{MainOutput, Parameter, context, Result};
use serde::{Deserialize, Serialize};

#[derive(Deserialize, Serialize)]
pub struct Source;

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    start: Parameter<f32, "$cycler_instance.start">,
}

#[context]
pub struct MainOutputs {
    value: MainOutput<f32>,
}

impl Source {
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self)
    }

    pub fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs> {
        Ok(MainOutputs { value: (*context.start).into() })
    }
}
