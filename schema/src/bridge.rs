//! What a bridge to other machines maps.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::spelling::BridgeKey;

/// Something of the running robot that a bridge gives a key of Zenoh: an output, a parameter, a procedure, or an instance that another machine runs.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Bridge {
    /// As clients write it: `Control.main_outputs.pose`, `parameters.walking.speed`, `Control.procedures.walk`; of a remote cycler the instance: `VisionTop`.
    pub path: String,
    /// Key of Zenoh without wildcards: `robot/pose`.
    pub key: BridgeKey,
    /// Where values go. Left out: "out", of a remote instance "in". Procedures take none: whoever queries the key calls them.
    #[serde(default)]
    pub direction: Option<Direction>,
    /// How values are written. Left out: "json".
    #[serde(default)]
    pub encoding: BridgeEncoding,
    /// Outputs: at most so many values in a second. Left out: one for each cycle.
    #[serde(default)]
    pub rate: Option<f64>,
}

/// Where values of a bridge go.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Direction {
    /// From the robot to the key.
    #[default]
    Out,
    /// From the key to the robot: parameters and remote instances alone.
    In,
    /// Both: parameters alone.
    Both,
}

/// How values of a bridge are written.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum BridgeEncoding {
    /// As text that every client reads.
    #[default]
    Json,
    /// As ROS 2 writes it: little-endian CDR; not for remote instances.
    Cdr,
}
