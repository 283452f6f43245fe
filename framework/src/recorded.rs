//! What a cycle took from elsewhere in `begin`, as bytes and back.
//!
//! A frame names cycles of other instances by number; their values stand beside it, once, however many frames refer to
//! them. Giving back goes the way that the values came: into a buffer of the replay's own, and out of it by the same
//! reader or consumer that the cycle has when it runs live, so that nodes cannot tell the difference.
//!
//! Invariant: what is given back shows the same values, times, order and split as what was saved.

mod body;
mod bytes;
mod capture;
mod condition;
mod digests;
mod disk;
mod encode;
mod ends;
mod history;
mod inputs;
mod logs;
mod output;
mod recorder;
mod report;
mod start;
mod stored;
mod target;
mod trace;
mod types;
#[cfg(feature = "yardstick")]
mod yardstick;

pub use body::{Loaded, Output, Outputs, Recorded, Visit, digest};
pub use bytes::{Loading, Reason, SaveError, Saving};
pub(crate) use capture::{BEGUN, FINISHED, Written};
pub use capture::{Capture, Head, PARAMETERS, VERSION, Values};
pub(crate) use digests::DIGEST;
pub use digests::Digests;
pub use framework_macros::Outputs;
pub use hulkgen_recording::{Counts, Settings};
pub use inputs::{Foreign, Found};
pub(crate) use logs::{LOGS, from_log};
pub use output::Forms;
pub(crate) use output::{JSON, shape_of};
pub use report::{InstanceRecorded, Missing, RecordingReport};
pub use start::{About, Recording};
pub(crate) use start::{FRAMES, TYPES, VALUES};
pub use stored::Stored;
pub(crate) use stored::{ValuePlace, ValuePlaces, channel_of};
pub(crate) use trace::layout_of;
pub(crate) use types::taken;
pub use types::{Describing, Taken, Types, describe};
#[cfg(feature = "yardstick")]
pub use yardstick::Yardstick;
