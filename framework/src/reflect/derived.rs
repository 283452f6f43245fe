//! What `#[derive(Reflect)]` needs at the place where it stands. Not meant to be written by hand.

pub use erased_serde;
pub use serde::Serialize;
pub use serde::de::DeserializeOwned;

pub use crate::error::Result;
pub use crate::foxglove::{Form as WellKnownForm, schema_of, written};
pub use crate::parameters::Given;

pub use super::binary::{EncodeError, encode_any, encode_tag, encode_unless, skipped_variant};
pub use super::{
    Children, Content, FieldShape, Form, Leaf, Limits, Pixels, Reflect, Segment, Shape,
    VariantContent, VariantShape,
};

/// The fields of a struct, with those of its flattened fields.
pub fn fields(parts: impl IntoIterator<Item = Fields>) -> Content {
    let mut fields = Vec::new();
    for part in parts {
        match part {
            Fields::One(field) => fields.push(field),
            Fields::Flattened(shape) => fields.extend(flattened(shape)),
        }
    }
    Content::Struct(fields)
}

/// What one field adds to the fields of its struct.
#[derive(Debug)]
pub enum Fields {
    One(FieldShape),
    /// From `#[serde(flatten)]`.
    Flattened(Shape),
}

fn flattened(shape: Shape) -> Vec<FieldShape> {
    match shape.content {
        Content::Struct(fields) => fields,
        Content::Option(inner) => {
            let fields = flattened(*inner).into_iter();
            fields
                .map(|field| FieldShape {
                    optional: true,
                    ..field
                })
                .collect()
        }
        // Keys or variants, which only a value has.
        _ => Vec::new(),
    }
}
