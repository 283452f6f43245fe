//! What the fields of a context are: the kinds that node files import.
//!
//! `#[context]` inserts the lifetime and takes the path away; what remains is one of these types, so that completion,
//! hover and go-to-definition work on every kind. `PerceptionInput` and `HistoricInput` live in [`crate::temporal`] and
//! [`crate::history`].

use std::ops::Deref;
use std::sync::Arc;

use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::buffer;
use crate::error::Result;
use crate::procedure::Call;
use crate::recorded::{Loading, Saving};
use crate::reflect::Reflect;
use crate::time::Timestamp;

/// This cycle's output of the own cycler, or the newest finished one of another instance: `Input<T, ["Instance",] "path">`.
///
/// The node sees `&T`. Of another instance, `T::default()` before its first cycle.
pub type Input<'context, T> = &'context T;

/// As [`Input`]; while something on the path is absent the node is skipped: `RequiredInput<Option<T>, "path?">`.
pub type RequiredInput<'context, T> = &'context T;

/// The own cycler's output of the last finished cycle, its default before: `PreviousInput<T, "path">`.
///
/// Orders nothing: the honest way to close a loop.
pub type PreviousInput<'context, T> = &'context T;

/// The newest finished output of another instance with its age: `LatestInput<T, "Instance", "path">`.
///
/// `None` before that instance's first cycle.
pub type LatestInput<V> = Option<buffer::Latest<V>>;

/// A field of the one parameter tree, declared by being read: `Parameter<T, "path">`.
pub type Parameter<'context, T> = &'context T;

/// Shared by the nodes of one instance and kept between cycles: `CyclerState<T, "path">`, to read only `CyclerState<&T, "path">`.
pub type CyclerState<'context, T> = &'context mut T;

/// The platform: all traits that the node asks of it are bounds of `CycleContext<impl …>`.
pub type HardwareInterface<'context, Interface> = &'context Arc<Interface>;

/// A call that this node may answer in this cycle: `Procedure<Request, Response, "name">`. What is not answered is refused.
pub type Procedure<'context, Request, Response> = Option<Call<'context, Request, Response>>;

/// One output of a node; the field's name is the output's name.
///
/// In `MainOutputs` it is returned by value, `.into()` from `T`. In `CycleContext` the node sees `&mut T`, at its default
/// with its heap capacity kept, in the place where it will be published.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct MainOutput<T> {
    /// What other nodes read.
    pub value: T,
}

/// When the data of a setup node was taken; becomes the cycle's timestamp.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct CaptureTime(pub Timestamp);

/// What a node sees of a main output that it writes in place.
pub trait InPlace<'context> {
    /// `&'context mut T`.
    type Slot;
}

/// What a node sees of a cycler state that it only reads.
pub trait ReadState {
    /// `&'context T`.
    type Read;
}

/// Where an additional output is kept; the value counts only in the cycle that filled it, so nothing is ever cleared.
#[derive(Debug, Default)]
pub struct AdditionalSlot<T> {
    cycle: u64,
    value: T,
}

/// An output that is computed only while somebody listens: `AdditionalOutput<T, "path">`.
#[derive(Debug)]
pub struct AdditionalOutput<'context, T> {
    subscribed: Option<u64>,
    slot: &'context mut AdditionalSlot<T>,
}

impl<T> From<T> for MainOutput<T> {
    #[inline]
    fn from(value: T) -> Self {
        Self { value }
    }
}

impl<T> Deref for MainOutput<T> {
    type Target = T;

    fn deref(&self) -> &T {
        &self.value
    }
}

impl From<Timestamp> for CaptureTime {
    fn from(timestamp: Timestamp) -> Self {
        Self(timestamp)
    }
}

impl<'context, T: 'context> InPlace<'context> for MainOutput<T> {
    type Slot = &'context mut T;
}

impl<'context, T> ReadState for &'context mut T {
    type Read = &'context T;
}

impl<T> AdditionalSlot<T> {
    /// What was filled in this cycle.
    #[inline]
    pub fn get(&self, cycle: u64) -> Option<&T> {
        // Cycles count from 1, so a slot that was never filled is absent.
        (cycle != 0 && self.cycle == cycle).then_some(&self.value)
    }
}

impl<T: Reflect + Serialize + DeserializeOwned> AdditionalSlot<T> {
    /// Into the frame of the cycle with this number: what was filled in it, as an `Option`.
    #[doc(hidden)]
    pub fn save(&self, cycle: u64, out: &mut Saving<'_, '_>) {
        let filled = self.get(cycle);
        out.put(&filled.is_some());
        if let Some(value) = filled {
            out.output(value);
        }
    }

    /// Out of it again.
    ///
    /// # Errors
    /// If the bytes are none of such an output.
    #[doc(hidden)]
    pub fn load(&mut self, cycle: u64, from: &mut Loading<'_>) -> Result<()> {
        self.cycle = 0;
        if let Some(value) = from.take()? {
            *self = Self { cycle, value };
        }
        Ok(())
    }
}

impl<'context, T> AdditionalOutput<'context, T> {
    /// For the cycle with this number.
    #[inline]
    pub fn new(subscribed: bool, cycle: u64, slot: &'context mut AdditionalSlot<T>) -> Self {
        Self {
            subscribed: subscribed.then_some(cycle),
            slot,
        }
    }

    /// Whether somebody listens; decided once per cycle.
    #[inline]
    pub fn is_subscribed(&self) -> bool {
        self.subscribed.is_some()
    }

    /// Computes and keeps the value if somebody listens.
    #[inline]
    pub fn fill_if_subscribed(&mut self, compute: impl FnOnce() -> T) {
        if let Some(cycle) = self.subscribed {
            *self.slot = AdditionalSlot {
                cycle,
                value: compute(),
            };
        }
    }
}
