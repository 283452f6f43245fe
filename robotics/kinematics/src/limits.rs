//! Owns how far and how fast joints may turn.

use types::head::HeadAngles;
use types::joints::JointName;

/// Range and speed of one joint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// Least angle in rad; hands: 0, closed.
    pub lower: f64,
    /// Greatest angle in rad; hands: 1, open.
    pub upper: f64,
    /// Greatest speed in rad/s; hands: openings per second.
    pub velocity: f64,
}

/// The head's pitch is limited where the shell would touch the shoulders: (|yaw|, least, greatest) in
/// degrees, linear between the rows (Aldebaran documentation, head collision table of the H25).
pub const HEAD_PITCH_BY_YAW_DEGREES: [[f64; 3]; 7] = [
    [0.0, -38.5, 29.51],
    [27.85, -38.5, 24.18],
    [43.32, -31.4, 21.2],
    [51.74, -27.5, 18.91],
    [62.45, -24.64, 17.19],
    [87.49, -18.91, 11.46],
    [119.52, -25.73, 18.91],
];

/// The limits of one joint (NAO V6 URDF).
pub const fn of(joint: JointName) -> Limits {
    match joint {
        JointName::HeadYaw => limits(-2.08567, 2.08567, 8.26797),
        JointName::HeadPitch => limits(-0.671952, 0.514872, 7.19407),
        JointName::LeftShoulderPitch => limits(-2.08567, 2.08567, 8.26797),
        JointName::LeftShoulderRoll => limits(-0.314159, 1.32645, 7.19407),
        JointName::LeftElbowYaw => limits(-2.08567, 2.08567, 8.26797),
        JointName::LeftElbowRoll => limits(-1.54462, -0.0349066, 7.19407),
        JointName::LeftWristYaw => limits(-1.82387, 1.82387, 24.6229),
        JointName::HipYawPitch => limits(-1.14529, 0.740718, 4.16174),
        JointName::LeftHipRoll => limits(-0.379435, 0.79046, 4.16174),
        JointName::LeftHipPitch => limits(-1.53589, 0.48398, 6.40239),
        JointName::LeftKneePitch => limits(-0.0923279, 2.11255, 6.40239),
        JointName::LeftAnklePitch => limits(-1.18944, 0.922581, 6.40239),
        JointName::LeftAnkleRoll => limits(-0.397761, 0.768992, 4.16174),
        JointName::RightHipRoll => limits(-0.79046, 0.379435, 4.16174),
        JointName::RightHipPitch => limits(-1.53589, 0.48398, 6.40239),
        JointName::RightKneePitch => limits(-0.0923279, 2.11255, 6.40239),
        JointName::RightAnklePitch => limits(-1.1863, 0.932006, 6.40239),
        JointName::RightAnkleRoll => limits(-0.768992, 0.397761, 4.16174),
        JointName::RightShoulderPitch => limits(-2.08567, 2.08567, 8.26797),
        JointName::RightShoulderRoll => limits(-1.32645, 0.314159, 7.19407),
        JointName::RightElbowYaw => limits(-2.08567, 2.08567, 8.26797),
        JointName::RightElbowRoll => limits(0.0349066, 1.54462, 7.19407),
        JointName::RightWristYaw => limits(-1.82387, 1.82387, 24.6229),
        JointName::LeftHand => limits(0.0, 1.0, 8.33),
        JointName::RightHand => limits(0.0, 1.0, 8.33),
    }
}

/// The nearest angle within the limits of a joint; what is no number becomes the middle of the range.
pub fn clamp(joint: JointName, angle: f32) -> f32 {
    let Limits { lower, upper, .. } = of(joint);
    if angle.is_nan() {
        return ((lower + upper) / 2.0) as f32;
    }
    angle.clamp(lower as f32, upper as f32)
}

/// The nearest head angles that the joints reach without the shell touching the shoulders.
pub fn clamp_head(angles: HeadAngles) -> HeadAngles {
    let yaw = clamp(JointName::HeadYaw, angles.yaw);
    let (lower, upper) = head_pitch_range(f64::from(yaw));
    let pitch = clamp(JointName::HeadPitch, angles.pitch);
    HeadAngles {
        yaw,
        pitch: pitch.clamp(lower as f32, upper as f32),
    }
}

/// Least and greatest pitch of the head in rad at a yaw in rad.
pub fn head_pitch_range(yaw: f64) -> (f64, f64) {
    let yaw = yaw.abs().to_degrees();
    let row = HEAD_PITCH_BY_YAW_DEGREES
        .windows(2)
        .find(|rows| yaw <= rows[1][0])
        .map_or_else(
            || HEAD_PITCH_BY_YAW_DEGREES[HEAD_PITCH_BY_YAW_DEGREES.len() - 1],
            |rows| between(rows[0], rows[1], yaw),
        );
    let shell = (row[1].to_radians(), row[2].to_radians());
    let joint = of(JointName::HeadPitch);
    (shell.0.max(joint.lower), shell.1.min(joint.upper))
}

const fn limits(lower: f64, upper: f64, velocity: f64) -> Limits {
    Limits {
        lower,
        upper,
        velocity,
    }
}

fn between(before: [f64; 3], after: [f64; 3], yaw: f64) -> [f64; 3] {
    let share = (yaw - before[0]) / (after[0] - before[0]);
    std::array::from_fn(|column| before[column] + share * (after[column] - before[column]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_pitch_is_limited_by_the_row_and_between_rows() {
        let (lower, upper) = head_pitch_range(43.32_f64.to_radians());
        assert!((lower - (-31.4_f64).to_radians()).abs() < 1e-9);
        assert!((upper - 21.2_f64.to_radians()).abs() < 1e-9);
        let (_, between) = head_pitch_range(-(27.85_f64 / 2.0).to_radians());
        assert!((between - ((29.51_f64 + 24.18) / 2.0).to_radians()).abs() < 1e-9);
    }

    #[test]
    fn a_turned_head_may_not_look_as_far_down() {
        let ahead = clamp_head(HeadAngles {
            yaw: 0.0,
            pitch: 1.0,
        });
        let aside = clamp_head(HeadAngles {
            yaw: 1.5,
            pitch: 1.0,
        });
        assert!((ahead.pitch - 0.514_872).abs() < 1e-6);
        assert!(aside.pitch < 0.21);
    }

    #[test]
    fn what_is_no_number_stays_within_the_limits() {
        let angle = clamp(JointName::LeftElbowRoll, f32::NAN);
        assert!((-1.544_62..=-0.034_9).contains(&angle));
        assert_eq!(clamp(JointName::LeftKneePitch, f32::INFINITY), 2.112_55);
    }
}
