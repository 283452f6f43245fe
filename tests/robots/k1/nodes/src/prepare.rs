//! Brings a body that is anywhere to the pose in which it stands, slowly.

use framework::{CycleTime, Input, MainOutput, Parameter, Result, Timestamp, context};
use serde::{Deserialize, Serialize};

use crate::types::{Angles, Body};

/// Where the body was when it began, and when.
#[derive(Debug, Deserialize, Serialize)]
pub struct Prepare {
    begun: Option<(Timestamp, Angles)>,
}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    body: Input<Body, "body">,
    cycle_time: CycleTime,
    #[reflect(unit = "s", range = 0.1..)]
    duration: Parameter<f32, "prepare.duration">,
    #[reflect(unit = "rad")]
    pose: Parameter<Vec<f32>, "prepare.pose">,
}

#[context]
pub struct MainOutputs {
    standing: MainOutput<Option<Angles>>,
}

impl Prepare {
    /// Never fails.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self { begun: None })
    }

    /// Joints that the pose does not name stay where they were.
    pub fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs> {
        let now = context.cycle_time.start;
        let (since, from) = *self.begun.get_or_insert((now, context.body.positions));
        let part = ((now - since).as_secs_f32() / context.duration).min(1.0);
        // Without a jump of the velocity at either end.
        let part = part * part * (3.0 - 2.0 * part);
        let mut standing = from;
        for (angle, to) in standing.iter_mut().zip(context.pose) {
            *angle += (to - *angle) * part;
        }
        Ok(MainOutputs {
            standing: Some(standing).into(),
        })
    }
}
