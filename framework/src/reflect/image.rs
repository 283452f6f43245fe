//! Values that are images: told by their type, so that they can be compressed by whoever knows no type of the robot.

use serde::Serialize;

use super::{Content, Reflect, Segment, Shape};

/// Of what an image consists; rows from the top, without gaps.
///
/// From `#[reflect(image = "yuyv")]` on a struct with the fields `width` and `height`, in pixels, and `data`, its bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Pixels {
    /// One byte for each pixel: its luminance.
    Gray,
    /// Red, green and blue of each pixel, as sRGB has them.
    Rgb,
    /// Y0 Cb Y1 Cr for two neighbouring pixels, full-range BT.601.
    Yuyv,
}

/// An image as it was found in a value.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Image {
    pub pixels: Pixels,
    /// Pixels in a row.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// As many as `width`, `height` and `pixels` ask for.
    pub bytes: Vec<u8>,
}

impl Pixels {
    /// As `#[reflect(image = …)]` and clients name it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Gray => "gray",
            Self::Rgb => "rgb",
            Self::Yuyv => "yuyv",
        }
    }

    /// How many bytes a pixel has.
    pub fn bytes(self) -> usize {
        match self {
            Self::Gray => 1,
            Self::Rgb => 3,
            Self::Yuyv => 2,
        }
    }
}

impl Shape {
    /// Whether its values are images, and of what; an image that may be absent is one, too.
    pub fn image(&self) -> Option<Pixels> {
        match &self.content {
            Content::Option(inner) => inner.image(),
            _ => self.pixels,
        }
    }
}

impl Image {
    /// What a value of a type that is an image holds: `None` where it is absent, has no pixels, or has another number of
    /// bytes than its size asks for.
    pub fn read(pixels: Pixels, value: &dyn Reflect) -> Option<Self> {
        let width = usize::try_from(number(value, "width")?).ok()?;
        let height = usize::try_from(number(value, "height")?).ok()?;
        let mut bytes = Vec::new();
        part(value, "data")?.encode(&mut bytes).ok()?;
        // In front of the bytes stands how many there are.
        bytes.drain(..size_of::<u32>().min(bytes.len()));
        let expected = width.checked_mul(height)?.checked_mul(pixels.bytes())?;
        let is_whole = pixels != Pixels::Yuyv || width.is_multiple_of(2);
        (expected > 0 && is_whole && bytes.len() == expected).then_some(Self {
            pixels,
            width,
            height,
            bytes,
        })
    }
}

fn part<'value>(value: &'value dyn Reflect, name: &str) -> Option<&'value dyn Reflect> {
    value.child(&Segment::Field(name.to_owned()))
}

/// An unsigned number of any width, as its bytes have it.
fn number(value: &dyn Reflect, name: &str) -> Option<u64> {
    let mut bytes = Vec::new();
    part(value, name)?.encode(&mut bytes).ok()?;
    let mut number = [0; size_of::<u64>()];
    number.get_mut(..bytes.len())?.copy_from_slice(&bytes);
    Some(u64::from_le_bytes(number))
}
