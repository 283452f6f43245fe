//! Turns the head to both sides.

use framework::{CycleTime, MainOutput, Parameter, Result, context};
use serde::{Deserialize, Serialize};

use crate::swing::swing;

/// Has nothing to remember.
#[derive(Debug, Deserialize, Serialize)]
pub struct LookAround {}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    cycle_time: CycleTime,
    #[reflect(unit = "rad")]
    amplitude: Parameter<f32, "look_around.amplitude">,
    #[reflect(unit = "s", range = 0.1..)]
    period: Parameter<f32, "look_around.period">,
}

#[context]
pub struct MainOutputs {
    head_yaw: MainOutput<Option<f32>>,
}

impl LookAround {
    /// Never fails.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self {})
    }

    /// Where the head shall look, rad.
    pub fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs> {
        let head_yaw = swing(&context.cycle_time, *context.amplitude, *context.period);
        Ok(MainOutputs {
            head_yaw: Some(head_yaw).into(),
        })
    }
}
