//! Needs a pose of `Control`, which is absent before its first cycle.

use framework::{Input, LatestInput, MainOutput, RequiredInput, Result, context};
use serde::{Deserialize, Serialize};

use crate::types::{Point, Pose, Spot};

#[derive(Deserialize, Serialize)]
pub struct HorizonFinder;

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    pose: RequiredInput<Pose, "Control", "pose">,
    position: RequiredInput<Option<Point>, "Control", "pose.position?">,
    target: Input<Option<Spot>, "Control", "target?">,
    whole_target: Input<Option<Spot>, "Control", "target">,
    heading: LatestInput<f32, "Control", "pose.heading">,
    latest_target: LatestInput<Option<Spot>, "Control", "target?">,
}

#[context]
pub struct MainOutputs {
    horizon: MainOutput<Option<f32>>,
}

impl HorizonFinder {
    pub fn new(_: CreationContext) -> Result<Self> {
        Ok(Self)
    }

    pub fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs> {
        let fresh = context.heading.filter(|heading| heading.is_new);
        let heading = fresh.map_or(context.pose.heading, |heading| *heading.value);
        let seen = context.target.or(context.whole_target.as_ref());
        let later = context.latest_target.and_then(|target| target.value);
        let nearest = seen.or(later).map_or(0.0, |spot| spot.x.min(1.0));
        Ok(MainOutputs {
            horizon: Some(heading + context.position.x.abs() + nearest).into(),
        })
    }
}
