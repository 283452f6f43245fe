//! Knows where the robot is, from measurements that become known in another order than that in which they were taken.

use framework::{
    CycleTime, MainOutput, Parameter, PerceptionInput, Result, Timeline, Timestamp, context,
    interleave,
};
use serde::{Deserialize, Serialize};

use crate::types::{Measurement, Sets, Span};

/// Where it was after the last persistent measurement, metres from the start.
#[derive(Debug, Deserialize, Serialize)]
pub struct PositionFilter {
    position: f32,
}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    vision: PerceptionInput<Measurement, "Vision", "measurement">,
    odometry: PerceptionInput<Measurement, "Odometry", "measurement">,
    radio: PerceptionInput<Measurement, "Radio", "measurement">,
    cycle_time: CycleTime,

    /// Of what a team mate says, between 0 and 1.
    trust: Parameter<f32, "position_filter.trust">,
}

#[context]
pub struct MainOutputs {
    /// What this cycle was given, and where the robot is; `None` only where this node failed.
    sets: MainOutput<Option<Sets>>,
}

impl PositionFilter {
    /// The robot begins at the start.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self { position: 0.0 })
    }

    /// Learns for good from what is persistent; looks ahead on a copy with what is transient.
    pub fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs> {
        let inputs = [context.vision, context.odometry, context.radio];
        for (_, measurement) in interleave(inputs.map(|input| input.persistent)) {
            self.position = after(self.position, *measurement, *context.trust);
        }
        let transient = interleave(inputs.map(|input| input.transient));
        let position = transient.fold(self.position, |position, (_, measurement)| {
            after(position, *measurement, *context.trust)
        });
        let sets = Sets {
            at: seconds(context.cycle_time.start),
            persistent: inputs.map(|input| span(input.persistent)),
            transient: inputs.map(|input| span(input.transient)),
            position,
        };
        Ok(MainOutputs {
            sets: Some(sets).into(),
        })
    }
}

/// Where the robot is after a measurement.
fn after(position: f32, measurement: Measurement, trust: f32) -> f32 {
    match measurement {
        Measurement::Nothing => position,
        Measurement::Moved(distance) => position + distance,
        Measurement::Seen(seen) => seen,
        Measurement::Told(told) => position + trust * (told - position),
    }
}

fn span(timeline: Timeline<'_, &Measurement>) -> Span {
    let ends = timeline.iter().next().zip(timeline.last());
    ends.map_or(Span::default(), |((first, _), (last, _))| Span {
        count: timeline.len() as u32,
        first: seconds(first),
        last: seconds(last),
    })
}

/// Of the run.
fn seconds(timestamp: Timestamp) -> f64 {
    (timestamp - Timestamp::ZERO).as_secs_f64()
}

#[cfg(test)]
mod tests {
    use framework::testing;

    use super::*;

    #[test]
    fn an_image_that_comes_late_corrects_the_past_and_not_the_present() {
        let mut node = PositionFilter::new(CreationContext {}).unwrap();
        let at = testing::at_millis;
        let (seen, step) = (Measurement::Seen(1.0), Measurement::Moved(0.1));
        let steps = [(at(20), &step), (at(30), &step)];
        let mut position = |vision, odometry| {
            let context = CycleContext {
                vision,
                odometry,
                radio: testing::perception(&[], &[]),
                cycle_time: testing::cycle_time(50, 10),
                trust: &0.5,
            };
            node.cycle(context).unwrap().sets.value.unwrap().position
        };
        // The image of 10 ms is still looked at.
        let transient = testing::perception(&[], &steps);
        assert_eq!(position(testing::perception(&[], &[]), transient), 0.2);
        let image = [(at(10), &seen)];
        let persistent = testing::perception(&steps, &[]);
        assert_eq!(position(testing::perception(&image, &[]), persistent), 1.2);
    }
}
