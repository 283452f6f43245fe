use framework::{MainOutput, Result, context};
use serde::{Deserialize, Serialize};

#[derive(Deserialize, Serialize)]
pub struct Detection;

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {}

#[context]
pub struct MainOutputs {
    distance: MainOutput<f32>,
}

impl Detection {
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self)
    }

    pub fn cycle(&mut self, _context: CycleContext) -> Result<MainOutputs> {
        Ok(MainOutputs { distance: 1.0.into() })
    }
}
