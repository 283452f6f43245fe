//! Values without parts.

use std::collections::BTreeSet;
use std::net::{IpAddr, Ipv4Addr, Ipv6Addr, SocketAddr};
use std::path::PathBuf;
use std::time::Duration;

use serde::Serialize;
use serde::de::DeserializeOwned;

use super::{Leaf, Reflect, Shape, whole};
use crate::time::Timestamp;

macro_rules! leaf {
    ($($type:ty => $leaf:expr;)*) => {$(
        impl Reflect for $type {
            fn shape() -> Shape {
                Shape::leaf::<Self>($leaf)
            }

            whole!();
        }
    )*};
}

leaf! {
    () => Leaf::Unit;
    bool => Leaf::Bool;
    char => Leaf::Character;
    f32 => Leaf::Float { bits: 32 };
    f64 => Leaf::Float { bits: 64 };
    i8 => Leaf::Signed { bits: 8 };
    i16 => Leaf::Signed { bits: 16 };
    i32 => Leaf::Signed { bits: 32 };
    i64 => Leaf::Signed { bits: 64 };
    i128 => Leaf::Signed { bits: 128 };
    isize => Leaf::Signed { bits: isize::BITS };
    u8 => Leaf::Unsigned { bits: 8 };
    u16 => Leaf::Unsigned { bits: 16 };
    u32 => Leaf::Unsigned { bits: 32 };
    u64 => Leaf::Unsigned { bits: 64 };
    u128 => Leaf::Unsigned { bits: 128 };
    usize => Leaf::Unsigned { bits: usize::BITS };
    String => Leaf::Text;
    PathBuf => Leaf::Text;
    IpAddr => Leaf::Text;
    Ipv4Addr => Leaf::Text;
    Ipv6Addr => Leaf::Text;
    SocketAddr => Leaf::Text;
    Duration => Leaf::Opaque;
    Timestamp => Leaf::Unsigned { bits: 64 };
}

impl<T: Serialize + DeserializeOwned + Ord> Reflect for BTreeSet<T> {
    fn shape() -> Shape {
        Shape::leaf::<Self>(Leaf::Opaque)
    }

    whole!();
}
