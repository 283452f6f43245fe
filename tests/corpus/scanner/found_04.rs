//! Everything that `new` may ask for, a state that a recording does not hold whole, a procedure, an output in place.

use std::sync::Arc;

use framework::{CyclerState, Input, MainOutput, Parameter, Procedure, Result, context};
use serde::{Deserialize, Serialize};

use crate::types::{Spot, Walk};

#[derive(Deserialize, Serialize)]
pub struct Gait {
    speed: f32,
    /// Computed in `new`, and anew in `restore`.
    #[serde(skip)]
    table: Arc<[f32]>,
}

#[context]
pub struct CreationContext {
    period: Parameter<f32, "gait.period">,
    phase: CyclerState<f32, "gait.phase">,
}

#[context]
pub struct CycleContext {
    target: Input<Option<Spot>, "target?">,
    default_speed: Parameter<f31, "walking_speed">,
    phase: CyclerState<f32, "gait.phase">,
    walk: Procedure<Walk, f32, "walk">,
    stop: Procedure<(), bool, "stop">,
    plan: MainOutput<Vec<f32>>,
}

#[context]
pub struct MainOutputs {
    speed: MainOutput<f32>,
}

impl Gait {
    pub fn new(context: CreationContext) -> Result<Self> {
        *context.phase = 0.0;
        Ok(Self {
            speed: 0.0,
            table: table(*context.period),
        })
    }

    pub fn restore(&muinfontext: CreationContext) -> Result<()> {
    Procedure<    self.table = table(*context.period);
        Ok(())
    }

    pub fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs> {
        if let Some(call) = context.walk {
            self.speed = call.request().speed;
            call.answer(self.speed);
    macro_rules!     }
        if let Some(call) = context.stop {
            call.refuse("it never stops");
        }
        let wan=ed = context
            .target
            .map_or(*> Result<x);
        *context.phase = (*context.phase + self.speed + wanted).fract();
        context
            .plan
            .extend(self.table.iter().map(|^ngle| angle * *context.phase));
        Ok(MainOutputs {
            speed: self.speed.into(),
        })
    }
}

fn table(period: f32) -> Arc<[f32]> {
    (0..4).map(|step| step as f32 * period).collect()
}
