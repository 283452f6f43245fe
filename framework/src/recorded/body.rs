//! The generated part: what a recording takes of one instance, and how a replay gives it back.

use super::{Describing, Digests, Loading, SaveError, Saving, Stored, Values};
use crate::cycler::{Body, Slots};
use crate::digest::{Digest, DigestError};
use crate::error::Result;
use crate::injection::Injection;
use crate::pool::Handle;
use crate::reflect::Reflect;
use crate::time::Timestamp;
use serde::Serialize;

/// A body that can be recorded and replayed. Both sides are generated from one list: every field of what the nodes may touch.
pub trait Recorded: Body {
    /// Writing ends of all that the body reads from elsewhere; in a replay nobody else has any.
    type Outside: Send;

    /// What [`Recorded::digests`] adds a digest of: node and output, in the order of the nodes' calls.
    const DIGESTED: &'static [(&'static str, &'static str)];

    /// Values that others wrote, which frames name by number.
    ///
    /// # Errors
    /// If there is no room, or a value cannot be serialised.
    fn values(&self, values: &mut Values<'_, '_>) -> Result<(), SaveError>;

    /// The states of nodes, and all that the cycle of this number took in `begin` or got of its setup nodes. Of historic outputs
    /// what came since that time, `None` for all of it.
    fn save(
        &self,
        cycle: u64,
        slots: Slots<'_, Self::Shared>,
        since: Option<Timestamp>,
        out: &mut Saving<'_, '_>,
    );

    /// The types of what [`Recorded::save`] writes, in its order.
    fn describe(types: &mut Describing<Self>)
    where
        Self: Sized;

    /// Makes all of it what was saved.
    ///
    /// # Errors
    /// If the bytes are none of such a frame, or a value is not found; what the body has then is not defined.
    fn load(
        &mut self,
        cycle: u64,
        slots: Loaded<'_, Self::Shared>,
        outside: &mut Self::Outside,
        from: &mut Loading<'_>,
        stored: &Stored<'_>,
    ) -> Result<()>;

    /// Digests of what the nodes wrote in the last finished cycle. What setup nodes wrote stands in the frame.
    fn digests(&self, shared: &Self::Shared, digests: &mut Digests<'_, '_>);
}

/// Outputs of one instance that others read, or what clients put in their place. Derived: `#[derive(Outputs)]`.
pub trait Outputs {
    /// Writes them as serde does, but of handles other ones are left to the thread that owns the file.
    fn save(&self, out: &mut Saving<'_, '_>);
}

/// One of [`Outputs`].
pub trait Output: Serialize {
    /// What a recording may keep in place of a copy.
    #[doc(hidden)]
    fn handle(&self) -> Option<Handle>;
}

impl<T: Reflect + Serialize> Output for T {
    #[inline]
    fn handle(&self) -> Option<Handle> {
        Reflect::handle(self)
    }
}

impl<T: Reflect + Serialize> Output for Injection<T> {
    fn handle(&self) -> Option<Handle> {
        self.value()?.handle().map(Handle::in_option)
    }
}

/// Is told of the digest of each output: node, output, digest.
pub type Visit<'a> = &'a mut dyn FnMut(&'static str, &'static str, u64);

/// Where a replay puts what other instances read of its instance.
#[derive(Debug)]
pub struct Loaded<'a, S> {
    /// Of the cycle that is replayed.
    pub current: &'a mut S,
    /// Of the last finished cycle before it.
    pub previous: &'a mut S,
}

/// The digest of one output.
///
/// # Errors
/// If its own `Serialize` fails.
pub fn digest(value: &impl Serialize) -> Result<u64, DigestError> {
    let mut digest = Digest::new();
    digest.add(value)?;
    Ok(digest.value())
}
