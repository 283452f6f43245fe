//! [`Clear`] for types of the standard library, of nalgebra and of the framework.

use std::collections::{BTreeMap, BTreeSet, VecDeque};
use std::net::{IpAddr, Ipv4Addr, Ipv6Addr, SocketAddr};
use std::ops::{Range, RangeInclusive};
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

use nalgebra::{
    Complex, Isometry, Point, Quaternion, Rotation, SMatrix, Scalar, Translation, Unit,
};

use super::Clear;
use crate::time::Timestamp;

macro_rules! plain {
    ($($type:ty),* $(,)?) => {$(
        impl Clear for $type {}
    )*};
}

/// Collections that keep their capacity when they are emptied.
macro_rules! collection {
    ($($type:ty where [$($bounds:tt)*];)*) => {$(
        impl<$($bounds)*> Clear for $type {
            fn clear(&mut self) {
                // The inherent function, which allocates nothing and gives nothing away.
                self.clear();
            }

            fn assign(&mut self, value: Self) {
                self.clear();
                self.extend(value);
            }
        }
    )*};
}
pub(super) use collection;

macro_rules! tuple {
    ($($index:tt $item:ident),*) => {
        impl<$($item: Clear),*> Clear for ($($item,)*) {
            fn assign(&mut self, value: Self) {
                $(self.$index.assign(value.$index);)*
            }
        }
    };
}

plain! {
    (), bool, char, f32, f64, i8, i16, i32, i64, i128, isize, u8, u16, u32, u64, u128, usize,
    Duration, IpAddr, Ipv4Addr, Ipv6Addr, SocketAddr, Timestamp,
}

collection! {
    Vec<T> where [T];
    VecDeque<T> where [T];
    BTreeMap<K, V> where [K: Ord, V];
    BTreeSet<T> where [T: Ord];
}

tuple!(0 A);
tuple!(0 A, 1 B);
tuple!(0 A, 1 B, 2 C);
tuple!(0 A, 1 B, 2 C, 3 D);
tuple!(0 A, 1 B, 2 C, 3 D, 4 E);
tuple!(0 A, 1 B, 2 C, 3 D, 4 E, 5 F);

impl Clear for String {
    fn clear(&mut self) {
        self.clear();
    }

    fn assign(&mut self, value: Self) {
        self.clear();
        self.push_str(&value);
    }
}

impl Clear for PathBuf {
    fn assign(&mut self, value: Self) {
        self.clear();
        self.push(value);
    }
}

impl<T: Clear> Clear for Option<T> {
    fn assign(&mut self, value: Self) {
        match (self, value) {
            (Some(content), Some(value)) => content.assign(value),
            (place, value) => *place = value,
        }
    }
}

impl<T: Clear> Clear for Box<T> {
    fn assign(&mut self, value: Self) {
        (**self).assign(*value);
    }
}

impl<T: Clear> Clear for Arc<T> {
    fn assign(&mut self, value: Self) {
        match (Self::get_mut(self), Self::try_unwrap(value)) {
            (Some(content), Ok(value)) => content.assign(value),
            (_, Ok(value)) => *self = Self::new(value),
            (_, Err(shared)) => *self = shared,
        }
    }
}

impl<T: Clear, const N: usize> Clear for [T; N] {
    fn assign(&mut self, value: Self) {
        for (place, value) in self.iter_mut().zip(value) {
            place.assign(value);
        }
    }
}

impl<T: Clear> Clear for Range<T> {
    fn assign(&mut self, value: Self) {
        self.start.assign(value.start);
        self.end.assign(value.end);
    }
}

impl<T> Clear for RangeInclusive<T> {}

impl<T: Scalar, const R: usize, const C: usize> Clear for SMatrix<T, R, C> {}
impl<T: Scalar, const D: usize> Clear for Point<T, D> {}
impl<T: Scalar, const D: usize> Clear for Translation<T, D> {}
impl<T: Scalar, const D: usize> Clear for Rotation<T, D> {}
impl<T: Scalar, R, const D: usize> Clear for Isometry<T, R, D> {}
impl<T: Scalar> Clear for Quaternion<T> {}
impl<T> Clear for Complex<T> {}
impl<T> Clear for Unit<T> {}
