//! Writes states that others read, one of them inside of another tree.

use framework::{CycleTime, CyclerState, Input, MainOutput, Result, context};
use serde::{Deserialize, Serialize};

use crate::types::{Point, Pose};

#[derive(Deserialize, Serialize)]
pub struct PoseFilter;

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    cycle_time: CycleTime,
    joints: Input<[f32; 3], "joints">,
    gain: CyclerState<f32, "filter.gain">,
    drift: CyclerState<Point, "filter.drift">,
}

#[context]
pub struct MainOutputs {
    pose: MainOutput<Pose>,
}

impl PoseFilter {
    pub fn new(_: CreationContext) -> Result<Self> {
        Ok(Self)
    }

    pub fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs> {
        let elapsed = context.cycle_time.since_last.as_secs_f32();
        *context.gain = 0.9 * *context.gain + 0.1;
        context.drift.x += elapsed * context.joints[0];
        context.drift.y += elapsed * context.joints[1];
        let position = (*context.gain > 0.2).then_some(*context.drift);
        Ok(MainOutputs {
            pose: Pose {
                position,
                heading: context.joints[2],
            }
            .into(),
        })
    }
}
