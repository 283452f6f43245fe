//! Owns what is asked of the head.

use framework::{Clear, Reflect};
use serde::{Deserialize, Serialize};

/// Where the head should point.
#[derive(Clear, Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct HeadAngles {
    /// Angle of `HeadYaw` in rad, positive to the left.
    pub yaw: f32,
    /// Angle of `HeadPitch` in rad, positive looks down.
    pub pitch: f32,
}

/// A command for the two joints of the head.
#[derive(Clear, Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
pub struct HeadCommand {
    /// The angles to reach in this cycle.
    pub angles: HeadAngles,
    /// Stiffness of both joints, 0 (limp) to 1.
    pub stiffness: f32,
}

/// What a client asks the head to do.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
pub enum HeadRequest {
    /// Do again what the behaviour says.
    #[default]
    Scan,
    /// Look there and stay, until the robot is limp or penalised.
    LookAt(HeadAngles),
}
