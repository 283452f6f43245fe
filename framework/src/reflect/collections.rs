//! Lists, maps and ranges of the standard library.

use std::collections::{BTreeMap, BTreeSet, VecDeque};
use std::ops::{Range, RangeInclusive};

use serde::Serialize;
use serde::de::DeserializeOwned;

use super::binary::{EncodeError, encode_count, encode_display, encode_text};
use super::{Children, Content, FieldShape, Reflect, Segment, Shape, whole};

/// Of a range.
const BOUNDS: [&str; 2] = ["start", "end"];

macro_rules! list {
    () => {
        fn child(&self, segment: &Segment) -> Option<&dyn Reflect> {
            Some(self.get(segment.index()?)?)
        }

        fn child_mut(&mut self, segment: &Segment) -> Option<&mut dyn Reflect> {
            Some(self.get_mut(segment.index()?)?)
        }

        fn children(&self) -> Children {
            Children::indexed(self.len())
        }

        whole!();
    };
}

/// Maps with texts as keys.
macro_rules! map {
    () => {
        fn shape() -> Shape {
            Shape::new::<Self>(Content::Map(Box::new(V::shape())))
        }

        fn child(&self, segment: &Segment) -> Option<&dyn Reflect> {
            match segment {
                Segment::Field(key) => Some(self.get(key)?),
                Segment::Index(key) => Some(self.get(&key.to_string())?),
                Segment::Position(_) => None,
            }
        }

        fn child_mut(&mut self, segment: &Segment) -> Option<&mut dyn Reflect> {
            match segment {
                Segment::Field(key) => Some(self.get_mut(key)?),
                Segment::Index(key) => Some(self.get_mut(&key.to_string())?),
                Segment::Position(_) => None,
            }
        }

        fn children(&self) -> Children {
            Children::named(self.keys().cloned())
        }

        fn encode(&self, bytes: &mut Vec<u8>) -> Result<(), EncodeError> {
            encode_count(self.len(), bytes)?;
            self.iter().try_for_each(|(key, value)| {
                encode_text(key, bytes)?;
                value.encode(bytes)
            })
        }

        whole!();
    };
}
pub(super) use map;

/// Maps with integers as keys: texts in the serde form.
macro_rules! counted_map {
    ($key:ty) => {
        fn shape() -> Shape {
            Shape::new::<Self>(Content::Map(Box::new(V::shape())))
        }

        fn child(&self, segment: &Segment) -> Option<&dyn Reflect> {
            Some(self.get(&segment.number::<$key>()?)?)
        }

        fn child_mut(&mut self, segment: &Segment) -> Option<&mut dyn Reflect> {
            Some(self.get_mut(&segment.number::<$key>()?)?)
        }

        fn children(&self) -> Children {
            Children::named(self.keys().map(ToString::to_string))
        }

        fn encode(&self, bytes: &mut Vec<u8>) -> Result<(), EncodeError> {
            encode_count(self.len(), bytes)?;
            self.iter().try_for_each(|(key, value)| {
                encode_display(key, bytes)?;
                value.encode(bytes)
            })
        }

        whole!();
    };
}
pub(super) use counted_map;

macro_rules! counted_maps {
    ($($key:ty)*) => {$(
        impl<V: Reflect + Serialize + DeserializeOwned> Reflect for BTreeMap<$key, V> {
            counted_map!($key);
        }
    )*};
}

counted_maps! { i8 i16 i32 i64 isize u8 u16 u32 u64 usize }

/// Sets: their elements have no index that lasts.
macro_rules! set {
    () => {
        fn shape() -> Shape {
            Shape::new::<Self>(Content::Set(Box::new(T::shape())))
        }

        fn encode(&self, bytes: &mut Vec<u8>) -> Result<(), EncodeError> {
            encode_count(self.len(), bytes)?;
            self.iter().try_for_each(|item| item.encode(bytes))
        }

        whole!();
    };
}
pub(super) use set;

impl<T: Reflect + Serialize + DeserializeOwned + Ord> Reflect for BTreeSet<T> {
    set!();
}

impl<T: Reflect + Serialize + DeserializeOwned> Reflect for Vec<T> {
    fn shape() -> Shape {
        list_shape::<Self, T>(None)
    }

    fn encode(&self, bytes: &mut Vec<u8>) -> Result<(), EncodeError> {
        encode_count(self.len(), bytes)?;
        T::encode_all(self, bytes)
    }

    list!();
}

impl<T: Reflect + Serialize + DeserializeOwned> Reflect for VecDeque<T> {
    fn shape() -> Shape {
        list_shape::<Self, T>(None)
    }

    fn encode(&self, bytes: &mut Vec<u8>) -> Result<(), EncodeError> {
        encode_count(self.len(), bytes)?;
        let (front, back) = self.as_slices();
        T::encode_all(front, bytes)?;
        T::encode_all(back, bytes)
    }

    list!();
}

impl<T: Reflect, const N: usize> Reflect for [T; N]
where
    [T; N]: Serialize + DeserializeOwned,
{
    fn shape() -> Shape {
        list_shape::<Self, T>(Some(N))
    }

    fn encode(&self, bytes: &mut Vec<u8>) -> Result<(), EncodeError> {
        T::encode_all(self, bytes)
    }

    list!();
}

impl<V: Reflect + Serialize + DeserializeOwned> Reflect for BTreeMap<String, V> {
    map!();
}

impl<T: Reflect + Serialize + DeserializeOwned> Reflect for Range<T> {
    fn shape() -> Shape {
        range_shape::<Self, T>()
    }

    fn child(&self, segment: &Segment) -> Option<&dyn Reflect> {
        match segment.field(&BOUNDS)? {
            0 => Some(&self.start),
            1 => Some(&self.end),
            _ => None,
        }
    }

    fn child_mut(&mut self, segment: &Segment) -> Option<&mut dyn Reflect> {
        match segment.field(&BOUNDS)? {
            0 => Some(&mut self.start),
            1 => Some(&mut self.end),
            _ => None,
        }
    }

    fn children(&self) -> Children {
        Children::named(BOUNDS)
    }

    fn encode(&self, bytes: &mut Vec<u8>) -> Result<(), EncodeError> {
        self.start.encode(bytes)?;
        self.end.encode(bytes)
    }

    whole!();
}

/// Its bounds are written together: the standard library lends them only to be read.
impl<T: Reflect + Serialize + DeserializeOwned> Reflect for RangeInclusive<T> {
    fn shape() -> Shape {
        range_shape::<Self, T>()
    }

    fn child(&self, segment: &Segment) -> Option<&dyn Reflect> {
        match segment.field(&BOUNDS)? {
            0 => Some(self.start()),
            1 => Some(self.end()),
            _ => None,
        }
    }

    fn children(&self) -> Children {
        Children::named(BOUNDS)
    }

    fn encode(&self, bytes: &mut Vec<u8>) -> Result<(), EncodeError> {
        self.start().encode(bytes)?;
        self.end().encode(bytes)
    }

    whole!();
}

fn list_shape<L, T: Reflect>(length: Option<usize>) -> Shape {
    Shape::new::<L>(Content::List {
        item: Box::new(T::shape()),
        length,
        names: &[],
    })
}

fn range_shape<R, T: Reflect>() -> Shape {
    let bound = |name| FieldShape::new(name, T::shape());
    Shape::new::<R>(Content::Struct(BOUNDS.map(bound).into()))
}
