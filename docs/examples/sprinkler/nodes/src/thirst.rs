//! Says how much water the bed lacks.

use framework::{Input, LatestInput, MainOutput, Parameter, Result, context};
use serde::{Deserialize, Serialize};

/// Keeps nothing between cycles.
#[derive(Debug, Deserialize, Serialize)]
pub struct Thirst {}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    moisture: Input<f32, "moisture">,
    rain: LatestInput<f32, "Weather", "mean_rain">,
    /// Moisture of the soil.
    wanted: Parameter<f32, "thirst.wanted">,
    /// mm/h; then nothing lacks.
    enough_rain: Parameter<f32, "thirst.enough_rain">,
}

#[context]
pub struct MainOutputs {
    /// What the moisture lacks; below 0 it is too wet.
    thirst: MainOutput<f32>,
}

impl Thirst {
    /// Nothing to prepare.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self {})
    }

    /// Rain does it for nothing.
    pub fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs> {
        let rains = context
            .rain
            .is_some_and(|rain| *rain.value >= *context.enough_rain);
        let lack = context.wanted - context.moisture;
        Ok(MainOutputs {
            thirst: if rains { lack.min(0.0) } else { lack }.into(),
        })
    }
}
