//! Owns the numbers of the links: NAO V6 URDF, masses and inertias also in the Aldebaran documentation.

use std::f64::consts::FRAC_1_SQRT_2;

use types::joints::JointName;

use super::{LINK_COUNT, Link, LinkName, Mass};

const X: [f64; 3] = [1.0, 0.0, 0.0];
const Y: [f64; 3] = [0.0, 1.0, 0.0];
const Z: [f64; 3] = [0.0, 0.0, 1.0];
const LEFT_DIAGONAL: [f64; 3] = [0.0, FRAC_1_SQRT_2, -FRAC_1_SQRT_2];
const RIGHT_DIAGONAL: [f64; 3] = [0.0, FRAC_1_SQRT_2, FRAC_1_SQRT_2];

/// The mass of the torso, which no joint carries.
pub const TORSO: Mass = mass(
    1.04956,
    [-0.00413, 0.0, 0.04342],
    [
        0.00308361,
        0.0028835,
        0.0015924,
        1.43116e-05,
        -3.30210972e-05,
        -2.70793e-05,
    ],
);

/// All links but the torso, every parent before its children.
pub const LINKS: [Link; LINK_COUNT - 1] = [
    Link {
        name: LinkName::Neck,
        parent: LinkName::Torso,
        joint: JointName::HeadYaw,
        origin: [0.0, 0.0, 0.1265],
        axis: Z,
        mass: mass(
            0.07842,
            [-1e-05, 0.0, -0.02742],
            [
                1.60324011e-05,
                1.70394033e-05,
                5.53372216e-06,
                1.57e-09,
                3.162764e-09,
                -5.295e-08,
            ],
        ),
    },
    Link {
        name: LinkName::Head,
        parent: LinkName::Neck,
        joint: JointName::HeadPitch,
        origin: [0.0, 0.0, 0.0],
        axis: Y,
        mass: mass(
            0.65973,
            [0.00109, 0.00146, 0.05719],
            [
                0.000770636101,
                0.000680032397,
                0.000714705824,
                4.76699432e-06,
                9.67894498e-06,
                -1.86875703e-05,
            ],
        ),
    },
    Link {
        name: LinkName::LeftShoulder,
        parent: LinkName::Torso,
        joint: JointName::LeftShoulderPitch,
        origin: [0.0, 0.098, 0.1],
        axis: Y,
        mass: mass(
            0.09304,
            [-0.00165, -0.02663, 0.00014],
            [
                1.83024984e-05,
                1.3900505e-05,
                2.01862006e-05,
                2.06011108e-06,
                1.89776e-09,
                -3.66351728e-07,
            ],
        ),
    },
    Link {
        name: LinkName::LeftUpperArm,
        parent: LinkName::LeftShoulder,
        joint: JointName::LeftShoulderRoll,
        origin: [0.0, 0.0, 0.0],
        axis: Z,
        mass: mass(
            0.15777,
            [0.02455, 0.00563, 0.0033],
            [
                8.71811648e-05,
                0.000274711841,
                0.000241811997,
                -2.53384328e-05,
                -1.42129934e-05,
                4.7138883e-07,
            ],
        ),
    },
    Link {
        name: LinkName::LeftElbow,
        parent: LinkName::LeftUpperArm,
        joint: JointName::LeftElbowYaw,
        origin: [0.105, 0.015, 0.0],
        axis: X,
        mass: mass(
            0.06483,
            [-0.02744, 0.0, -0.00014],
            [
                5.59587933e-06,
                2.66178974e-05,
                2.76293981e-05,
                4.39e-09,
                2.92240928e-07,
                -1.84e-09,
            ],
        ),
    },
    Link {
        name: LinkName::LeftForearm,
        parent: LinkName::LeftElbow,
        joint: JointName::LeftElbowRoll,
        origin: [0.0, 0.0, 0.0],
        axis: Z,
        mass: mass(
            0.07761,
            [0.02556, 0.00281, 0.00076],
            [
                2.46746361e-05,
                3.8383664e-05,
                3.59707952e-05,
                3.2313396e-06,
                1.58221082e-06,
                1.39183916e-07,
            ],
        ),
    },
    Link {
        name: LinkName::LeftHand,
        parent: LinkName::LeftForearm,
        joint: JointName::LeftWristYaw,
        origin: [0.05595, 0.0, 0.0],
        axis: X,
        mass: mass(
            0.18533,
            [0.03434, -0.00088, 0.00308],
            [
                6.86477459e-05,
                0.000135755962,
                0.000133227997,
                1.16145664e-07,
                -2.87257482e-06,
                2.67545157e-06,
            ],
        ),
    },
    Link {
        name: LinkName::RightShoulder,
        parent: LinkName::Torso,
        joint: JointName::RightShoulderPitch,
        origin: [0.0, -0.098, 0.1],
        axis: Y,
        mass: mass(
            0.09304,
            [-0.00165, 0.02663, 0.00014],
            [
                1.83024984e-05,
                1.3900495e-05,
                2.01862006e-05,
                -2.06011108e-06,
                1.87776e-09,
                3.66831728e-07,
            ],
        ),
    },
    Link {
        name: LinkName::RightUpperArm,
        parent: LinkName::RightShoulder,
        joint: JointName::RightShoulderRoll,
        origin: [0.0, 0.0, 0.0],
        axis: Z,
        mass: mass(
            0.15777,
            [0.02455, -0.00563, 0.0033],
            [
                0.000103400845,
                0.000270770161,
                0.000254528997,
                5.48845728e-05,
                -1.32643134e-05,
                9.16702117e-06,
            ],
        ),
    },
    Link {
        name: LinkName::RightElbow,
        parent: LinkName::RightUpperArm,
        joint: JointName::RightElbowYaw,
        origin: [0.105, -0.015, 0.0],
        axis: X,
        mass: mass(
            0.06483,
            [-0.02744, 0.0, -0.00014],
            [
                5.59587933e-06,
                2.66178974e-05,
                2.76293981e-05,
                4.39e-09,
                2.92240928e-07,
                -1.84e-09,
            ],
        ),
    },
    Link {
        name: LinkName::RightForearm,
        parent: LinkName::RightElbow,
        joint: JointName::RightElbowRoll,
        origin: [0.0, 0.0, 0.0],
        axis: Z,
        mass: mass(
            0.07761,
            [0.02556, -0.00281, 0.00076],
            [
                2.47330561e-05,
                3.8471944e-05,
                3.59318952e-05,
                -3.2419796e-06,
                9.06450816e-07,
                -1.38813916e-07,
            ],
        ),
    },
    Link {
        name: LinkName::RightHand,
        parent: LinkName::RightForearm,
        joint: JointName::RightWristYaw,
        origin: [0.05595, 0.0, 0.0],
        axis: X,
        mass: mass(
            0.18533,
            [0.03434, 0.00088, 0.00308],
            [
                6.86476559e-05,
                0.000135756032,
                0.000133228007,
                1.13171843e-05,
                -2.87250482e-06,
                3.68008843e-06,
            ],
        ),
    },
    Link {
        name: LinkName::LeftPelvis,
        parent: LinkName::Torso,
        joint: JointName::HipYawPitch,
        origin: [0.0, 0.05, -0.085],
        axis: LEFT_DIAGONAL,
        mass: mass(
            0.06981,
            [-0.00781, -0.01114, 0.02661],
            [
                2.34069674e-05,
                4.76352228e-05,
                4.97024292e-05,
                1.07908735e-06,
                -1.76000042e-06,
                2.76085473e-06,
            ],
        ),
    },
    Link {
        name: LinkName::LeftHip,
        parent: LinkName::LeftPelvis,
        joint: JointName::LeftHipRoll,
        origin: [0.0, 0.0, 0.0],
        axis: X,
        mass: mass(
            0.14053,
            [-0.01549, 0.00029, -0.00515],
            [
                2.38444145e-05,
                6.08246008e-05,
                5.43691792e-05,
                -6.53574813e-07,
                7.12903995e-06,
                -2.14061555e-07,
            ],
        ),
    },
    Link {
        name: LinkName::LeftThigh,
        parent: LinkName::LeftHip,
        joint: JointName::LeftHipPitch,
        origin: [0.0, 0.0, 0.0],
        axis: Y,
        mass: mass(
            0.38968,
            [0.00138, 0.00221, -0.05373],
            [
                0.000509843785,
                0.000465358345,
                0.000301097877,
                2.11289606e-06,
                5.64170312e-05,
                -7.91441914e-06,
            ],
        ),
    },
    Link {
        name: LinkName::LeftTibia,
        parent: LinkName::LeftThigh,
        joint: JointName::LeftKneePitch,
        origin: [0.0, 0.0, -0.1],
        axis: Y,
        mass: mass(
            0.30142,
            [0.00453, 0.00225, -0.04936],
            [
                0.00044617051,
                0.000388084249,
                0.000185516252,
                3.70596335e-06,
                -3.08981131e-05,
                6.0168248e-06,
            ],
        ),
    },
    Link {
        name: LinkName::LeftAnkle,
        parent: LinkName::LeftTibia,
        joint: JointName::LeftAnklePitch,
        origin: [0.0, 0.0, -0.1029],
        axis: Y,
        mass: mass(
            0.13416,
            [0.00045, 0.00029, 0.00685],
            [
                3.22034045e-05,
                6.7943e-05,
                5.48268997e-05,
                -8.83212e-09,
                4.2755082e-06,
                2.8482884e-07,
            ],
        ),
    },
    Link {
        name: LinkName::LeftFoot,
        parent: LinkName::LeftAnkle,
        joint: JointName::LeftAnkleRoll,
        origin: [0.0, 0.0, 0.0],
        axis: X,
        mass: mass(
            0.17184,
            [0.02542, 0.0033, -0.03239],
            [
                8.72921391e-05,
                0.000353023904,
                0.00041284506,
                8.71895024e-06,
                -2.10591699e-06,
                3.7396792e-07,
            ],
        ),
    },
    Link {
        name: LinkName::RightPelvis,
        parent: LinkName::Torso,
        joint: JointName::HipYawPitch,
        origin: [0.0, -0.05, -0.085],
        axis: RIGHT_DIAGONAL,
        mass: mass(
            0.06981,
            [-0.00781, 0.01114, 0.02661],
            [
                3.18765674e-05,
                5.18360128e-05,
                5.39658392e-05,
                -1.07145735e-06,
                -1.77289042e-06,
                -7.00672473e-06,
            ],
        ),
    },
    Link {
        name: LinkName::RightHip,
        parent: LinkName::RightPelvis,
        joint: JointName::RightHipRoll,
        origin: [0.0, 0.0, 0.0],
        axis: X,
        mass: mass(
            0.14053,
            [-0.01549, -0.00029, -0.00515],
            [
                2.38474145e-05,
                6.08240008e-05,
                5.43727792e-05,
                6.12114813e-07,
                7.10245995e-06,
                2.12401555e-07,
            ],
        ),
    },
    Link {
        name: LinkName::RightThigh,
        parent: LinkName::RightHip,
        joint: JointName::RightHipPitch,
        origin: [0.0, 0.0, 0.0],
        axis: Y,
        mass: mass(
            0.38968,
            [0.00138, -0.00221, -0.05373],
            [
                0.000510606785,
                0.000466499665,
                0.000301333547,
                -2.02771606e-06,
                5.69934212e-05,
                7.09150914e-06,
            ],
        ),
    },
    Link {
        name: LinkName::RightTibia,
        parent: LinkName::RightThigh,
        joint: JointName::RightKneePitch,
        origin: [0.0, 0.0, -0.1],
        axis: Y,
        mass: mass(
            0.30142,
            [0.00453, -0.00225, -0.04936],
            [
                0.00044692051,
                0.000387710759,
                0.000183741742,
                -3.96835335e-06,
                -3.93982331e-05,
                -5.0030248e-06,
            ],
        ),
    },
    Link {
        name: LinkName::RightAnkle,
        parent: LinkName::RightTibia,
        joint: JointName::RightAnklePitch,
        origin: [0.0, 0.0, -0.1029],
        axis: Y,
        mass: mass(
            0.13416,
            [0.00045, -0.00029, 0.00685],
            [
                3.22017045e-05,
                6.79885e-05,
                5.48746997e-05,
                4.683212e-08,
                4.2882282e-06,
                -2.7110884e-07,
            ],
        ),
    },
    Link {
        name: LinkName::RightFoot,
        parent: LinkName::RightAnkle,
        joint: JointName::RightAnkleRoll,
        origin: [0.0, 0.0, 0.0],
        axis: X,
        mass: mass(
            0.17184,
            [0.02542, -0.0033, -0.03239],
            [
                8.71523391e-05,
                0.000352156094,
                0.00041212387,
                -8.54035024e-06,
                -2.35205699e-06,
                -4.8130792e-07,
            ],
        ),
    },
];

const fn mass(mass: f64, center: [f64; 3], inertia: [f64; 6]) -> Mass {
    Mass {
        mass,
        center,
        inertia,
    }
}
