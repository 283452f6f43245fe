//! Smooths the rain, since single drops say little.

use framework::{Input, MainOutput, Parameter, Result, context};
use serde::{Deserialize, Serialize};

/// The mean so far, mm/h.
#[derive(Debug, Deserialize, Serialize)]
pub struct RainMean {
    mean: f32,
}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    rain: Input<f32, "rain">,
    /// Of each new value.
    share: Parameter<f32, "rain_mean.share">,
}

#[context]
pub struct MainOutputs {
    /// mm/h.
    mean_rain: MainOutput<f32>,
}

impl RainMean {
    /// It is dry until something falls.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self { mean: 0.0 })
    }

    /// A little of the new value, much of the old ones.
    pub fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs> {
        self.mean += context.share * (context.rain - self.mean);
        Ok(MainOutputs {
            mean_rain: self.mean.into(),
        })
    }
}
