//! What others read of cycler `Lookout`, which another machine runs.
//!
//! Written by `hulkgen generate` from hulk.toml and the nodes it names. Do not edit.

use framework::Reflect;
use framework::recorded::Outputs;
use outpost_nodes::types::Ship;
use serde::Deserialize;
use serde::Serialize;

/// Main outputs that come from outside; each names the node that writes it in the whole
/// robot.
#[derive(Clone, Debug, Default, Deserialize, Outputs, Reflect, Serialize)]
pub struct SharedOutputs {
    /// outpost_nodes::lookout::range_finder
    pub ship: Ship,
}
