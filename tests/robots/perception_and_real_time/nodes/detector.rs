use framework::{Input, LatestInput, MainOutput, context, Result};
use serde::{Deserialize, Serialize};

#[derive(Deserialize, Serialize)]
pub struct Detector;

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    brightness: Input<u8, "brightness">,
    estimate: LatestInput<f32, "Control", "estimate">,
}

#[context]
pub struct MainOutputs {
    seen: MainOutput<Vec<f32>>,
}

impl Detector {
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self)
    }

    pub fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs> {
        let estimate = context.estimate.map_or(0.0, |latest| *latest.value);
        Ok(MainOutputs { seen: vec![estimate + f32::from(*context.brightness)].into() })
    }
}
