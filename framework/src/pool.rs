//! Large values (images) that are handed on by handle: made once, filled by one owner again and again, read by many.
//!
//! ```
//! use framework::{Leased, Pool};
//!
//! let mut pool = Pool::new(3, || vec![0_u8; 600]);
//! let mut image = pool.free().expect("nobody has a handle yet");
//! image[0] = 7;
//! let output: Option<Leased<Vec<u8>>> = Some(image.lease());
//! // Histories, queues and other instances copy the handle, never the value.
//! let in_a_history = output.clone();
//! assert_eq!(in_a_history.expect("it was leased")[0], 7);
//! ```
//! A value is free again when its last handle is gone. A pool has as many values as have had handles at once, and makes no more
//! of them than it may, but for those that a recording holds. As an output it is an `Option`: absent until something is leased, and
//! absent again, without the handle, when the output is cleared.

use std::fmt;
use std::ops::{Deref, DerefMut};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, AtomicUsize, Ordering};

use hulkgen_recording::Late;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use crate::clear::Clear;
use crate::digest::Digest;
use crate::error::{Error, NoEvent};
use crate::foxglove::Form;
use crate::guarded::contain;
use crate::parameters::Given;
use crate::reflect::{Children, EncodeError, Reflect, Segment, Shape};
use crate::report::tell;

/// Values that are filled again and again. It is their owner's alone: a camera has one of its own.
#[derive(Debug)]
pub struct Pool<T> {
    values: Vec<Arc<Pooled<T>>>,
    /// So many it may have.
    most: usize,
    make: fn() -> T,
    /// Where the search begins: values are given back in about the order in which they were leased.
    next: usize,
    /// Handles that recordings have.
    recorded: Arc<AtomicUsize>,
}

/// A value of a pool that nobody else sees.
#[derive(Debug)]
pub struct Free<'pool, T> {
    value: &'pool mut Arc<Pooled<T>>,
}

/// A handle of a value that is not written any more. A clone is another handle of the same value.
pub struct Leased<T>(Arc<Pooled<T>>);

/// A value, and how many handles recordings have of all values of its pool: they hold what a disk is slow to take.
#[derive(Debug)]
struct Pooled<T> {
    value: T,
    recorded: Arc<AtomicUsize>,
}

/// A handle for a recording, which writes the value when its cycle is over.
#[doc(hidden)]
pub struct Handle {
    pub(crate) value: Arc<dyn Late>,
    /// So many `Option`s are around it.
    pub(crate) options: usize,
}

impl<T> Pool<T> {
    /// A pool of at most so many values. A slot, a history entry and a reader that holds a value hold one each; while
    /// clients watch an output, up to [`WINDOW`](crate::tap::WINDOW) and a few more. For handles that a recording has, until its file
    /// has the values, it has more: at most as many as [`late`](crate::recorded::Settings::late) says.
    pub fn new(most: usize, make: fn() -> T) -> Self {
        Self {
            values: Vec::new(),
            most,
            make,
            next: 0,
            recorded: Arc::default(),
        }
    }

    /// A value without handles, as it was left, and the same until it is leased. Only if there are handles of all of them, one
    /// more is made.
    ///
    /// # Errors
    /// `NoEvent` if there are as many as there may be, and handles of all of them: a camera that gives this to its setup node
    /// takes the newest image as soon as a handle goes, and those before are counted.
    pub fn free(&mut self) -> Result<Free<'_, T>, NoEvent> {
        let count = self.values.len();
        // Before the search: what a recording lets go from here on is found. Acquire: no part of the search comes before.
        let most = self.most + self.recorded.load(Ordering::Acquire);
        let index = (self.next..count)
            .chain(0..self.next)
            .find(|index| Arc::get_mut(&mut self.values[*index]).is_some());
        let index = match index {
            Some(index) => index,
            None if count < most => {
                self.values.push(Arc::new(Pooled {
                    value: (self.make)(),
                    recorded: self.recorded.clone(),
                }));
                count
            }
            None => {
                return Err(NoEvent(format!(
                    "readers hold all {count} values of the pool"
                )));
            }
        };
        self.next = index;
        Ok(Free {
            value: &mut self.values[index],
        })
    }

    /// How many values it has made.
    pub fn made(&self) -> usize {
        self.values.len()
    }
}

impl<T> Free<'_, T> {
    /// Ends the writing: a handle for everybody who reads.
    pub fn lease(self) -> Leased<T> {
        Leased(self.value.clone())
    }
}

impl<T> Deref for Free<'_, T> {
    type Target = T;

    fn deref(&self) -> &T {
        &self.value.value
    }
}

impl<T> DerefMut for Free<'_, T> {
    fn deref_mut(&mut self) -> &mut T {
        let held = Arc::get_mut(self.value);
        &mut held
            .expect("a free value has no handle, and this borrow lets none be made")
            .value
    }
}

impl<T> Leased<T> {
    /// A value of no pool: what a recording or a client gives.
    pub fn of(value: T) -> Self {
        Self(Arc::new(Pooled {
            value,
            recorded: Arc::default(),
        }))
    }

    /// The value alone, as a copy where there are other handles.
    fn own(&mut self) -> &mut T
    where
        T: Clone,
    {
        &mut Arc::make_mut(&mut self.0).value
    }

    /// Whether both are handles of the same value.
    pub fn is_same(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

impl<T: Clone> Clone for Pooled<T> {
    /// Of no pool.
    fn clone(&self) -> Self {
        Self {
            value: self.value.clone(),
            recorded: Arc::default(),
        }
    }
}

impl<T: Reflect + Send + Sync> Late for Pooled<T> {
    fn write(&self, bytes: &mut Vec<u8>) -> bool {
        let written = contain("the recording", || {
            Ok(postcard::to_io(self.value.as_serialize(), bytes)?)
        });
        if let Err(error) = &written {
            tell_refused(&self.value, error);
        }
        written.is_ok()
    }

    fn keep(&self) {
        self.recorded.fetch_add(1, Ordering::Relaxed);
    }

    fn let_go(self: Arc<Self>) {
        let recorded = self.recorded.clone();
        // Its pool may be gone.
        let _ = contain("the recording", || {
            drop(self);
            Ok(())
        });
        // Release: whoever sees it finds the value free.
        recorded.fetch_sub(1, Ordering::Release);
    }
}

/// Tells the first, and ever fewer of those behind it: an output that cannot be written never can.
#[cold]
fn tell_refused(value: &dyn Reflect, error: &Error) {
    static REFUSED: AtomicU64 = AtomicU64::new(0);
    let number = REFUSED.fetch_add(1, Ordering::Relaxed) + 1;
    if number.is_power_of_two() {
        let name = value.type_name();
        // postcard does not tell what the value said.
        let said = contain("the recording", || {
            Ok(Digest::new().add(value.as_serialize())?)
        });
        let error = said.err().unwrap_or_else(|| Error::new(error.to_string()));
        tell(format_args!(
            "a `{name}` is not recorded, nor what its instance recorded soon after it: {error} (failure {number} of all values)"
        ));
    }
}

impl Handle {
    /// Of an `Option` of what this is a handle of.
    pub(crate) fn in_option(self) -> Self {
        Self {
            options: self.options + 1,
            ..self
        }
    }
}

impl<T> Clone for Leased<T> {
    fn clone(&self) -> Self {
        Self(self.0.clone())
    }
}

impl<T> Deref for Leased<T> {
    type Target = T;

    fn deref(&self) -> &T {
        &self.0.value
    }
}

impl<T: fmt::Debug> fmt::Debug for Leased<T> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        (**self).fmt(formatter)
    }
}

impl<T: PartialEq> PartialEq for Leased<T> {
    fn eq(&self, other: &Self) -> bool {
        self.is_same(other) || **self == **other
    }
}

impl<T> Clear for Leased<T> {}

/// As the value itself.
impl<T: Serialize> Serialize for Leased<T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        (**self).serialize(serializer)
    }
}

impl<'de, T: Deserialize<'de>> Deserialize<'de> for Leased<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        T::deserialize(deserializer).map(Self::of)
    }
}

/// Its parts are those of the value; what is written is a copy of its own where there are other handles.
impl<T: Reflect + Clone + Send + Sync + 'static> Reflect for Leased<T> {
    fn shape() -> Shape {
        T::shape()
    }

    fn foxglove() -> Option<Form<Self>> {
        Some(Form {
            schema: T::foxglove()?.schema,
            write: |value, timestamp| (T::foxglove()?.write)(value, timestamp),
        })
    }

    fn child(&self, segment: &Segment) -> Option<&dyn Reflect> {
        (**self).child(segment)
    }

    fn child_mut(&mut self, segment: &Segment) -> Option<&mut dyn Reflect> {
        self.own().child_mut(segment)
    }

    fn children(&self) -> Children {
        (**self).children()
    }

    fn encode(&self, bytes: &mut Vec<u8>) -> Result<(), EncodeError> {
        (**self).encode(bytes)
    }

    fn as_serialize(&self) -> &dyn erased_serde::Serialize {
        (**self).as_serialize()
    }

    fn deserialize_from(&mut self, given: &Given<'_>) -> crate::Result<()> {
        self.own().deserialize_from(given)
    }

    fn handle(&self) -> Option<Handle> {
        Some(Handle {
            value: self.0.clone(),
            options: 0,
        })
    }
}
