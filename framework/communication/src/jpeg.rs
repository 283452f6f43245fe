//! Images as JPEG files.

use std::borrow::Cow;

use framework::reflect::{Image, Pixels};
use jpeg_encoder::{ColorType, Encoder, SamplingFactor};

/// A whole file; `None` for an image with more pixels in a row or more rows than a file can say.
///
/// `quality` from 1 (small) to 100 (good). Neighbours in a row share their colour, as they do in `Pixels::Yuyv`.
pub(crate) fn encode(image: &Image, quality: u8) -> Option<Vec<u8>> {
    let width = u16::try_from(image.width).ok()?;
    let height = u16::try_from(image.height).ok()?;
    let (bytes, colours) = match image.pixels {
        Pixels::Gray => (Cow::Borrowed(&image.bytes), ColorType::Luma),
        Pixels::Rgb => (Cow::Borrowed(&image.bytes), ColorType::Rgb),
        Pixels::Yuyv => (Cow::Owned(one_by_one(&image.bytes)), ColorType::Ycbcr),
    };
    let mut file = Vec::with_capacity(bytes.len() / 8);
    let mut encoder = Encoder::new(&mut file, quality.clamp(1, 100));
    encoder.set_sampling_factor(SamplingFactor::R_4_2_2);
    encoder.encode(&bytes, width, height, colours).ok()?;
    Some(file)
}

/// Every pixel with its luminance and both colours.
fn one_by_one(yuyv: &[u8]) -> Vec<u8> {
    let (pairs, _) = yuyv.as_chunks::<4>();
    let pixels = pairs
        .iter()
        .flat_map(|[first, blue, second, red]| [*first, *blue, *red, *second, *blue, *red]);
    pixels.collect()
}

#[cfg(test)]
mod tests;
