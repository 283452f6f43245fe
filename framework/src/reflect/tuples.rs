//! Tuples: parts by index.

use serde::Serialize;
use serde::de::DeserializeOwned;

use super::binary::EncodeError;
use super::{Children, Content, Reflect, Segment, Shape, whole};

macro_rules! tuple {
    ($length:literal: $($index:tt $item:ident),*) => {
        impl<$($item: Reflect + Serialize + DeserializeOwned),*> Reflect for ($($item,)*) {
            fn shape() -> Shape {
                Shape::new::<Self>(Content::Tuple(vec![$($item::shape()),*]))
            }

            fn child(&self, segment: &Segment) -> Option<&dyn Reflect> {
                match segment.index()? {
                    $($index => Some(&self.$index),)*
                    _ => None,
                }
            }

            fn child_mut(&mut self, segment: &Segment) -> Option<&mut dyn Reflect> {
                match segment.index()? {
                    $($index => Some(&mut self.$index),)*
                    _ => None,
                }
            }

            fn children(&self) -> Children {
                Children::indexed($length)
            }

            fn encode(&self, bytes: &mut Vec<u8>) -> Result<(), EncodeError> {
                $(self.$index.encode(bytes)?;)*
                Ok(())
            }

            whole!();
        }
    };
}

tuple!(1: 0 A);
tuple!(2: 0 A, 1 B);
tuple!(3: 0 A, 1 B, 2 C);
tuple!(4: 0 A, 1 B, 2 C, 3 D);
tuple!(5: 0 A, 1 B, 2 C, 3 D, 4 E);
tuple!(6: 0 A, 1 B, 2 C, 3 D, 4 E, 5 F);
