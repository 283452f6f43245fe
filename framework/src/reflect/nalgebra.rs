//! Vectors, points, matrices and rotations. A number in one has a name (`x`) and an index, as in its serde form.

use nalgebra::{
    Complex, Isometry, Point, Quaternion, RealField, Rotation, SMatrix, Scalar, Translation, Unit,
};
use serde::Serialize;
use serde::de::DeserializeOwned;

use super::binary::EncodeError;
use super::{Children, Content, FieldShape, Reflect, Segment, Shape, whole};
use crate::parameters::Given;

const AXES: [&str; 4] = ["x", "y", "z", "w"];
const QUATERNION: [&str; 4] = ["i", "j", "k", "w"];
const ISOMETRY: [&str; 2] = ["rotation", "translation"];
const COMPLEX: [&str; 2] = ["re", "im"];
/// How far from one the length of what must be a unit may be when it is written.
const UNIT_TOLERANCE: f64 = 1e-3;

/// A number of a vector.
trait Number: Scalar + Reflect + Serialize + DeserializeOwned {}

impl<T: Scalar + Reflect + Serialize + DeserializeOwned> Number for T {}

impl<T: Number, const R: usize, const C: usize> Reflect for SMatrix<T, R, C> {
    fn shape() -> Shape {
        list_shape::<Self, T>(R * C, axes(R, C))
    }

    fn child(&self, segment: &Segment) -> Option<&dyn Reflect> {
        Some(self.as_slice().get(segment.position(axes(R, C))?)?)
    }

    fn child_mut(&mut self, segment: &Segment) -> Option<&mut dyn Reflect> {
        Some(self.as_mut_slice().get_mut(segment.position(axes(R, C))?)?)
    }

    fn children(&self) -> Children {
        list_children(R * C, axes(R, C))
    }

    fn encode(&self, bytes: &mut Vec<u8>) -> Result<(), EncodeError> {
        T::encode_all(self.as_slice(), bytes)
    }

    whole!();
}

impl<T: Number, const D: usize> Reflect for Point<T, D> {
    fn shape() -> Shape {
        list_shape::<Self, T>(D, axes(D, 1))
    }

    fn child(&self, segment: &Segment) -> Option<&dyn Reflect> {
        self.coords.child(segment)
    }

    fn child_mut(&mut self, segment: &Segment) -> Option<&mut dyn Reflect> {
        self.coords.child_mut(segment)
    }

    fn children(&self) -> Children {
        self.coords.children()
    }

    fn encode(&self, bytes: &mut Vec<u8>) -> Result<(), EncodeError> {
        self.coords.encode(bytes)
    }

    whole!();
}

impl<T: Number, const D: usize> Reflect for Translation<T, D> {
    fn shape() -> Shape {
        list_shape::<Self, T>(D, axes(D, 1))
    }

    fn child(&self, segment: &Segment) -> Option<&dyn Reflect> {
        self.vector.child(segment)
    }

    fn child_mut(&mut self, segment: &Segment) -> Option<&mut dyn Reflect> {
        self.vector.child_mut(segment)
    }

    fn children(&self) -> Children {
        self.vector.children()
    }

    fn encode(&self, bytes: &mut Vec<u8>) -> Result<(), EncodeError> {
        self.vector.encode(bytes)
    }

    whole!();
}

impl<T, R, const D: usize> Reflect for Isometry<T, R, D>
where
    T: Number,
    R: Reflect + Serialize + DeserializeOwned,
{
    fn shape() -> Shape {
        Shape::new::<Self>(Content::Struct(vec![
            FieldShape::new("rotation", R::shape()),
            FieldShape::new("translation", Translation::<T, D>::shape()),
        ]))
    }

    fn child(&self, segment: &Segment) -> Option<&dyn Reflect> {
        match segment.field(&ISOMETRY)? {
            0 => Some(&self.rotation),
            1 => Some(&self.translation),
            _ => None,
        }
    }

    fn child_mut(&mut self, segment: &Segment) -> Option<&mut dyn Reflect> {
        match segment.field(&ISOMETRY)? {
            0 => Some(&mut self.rotation),
            1 => Some(&mut self.translation),
            _ => None,
        }
    }

    fn children(&self) -> Children {
        Children::named(ISOMETRY)
    }

    fn encode(&self, bytes: &mut Vec<u8>) -> Result<(), EncodeError> {
        self.rotation.encode(bytes)?;
        self.translation.encode(bytes)
    }

    whole!();
}

impl<T: Number> Reflect for Quaternion<T> {
    fn shape() -> Shape {
        list_shape::<Self, T>(4, &QUATERNION)
    }

    fn child(&self, segment: &Segment) -> Option<&dyn Reflect> {
        Some(self.coords.as_slice().get(segment.position(&QUATERNION)?)?)
    }

    fn child_mut(&mut self, segment: &Segment) -> Option<&mut dyn Reflect> {
        Some(
            self.coords
                .as_mut_slice()
                .get_mut(segment.position(&QUATERNION)?)?,
        )
    }

    fn children(&self) -> Children {
        list_children(4, &QUATERNION)
    }

    fn encode(&self, bytes: &mut Vec<u8>) -> Result<(), EncodeError> {
        T::encode_all(self.coords.as_slice(), bytes)
    }

    whole!();
}

impl<T: Number> Reflect for Complex<T> {
    fn shape() -> Shape {
        list_shape::<Self, T>(2, &COMPLEX)
    }

    fn child(&self, segment: &Segment) -> Option<&dyn Reflect> {
        match segment.position(&COMPLEX)? {
            0 => Some(&self.re),
            1 => Some(&self.im),
            _ => None,
        }
    }

    fn child_mut(&mut self, segment: &Segment) -> Option<&mut dyn Reflect> {
        match segment.position(&COMPLEX)? {
            0 => Some(&mut self.re),
            1 => Some(&mut self.im),
            _ => None,
        }
    }

    fn children(&self) -> Children {
        list_children(2, &COMPLEX)
    }

    fn encode(&self, bytes: &mut Vec<u8>) -> Result<(), EncodeError> {
        self.re.encode(bytes)?;
        self.im.encode(bytes)
    }

    whole!();
}

/// Its numbers are only written together, and only as a unit: filters rely on it.
macro_rules! unit {
    ($(<$($constant:ident)?> $inner:ty, $norm:expr;)*) => {$(
        impl<T: Number + RealField, $(const $constant: usize)?> Reflect for Unit<$inner> {
            fn shape() -> Shape {
                Shape {
                    type_name: std::any::type_name::<Self>(),
                    ..<$inner as Reflect>::shape()
                }
            }

            fn child(&self, segment: &Segment) -> Option<&dyn Reflect> {
                self.as_ref().child(segment)
            }

            fn children(&self) -> Children {
                self.as_ref().children()
            }

            fn encode(&self, bytes: &mut Vec<u8>) -> Result<(), EncodeError> {
                self.as_ref().encode(bytes)
            }

            fn as_serialize(&self) -> &dyn erased_serde::Serialize {
                self
            }

            fn deserialize_from(&mut self, given: &Given<'_>) -> crate::Result<()> {
                let value: Self = given.read()?;
                let norm: fn(&$inner) -> T = $norm;
                check_unit(norm(value.as_ref()) - T::one())?;
                *self = value;
                Ok(())
            }
        }
    )*};
}

unit! {
    <> Quaternion<T>, |quaternion| quaternion.norm();
    <> Complex<T>, |complex| complex.re.clone().hypot(complex.im.clone());
    <D> SMatrix<T, D, 1>, |vector| vector.norm();
}

/// Its numbers are only written together, and only as a rotation.
impl<T: Number + RealField, const D: usize> Reflect for Rotation<T, D> {
    fn shape() -> Shape {
        list_shape::<Self, T>(D * D, &[])
    }

    fn child(&self, segment: &Segment) -> Option<&dyn Reflect> {
        self.matrix().child(segment)
    }

    fn children(&self) -> Children {
        self.matrix().children()
    }

    fn encode(&self, bytes: &mut Vec<u8>) -> Result<(), EncodeError> {
        self.matrix().encode(bytes)
    }

    fn as_serialize(&self) -> &dyn erased_serde::Serialize {
        self
    }

    fn deserialize_from(&mut self, given: &Given<'_>) -> crate::Result<()> {
        let value: Self = given.read()?;
        let matrix = value.matrix();
        check_unit((matrix.transpose() * matrix - SMatrix::<T, D, D>::identity()).norm())?;
        *self = value;
        Ok(())
    }
}

/// Words for the indices of a vector.
fn axes(rows: usize, columns: usize) -> &'static [&'static str] {
    match AXES.get(..rows) {
        Some(axes) if columns == 1 => axes,
        _ => &[],
    }
}

fn list_shape<L, T: Reflect>(length: usize, names: &'static [&'static str]) -> Shape {
    Shape::new::<L>(Content::List {
        item: Box::new(T::shape()),
        length: Some(length),
        names,
    })
}

fn list_children(length: usize, names: &'static [&'static str]) -> Children {
    Children {
        indices: length,
        ..Children::named(names.iter().copied())
    }
}

fn check_unit<T: RealField>(deviation: T) -> crate::Result<()> {
    if deviation.abs() <= nalgebra::convert(UNIT_TOLERANCE) {
        return Ok(());
    }
    Err(crate::Error::new(
        "expected a rotation or direction: its length is not one",
    ))
}
