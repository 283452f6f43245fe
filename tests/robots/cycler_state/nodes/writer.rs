use framework::{CyclerState, context, Result};
use serde::{Deserialize, Serialize};

#[derive(Deserialize, Serialize)]
pub struct Writer;

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    total: CyclerState<u64, "sums.total">,
}

#[context]
pub struct MainOutputs {}

impl Writer {
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self)
    }

    pub fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs> {
        *context.total += 1;
        Ok(MainOutputs {})
    }
}
