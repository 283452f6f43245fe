//! Lists, maps and ranges of the standard library.

use std::collections::{BTreeMap, VecDeque};
use std::ops::{Range, RangeInclusive};

use serde::Serialize;
use serde::de::DeserializeOwned;

use super::{Children, Content, FieldShape, Reflect, Segment, Shape, whole};

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
            Shape {
                type_name: std::any::type_name::<Self>(),
                content: Content::Map(Box::new(V::shape())),
            }
        }

        fn child(&self, segment: &Segment) -> Option<&dyn Reflect> {
            match segment {
                Segment::Field(key) => Some(self.get(key)?),
                Segment::Index(key) => Some(self.get(&key.to_string())?),
            }
        }

        fn child_mut(&mut self, segment: &Segment) -> Option<&mut dyn Reflect> {
            match segment {
                Segment::Field(key) => Some(self.get_mut(key)?),
                Segment::Index(key) => Some(self.get_mut(&key.to_string())?),
            }
        }

        fn children(&self) -> Children {
            Children::named(self.keys().cloned())
        }

        whole!();
    };
}
pub(super) use map;

impl<T: Reflect + Serialize + DeserializeOwned> Reflect for Vec<T> {
    fn shape() -> Shape {
        list_shape::<Self, T>(None)
    }

    list!();
}

impl<T: Reflect + Serialize + DeserializeOwned> Reflect for VecDeque<T> {
    fn shape() -> Shape {
        list_shape::<Self, T>(None)
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
        match segment.name()? {
            "start" => Some(&self.start),
            "end" => Some(&self.end),
            _ => None,
        }
    }

    fn child_mut(&mut self, segment: &Segment) -> Option<&mut dyn Reflect> {
        match segment.name()? {
            "start" => Some(&mut self.start),
            "end" => Some(&mut self.end),
            _ => None,
        }
    }

    fn children(&self) -> Children {
        Children::named(["end", "start"])
    }

    whole!();
}

/// Its bounds are written together: the standard library lends them only to be read.
impl<T: Reflect + Serialize + DeserializeOwned> Reflect for RangeInclusive<T> {
    fn shape() -> Shape {
        range_shape::<Self, T>()
    }

    fn child(&self, segment: &Segment) -> Option<&dyn Reflect> {
        match segment.name()? {
            "start" => Some(self.start()),
            "end" => Some(self.end()),
            _ => None,
        }
    }

    fn children(&self) -> Children {
        Children::named(["end", "start"])
    }

    whole!();
}

fn list_shape<L, T: Reflect>(length: Option<usize>) -> Shape {
    Shape {
        type_name: std::any::type_name::<L>(),
        content: Content::List {
            item: Box::new(T::shape()),
            length,
            names: &[],
        },
    }
}

fn range_shape<R, T: Reflect>() -> Shape {
    let bound = |name| FieldShape {
        name,
        docs: "",
        unit: None,
        shape: T::shape(),
    };
    Shape {
        type_name: std::any::type_name::<R>(),
        content: Content::Struct(vec![bound("start"), bound("end")]),
    }
}
