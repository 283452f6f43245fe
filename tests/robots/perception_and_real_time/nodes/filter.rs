use framework::{HistoricInput, MainOutput, PerceptionInput, PreviousInput, context, Result};
use serde::{Deserialize, Serialize};

#[derive(Deserialize, Serialize)]
pub struct Filter;

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    seen: PerceptionInput<Vec<f32>, "Vision", "seen">,
    past: HistoricInput<f32, "raw">,
    before: PreviousInput<f32, "estimate">,
}

#[context]
pub struct MainOutputs {
    estimate: MainOutput<f32>,
}

impl Filter {
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self)
    }

    pub fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs> {
        let mut estimate = *context.before + context.past.iter().map(|(_, raw)| raw).sum::<f32>();
        for (_, seen) in context.seen.persistent {
            estimate += seen.iter().sum::<f32>();
        }
        Ok(MainOutputs { estimate: estimate.into() })
    }
}
