//! Swings both arms against each other.

use framework::{CycleTime, MainOutput, Parameter, Result, context};
use serde::{Deserialize, Serialize};

use crate::swing::swing;

/// Has nothing to remember.
#[derive(Debug, Deserialize, Serialize)]
pub struct Wave {}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    cycle_time: CycleTime,
    #[reflect(unit = "rad")]
    amplitude: Parameter<f32, "wave.amplitude">,
    #[reflect(unit = "s", range = 0.1..)]
    period: Parameter<f32, "wave.period">,
}

#[context]
pub struct MainOutputs {
    arm_pitch: MainOutput<Option<f32>>,
}

impl Wave {
    /// Never fails.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self {})
    }

    /// How far the left arm swings; the right one the other way, rad.
    pub fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs> {
        let arm_pitch = swing(&context.cycle_time, *context.amplitude, *context.period);
        Ok(MainOutputs {
            arm_pitch: Some(arm_pitch).into(),
        })
    }
}
