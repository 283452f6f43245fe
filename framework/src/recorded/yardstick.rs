//! What benches measure a recording with: postcard itself, which writes the same values into a slice.

use std::mem;

use serde::Serialize;

use super::bytes::Reason;
use super::target::Target;
use super::{Capture, SaveError, Written};
use crate::cycler::Instance;
use crate::time::Timestamp;

/// Follows the frames of one instance: what was written of other instances is not written again.
#[derive(Debug, Default)]
pub struct Yardstick {
    written: Written,
    since: Option<Timestamp>,
}

/// Memory that postcard fills.
#[derive(Debug)]
pub(crate) struct Slice<'block> {
    free: &'block mut [u8],
    pub(crate) is_first: bool,
}

impl Yardstick {
    /// Writes what a frame of the cycle that has begun would have: values of others, head, states of nodes, what the cycle took.
    /// Gives how many bytes these are.
    ///
    /// # Errors
    /// If a value cannot be serialised, or has no room.
    pub fn write(
        &mut self,
        instance: &mut dyn Instance,
        memory: &mut [u8],
    ) -> Result<usize, SaveError> {
        let room = memory.len();
        let mut slice = Slice {
            free: memory,
            is_first: self.since.is_none(),
        };
        instance.save(&mut Capture {
            target: Target::Slice(&mut slice),
            written: &mut self.written,
            since: self.since,
        })?;
        self.written.keep();
        self.since = Some(instance.cycle().time.start);
        Ok(room - slice.free.len())
    }
}

impl Slice<'_> {
    /// Appends a value.
    ///
    /// # Errors
    /// What postcard says.
    // One call, so that what writes frames is as much code as without it.
    #[inline(never)]
    pub(crate) fn put<T: Serialize + ?Sized>(&mut self, value: &T) -> Result<(), Reason> {
        let free = mem::take(&mut self.free);
        let used = postcard::to_slice(value, &mut *free).map(|bytes| bytes.len());
        let (_, free) = free.split_at_mut(*used.as_ref().unwrap_or(&0));
        self.free = free;
        used.map(drop).map_err(refused)
    }
}

#[cold]
#[inline(never)]
fn refused(error: postcard::Error) -> Reason {
    Reason::new(error.to_string())
}
