//! Reflection: any value that a node exchanges, by path.
//!
//! Clients name values by path (`lamp.position.x`) and get only what they name: [`at`] walks by reference, copies nothing
//! and serialises nothing; [`Reflect::as_serialize`] of what it found serialises just that. Names below a value are those
//! that serde gives them. [`Shape`] tells the same tree without a value, with documentation and units.

pub mod binary;
pub mod derived;
pub mod path;
pub mod shape;

mod collections;
mod hashed;
mod image;
mod leaves;
mod limits;
mod lookup;
mod nalgebra;
mod pointers;
mod resolved;
mod schema;
mod tuples;
mod unknown;

use std::borrow::Cow;

use crate::foxglove::Form as WellKnownForm;
use crate::parameters::Given;
use crate::pool::Handle;

pub use binary::EncodeError;
pub use image::{Image, Pixels};
pub use limits::{Limits, OutOfRange};
pub use path::{InvalidPath, Path, Segment};
pub use resolved::ResolvedPath;
pub use shape::{Content, FieldShape, Form, Leaf, Shape, VariantContent, VariantShape};
pub use unknown::{Reason, UnknownPath};

/// A value whose parts can be named, read and written.
///
/// Derived: `#[derive(Reflect)]` beside `Serialize` and `Deserialize`, whose `rename`, `rename_all`, `skip`, `flatten`,
/// `transparent`, `tag`, `content` and `untagged` it follows. On a field `#[reflect(unit = "m")]` tells its unit,
/// `#[reflect(range = 0.0..=1.0)]` where its numbers must lie when it is a parameter, `#[reflect(skip)]` hides it.
/// `#[reflect(image = "yuyv")]` on a struct says that its values are images: [`Pixels`].
/// On the type `#[reflect(foxglove = FUNCTION)]` tells how it is drawn ([`crate::foxglove`]).
#[diagnostic::on_unimplemented(
    message = "`{Self}` does not implement `Reflect`",
    label = "cannot be shown, recorded or set by path",
    note = "add `#[derive(Reflect)]` (`use framework::Reflect`) beside `Serialize` and `Deserialize`"
)]
pub trait Reflect {
    /// What a value of this type can have below it.
    fn shape() -> Shape
    where
        Self: Sized;

    /// The form in which tools draw it, where the type says that it has one.
    fn foxglove() -> Option<WellKnownForm<Self>>
    where
        Self: Sized,
    {
        None
    }

    /// The part with that name or index; of an enum, of its active variant.
    fn child(&self, _segment: &Segment) -> Option<&dyn Reflect> {
        None
    }

    /// As [`Reflect::child`]; also `None` for parts of what must stay consistent (the numbers of a unit quaternion).
    fn child_mut(&mut self, _segment: &Segment) -> Option<&mut dyn Reflect> {
        None
    }

    /// What [`Reflect::child`] knows now.
    fn children(&self) -> Children {
        Children::default()
    }

    /// Appends the whole value as [`binary`] lays out its shape. Whoever wants to send it calls [`binary::encode`].
    fn encode(&self, bytes: &mut Vec<u8>) -> Result<(), EncodeError>;

    /// As [`Reflect::encode`] of each.
    fn encode_all(values: &[Self], bytes: &mut Vec<u8>) -> Result<(), EncodeError>
    where
        Self: Sized,
    {
        values.iter().try_for_each(|value| value.encode(bytes))
    }

    /// The whole value, for any serde format.
    fn as_serialize(&self) -> &dyn erased_serde::Serialize;

    /// Replaces the whole value; on an error it stays as it was.
    fn deserialize_from(&mut self, given: &Given<'_>) -> crate::Result<()>;

    /// What a recording may keep in place of a copy; only values of a [pool](crate::pool) have it.
    #[doc(hidden)]
    fn handle(&self) -> Option<Handle> {
        None
    }

    /// Full name of the type, for people.
    fn type_name(&self) -> &'static str {
        std::any::type_name::<Self>()
    }
}

/// What stands below a value: names, or indices from zero, or both.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Children {
    /// Sorted.
    pub names: Vec<Cow<'static, str>>,
    /// How many indices are valid.
    pub indices: usize,
    /// The value is an `Option` without content now.
    pub absent: bool,
}

impl Children {
    /// Only names, in any order.
    pub fn named<N: Into<Cow<'static, str>>>(names: impl IntoIterator<Item = N>) -> Self {
        let mut names: Vec<_> = names.into_iter().map(Into::into).collect();
        names.sort_unstable();
        Self {
            names,
            ..Self::default()
        }
    }

    /// Only indices.
    pub fn indexed(indices: usize) -> Self {
        Self {
            indices,
            ..Self::default()
        }
    }

    /// Those of a flattened field, too.
    #[must_use]
    pub fn and(mut self, other: Self) -> Self {
        self.names.extend(other.names);
        self.names.sort_unstable();
        self.names.dedup();
        self.indices = self.indices.max(other.indices);
        self
    }
}

/// The part of a value at a path.
pub fn at<'value>(
    value: &'value dyn Reflect,
    path: &Path,
) -> Result<&'value dyn Reflect, UnknownPath> {
    let mut part = value;
    for (position, segment) in path.segments().iter().enumerate() {
        part = match part.child(segment) {
            Some(child) => child,
            None => return Err(UnknownPath::new(path, position, part.children())),
        };
    }
    Ok(part)
}

/// The part of a value at a path, to be written.
pub fn at_mut<'value>(
    value: &'value mut dyn Reflect,
    path: &Path,
) -> Result<&'value mut dyn Reflect, UnknownPath> {
    let mut part = value;
    for (position, segment) in path.segments().iter().enumerate() {
        if part.child(segment).is_none() {
            return Err(UnknownPath::new(path, position, part.children()));
        }
        part = part
            .child_mut(segment)
            .ok_or_else(|| UnknownPath::only_whole(path, position))?;
    }
    Ok(part)
}

/// What all types do that are written and read as a whole by their own serde implementation.
macro_rules! whole {
    () => {
        fn as_serialize(&self) -> &dyn ::erased_serde::Serialize {
            self
        }

        fn deserialize_from(&mut self, given: &crate::parameters::Given<'_>) -> crate::Result<()> {
            *self = given.read()?;
            Ok(())
        }
    };
}
use whole;
