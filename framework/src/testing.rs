//! What the tests of nodes put into a context, without a robot around it.
//!
//! ```
//! use framework::testing;
//! use framework::{AdditionalOutput, CycleTime};
//!
//! struct CycleContext<'context> {
//!     time: CycleTime,
//!     radius: &'context f32,
//!     candidates: AdditionalOutput<'context, Vec<f32>>,
//! }
//!
//! let radius: f32 = testing::parameter("0.05");
//! let mut candidates = testing::AdditionalProbe::default();
//! let mut context = CycleContext {
//!     time: testing::cycle_time(1000, 12),
//!     radius: &radius,
//!     candidates: candidates.output(),
//! };
//! context.candidates.fill_if_subscribed(|| vec![*context.radius]);
//! assert_eq!(candidates.value(), Some(&vec![0.05]));
//! ```

mod captured;
mod created;
mod generated;
mod parameter_file;
mod skipped;
mod temporal;

use std::time::Duration;

use serde::de::DeserializeOwned;

use crate::context::{AdditionalOutput, AdditionalSlot};
use crate::launch::Target;
use crate::parameters;
use crate::time::{CycleTime, Timestamp};

pub use captured::{Captured, CapturedCall, CapturedHistory, CapturedSeries};
pub use created::created;
pub use generated::{assert_generated, assert_generated_with};
pub use parameter_file::ParameterFile;
pub use skipped::skip;
pub use temporal::*;

/// A target without identities, graph and replay, whose parameters lie in `parameters`: `Target { name: "lab", ..TARGET }`.
pub const TARGET: Target = Target {
    robot: "test",
    name: "simulated",
    parameters: "parameters",
    location: None,
    identities: &[],
    graph: "",
    recording_budget: 1 << 20,
    manifest: "",
    dataflow: "",
    replayables: &[],
};

/// A point in time, in milliseconds since the start of the run.
pub fn at_millis(millis: u64) -> Timestamp {
    Timestamp::ZERO + Duration::from_millis(millis)
}

/// A cycle at `start`, so long after the one before; both in milliseconds.
pub fn cycle_time(start: u64, since_last: u64) -> CycleTime {
    CycleTime {
        start: at_millis(start),
        since_last: Duration::from_millis(since_last),
    }
}

/// A parameter as the parameter files would write it: `0.05`, `[1, 2]`, `{ step = 0.1 }`, or the lines of a table.
///
/// # Panics
/// If the text is no such value, with what is wrong with it.
pub fn parameter<T: DeserializeOwned>(text: &str) -> T {
    #[derive(serde::Deserialize)]
    struct Wrapped<T> {
        value: T,
    }
    let as_value = parameters::from_text("value", &format!("value = {}", text.trim()));
    let value = as_value.map(|Wrapped { value }| value).or_else(|error| {
        // A whole table looks different, and its error says more.
        parameters::from_text("table", text)
            .map_err(|of_table| if text.contains('=') { of_table } else { error })
    });
    value.unwrap_or_else(|error| panic!("{error}"))
}

/// Listens to one additional output of a node.
#[derive(Debug)]
pub struct AdditionalProbe<T> {
    slot: AdditionalSlot<T>,
    cycle: u64,
    subscribed: bool,
}

impl<T: Default> Default for AdditionalProbe<T> {
    fn default() -> Self {
        Self {
            slot: AdditionalSlot::default(),
            cycle: 0,
            subscribed: true,
        }
    }
}

impl<T: Default> AdditionalProbe<T> {
    /// Nobody listens: what the node computes only for listeners must not be needed.
    pub fn unsubscribed() -> Self {
        Self {
            subscribed: false,
            ..Self::default()
        }
    }
}

impl<T> AdditionalProbe<T> {
    /// For the context of the next call of `cycle`.
    pub fn output(&mut self) -> AdditionalOutput<'_, T> {
        self.cycle += 1;
        AdditionalOutput::new(self.subscribed, self.cycle, &mut self.slot)
    }

    /// What the node filled in its last call.
    pub fn value(&self) -> Option<&T> {
        self.slot.get(self.cycle)
    }
}
