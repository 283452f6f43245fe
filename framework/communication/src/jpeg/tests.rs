//! Files are read by a decoder of somebody else.

use framework::reflect::{Image, Pixels};
use zune_jpeg::JpegDecoder;
use zune_jpeg::zune_core::bytestream::ZCursor;

use super::encode;

/// Full-range BT.601.
fn ycbcr(rgb: [u8; 3]) -> [f32; 3] {
    let [red, green, blue] = rgb.map(f32::from);
    let luminance = 0.299 * red + 0.587 * green + 0.114 * blue;
    [
        luminance,
        128.0 + (blue - luminance) / 1.772,
        128.0 + (red - luminance) / 1.402,
    ]
}

/// A ball on a lawn, with soft edges.
fn scene(pixels: Pixels, width: usize, height: usize) -> Image {
    let rgb = |x: usize, y: usize| -> [u8; 3] {
        let (dx, dy) = (x as f32 - 20.0, y as f32 - 14.0);
        let near = (1.0 - (dx * dx + dy * dy).sqrt() / 18.0).clamp(0.0, 1.0);
        [40.0 + 180.0 * near, 120.0 + 60.0 * near, 40.0 + 20.0 * near].map(|colour| colour as u8)
    };
    let places = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    let bytes = match pixels {
        Pixels::Rgb => places.flat_map(|(x, y)| rgb(x, y)).collect(),
        Pixels::Gray => places.map(|(x, y)| ycbcr(rgb(x, y))[0] as u8).collect(),
        Pixels::Yuyv => places
            .flat_map(|(x, y)| {
                let [luminance, ..] = ycbcr(rgb(x, y));
                let colour = ycbcr(rgb(x - x % 2, y))[1 + x % 2];
                [luminance as u8, colour as u8]
            })
            .collect(),
    };
    Image {
        pixels,
        width,
        height,
        bytes,
    }
}

fn decoded(file: &[u8]) -> (usize, usize, Vec<u8>) {
    let mut decoder = JpegDecoder::new(ZCursor::new(file));
    let bytes = decoder.decode().expect("this is a JPEG file");
    let (width, height) = decoder.dimensions().expect("it has a size");
    (width, height, bytes)
}

/// The decoder makes colours of gray.
fn decoded_gray(file: &[u8]) -> Vec<u8> {
    let (.., found) = decoded(file);
    found.into_iter().step_by(3).collect()
}

/// The greatest difference of a colour, and the average.
fn differences(one: &[u8], other: &[u8]) -> (u8, f32) {
    assert_eq!(one.len(), other.len());
    let differences = one
        .iter()
        .zip(other)
        .map(|(one, other)| one.abs_diff(*other));
    let sum: f32 = differences.clone().map(f32::from).sum();
    (
        differences.max().unwrap_or_default(),
        sum / one.len() as f32,
    )
}

#[test]
fn a_decoder_finds_what_was_there() {
    // Sizes that no block divides, too.
    for (width, height) in [(64, 48), (42, 29), (2, 1)] {
        let rgb = scene(Pixels::Rgb, width, height);
        for pixels in [Pixels::Rgb, Pixels::Yuyv] {
            let file = encode(&scene(pixels, width, height), 95).expect("small");
            let (wide, high, found) = decoded(&file);
            assert_eq!((wide, high), (width, height));
            let (most, mean) = differences(&found, &rgb.bytes);
            assert!(
                most <= 16 && mean < 2.5,
                "{pixels:?} {width}: {most} {mean}"
            );
        }
        let gray = scene(Pixels::Gray, width, height);
        let found = decoded_gray(&encode(&gray, 95).expect("small"));
        let (most, mean) = differences(&found, &gray.bytes);
        assert!(most <= 6 && mean < 1.5, "gray {width}: {most} {mean}");
    }
}

#[test]
fn less_quality_is_smaller() {
    let image = scene(Pixels::Yuyv, 320, 240);
    let sizes = [100, 90, 70, 40, 10].map(|quality| encode(&image, quality).expect("small").len());
    assert!(sizes.is_sorted_by(|one, next| one > next), "{sizes:?}");
    assert!(sizes[2] < image.bytes.len() / 20, "{sizes:?}");
}

#[test]
fn what_a_file_cannot_say_is_none() {
    let image = Image {
        pixels: Pixels::Gray,
        width: 70_000,
        height: 1,
        bytes: vec![0; 70_000],
    };
    assert_eq!(encode(&image, 50), None);
}
