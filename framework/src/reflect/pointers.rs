//! Values that stand for another: its parts are theirs.

use std::sync::Arc;

use serde::Serialize;
use serde::de::DeserializeOwned;

use super::binary::EncodeError;
use super::{Children, Content, Reflect, Segment, Shape, whole};
use crate::foxglove::Form;
use crate::parameters::Given;
use crate::pool::Handle;

impl<T: Reflect + Serialize + DeserializeOwned> Reflect for Option<T> {
    fn shape() -> Shape {
        Shape::new::<Self>(Content::Option(Box::new(T::shape())))
    }

    fn foxglove() -> Option<Form<Self>> {
        Some(Form {
            schema: T::foxglove()?.schema,
            write: |value, timestamp| (T::foxglove()?.write)(value.as_ref()?, timestamp),
        })
    }

    fn child(&self, segment: &Segment) -> Option<&dyn Reflect> {
        self.as_ref()?.child(segment)
    }

    fn child_mut(&mut self, segment: &Segment) -> Option<&mut dyn Reflect> {
        self.as_mut()?.child_mut(segment)
    }

    fn children(&self) -> Children {
        match self {
            Some(value) => value.children(),
            None => Children {
                absent: true,
                ..Children::default()
            },
        }
    }

    fn encode(&self, bytes: &mut Vec<u8>) -> Result<(), EncodeError> {
        match self {
            None => {
                bytes.push(0);
                Ok(())
            }
            Some(value) => {
                bytes.push(1);
                value.encode(bytes)
            }
        }
    }

    fn handle(&self) -> Option<Handle> {
        self.as_ref()?.handle().map(Handle::in_option)
    }

    whole!();
}

impl<T: Reflect> Reflect for Box<T> {
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
        (**self).child_mut(segment)
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
        (**self).deserialize_from(given)
    }
}

/// Written through a copy of its own where it is shared.
impl<T: Reflect + Clone> Reflect for Arc<T> {
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
        Self::make_mut(self).child_mut(segment)
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
        Self::make_mut(self).deserialize_from(given)
    }
}
