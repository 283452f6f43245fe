//! Owns where the robot's parts are, as the joint angles say.

use framework::foxglove::{FrameTransform, FrameTransforms, Quaternion, Vector3};
use framework::{Clear, Reflect, Timestamp};
use nalgebra::Isometry3;
use serde::{Deserialize, Serialize};

use crate::feet::Feet;

/// Poses in the torso frame (origin between the shoulders, 0.085 m above the hip axis).
///
/// `part_to_torso * point_in_part` is the point in the torso frame.
#[derive(Clear, Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
#[reflect(foxglove = Self::frame_transforms)]
pub struct RobotKinematics {
    /// The head after both its joints, origin in the neck.
    pub head_to_torso: Isometry3<f32>,
    /// The soles: on the ground below the ankle.
    pub soles_to_torso: Feet<Isometry3<f32>>,
    /// The tibiae, origin in the knee.
    pub knees_to_torso: Feet<Isometry3<f32>>,
    /// The forearms, origin in the elbow.
    pub elbows_to_torso: Hands<Isometry3<f32>>,
    /// The centres of the hands.
    pub hands_to_torso: Hands<Isometry3<f32>>,
}

/// One value for each hand.
#[derive(Clear, Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
pub struct Hands<T> {
    /// Of the left hand.
    pub left: T,
    /// Of the right hand.
    pub right: T,
}

impl RobotKinematics {
    /// As tools draw it: frames in the frame `torso`.
    fn frame_transforms(&self, timestamp: Timestamp) -> FrameTransforms {
        let parts = [
            ("head", self.head_to_torso),
            ("left_sole", self.soles_to_torso.left),
            ("right_sole", self.soles_to_torso.right),
            ("left_knee", self.knees_to_torso.left),
            ("right_knee", self.knees_to_torso.right),
            ("left_elbow", self.elbows_to_torso.left),
            ("right_elbow", self.elbows_to_torso.right),
            ("left_hand", self.hands_to_torso.left),
            ("right_hand", self.hands_to_torso.right),
        ];
        let transforms = parts.map(|(part, part_to_torso)| {
            let translation = part_to_torso.translation.vector.cast();
            let rotation = part_to_torso.rotation.coords.cast();
            FrameTransform {
                timestamp: timestamp.into(),
                parent_frame_id: "torso".to_owned(),
                child_frame_id: part.to_owned(),
                translation: Vector3 {
                    x: translation.x,
                    y: translation.y,
                    z: translation.z,
                },
                rotation: Quaternion {
                    x: rotation.x,
                    y: rotation.y,
                    z: rotation.z,
                    w: rotation.w,
                },
            }
        });
        FrameTransforms {
            transforms: transforms.into(),
        }
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{Translation3, UnitQuaternion};

    use super::*;

    #[test]
    fn tools_draw_every_part_where_it_is() {
        let rotation = UnitQuaternion::from_euler_angles(0.0, 0.0, 1.0);
        let mut kinematics = RobotKinematics::default();
        kinematics.hands_to_torso.right =
            Isometry3::from_parts(Translation3::new(0.1, -0.2, 0.3), rotation);
        let form = RobotKinematics::foxglove().expect("its type says so");
        assert_eq!(form.schema.name, "foxglove.FrameTransforms");
        let drawn = kinematics.frame_transforms(Timestamp::from_nanos(5));
        assert_eq!(drawn.transforms.len(), 9);
        let hand = &drawn.transforms[8];
        assert_eq!(
            (&*hand.parent_frame_id, &*hand.child_frame_id),
            ("torso", "right_hand")
        );
        assert_eq!(hand.timestamp.nsec, 5);
        assert_eq!(hand.translation.y, f64::from(-0.2_f32));
        assert_eq!(hand.rotation.z, f64::from(rotation.k));
        assert_eq!(hand.rotation.w, f64::from(rotation.w));
    }
}
