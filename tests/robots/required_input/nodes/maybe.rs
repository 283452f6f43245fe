use framework::{MainOutput, context, Result};
use serde::{Deserialize, Serialize};

#[derive(Deserialize, Serialize)]
pub struct Maybe;

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {}

#[context]
pub struct MainOutputs {
    found: MainOutput<Option<u8>>,
}

impl Maybe {
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self)
    }

    pub fn cycle(&mut self, _context: CycleContext) -> Result<MainOutputs> {
        Ok(MainOutputs { found: None.into() })
    }
}
