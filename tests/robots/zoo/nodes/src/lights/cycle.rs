//! A node without any field at all. Its name is that of a function of generated code.

use framework::{Result, context};
use serde::{Deserialize, Serialize};

#[derive(Deserialize, Serialize)]
pub struct Cycle {
    cycles: u64,
}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {}

#[context]
pub struct MainOutputs {}

impl Cycle {
    pub fn new(_: CreationContext) -> Result<Self> {
        Ok(Self { cycles: 0 })
    }

    pub fn cycle(&mut self, _: CycleContext) -> Result<MainOutputs> {
        self.cycles += 1;
        Ok(MainOutputs {})
    }
}
