//! Knows where the rover is from how far its wheels rolled, less and less well.

use framework::{Input, MainOutput, Parameter, Result, context};
use serde::{Deserialize, Serialize};

use crate::types::{Pose, Rolled, wrapped};

/// Where it was.
#[derive(Debug, Deserialize, Serialize)]
pub struct Odometry {
    pose: Pose,
}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    rolled: Input<Rolled, "rolled">,

    /// From wheel to wheel.
    #[reflect(unit = "m", range = 0.01..)]
    track: Parameter<f32, "odometry.track">,
}

#[context]
pub struct MainOutputs {
    pose: MainOutput<Pose>,
}

impl Odometry {
    /// The start is the origin.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self {
            pose: Pose::default(),
        })
    }

    /// A short piece of a circle is straight, in the direction of its middle.
    pub fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs> {
        let Rolled { left, right } = *context.rolled;
        let (forward, turn) = ((left + right) / 2.0, (right - left) / context.track);
        let Pose { position, heading } = &mut self.pose;
        let (sine, cosine) = (*heading + turn / 2.0).sin_cos();
        position[0] += forward * cosine;
        position[1] += forward * sine;
        *heading = wrapped(*heading + turn);
        Ok(MainOutputs {
            pose: self.pose.into(),
        })
    }
}

#[cfg(test)]
mod tests {
    use std::f32::consts::FRAC_PI_2;

    use super::*;

    #[test]
    fn a_quarter_of_a_circle_to_the_left() {
        let mut node = Odometry::new(CreationContext {}).unwrap();
        // Around a centre 1 m to the left.
        let step = FRAC_PI_2 / 100.0;
        let rolled = Rolled {
            left: step * 0.85,
            right: step * 1.15,
        };
        let poses = (0..100).map(|_| {
            let context = CycleContext {
                rolled: &rolled,
                track: &0.3,
            };
            node.cycle(context).unwrap().pose.value
        });
        let Pose { position, heading } = poses.last().unwrap();
        for value in [position[0] - 1.0, position[1] - 1.0, heading - FRAC_PI_2] {
            assert!(value.abs() < 1e-3, "{position:?} {heading}");
        }
    }
}
