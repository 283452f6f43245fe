//! Owns how a body gets from one pose into another: smoothly, and no joint faster than it may.

use kinematics::limits;
use types::joints::Joints;
use types::motor_commands::MotorCommands;

/// Peak speed over mean speed of the smooth step `3 s² - 2 s³`.
const PEAK: f32 = 1.5;

/// Joints nearer to their target than this have reached it, in rad (hands: openings); a tenth of
/// the NAO's least joint play.
const REACHED: f32 = 1e-3;

/// The least share of a joint's speed that a duration is computed with.
const LEAST_SHARE: f32 = 0.01;

/// The pose that a motion starts from: what was sent where the joints hold it, what is measured
/// where they are limp. What is no number becomes one within the joint's limits.
pub(crate) fn current_pose(
    previous: Option<&MotorCommands>,
    measured: &Joints<f32>,
) -> Joints<f32> {
    Joints::from_fn(|joint| {
        let angle = match previous {
            Some(previous) if previous.stiffnesses[joint] > 0.0 || measured[joint].is_nan() => {
                previous.positions[joint]
            }
            _ => measured[joint],
        };
        if angle.is_finite() {
            angle
        } else {
            limits::clamp(joint, angle)
        }
    })
}

/// How long the slowest joint takes in s, at a share of every joint's greatest speed; 0 where the
/// body is there already.
pub(crate) fn duration(start: &Joints<f32>, target: &Joints<f32>, velocity_share: f32) -> f32 {
    let velocity_share = if velocity_share.is_nan() {
        LEAST_SHARE
    } else {
        velocity_share.clamp(LEAST_SHARE, 1.0)
    };
    let durations = start.iter().map(|(joint, angle)| {
        let way = (target[joint] - angle).abs();
        let velocity = limits::of(joint).velocity as f32 * velocity_share;
        if way < REACHED {
            0.0
        } else {
            PEAK * way / velocity
        }
    });
    durations.fold(0.0, f32::max)
}

/// How much of its duration a transition has behind it, 0 to 1.
pub(crate) fn progress(elapsed: f32, duration: f32) -> f32 {
    if duration > 0.0 {
        (elapsed / duration).clamp(0.0, 1.0)
    } else {
        1.0
    }
}

/// The pose at a progress from 0 to 1: starts and ends at rest.
pub(crate) fn pose(start: &Joints<f32>, target: &Joints<f32>, progress: f32) -> Joints<f32> {
    let share = progress * progress * (3.0 - 2.0 * progress);
    Joints::from_fn(|joint| start[joint] * (1.0 - share) + target[joint] * share)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limp_joints_start_where_they_are_and_held_ones_where_they_were_sent() {
        let mut previous = MotorCommands {
            positions: Joints::filled(0.5),
            stiffnesses: Joints::filled(0.8),
        };
        previous.stiffnesses.head_yaw = 0.0;
        previous.stiffnesses.head_pitch = 0.0;
        let mut measured = Joints::filled(0.1);
        measured.head_pitch = f32::NAN;
        let start = current_pose(Some(&previous), &measured);
        assert_eq!(start.head_yaw, 0.1);
        assert_eq!(start.head_pitch, 0.5);
        assert_eq!(start.left_knee_pitch, 0.5);
        assert_eq!(current_pose(None, &measured).left_knee_pitch, 0.1);
    }

    #[test]
    fn a_start_that_is_no_number_becomes_one_within_the_limits() {
        let target = Joints::filled(0.1);
        for ruined in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
            let measured = Joints::filled(ruined);
            let sent = |stiffness| MotorCommands {
                positions: Joints::filled(ruined),
                stiffnesses: Joints::filled(stiffness),
            };
            for previous in [None, Some(sent(0.0)), Some(sent(0.8))] {
                let start = current_pose(previous.as_ref(), &measured);
                for (joint, angle) in start.iter() {
                    assert_eq!(*angle, limits::clamp(joint, ruined), "{joint:?}");
                }
                assert!(duration(&start, &target, 0.25).is_finite());
                let now = pose(&start, &target, 0.0);
                assert!(now.iter().all(|(_, angle)| angle.is_finite()));
            }
        }
    }

    #[test]
    fn the_slowest_joint_sets_the_duration() {
        let start = Joints::filled(0.0);
        let mut target = start;
        target.left_knee_pitch = 1.0;
        target.head_yaw = 0.1;
        let expected = 1.5 / (6.40239 * 0.25);
        assert!((duration(&start, &target, 0.25) - expected).abs() < 1e-4);
        assert_eq!(duration(&start, &start, 0.25), 0.0);
    }

    #[test]
    fn a_share_that_is_no_number_is_slow() {
        let (start, target) = (Joints::filled(0.0), Joints::filled(0.5));
        let slowest = duration(&start, &target, LEAST_SHARE);
        assert_eq!(duration(&start, &target, f32::NAN), slowest);
        assert!(slowest.is_finite());
    }

    #[test]
    fn no_joint_is_faster_than_its_share() {
        let (start, target) = (Joints::filled(-0.3), Joints::filled(0.9));
        let duration = duration(&start, &target, 0.25);
        let mut last = start;
        for step in 0..=200_u8 {
            let elapsed = f32::from(step) * 0.012;
            let now = pose(&start, &target, progress(elapsed, duration));
            for (joint, angle) in now.iter() {
                let velocity = (angle - last[joint]) / 0.012;
                let limit = limits::of(joint).velocity as f32 * 0.25;
                assert!(velocity <= limit * 1.001, "{joint:?}: {velocity} > {limit}");
            }
            last = now;
        }
        assert_eq!(last, target);
    }
}
