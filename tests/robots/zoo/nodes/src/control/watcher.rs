//! Reads one output through every form of path. Stands first in the manifest and runs nearly last.

use framework::{AdditionalOutput, CyclerState, Input, MainOutput, RequiredInput, Result, context};
use serde::{Deserialize, Serialize};

use crate::types::{Nested, Point, Report, Spot};

#[derive(Deserialize, Serialize)]
pub struct Watcher;

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    report: Input<Report, "report">,
    certainty: Input<f32, "report.certainty">,
    best: Input<Option<Spot>, "report.best?">,
    whole_best: Input<Option<Spot>, "report.best">,
    brightness: Input<Option<f32>, "report.best?.brightness">,
    nested: RequiredInput<Option<Nested>, "report.nested?">,
    plain: Input<Option<f32>, "report.nested?.plain">,
    deep: Input<Option<f32>, "report.nested?.deep?">,
    outputs: RequiredInput<Option<f32>, "report.nested?.plain">,
    gain: CyclerState<&f32, "filter.gain">,
    drift: CyclerState<&Point, "filter.drift">,
    seen: AdditionalOutput<Vec<f32>, "debug.watcher.seen">,
    certainties: AdditionalOutput<f32, "debug.certainty">,
}

#[context]
pub struct MainOutputs {
    seen: MainOutput<u32>,
}

impl Watcher {
    pub fn new(_: CreationContext) -> Result<Self> {
        Ok(Self)
    }

    pub fn cycle(&mut self, mut context: CycleContext) -> Result<MainOutputs> {
        let options = [
            context.best.is_some() == context.whole_best.is_some(),
            context.brightness.is_some() == context.report.best.is_some(),
            context.plain == Some(&context.nested.plain),
            context.deep == context.nested.deep.as_ref(),
            *context.outputs == context.nested.plain,
        ];
        let seen = options.iter().filter(|agree| **agree).count() as u32;
        let gain = *context.gain;
        context
            .seen
            .fill_if_subscribed(|| vec![seen as f32, gain, context.drift.x]);
        context
            .certainties
            .fill_if_subscribed(|| *context.certainty);
        Ok(MainOutputs { seen: seen.into() })
    }
}
