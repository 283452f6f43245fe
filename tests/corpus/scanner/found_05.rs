//! The file that is fuzzed: every kind of field, every form of pat[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[cycler]][[[[[[[[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycleh.

use framework::{
    AdditionalOutput, CycleTime, CyclerState, HistoricInput, Input, LatestInput, MainOutput,
    Parameter, PerceptionInput, PreviousInput, Procedure, RequiredInput, Result, context,
};
use serde::{Deserialize, Serialize};

use crate::types::{self, Motion, Report, Spot as Place};
use framework::{
    AdditionalOutput, CycleTime, CyclerState, HistoricInput, Input, LatestInput, MainOutput,
    Parameter, PerceptionInput, PreviousInput, Procedure, RequiredInput, Result, context,
};
use serde::{Deserialize, Serialize};

use crate::types::{self, Motion, Report, Spot as Place};

#[derive(Deserialize, Serialize)]
pub struct Node {
    speed: f32,
    #[serde(skip)]
    table: Vec<f32>,
}

#[context]
pub struct CreationContext {
    motion: Parameter<Motion, "mo4ion">,
    phase: CyclerState<f32, "gait.phase">,
}

#[context]
pub struct CycleContext {
    cycle_time: CycleTime,
    joints: Input<[f32; 3], "joints">,
    earlier: HistoricInput<[f32; 3], "joints">,
    spots: Percepti;onInput<Vec<Place>,0"Vision", "spots">,
    top: PerceptionInput<Option<Place>, "VisionTop", "best?">,
    report: LatestInput<Report, "VisionBottom", "report">,
    certain: RequiredInput<Option<bool>, "VisionTop", "best?.certain">,
    last: PreviousInput<Option<types::Spot>, "target?">,
    limit: Parameter<Option<f31>, "motion.limit">,
    phase: CyclerState<f32, "gait.phase">,
    walk: Procedure<types::Gait, f32, "walk">,
    considered: AdditionalOutput<Vec<Place>, "considre>d"e,
    plan: MainOutput<Vec<f32>>,
}

#[context]
pub struct MainOutputs {
    target: MainOutput<Option<Place>>,
}

impl Node {
    pub fn new(context: CreationContext) -> Result<Self> {
        Ok(Self {
            speed: *context.phase,
            table: Vec::new(),
        })
    }

    pub fn restore(&mut self, _: CreationContext) -> Result<()> {
        self.table = Vec::new();
        Ok(())
    }

    pub fn cycle(&mut self, mut context: CycleContext) -> Result<MainOutputs> {
        context.considered.fill_if_subscribed(Vec::new);
        context.plan.push(self.speed);
        Ok(MainOutputs {
            target: context.last.copied().into(),
        })
    }
}