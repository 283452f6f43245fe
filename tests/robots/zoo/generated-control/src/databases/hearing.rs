//! What others read of cycler `Hearing`, which is left out.
//!
//! Written by `hulkgen generate` from hulk.toml and the nodes it names. Do not edit.

use framework::Reflect;
use framework::recorded::Outputs;
use serde::Deserialize;
use serde::Serialize;
use zoo_nodes::types::Whistle;

/// Main outputs that come from outside; each names the node that writes it in the whole
/// robot.
#[derive(Clone, Debug, Default, Deserialize, Outputs, Reflect, Serialize)]
pub struct SharedOutputs {
    /// zoo_nodes::hearing::ear
    pub loudness: f32,
    /// zoo_nodes::hearing::whistle
    pub whistle: Option<Whistle>,
}
