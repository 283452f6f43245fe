//! What one step does, and how large it may be.

use framework::{Reflect, math};
use serde::{Deserialize, Serialize};
use types::feet::Side;
use types::motion::Step;

/// The largest steps.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct StepLimits {
    /// In m, greater than 0.
    #[reflect(range = 0.001..)]
    pub forward: f32,
    /// In m, greater than 0.
    #[reflect(range = 0.001..)]
    pub backward: f32,
    /// In m, to either side, greater than 0.
    #[reflect(range = 0.001..)]
    pub sideways: f32,
    /// In rad, greater than 0.
    #[reflect(range = 0.001..)]
    pub turn: f32,
    /// How much longer than the last one a step may be, in m.
    #[reflect(range = 0.0..)]
    pub acceleration: f32,
    /// How much more than the last one a step may turn, in rad.
    #[reflect(range = 0.0..)]
    pub turn_acceleration: f32,
}

impl StepLimits {
    /// The step nearest to `wanted` that the legs can do after `last` while this foot carries.
    pub fn apply(&self, wanted: Step, last: Step, support: Side) -> Step {
        let step = self.in_volume(wanted);
        let forward = accelerated(step.forward, last.forward, self.acceleration);
        let turn = accelerated(step.turn, last.turn, self.turn_acceleration);
        Step {
            forward,
            left: outwards(step.left, support),
            turn,
        }
    }

    /// The largest step in the direction of `wanted` that is not larger; what is no number is no wish.
    ///
    /// Turning has precedence; what is left of the volume goes to the direction.
    pub fn in_volume(&self, wanted: Step) -> Step {
        let wanted = finite(wanted);
        let forward_limit = if wanted.forward < 0.0 {
            self.backward
        } else {
            self.forward
        };
        let turn_limit = self.turn.max(0.0);
        let turn = wanted.turn.clamp(-turn_limit, turn_limit);
        let turned = turn / turn_limit;
        let free = (1.0 - turned * turned).max(0.0);
        let (x, y) = (wanted.forward / forward_limit, wanted.left / self.sideways);
        // Rounder than a diamond, flatter than a circle: legs get in each other's way on the diagonal.
        let used = math::powf(
            math::powf(x.abs(), 1.5) + math::powf(y.abs(), 1.5),
            1.0 / 1.5,
        );
        let most = free.sqrt();
        let share = if used > most { most / used } else { 1.0 };
        Step {
            forward: wanted.forward * share,
            left: wanted.left * share,
            turn,
        }
    }
}

/// What is left of it for a swing foot that goes away from the support foot: it would step on it.
pub(crate) fn outwards(wanted: f32, support: Side) -> f32 {
    match support {
        Side::Right => wanted.max(0.0),
        Side::Left => wanted.min(0.0),
    }
}

fn finite(step: Step) -> Step {
    let finite = |value: f32| if value.is_finite() { value } else { 0.0 };
    Step {
        forward: finite(step.forward),
        left: finite(step.left),
        turn: finite(step.turn),
    }
}

/// At most `most` further from zero than the last one; nearer in any step.
fn accelerated(wanted: f32, last: f32, most: f32) -> f32 {
    let from = if wanted * last > 0.0 { last.abs() } else { 0.0 };
    wanted.abs().min(from + most).copysign(wanted)
}
