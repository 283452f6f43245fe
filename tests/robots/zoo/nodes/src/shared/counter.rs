//! The same node in several cyclers, each with a state of its own.

use framework::{CyclerState, MainOutput, Result, context};
use serde::{Deserialize, Serialize};

#[derive(Deserialize, Serialize)]
pub struct Counter;

#[context]
pub struct CreationContext {
    count: CyclerState<u64, "count">,
}

#[context]
pub struct CycleContext {
    count: CyclerState<u64, "count">,
}

#[context]
pub struct MainOutputs {
    cycles: MainOutput<u64>,
}

impl Counter {
    pub fn new(context: CreationContext) -> Result<Self> {
        *context.count = 100;
        Ok(Self)
    }

    pub fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs> {
        *context.count += 1;
        Ok(MainOutputs {
            cycles: (*context.count).into(),
        })
    }
}
