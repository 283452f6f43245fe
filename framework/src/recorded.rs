//! What a cycle took from elsewhere in `begin`, as bytes and back.
//!
//! A frame names cycles of other instances by number; their values stand beside it, once, however many frames refer to
//! them. Giving back goes the way that the values came: into a buffer of the replay's own, and out of it by the same
//! reader or consumer that the cycle has when it runs live, so that nodes cannot tell the difference.
//!
//! Invariant: what is given back shows the same values, times, order and split as what was saved.

mod bytes;
mod history;
mod inputs;

pub use bytes::{Loading, SaveError, Saving};
pub use inputs::{Foreign, Found};
