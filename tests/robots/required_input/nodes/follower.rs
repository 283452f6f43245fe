use framework::{MainOutput, RequiredInput, context, Result};
use serde::{Deserialize, Serialize};

#[derive(Deserialize, Serialize)]
pub struct Follower;

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    found: RequiredInput<Option<u8>, "found?">,
}

#[context]
pub struct MainOutputs {
    next: MainOutput<u8>,
}

impl Follower {
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self)
    }

    pub fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs> {
        Ok(MainOutputs { next: context.found.wrapping_add(1).into() })
    }
}
