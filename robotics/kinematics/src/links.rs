//! Owns the tree of links: what turns about what, and how heavy it is.

use types::joints::JointName;

mod table;

pub use table::{LINKS, TORSO};

/// How many links the robot has, torso included.
pub const LINK_COUNT: usize = 25;

/// One rigid part and the joint that carries it.
///
/// `child_to_parent = translate(origin) * rotate(axis, angle of the joint)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Link {
    /// The part.
    pub name: LinkName,
    /// The part that carries it; it stands before this one in [`LINKS`].
    pub parent: LinkName,
    /// The joint between the two.
    pub joint: JointName,
    /// Where the joint is in the parent's frame, in m.
    pub origin: [f64; 3],
    /// The axis of the joint, a unit vector.
    pub axis: [f64; 3],
    /// Mass and where it is.
    pub mass: Mass,
}

/// The mass of one link.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mass {
    /// In kg.
    pub mass: f64,
    /// Centre of mass in the link's frame, in m.
    pub center: [f64; 3],
    /// Moments of inertia about the centre of mass along the link's axes, in kg m²: xx, yy, zz, xy,
    /// xz, yz. The published tables are about the origin of the link; these are moved by the
    /// parallel axis theorem and are those of the URDF.
    pub inertia: [f64; 6],
}

/// The rigid parts of the robot; `as usize` is the place in [`crate::Poses`].
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub enum LinkName {
    /// Everything between neck, shoulders, and hips.
    Torso,
    /// After `HeadYaw`.
    Neck,
    /// After `HeadPitch`.
    Head,
    /// After `LShoulderPitch`.
    LeftShoulder,
    /// After `LShoulderRoll`.
    LeftUpperArm,
    /// After `LElbowYaw`.
    LeftElbow,
    /// After `LElbowRoll`.
    LeftForearm,
    /// After `LWristYaw`.
    LeftHand,
    /// After `RShoulderPitch`.
    RightShoulder,
    /// After `RShoulderRoll`.
    RightUpperArm,
    /// After `RElbowYaw`.
    RightElbow,
    /// After `RElbowRoll`.
    RightForearm,
    /// After `RWristYaw`.
    RightHand,
    /// After `HipYawPitch` on the left.
    LeftPelvis,
    /// After `LHipRoll`.
    LeftHip,
    /// After `LHipPitch`.
    LeftThigh,
    /// After `LKneePitch`.
    LeftTibia,
    /// After `LAnklePitch`.
    LeftAnkle,
    /// After `LAnkleRoll`.
    LeftFoot,
    /// After `HipYawPitch` on the right.
    RightPelvis,
    /// After `RHipRoll`.
    RightHip,
    /// After `RHipPitch`.
    RightThigh,
    /// After `RKneePitch`.
    RightTibia,
    /// After `RAnklePitch`.
    RightAnkle,
    /// After `RAnkleRoll`.
    RightFoot,
}

impl LinkName {
    /// Where the joint that carries this part is in the frame of its parent, in m; the torso, which
    /// nothing carries, is where its own frame is.
    pub const fn origin(self) -> [f64; 3] {
        let mut index = 0;
        while index < LINKS.len() {
            if LINKS[index].name as usize == self as usize {
                return LINKS[index].origin;
            }
            index += 1;
        }
        [0.0; 3]
    }
}
