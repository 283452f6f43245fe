//! Owns the numbers of the links: NAO V6 URDF, masses also in the Aldebaran documentation.

use std::f64::consts::FRAC_1_SQRT_2;

use types::joints::JointName;

use super::{LINK_COUNT, Link, LinkName, Mass};

const X: [f64; 3] = [1.0, 0.0, 0.0];
const Y: [f64; 3] = [0.0, 1.0, 0.0];
const Z: [f64; 3] = [0.0, 0.0, 1.0];
const LEFT_DIAGONAL: [f64; 3] = [0.0, FRAC_1_SQRT_2, -FRAC_1_SQRT_2];
const RIGHT_DIAGONAL: [f64; 3] = [0.0, FRAC_1_SQRT_2, FRAC_1_SQRT_2];

/// The mass of the torso, which no joint carries.
pub const TORSO: Mass = mass(1.04956, [-0.00413, 0.0, 0.04342]);

/// All links but the torso, every parent before its children.
pub const LINKS: [Link; LINK_COUNT - 1] = [
    Link {
        name: LinkName::Neck,
        parent: LinkName::Torso,
        joint: JointName::HeadYaw,
        origin: [0.0, 0.0, 0.1265],
        axis: Z,
        mass: mass(0.07842, [-1e-05, 0.0, -0.02742]),
    },
    Link {
        name: LinkName::Head,
        parent: LinkName::Neck,
        joint: JointName::HeadPitch,
        origin: [0.0, 0.0, 0.0],
        axis: Y,
        mass: mass(0.65973, [0.00109, 0.00146, 0.05719]),
    },
    Link {
        name: LinkName::LeftShoulder,
        parent: LinkName::Torso,
        joint: JointName::LeftShoulderPitch,
        origin: [0.0, 0.098, 0.1],
        axis: Y,
        mass: mass(0.09304, [-0.00165, -0.02663, 0.00014]),
    },
    Link {
        name: LinkName::LeftUpperArm,
        parent: LinkName::LeftShoulder,
        joint: JointName::LeftShoulderRoll,
        origin: [0.0, 0.0, 0.0],
        axis: Z,
        mass: mass(0.15777, [0.02455, 0.00563, 0.0033]),
    },
    Link {
        name: LinkName::LeftElbow,
        parent: LinkName::LeftUpperArm,
        joint: JointName::LeftElbowYaw,
        origin: [0.105, 0.015, 0.0],
        axis: X,
        mass: mass(0.06483, [-0.02744, 0.0, -0.00014]),
    },
    Link {
        name: LinkName::LeftForearm,
        parent: LinkName::LeftElbow,
        joint: JointName::LeftElbowRoll,
        origin: [0.0, 0.0, 0.0],
        axis: Z,
        mass: mass(0.07761, [0.02556, 0.00281, 0.00076]),
    },
    Link {
        name: LinkName::LeftHand,
        parent: LinkName::LeftForearm,
        joint: JointName::LeftWristYaw,
        origin: [0.05595, 0.0, 0.0],
        axis: X,
        mass: mass(0.18533, [0.03434, -0.00088, 0.00308]),
    },
    Link {
        name: LinkName::RightShoulder,
        parent: LinkName::Torso,
        joint: JointName::RightShoulderPitch,
        origin: [0.0, -0.098, 0.1],
        axis: Y,
        mass: mass(0.09304, [-0.00165, 0.02663, 0.00014]),
    },
    Link {
        name: LinkName::RightUpperArm,
        parent: LinkName::RightShoulder,
        joint: JointName::RightShoulderRoll,
        origin: [0.0, 0.0, 0.0],
        axis: Z,
        mass: mass(0.15777, [0.02455, -0.00563, 0.0033]),
    },
    Link {
        name: LinkName::RightElbow,
        parent: LinkName::RightUpperArm,
        joint: JointName::RightElbowYaw,
        origin: [0.105, -0.015, 0.0],
        axis: X,
        mass: mass(0.06483, [-0.02744, 0.0, -0.00014]),
    },
    Link {
        name: LinkName::RightForearm,
        parent: LinkName::RightElbow,
        joint: JointName::RightElbowRoll,
        origin: [0.0, 0.0, 0.0],
        axis: Z,
        mass: mass(0.07761, [0.02556, -0.00281, 0.00076]),
    },
    Link {
        name: LinkName::RightHand,
        parent: LinkName::RightForearm,
        joint: JointName::RightWristYaw,
        origin: [0.05595, 0.0, 0.0],
        axis: X,
        mass: mass(0.18533, [0.03434, 0.00088, 0.00308]),
    },
    Link {
        name: LinkName::LeftPelvis,
        parent: LinkName::Torso,
        joint: JointName::HipYawPitch,
        origin: [0.0, 0.05, -0.085],
        axis: LEFT_DIAGONAL,
        mass: mass(0.06981, [-0.00781, -0.01114, 0.02661]),
    },
    Link {
        name: LinkName::LeftHip,
        parent: LinkName::LeftPelvis,
        joint: JointName::LeftHipRoll,
        origin: [0.0, 0.0, 0.0],
        axis: X,
        mass: mass(0.14053, [-0.01549, 0.00029, -0.00515]),
    },
    Link {
        name: LinkName::LeftThigh,
        parent: LinkName::LeftHip,
        joint: JointName::LeftHipPitch,
        origin: [0.0, 0.0, 0.0],
        axis: Y,
        mass: mass(0.38968, [0.00138, 0.00221, -0.05373]),
    },
    Link {
        name: LinkName::LeftTibia,
        parent: LinkName::LeftThigh,
        joint: JointName::LeftKneePitch,
        origin: [0.0, 0.0, -0.1],
        axis: Y,
        mass: mass(0.30142, [0.00453, 0.00225, -0.04936]),
    },
    Link {
        name: LinkName::LeftAnkle,
        parent: LinkName::LeftTibia,
        joint: JointName::LeftAnklePitch,
        origin: [0.0, 0.0, -0.1029],
        axis: Y,
        mass: mass(0.13416, [0.00045, 0.00029, 0.00685]),
    },
    Link {
        name: LinkName::LeftFoot,
        parent: LinkName::LeftAnkle,
        joint: JointName::LeftAnkleRoll,
        origin: [0.0, 0.0, 0.0],
        axis: X,
        mass: mass(0.17184, [0.02542, 0.0033, -0.03239]),
    },
    Link {
        name: LinkName::RightPelvis,
        parent: LinkName::Torso,
        joint: JointName::HipYawPitch,
        origin: [0.0, -0.05, -0.085],
        axis: RIGHT_DIAGONAL,
        mass: mass(0.06981, [-0.00781, 0.01114, 0.02661]),
    },
    Link {
        name: LinkName::RightHip,
        parent: LinkName::RightPelvis,
        joint: JointName::RightHipRoll,
        origin: [0.0, 0.0, 0.0],
        axis: X,
        mass: mass(0.14053, [-0.01549, -0.00029, -0.00515]),
    },
    Link {
        name: LinkName::RightThigh,
        parent: LinkName::RightHip,
        joint: JointName::RightHipPitch,
        origin: [0.0, 0.0, 0.0],
        axis: Y,
        mass: mass(0.38968, [0.00138, -0.00221, -0.05373]),
    },
    Link {
        name: LinkName::RightTibia,
        parent: LinkName::RightThigh,
        joint: JointName::RightKneePitch,
        origin: [0.0, 0.0, -0.1],
        axis: Y,
        mass: mass(0.30142, [0.00453, -0.00225, -0.04936]),
    },
    Link {
        name: LinkName::RightAnkle,
        parent: LinkName::RightTibia,
        joint: JointName::RightAnklePitch,
        origin: [0.0, 0.0, -0.1029],
        axis: Y,
        mass: mass(0.13416, [0.00045, -0.00029, 0.00685]),
    },
    Link {
        name: LinkName::RightFoot,
        parent: LinkName::RightAnkle,
        joint: JointName::RightAnkleRoll,
        origin: [0.0, 0.0, 0.0],
        axis: X,
        mass: mass(0.17184, [0.02542, -0.0033, -0.03239]),
    },
];

const fn mass(mass: f64, center: [f64; 3]) -> Mass {
    Mass { mass, center }
}
