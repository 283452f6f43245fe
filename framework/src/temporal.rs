//! One order of time over the cycles of several perception instances, without moving or copying
//! any of them.
//!
//! Every real-time cycle calls [`Horizon::consume`] with its timestamp t0 and one [`Consumer`] per
//! perception instance. Each completed cycle has two times: its own `timestamp` (when the data was
//! taken) and its `order`. The order is given when a consumer sees the cycle first, and stays:
//! the latest of the timestamp, the horizon (the greatest order delivered as persistent) and the
//! order of the same instance's cycle before.
//!
//! ```text
//!             persistent             transient                 waits
//!   ----|-------|---|---------|-----------|------|-------|------------|-----> order
//!    horizon                      first pending         t0
//! ```
//!
//! - *persistent*: order before every pending announcement and not after t0; delivered once, then
//!   let go by the next call. A pending announcement counts at the order its completion would get
//!   now; one older than its instance's `pending_timeout` is not waited for.
//! - *transient*: the others up to t0; delivered again every cycle until they are persistent.
//! - what is after t0 waits and is not visible.
//!
//! Invariant: the order never decreases over everything that was delivered as persistent. So what
//! becomes known late is delivered at the horizon, with its own timestamp, and counted.
//!
//! A window that is full of cycles that wait for somebody else turns the oldest persistent, as
//! many as it takes to have room for one more: nothing is lost and nobody is blocked. Cycles are
//! lost only where more complete than a window has room for between two calls.

mod consumer;
mod horizon;
mod interleaving;
mod reference;
mod roll_back;
mod series;

pub use consumer::{Consumer, Projection, QueueCounts};
pub use horizon::{Bounds, Horizon, Lane};
pub use interleaving::{Interleaved, Interleaving, interleave};
pub use reference::{Reference, ReferenceKind};
pub use roll_back::RollBack;
pub use series::{Item, Items, Iter, PerceptionInput, Series, Timeline};
