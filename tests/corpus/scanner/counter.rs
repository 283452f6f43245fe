use framework::{MainOutput, context, Result};
use serde::{Deserialize, Serialize};

#[derive(Deserialize, Serialize)]
pub struct Counter;

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {}

#[context]
pub struct MainOutputs {
    count: MainOutput<u64>,
}

impl Counter {
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self)
    }

    pub fn cycle(&mut self, _context: CycleContext) -> Result<MainOutputs> {
        Ok(MainOutputs { count: 1.into() })
    }
}
