use framework::{AdditionalOutput, CyclerState, MainOutput, context, Result};
use serde::{Deserialize, Serialize};

#[derive(Deserialize, Serialize)]
pub struct Reader;

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    total: CyclerState<&u64, "sums.total">,
    trace: AdditionalOutput<Vec<u64>, "traces.total">,
}

#[context]
pub struct MainOutputs {
    even: MainOutput<bool>,
}

impl Reader {
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self)
    }

    pub fn cycle(&mut self, mut context: CycleContext) -> Result<MainOutputs> {
        context.trace.fill_if_subscribed(|| vec![*context.total]);
        Ok(MainOutputs { even: (*context.total % 2 == 0).into() })
    }
}
