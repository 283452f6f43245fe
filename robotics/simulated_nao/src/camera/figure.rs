//! What a NAO looks like: capsules on its links, coarse but with the right outline.
//!
//! Sizes are those of the collision primitives that B-Human publishes for its simulated NAO V6,
//! rounded; the soles have the extent of [`kinematics::feet::LEFT_SOLE`].

use kinematics::Poses;
use kinematics::links::LinkName;
use nalgebra::{Isometry3, Point3};

use super::color::Color;
use crate::scene::Team;

/// How many capsules a body has.
pub(crate) const PARTS: usize = TRUNK.len() + 2 * LIMBS.len() + HEAD.len();
/// The first of them are what a robot sees of itself: all but its head.
pub(crate) const PARTS_BELOW_HEAD: usize = PARTS - HEAD.len();

/// A ball drawn along a straight line while its radius changes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Capsule {
    pub(crate) ends: [Point3<f32>; 2],
    pub(crate) radii: [f32; 2],
    pub(crate) color: Color,
    /// Whether it is a cylinder instead.
    pub(crate) is_flat: bool,
}

#[derive(Clone, Copy, Debug)]
enum Paint {
    Shell,
    Joint,
    Dark,
    Shirt,
}

/// A capsule in the frame of its link.
#[derive(Clone, Copy, Debug)]
struct Part(LinkName, [[f32; 3]; 2], [f32; 2], Paint);

const TRUNK: [Part; 4] = [
    Part(
        LinkName::Torso,
        [[0.0, 0.012, -0.055], [0.0, 0.028, 0.07]],
        [0.048, 0.052],
        Paint::Shirt,
    ),
    Part(
        LinkName::Torso,
        [[0.0, -0.012, -0.055], [0.0, -0.028, 0.07]],
        [0.048, 0.052],
        Paint::Shirt,
    ),
    Part(
        LinkName::Torso,
        [[0.048, 0.0, 0.02], [0.048, 0.0, 0.02]],
        [0.013, 0.013],
        Paint::Shell,
    ),
    Part(
        LinkName::Torso,
        [[0.0, -0.04, -0.09], [0.0, 0.04, -0.09]],
        [0.045, 0.045],
        Paint::Shell,
    ),
];

/// Of the left side; the right one mirrors it.
const LIMBS: [Part; 10] = [
    Part(
        LinkName::LeftShoulder,
        [[0.0, -0.015, 0.0], [0.0, 0.005, 0.0]],
        [0.038, 0.038],
        Paint::Joint,
    ),
    Part(
        LinkName::LeftUpperArm,
        [[0.01, 0.005, 0.0], [0.095, 0.012, 0.0]],
        [0.034, 0.028],
        Paint::Shirt,
    ),
    Part(
        LinkName::LeftForearm,
        [[0.0, 0.0, 0.0], [0.05, 0.0, 0.0]],
        [0.028, 0.026],
        Paint::Shell,
    ),
    Part(
        LinkName::LeftHand,
        [[0.015, 0.0, -0.005], [0.06, 0.0, -0.012]],
        [0.025, 0.022],
        Paint::Joint,
    ),
    Part(
        LinkName::LeftThigh,
        [[0.0, 0.0, -0.01], [0.0, 0.0, -0.085]],
        [0.045, 0.041],
        Paint::Shell,
    ),
    Part(
        LinkName::LeftTibia,
        [[0.0, 0.0, 0.0], [0.0, 0.0, -0.015]],
        [0.039, 0.035],
        Paint::Joint,
    ),
    Part(
        LinkName::LeftTibia,
        [[0.003, 0.0, -0.03], [0.0, 0.0, -0.095]],
        [0.041, 0.035],
        Paint::Shell,
    ),
    Part(
        LinkName::LeftFoot,
        [[-0.03, 0.029, -0.0245], [0.066, 0.024, -0.0245]],
        [0.0205, 0.0205],
        Paint::Shell,
    ),
    Part(
        LinkName::LeftFoot,
        [[-0.03, -0.014, -0.0245], [0.074, -0.013, -0.0245]],
        [0.0205, 0.0205],
        Paint::Shell,
    ),
    Part(
        LinkName::LeftFoot,
        [[-0.02, 0.006, -0.016], [0.055, 0.005, -0.02]],
        [0.029, 0.024],
        Paint::Shell,
    ),
];

const HEAD: [Part; 5] = [
    Part(
        LinkName::Neck,
        [[0.0, 0.0, -0.02], [0.0, 0.0, 0.02]],
        [0.03, 0.03],
        Paint::Joint,
    ),
    Part(
        LinkName::Head,
        [[0.0, -0.016, 0.05], [0.0, 0.016, 0.05]],
        [0.057, 0.057],
        Paint::Shell,
    ),
    Part(
        LinkName::Head,
        [[0.0, -0.06, 0.05], [0.0, 0.06, 0.05]],
        [0.03, 0.03],
        Paint::Joint,
    ),
    Part(
        LinkName::Head,
        [[0.05, 0.027, 0.055], [0.05, 0.027, 0.055]],
        [0.014, 0.014],
        Paint::Dark,
    ),
    Part(
        LinkName::Head,
        [[0.05, -0.027, 0.055], [0.05, -0.027, 0.055]],
        [0.014, 0.014],
        Paint::Dark,
    ),
];

impl Capsule {
    pub(crate) fn transformed(self, pose: &Isometry3<f32>) -> Self {
        Self {
            ends: self.ends.map(|end| pose * end),
            ..self
        }
    }

    /// The height of its lowest point.
    #[cfg(test)]
    pub(crate) fn lowest(&self) -> f32 {
        let low = |end: usize| self.ends[end].z - self.radii[end];
        low(0).min(low(1))
    }
}

impl Part {
    fn capsule(&self, poses: &Poses<f32>, shirt: Color) -> Capsule {
        let Self(link, ends, radii, paint) = *self;
        let link = poses.link(link);
        Capsule {
            ends: ends.map(|end| link * Point3::from(end)),
            radii,
            color: match paint {
                Paint::Shell => Color::SHELL,
                Paint::Joint => Color::JOINT,
                Paint::Dark => Color::DARK,
                Paint::Shirt => shirt,
            },
            is_flat: false,
        }
    }

    fn mirrored(self) -> Self {
        let Self(link, ends, radii, paint) = self;
        let ends = ends.map(|[x, y, z]| [x, -y, z]);
        Self(right_of(link), ends, radii, paint)
    }
}

/// The body in the torso frame.
pub(crate) fn parts(poses: &Poses<f32>, shirt: Color) -> [Capsule; PARTS] {
    std::array::from_fn(|index| {
        let limbs = TRUNK.len()..TRUNK.len() + 2 * LIMBS.len();
        let part = if index < limbs.start {
            TRUNK[index]
        } else if index < limbs.end {
            let limb = LIMBS[(index - limbs.start) / 2];
            if index % 2 == 0 {
                limb
            } else {
                limb.mirrored()
            }
        } else {
            HEAD[index - limbs.end]
        };
        part.capsule(poses, shirt)
    })
}

/// The colour of a team's shirts.
pub(crate) fn shirt(team: Team) -> Color {
    match team {
        Team::Own => Color::BLUE_SHIRT,
        Team::Opponent => Color::RED_SHIRT,
    }
}

fn right_of(link: LinkName) -> LinkName {
    match link {
        LinkName::LeftShoulder => LinkName::RightShoulder,
        LinkName::LeftUpperArm => LinkName::RightUpperArm,
        LinkName::LeftForearm => LinkName::RightForearm,
        LinkName::LeftHand => LinkName::RightHand,
        LinkName::LeftThigh => LinkName::RightThigh,
        LinkName::LeftTibia => LinkName::RightTibia,
        LinkName::LeftFoot => LinkName::RightFoot,
        other => other,
    }
}
