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
//! of them than it may. As an output it is an `Option`: absent until something is leased, and
//! absent again, without the handle, when the output is cleared.

use std::fmt;
use std::ops::{Deref, DerefMut};
use std::sync::Arc;

use serde::{Deserialize, Deserializer, Serialize, Serializer};

use crate::clear::Clear;
use crate::error::NoEvent;
use crate::foxglove::Form;
use crate::reflect::{Children, EncodeError, Reflect, Segment, Shape};

/// Values that are filled again and again. It is their owner's alone: a camera has one of its own.
#[derive(Debug)]
pub struct Pool<T> {
    values: Vec<Arc<T>>,
    /// So many it may have.
    most: usize,
    make: fn() -> T,
    /// Where the search begins: values are given back in about the order in which they were leased.
    next: usize,
}

/// A value of a pool that nobody else sees.
#[derive(Debug)]
pub struct Free<'pool, T> {
    value: &'pool mut Arc<T>,
}

/// A handle of a value that is not written any more. A clone is another handle of the same value.
pub struct Leased<T>(Arc<T>);

impl<T> Pool<T> {
    /// A pool of at most so many values. A slot, a history entry and a reader that holds a value hold one each; while
    /// clients watch an output, up to [`WINDOW`](crate::tap::WINDOW) and a few more.
    pub fn new(most: usize, make: fn() -> T) -> Self {
        Self {
            values: Vec::new(),
            most,
            make,
            next: 0,
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
        let index = (self.next..count)
            .chain(0..self.next)
            .find(|index| Arc::get_mut(&mut self.values[*index]).is_some());
        let index = match index {
            Some(index) => index,
            None if count < self.most => {
                self.values.push(Arc::new((self.make)()));
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
        self.value
    }
}

impl<T> DerefMut for Free<'_, T> {
    fn deref_mut(&mut self) -> &mut T {
        Arc::get_mut(self.value)
            .expect("a free value has no handle, and this borrow lets none be made")
    }
}

impl<T> Leased<T> {
    /// A value of no pool: what a recording or a client gives.
    pub fn of(value: T) -> Self {
        Self(Arc::new(value))
    }

    /// Whether both are handles of the same value.
    pub fn is_same(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
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
        &self.0
    }
}

impl<T: fmt::Debug> fmt::Debug for Leased<T> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(formatter)
    }
}

impl<T: PartialEq> PartialEq for Leased<T> {
    fn eq(&self, other: &Self) -> bool {
        self.is_same(other) || self.0 == other.0
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
impl<T: Reflect + Clone> Reflect for Leased<T> {
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
        self.0.child(segment)
    }

    fn child_mut(&mut self, segment: &Segment) -> Option<&mut dyn Reflect> {
        self.0.child_mut(segment)
    }

    fn children(&self) -> Children {
        self.0.children()
    }

    fn encode(&self, bytes: &mut Vec<u8>) -> Result<(), EncodeError> {
        self.0.encode(bytes)
    }

    fn as_serialize(&self) -> &dyn erased_serde::Serialize {
        self.0.as_serialize()
    }

    fn deserialize_from(
        &mut self,
        deserializer: &mut dyn erased_serde::Deserializer<'_>,
    ) -> Result<(), erased_serde::Error> {
        self.0.deserialize_from(deserializer)
    }
}
