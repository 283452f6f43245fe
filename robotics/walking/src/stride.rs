//! One step in the air: where both soles are at each of its moments.

use framework::{Reflect, math};
use nalgebra::{Isometry3, Translation3, UnitQuaternion};
use serde::{Deserialize, Serialize};
use types::feet::{Feet, Side};
use types::motion::Step;

use crate::parameters::{Parameters, StrideParameters};
use crate::step::outwards;

/// A sole in the walk frame; it is level.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
pub struct Sole {
    /// In m.
    pub forward: f32,
    /// In m.
    pub left: f32,
    /// Above the floor, in m.
    pub height: f32,
    /// In rad.
    pub yaw: f32,
}

/// From both feet as they stand to both feet as they will.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
pub struct Stride {
    pub support: Side,
    pub step: Step,
    pub start: Feet<Sole>,
    pub end: Feet<Sole>,
    /// In s.
    pub duration: f32,
    /// In m.
    pub apex: f32,
}

impl Sole {
    /// From the frame of the sole to the walk frame.
    pub fn to_walk(self) -> Isometry3<f32> {
        Isometry3::from_parts(
            Translation3::new(self.forward, self.left, self.height),
            UnitQuaternion::from_euler_angles(0.0, 0.0, self.yaw),
        )
    }
}

/// Both feet side by side.
pub(crate) fn standing(parameters: &Parameters) -> Feet<Sole> {
    after(Step::ZERO, Side::Left, parameters)
}

/// Where the feet are when this step is done: half of it each, as the body goes on in between.
///
/// A foot does not turn inwards. The one that turns outwards turns for the next step as well, in which the other one comes to
/// stand beside it: the body turns by the same in both.
fn after(step: Step, support: Side, parameters: &Parameters) -> Feet<Sole> {
    let apart = 2.0 * outwards(step.turn, support);
    let sole = |side: Side| {
        let (half, outward) = (
            if side == support { -0.5 } else { 0.5 },
            if side == Side::Left { 1.0 } else { -1.0 },
        );
        Sole {
            forward: half * step.forward,
            left: outward * parameters.foot_offset + half * step.left,
            height: 0.0,
            yaw: half * apart,
        }
    };
    Feet {
        left: sole(Side::Left),
        right: sole(Side::Right),
    }
}

impl Stride {
    /// From where the soles are now; `turn` is what the feet turn for the turn of the step, in rad.
    pub fn plan(
        start: Feet<Sole>,
        step: Step,
        turn: f32,
        support: Side,
        parameters: &Parameters,
    ) -> Self {
        let end = after(Step { turn, ..step }, support, parameters);
        let StrideParameters {
            duration,
            duration_per_meter,
            apex,
            apex_per_meter,
            ..
        } = parameters.stride;
        let mut stride = Self {
            support,
            step,
            start,
            end,
            duration,
            apex,
        };
        let travel = stride.travel();
        stride.duration += travel * duration_per_meter;
        stride.apex += travel * apex_per_meter;
        stride
    }

    /// How far the swing foot goes over the floor, in m: the support foot stands on it.
    fn travel(&self) -> f32 {
        let swing = other(self.support);
        let apart = |soles: &Feet<Sole>| {
            let (swing, support) = (soles.on(swing), soles.on(self.support));
            (swing.forward - support.forward, swing.left - support.left)
        };
        let (before, behind) = (apart(&self.start), apart(&self.end));
        math::hypot(behind.0 - before.0, behind.1 - before.1)
    }

    /// The soles so long after the start, in s; after its duration the stride stays where it ends.
    pub fn soles(&self, elapsed: f32) -> Feet<Sole> {
        let phase = (elapsed / self.duration).clamp(0.0, 1.0);
        let sole = |side: Side| {
            let (start, end) = (self.start.on(side), self.end.on(side));
            let mix = |share: f32, start: f32, end: f32| start + share * (end - start);
            // The body goes on evenly, the swing foot starts and ends at rest.
            let (over_floor, lift) = if side == self.support {
                (phase, 0.0)
            } else {
                (parabolic(phase), self.apex * lift(phase))
            };
            Sole {
                forward: mix(over_floor, start.forward, end.forward),
                left: mix(over_floor, start.left, end.left),
                height: mix(phase, start.height, end.height) + lift,
                yaw: mix(phase, start.yaw, end.yaw),
            }
        };
        Feet {
            left: sole(Side::Left),
            right: sole(Side::Right),
        }
    }
}

/// The other foot.
pub(crate) fn other(side: Side) -> Side {
    match side {
        Side::Left => Side::Right,
        Side::Right => Side::Left,
    }
}

/// From 0 to 1 with even acceleration and then even deceleration.
fn parabolic(phase: f32) -> f32 {
    if phase < 0.5 {
        2.0 * phase * phase
    } else {
        1.0 - 2.0 * (1.0 - phase) * (1.0 - phase)
    }
}

/// From 0 up to 1 and back, at rest at both ends and at the top.
fn lift(phase: f32) -> f32 {
    parabolic(1.0 - (2.0 * phase - 1.0).abs())
}
