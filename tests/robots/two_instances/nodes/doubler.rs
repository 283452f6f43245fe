use framework::{Input, MainOutput, context, Result};
use serde::{Deserialize, Serialize};

#[derive(Deserialize, Serialize)]
pub struct Doubler;

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    value: Input<f32, "value">,
}

#[context]
pub struct MainOutputs {
    doubled: MainOutput<f32>,
}

impl Doubler {
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self)
    }

    pub fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs> {
        Ok(MainOutputs { doubled: (2.0 * context.value).into() })
    }
}
