//! Owns forward kinematics: from joint angles to the poses of all parts.

use nalgebra::{
    Isometry3, Point3, RealField, Translation3, Unit, UnitQuaternion, Vector3, convert,
};
use types::feet::{Feet, Side};
use types::joints::Joints;
use types::robot_kinematics::{Hands, RobotKinematics};

use crate::feet::SOLE_BELOW_ANKLE;
use crate::links::{LINK_COUNT, LINKS, Link, LinkName, Mass, TORSO};

/// The centre of the hand in the frame after `WristYaw`, in m (NAO V6 URDF).
pub const HAND_CENTER: [f64; 3] = [0.05775, 0.0, -0.01231];

/// Poses of all links in the torso frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Poses<T: RealField + Copy> {
    links: [Isometry3<T>; LINK_COUNT],
}

/// Where every link is for the given joint angles in rad.
pub fn forward_kinematics<T: RealField + Copy>(joints: &Joints<T>) -> Poses<T> {
    let mut links = [Isometry3::identity(); LINK_COUNT];
    for link in &LINKS {
        let parent = links[link.parent as usize];
        links[link.name as usize] = parent * child_to_parent(link, joints[link.joint]);
    }
    Poses { links }
}

impl<T: RealField + Copy> Poses<T> {
    /// From the frame of a link to the torso frame.
    pub fn link(&self, link: LinkName) -> Isometry3<T> {
        self.links[link as usize]
    }

    /// From the frame of a sole (below the ankle, on the ground) to the torso frame.
    pub fn sole(&self, side: Side) -> Isometry3<T> {
        let foot = match side {
            Side::Left => LinkName::LeftFoot,
            Side::Right => LinkName::RightFoot,
        };
        self.link(foot) * Translation3::from(vector([0.0, 0.0, -SOLE_BELOW_ANKLE]))
    }

    /// From the frame in the centre of a hand to the torso frame.
    pub fn hand(&self, side: Side) -> Isometry3<T> {
        let hand = match side {
            Side::Left => LinkName::LeftHand,
            Side::Right => LinkName::RightHand,
        };
        self.link(hand) * Translation3::from(vector(HAND_CENTER))
    }

    /// The robot's centre of mass in the torso frame, in m.
    pub fn center_of_mass(&self) -> Point3<T> {
        let torso = (self.link(LinkName::Torso), TORSO);
        let others = LINKS.iter().map(|link| (self.link(link.name), link.mass));
        let (moment, mass) = others.chain([torso]).fold(
            (Vector3::zeros(), T::zero()),
            |(moment, total), (pose, Mass { mass, center, .. })| {
                let center = pose * Point3::from(vector(center));
                let mass: T = convert(mass);
                (moment + center.coords * mass, total + mass)
            },
        );
        Point3::from(moment / mass)
    }
}

impl From<&Poses<f32>> for RobotKinematics {
    fn from(poses: &Poses<f32>) -> Self {
        Self {
            head_to_torso: poses.link(LinkName::Head),
            soles_to_torso: Feet {
                left: poses.sole(Side::Left),
                right: poses.sole(Side::Right),
            },
            knees_to_torso: Feet {
                left: poses.link(LinkName::LeftTibia),
                right: poses.link(LinkName::RightTibia),
            },
            elbows_to_torso: Hands {
                left: poses.link(LinkName::LeftForearm),
                right: poses.link(LinkName::RightForearm),
            },
            hands_to_torso: Hands {
                left: poses.hand(Side::Left),
                right: poses.hand(Side::Right),
            },
        }
    }
}

fn child_to_parent<T: RealField + Copy>(link: &Link, angle: T) -> Isometry3<T> {
    Isometry3::from_parts(
        Translation3::from(vector(link.origin)),
        UnitQuaternion::from_axis_angle(&Unit::new_unchecked(vector(link.axis)), angle),
    )
}

fn vector<T: RealField + Copy>(components: [f64; 3]) -> Vector3<T> {
    Vector3::from(components.map(convert))
}
