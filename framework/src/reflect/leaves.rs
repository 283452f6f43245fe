//! Values without parts.

use std::net::{IpAddr, Ipv4Addr, Ipv6Addr, SocketAddr};
use std::path::{Path as FilePath, PathBuf};
use std::time::Duration;

use super::binary::{EncodeError, encode_display, encode_numbers, encode_text};
use super::{Leaf, Reflect, Shape, whole};
use crate::time::Timestamp;

macro_rules! leaf {
    ($($type:ty => $leaf:expr, $encode:expr;)*) => {$(
        impl Reflect for $type {
            fn shape() -> Shape {
                Shape::leaf::<Self>($leaf)
            }

            fn encode(&self, bytes: &mut Vec<u8>) -> Result<(), EncodeError> {
                let encode: fn(&Self, &mut Vec<u8>) -> Result<(), EncodeError> = $encode;
                encode(self, bytes)
            }

            whole!();
        }
    )*};
}

/// Numbers, which are also written many at once.
macro_rules! number {
    ($($type:ty as $wire:ty => $leaf:expr;)*) => {$(
        impl Reflect for $type {
            fn shape() -> Shape {
                Shape::leaf::<Self>($leaf)
            }

            fn encode(&self, bytes: &mut Vec<u8>) -> Result<(), EncodeError> {
                bytes.extend_from_slice(&(*self as $wire).to_le_bytes());
                Ok(())
            }

            fn encode_all(numbers: &[Self], bytes: &mut Vec<u8>) -> Result<(), EncodeError> {
                encode_numbers(numbers, |number| (number as $wire).to_le_bytes(), bytes);
                Ok(())
            }

            whole!();
        }
    )*};
}

number! {
    f32 as f32 => Leaf::Float { bits: 32 };
    f64 as f64 => Leaf::Float { bits: 64 };
    i8 as i8 => Leaf::Signed { bits: 8 };
    i16 as i16 => Leaf::Signed { bits: 16 };
    i32 as i32 => Leaf::Signed { bits: 32 };
    i64 as i64 => Leaf::Signed { bits: 64 };
    i128 as i128 => Leaf::Signed { bits: 128 };
    // As serde has them, whatever the machine.
    isize as i64 => Leaf::Signed { bits: 64 };
    usize as u64 => Leaf::Unsigned { bits: 64 };
    u8 as u8 => Leaf::Unsigned { bits: 8 };
    u16 as u16 => Leaf::Unsigned { bits: 16 };
    u32 as u32 => Leaf::Unsigned { bits: 32 };
    u64 as u64 => Leaf::Unsigned { bits: 64 };
    u128 as u128 => Leaf::Unsigned { bits: 128 };
    bool as u8 => Leaf::Bool;
    char as u32 => Leaf::Character;
}

leaf! {
    () => Leaf::Unit, |(), _| Ok(());
    String => Leaf::Text, |text, bytes| encode_text(text, bytes);
    PathBuf => Leaf::Text, |path, bytes| encode_path(path, bytes);
    IpAddr => Leaf::Text, |address, bytes| encode_display(address, bytes);
    Ipv4Addr => Leaf::Text, |address, bytes| encode_display(address, bytes);
    Ipv6Addr => Leaf::Text, |address, bytes| encode_display(address, bytes);
    SocketAddr => Leaf::Text, |address, bytes| encode_display(address, bytes);
    Duration => Leaf::Duration, encode_duration;
    Timestamp => Leaf::Unsigned { bits: 64 }, |timestamp, bytes| timestamp.as_nanos().encode(bytes);
}

fn encode_path(path: &FilePath, bytes: &mut Vec<u8>) -> Result<(), EncodeError> {
    match path.to_str() {
        Some(text) => encode_text(text, bytes),
        None => Err(EncodeError::new(format!(
            "the path {} is no Unicode",
            path.display()
        ))),
    }
}

fn encode_duration(duration: &Duration, bytes: &mut Vec<u8>) -> Result<(), EncodeError> {
    duration.as_secs().encode(bytes)?;
    duration.subsec_nanos().encode(bytes)
}
