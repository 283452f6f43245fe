//! Owns a motion: which pose it has when.

use framework::Reflect;
use kinematics::limits;
use serde::{Deserialize, Serialize};
use types::head::HeadAngles;
use types::joints::Joints;
use types::motor_commands::MotorCommands;

use crate::limbs::{Head, LeftArm, LeftLeg, RightArm, RightLeg};

/// No frame takes longer, in s: a motion is over within a time that somebody can wait for.
const LONGEST_FRAME: f32 = 5.0;

/// What is that much beyond a limit, in rad, was rounded: files have few digits.
const ROUNDING: f32 = 1e-3;

/// Poses one after the other.
#[derive(Clone, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
#[serde(try_from = "Unchecked")]
pub struct Motion {
    frames: Vec<Keyframe>,
}

/// One pose of a motion, and the way there.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Keyframe {
    /// How long the way from the last frame takes.
    #[reflect(unit = "s", range = 0.001..=5.0)]
    pub duration: f32,
    /// Of all joints on the way, 0 (limp) to 1.
    #[reflect(range = 0.0..=1.0)]
    pub stiffness: f32,
    /// Angles of its joints, like those of the other limbs.
    pub head: Head,
    /// Likewise.
    pub left_arm: LeftArm,
    /// Likewise.
    pub right_arm: RightArm,
    /// The one motor of both hips, negative turns the toes out.
    #[reflect(unit = "rad", range = -1.146..=0.741)]
    pub hip_yaw_pitch: f32,
    /// Likewise.
    pub left_leg: LeftLeg,
    /// Likewise.
    pub right_leg: RightLeg,
}

/// What stands in the file.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Unchecked {
    frames: Vec<Keyframe>,
}

impl Motion {
    /// Where it begins, in rad.
    pub fn start(&self) -> Joints<f32> {
        self.frames
            .first()
            .map_or_else(Joints::default, Keyframe::pose)
    }

    /// In s.
    pub fn duration(&self) -> f32 {
        self.frames.iter().map(|frame| frame.duration).sum()
    }

    /// Everything so long after its begin (s), of a body that was at `from` (rad) then; after its end the last pose.
    pub fn at(&self, elapsed: f32, from: &Joints<f32>) -> MotorCommands {
        let (mut before, mut left) = (*from, elapsed);
        let mut commands = MotorCommands::holding(*from, 0.0);
        for frame in &self.frames {
            let target = frame.pose();
            let share = (left / frame.duration).clamp(0.0, 1.0);
            let positions =
                Joints::from_fn(|joint| before[joint] + share * (target[joint] - before[joint]));
            commands = MotorCommands::holding(positions, frame.stiffness);
            if left < frame.duration {
                break;
            }
            (before, left) = (target, left - frame.duration);
        }
        commands
    }
}

impl Keyframe {
    /// All joints, in rad; hands are closed.
    pub fn pose(&self) -> Joints<f32> {
        let Self {
            head,
            left_arm,
            right_arm,
            left_leg,
            right_leg,
            ..
        } = self;
        Joints {
            head_yaw: head.yaw,
            head_pitch: head.pitch,
            left_shoulder_pitch: left_arm.shoulder_pitch,
            left_shoulder_roll: left_arm.shoulder_roll,
            left_elbow_yaw: left_arm.elbow_yaw,
            left_elbow_roll: left_arm.elbow_roll,
            left_wrist_yaw: left_arm.wrist_yaw,
            hip_yaw_pitch: self.hip_yaw_pitch,
            left_hip_roll: left_leg.hip_roll,
            left_hip_pitch: left_leg.hip_pitch,
            left_knee_pitch: left_leg.knee_pitch,
            left_ankle_pitch: left_leg.ankle_pitch,
            left_ankle_roll: left_leg.ankle_roll,
            right_hip_roll: right_leg.hip_roll,
            right_hip_pitch: right_leg.hip_pitch,
            right_knee_pitch: right_leg.knee_pitch,
            right_ankle_pitch: right_leg.ankle_pitch,
            right_ankle_roll: right_leg.ankle_roll,
            right_shoulder_pitch: right_arm.shoulder_pitch,
            right_shoulder_roll: right_arm.shoulder_roll,
            right_elbow_yaw: right_arm.elbow_yaw,
            right_elbow_roll: right_arm.elbow_roll,
            right_wrist_yaw: right_arm.wrist_yaw,
            ..Joints::default()
        }
    }

    /// What is wrong with it, after a frame with this pose.
    fn mistake(&self, before: Option<&Joints<f32>>) -> Option<String> {
        // Written so that what is no number is wrong, too.
        if !(self.duration > 0.0 && self.duration <= LONGEST_FRAME) {
            return Some(format!(
                "`duration` is {} s, which is not between 0 and {LONGEST_FRAME} s",
                self.duration
            ));
        }
        if !(0.0..=1.0).contains(&self.stiffness) {
            return Some(format!("`stiffness` is {}, not 0 to 1", self.stiffness));
        }
        let pose = self.pose();
        let head = HeadAngles {
            yaw: pose.head_yaw,
            pitch: pose.head_pitch,
        };
        for (joint, angle) in pose.iter() {
            let nearest = limits::clamp(joint, *angle);
            let off = (angle - nearest).abs();
            if off.is_nan() || off > ROUNDING {
                return Some(format!(
                    "{joint:?} cannot turn to {angle} rad, only to {nearest}"
                ));
            }
            let way = before.map_or(0.0, |before| (angle - before[joint]).abs());
            let most = limits::of(joint).velocity as f32;
            if way > most * self.duration + ROUNDING {
                let least = way / most;
                return Some(format!(
                    "{joint:?} needs {least:.3} s for its way, `duration` is {} s",
                    self.duration
                ));
            }
        }
        let nearest = limits::clamp_head(head).pitch;
        ((head.pitch - nearest).abs() > ROUNDING).then(|| {
            format!(
                "HeadPitch cannot turn to {} rad at this HeadYaw, only to {nearest}",
                head.pitch
            )
        })
    }
}

impl TryFrom<Unchecked> for Motion {
    type Error = String;

    fn try_from(unchecked: Unchecked) -> Result<Self, String> {
        let mut before = None;
        for (number, frame) in unchecked.frames.iter().enumerate() {
            if let Some(mistake) = frame.mistake(before.as_ref()) {
                return Err(format!("frame {number}: {mistake}"));
            }
            before = Some(frame.pose());
        }
        if unchecked.frames.is_empty() {
            return Err("a motion has at least one frame".to_owned());
        }
        Ok(Self {
            frames: unchecked.frames,
        })
    }
}

#[cfg(test)]
mod tests {
    use framework::reflect::Content;
    use types::joints::JointName;

    use super::*;

    /// As [`FRAME`], with a line of it replaced.
    fn read(changes: &[(&str, &str)]) -> Result<Motion, String> {
        let frame = |line: &str, replaced: &str| {
            let lines = FRAME.lines().map(|one| match one.split_once(" = ") {
                Some((key, _)) if key == line => format!("{line} = {replaced}"),
                _ => one.to_owned(),
            });
            lines.collect::<Vec<_>>().join("\n")
        };
        let frames = changes.iter().map(|(line, replaced)| frame(line, replaced));
        toml::from_str(&frames.collect::<String>()).map_err(|error| error.to_string())
    }

    const FRAME: &str = "
[[frames]]
duration = 0.5
stiffness = 0.8
head = [0.0, 0.0]
left_arm = [1.5, 0.2, -1.5, -0.1, 0.0]
right_arm = [1.5, -0.2, 1.5, 0.1, 0.0]
hip_yaw_pitch = 0.0
left_leg = [0.0, -0.3, 0.9, -0.6, 0.0]
right_leg = [0.0, -0.3, 0.9, -0.6, 0.0]
";

    #[test]
    fn poses_follow_one_another() {
        let motion = read(&[("duration", "0.5"), ("head", "[1.0, 0.0]")]).unwrap();
        assert_eq!(motion.duration(), 1.0);
        let from = Joints::filled(0.1);
        assert_eq!(motion.at(0.0, &from).positions, from);
        let on_the_way = motion.at(0.25, &from);
        assert!((on_the_way.positions.left_shoulder_pitch - 0.8).abs() < 1e-6);
        assert_eq!(on_the_way.stiffnesses.left_knee_pitch, 0.8);
        assert!((motion.at(0.75, &from).positions.head_yaw - 0.5).abs() < 1e-6);
        for after in [1.0, 7.0] {
            assert_eq!(motion.at(after, &from).positions.head_yaw, 1.0);
        }
        assert_eq!(motion.start().head_yaw, 0.0);
        assert_eq!(motion.start().right_elbow_roll, 0.1);
    }

    #[test]
    fn what_harms_the_robot_is_refused_with_its_place() {
        for (key, value, expected) in [
            ("duration", "0.0", "`duration` is 0 s"),
            ("duration", "nan", "`duration` is NaN s"),
            ("duration", "5.1", "`duration` is 5.1 s"),
            ("stiffness", "1.1", "`stiffness` is 1.1"),
            (
                "head",
                "[2.0, 0.5]",
                "HeadPitch cannot turn to 0.5 rad at this HeadYaw",
            ),
            ("head", "[nan, 0.0]", "HeadYaw cannot turn to NaN rad"),
            (
                "left_leg",
                "[0.0, -0.3, 2.2, -0.6, 0.0]",
                "LeftKneePitch cannot turn to 2.2 rad",
            ),
            ("hip_yaw_pitch", "inf", "HipYawPitch cannot turn to inf rad"),
            ("duration", "0.5\nspeed = 1", "unknown field `speed`"),
        ] {
            let error = read(&[("duration", "0.5"), (key, value)]).unwrap_err();
            assert!(error.contains(expected), "{error}");
            assert!(
                error.contains("frame 1") || error.contains("speed"),
                "{error}"
            );
        }
        assert!(read(&[]).unwrap_err().contains("frames"));
    }

    #[test]
    fn ranges_are_the_limits_rounded_outwards() {
        let mut ranges = Vec::new();
        let shapes = [
            Head::shape(),
            LeftArm::shape(),
            Keyframe::shape(),
            LeftLeg::shape(),
            RightLeg::shape(),
            RightArm::shape(),
        ];
        for shape in &shapes {
            let Content::Struct(fields) = &shape.content else {
                panic!("{} is a struct", shape.type_name);
            };
            let angles = fields.iter().filter(|field| field.unit == Some("rad"));
            ranges.extend(angles.map(|field| field.range.unwrap()));
        }
        let joints = Joints::<f32>::default();
        let joints = joints.iter().map(|(joint, _)| joint);
        let turning =
            joints.filter(|joint| !matches!(joint, JointName::LeftHand | JointName::RightHand));
        let limits: Vec<_> = turning.map(|joint| (joint, limits::of(joint))).collect();
        assert_eq!(limits.len(), ranges.len());
        for ((joint, limits), range) in limits.iter().zip(ranges) {
            let beyond = [
                limits.lower - range.minimum.unwrap(),
                range.maximum.unwrap() - limits.upper,
            ];
            for beyond in beyond {
                assert!((0.0..=f64::from(ROUNDING)).contains(&beyond), "{joint:?}");
            }
        }
    }

    #[test]
    fn a_way_that_no_motor_can_go_in_its_time_is_refused() {
        let motion = |duration| {
            let right_leg = "[0.0, -1.5, 0.9, -0.6, 0.0]";
            let frame = format!("{duration}\nright_leg = {right_leg}");
            let text = FRAME.to_owned() + &FRAME.replace("0.5", &frame);
            // The first of the two lines is the one that counts for `toml`, so take the old one away.
            let text = text.replacen(
                "\nright_leg = [0.0, -0.3, 0.9, -0.6, 0.0]\n",
                "\nright_leg = [0.0, -0.3, 0.9, -0.6, 0.0]\n#",
                1,
            );
            let end = text.rfind("right_leg").unwrap();
            toml::from_str::<Motion>(&text[..end]).map_err(|error| error.to_string())
        };
        let most = limits::of(JointName::RightHipPitch).velocity as f32;
        let least = 1.2 / most;
        let error = motion(least - 0.01).unwrap_err();
        assert!(error.contains("RightHipPitch needs 0.187 s"), "{error}");
        motion(least + 0.001).unwrap();
    }
}
