//! What is said of a cycle between the machine that runs it and the bridge.
//!
//! ```text
//! { "announce": { "time": 1795405533000000000 } }
//! { "complete": { "time": 1795405533000000000, "outputs": { "balls": [] } } }
//! { "abandon": { "time": 1795405533000000000 } }
//! ```

use serde::{Deserialize, Serialize};
use serde_json::Value;

/// The longest payload that the bridge reads, in bytes.
pub(crate) const LONGEST: usize = 1 << 20;

/// One sample, or the payload of one query, under the key of an instance. Times are nanoseconds since 1970: two machines have
/// no other clock in common.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Said {
    /// The cycle has its data.
    Announce {
        /// When they were taken.
        time: u64,
    },
    /// The cycle is done.
    Complete {
        /// As announced.
        time: u64,
        /// An object of the main outputs that the robot reads.
        outputs: Value,
    },
    /// The cycle has no outputs.
    Abandon {
        /// As announced.
        time: u64,
    },
}
