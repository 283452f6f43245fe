use framework::{CycleTime, MainOutput, context, Result};
use serde::{Deserialize, Serialize};

#[derive(Deserialize, Serialize)]
pub struct Pace;

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    time: CycleTime,
}

#[context]
pub struct MainOutputs {
    raw: MainOutput<f32>,
}

impl Pace {
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self)
    }

    pub fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs> {
        Ok(MainOutputs { raw: context.time.since_last.as_secs_f32().into() })
    }
}
