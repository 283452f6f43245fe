//! Owns what no command for the motors may exceed, whoever made it: speeds first, then angles.

use kinematics::limits;
use types::head::HeadAngles;
use types::joints::{JointName, Joints};
use types::motor_commands::MotorCommands;

use crate::transition;

/// A longer cycle does not allow a longer step, in s.
const LONGEST_STEP: f32 = 0.1;

/// The command nearest to `wanted` that harms no joint, `seconds` after the one that was sent last.
///
/// Every joint moves from where it was sent last, no faster than `velocity_share` of what it can and within its limits. A limp
/// joint goes wherever it is pushed, and its command with it, so that it starts from there.
pub(crate) fn harmless(
    wanted: &MotorCommands,
    last: Option<&MotorCommands>,
    measured: &Joints<f32>,
    seconds: f32,
    velocity_share: f32,
) -> MotorCommands {
    let reach = zero_to_one(velocity_share) * zero_to_one(seconds / LONGEST_STEP) * LONGEST_STEP;
    let current = transition::current_pose(last, measured);
    let stiffnesses = wanted.stiffnesses.map(zero_to_one);
    let positions = Joints::from_fn(|joint| {
        if stiffnesses[joint] > 0.0 {
            let reach = limits::of(joint).velocity as f32 * reach;
            approach(joint, current[joint], wanted.positions[joint], reach)
        } else {
            limp_angle(joint, measured[joint], current[joint])
        }
    });
    MotorCommands {
        positions: limit_head(positions),
        stiffnesses,
    }
}

/// A limp joint goes wherever it is pushed; commands follow it, so that it starts from there.
fn limp_angle(joint: JointName, measured: f32, current: f32) -> f32 {
    limits::clamp(joint, if measured.is_nan() { current } else { measured })
}

/// The angle nearest to `wanted` that is within `reach` of `last`, and within the joint's limits.
fn approach(joint: JointName, last: f32, wanted: f32, reach: f32) -> f32 {
    // What is no number is no reason to move; `clamp` would panic on it.
    let last = limits::clamp(joint, last);
    let wanted = if wanted.is_nan() { last } else { wanted };
    limits::clamp(joint, wanted.clamp(last - reach, last + reach))
}

/// The shell limits the pitch by the yaw.
fn limit_head(mut positions: Joints<f32>) -> Joints<f32> {
    let HeadAngles { yaw, pitch } = limits::clamp_head(HeadAngles {
        yaw: positions.head_yaw,
        pitch: positions.head_pitch,
    });
    positions.head_yaw = yaw;
    positions.head_pitch = pitch;
    positions
}

/// What is no number counts as nothing: no movement, no stiffness.
fn zero_to_one(share: f32) -> f32 {
    if share.is_nan() {
        0.0
    } else {
        share.clamp(0.0, 1.0)
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    /// Any angle, likely ones and such that are no numbers.
    fn angle() -> impl Strategy<Value = f32> {
        prop_oneof![
            4 => -3.0..3.0_f32,
            1 => any::<f32>(),
            1 => prop::sample::select(vec![f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 1e30]),
        ]
    }

    fn joints() -> impl Strategy<Value = Joints<f32>> {
        prop::array::uniform25(angle()).prop_map(Joints::from_array)
    }

    fn commands() -> impl Strategy<Value = MotorCommands> {
        (joints(), joints()).prop_map(|(positions, stiffnesses)| MotorCommands {
            positions,
            stiffnesses,
        })
    }

    proptest! {
        #[test]
        fn whatever_is_wanted_limits_and_speeds_hold(
            wanted in prop::collection::vec(commands(), 1..8),
            measured in joints(),
            seconds in angle(),
            share in angle(),
        ) {
            let mut last: Option<MotorCommands> = None;
            for wanted in wanted {
                let sent = harmless(&wanted, last.as_ref(), &measured, seconds, share);
                for (joint, angle) in sent.positions.iter() {
                    prop_assert!(angle.is_finite(), "{joint:?} {angle}");
                    prop_assert_eq!(*angle, limits::clamp(joint, *angle), "{:?}", joint);
                    prop_assert!((0.0..=1.0).contains(&sent.stiffnesses[joint]));
                    let is_held = |commands: &MotorCommands| commands.stiffnesses[joint] > 0.0;
                    // The head's pitch gives way to its shell, however fast that is.
                    if let Some(last) = last.filter(is_held)
                        && is_held(&sent)
                        && joint != JointName::HeadPitch
                    {
                        let way = (angle - last.positions[joint]).abs();
                        let most = limits::of(joint).velocity as f32 * LONGEST_STEP;
                        prop_assert!(way <= most + 1e-5, "{joint:?} moves by {way}");
                    }
                }
                let head = HeadAngles { yaw: sent.positions.head_yaw, pitch: sent.positions.head_pitch };
                prop_assert_eq!(limits::clamp_head(head), head);
                last = Some(sent);
            }
        }

        #[test]
        fn what_harms_nothing_is_not_changed(wanted in commands(), measured in joints()) {
            let sent = harmless(&wanted, None, &measured, 0.012, 1.0);
            let next = harmless(&wanted, Some(&sent), &measured, 0.012, 1.0);
            prop_assert_eq!(harmless(&next, Some(&sent), &measured, 0.012, 1.0), next);
        }
    }

    #[test]
    fn what_is_no_number_does_not_move() {
        assert!(approach(JointName::HeadYaw, f32::NAN, 0.1, 0.01).is_finite());
        assert!(limp_angle(JointName::HeadYaw, f32::NAN, f32::NAN).is_finite());
    }
}
