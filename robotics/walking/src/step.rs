//! What one step does, and how large it may be.

use framework::{Clear, Reflect};
use serde::{Deserialize, Serialize};
use types::feet::Side;

/// How far the swing foot comes to stand from where it would stand beside the support foot.
#[derive(Clear, Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Step {
    /// In m.
    pub forward: f32,
    /// In m.
    pub left: f32,
    /// In rad, positive to the left.
    pub turn: f32,
}

/// The largest steps.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Limits {
    /// In m, greater than 0.
    pub forward: f32,
    /// In m, greater than 0.
    pub backward: f32,
    /// In m, to either side, greater than 0.
    pub sideways: f32,
    /// In rad, greater than 0.
    pub turn: f32,
    /// How much longer than the last one a step may be, in m.
    pub acceleration: f32,
    /// How much more than the last one a step may turn, in rad.
    pub turn_acceleration: f32,
}

impl Step {
    /// Both feet side by side.
    pub const ZERO: Self = Self {
        forward: 0.0,
        left: 0.0,
        turn: 0.0,
    };

    /// What is no number is no wish.
    fn finite(self) -> Self {
        let finite = |value: f32| if value.is_finite() { value } else { 0.0 };
        Self {
            forward: finite(self.forward),
            left: finite(self.left),
            turn: finite(self.turn),
        }
    }
}

impl Limits {
    /// The step nearest to `wanted` that the legs can do after `last` while this foot carries.
    pub fn apply(&self, wanted: Step, last: Step, support: Side) -> Step {
        let step = self.in_volume(wanted.finite());
        let forward = accelerated(step.forward, last.forward, self.acceleration);
        let turn = accelerated(step.turn, last.turn, self.turn_acceleration);
        let (left, turn) = self.outwards(step.left, turn, support);
        Step {
            forward,
            left,
            turn,
        }
    }

    /// Turning has precedence; what is left of the volume goes to the direction.
    fn in_volume(&self, wanted: Step) -> Step {
        let forward_limit = if wanted.forward < 0.0 {
            self.backward
        } else {
            self.forward
        };
        let turn = wanted.turn.clamp(-self.turn, self.turn);
        let turned = turn / self.turn;
        let free = (1.0 - turned * turned).max(0.0);
        let (x, y) = (wanted.forward / forward_limit, wanted.left / self.sideways);
        // Rounder than a diamond, flatter than a circle: legs get in each other's way on the diagonal.
        let used = (x.abs().powf(1.5) + y.abs().powf(1.5)).powf(1.0 / 1.5);
        let most = free.sqrt();
        let share = if used > most { most / used } else { 1.0 };
        Step {
            forward: wanted.forward * share,
            left: wanted.left * share,
            turn,
        }
    }

    /// The swing foot goes away from the support foot: it would step on it.
    fn outwards(&self, left: f32, turn: f32, support: Side) -> (f32, f32) {
        match support {
            Side::Right => (left.max(0.0), turn.max(0.0)),
            Side::Left => (left.min(0.0), turn.min(0.0)),
        }
    }
}

/// At most `most` further from zero than the last one; nearer in any step.
fn accelerated(wanted: f32, last: f32, most: f32) -> f32 {
    let from = if wanted * last > 0.0 { last.abs() } else { 0.0 };
    wanted.abs().min(from + most).copysign(wanted)
}
