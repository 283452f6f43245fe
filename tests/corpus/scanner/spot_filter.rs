//! Perception in every form, history in every form, and what it said in the cycle before.

use framework::{HistoricInput, MainOutput, PerceptionInput, PreviousInput, Result, context};
use serde::{Deserialize, Serialize};

use crate::types::{Nested, Point, Pose, Report, Spot, Whistle};

#[derive(Deserialize, Serialize)]
pub struct SpotFilter;

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    spots: PerceptionInput<Vec<Spot>, "Vision", "spots">,
    best: PerceptionInput<Option<Spot>, "Vision", "best?">,
    top: PerceptionInput<Option<Spot>, "VisionTop", "best?">,
    loudness: PerceptionInput<f32, "Hearing", "loudness">,
    whistle: PerceptionInput<Option<Whistle>, "Hearing", "whistle">,
    pose: HistoricInput<Pose, "pose">,
    position: HistoricInput<Option<Point>, "pose.position?">,
    heading: HistoricInput<f32, "pose.heading">,
    last: PreviousInput<Option<Spot>, "target?">,
    last_best: PreviousInput<Option<Spot>, "report.best?">,
}

#[context]
pub struct MainOutputs {
    target: MainOutput<Option<Spot>>,
    report: MainOutput<Report>,
}

impl SpotFilter {
    pub fn new(_: CreationContext) -> Result<Self> {
        Ok(Self)
    }

    pub fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs> {
        let mut target = context.last.or(context.last_best).copied();
        for (timestamp, spots) in context.spots.persistent {
            let pose = context.pose.get(timestamp).copied().unwrap_or_default();
            let position = context.position.get(timestamp).flatten();
            let heading = context.heading.get(timestamp).copied().unwrap_or_default();
            if let (Some(spot), Some(position)) =
                (spots.first(), position.or(pose.position.as_ref()))
            {
                target = Some(Spot {
                    x: spot.x + position.x - heading,
                    ..*spot
                });
            }
        }
        let best = context
            .best
            .transient
            .last()
            .and_then(|(_, best)| best)
            .copied();
        let whistles = context
            .whistle
            .persistent
            .iter()
            .filter(|(_, whistle)| whistle.is_some());
        let nested = Nested {
            deep: context
                .top
                .persistent
                .last()
                .and_then(|(_, best)| best)
                .map(|best| best.x),
            plain: whistles.count() as f32,
        };
        let loudness: f32 = context
            .loudness
            .transient
            .iter()
            .map(|(_, loudness)| *loudness)
            .sum();
        let report = Report {
            best,
            nested: Some(nested),
            certainty: loudness,
        };
        Ok(MainOutputs {
            target: target.into(),
            report: report.into(),
        })
    }
}
