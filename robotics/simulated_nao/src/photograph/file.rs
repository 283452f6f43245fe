//! PNG files and what stands in them.

use std::fs::File;
use std::io::{BufReader, BufWriter};
use std::path::{Path, PathBuf};

use framework::{Error, Result};
use png::{BitDepth, ColorType, Decoder, Encoder, Limits, Transformations};
use types::image::{Yuv, YuyvImage};

/// No side of an image is longer, px.
const LONGEST: u32 = 4096;
/// As a decoder may take for the largest image.
const BYTES: usize = 1 << 27;

/// Red, green and blue of each pixel.
pub(super) struct Rgb {
    pub(super) width: u32,
    pub(super) height: u32,
    pub(super) data: Vec<u8>,
}

/// The image in a PNG file; pairs of pixels share their mean chrominance.
///
/// # Errors
/// Where it cannot be read, is no PNG, or is too small or too large.
pub(super) fn read(path: &Path, is_ycbcr: bool) -> Result<YuyvImage> {
    decode(path, is_ycbcr).map_err(|error| error.context(format!("image {}", path.display())))
}

fn decode(path: &Path, is_ycbcr: bool) -> Result<YuyvImage> {
    let mut decoder =
        Decoder::new_with_limits(BufReader::new(File::open(path)?), Limits { bytes: BYTES });
    decoder.set_transformations(Transformations::normalize_to_color8());
    let mut reader = decoder.read_info()?;
    let (width, height) = (reader.info().width, reader.info().height);
    if !(16..=LONGEST).contains(&width) || !(16..=LONGEST).contains(&height) {
        return Err(Error::new(format!(
            "{width} × {height} pixels; sides are from 16 to {LONGEST} long"
        )));
    }
    let size = reader
        .output_buffer_size()
        .ok_or_else(|| Error::new("it is too large"))?;
    let mut data = vec![0; size];
    let frame = reader.next_frame(&mut data)?;
    let channels = frame.color_type.samples();
    if is_ycbcr && channels < 3 {
        return Err(Error::new("an image without colours holds no Y, Cb and Cr"));
    }
    let color = |pixel: &[u8]| match pixel {
        [y, u, v, ..] if is_ycbcr => Yuv {
            y: *y,
            u: *u,
            v: *v,
        },
        [red, green, blue, ..] => Yuv::from_rgb([*red, *green, *blue]),
        [grey, ..] => Yuv::from_rgb([*grey; 3]),
        [] => Yuv::from_rgb([0; 3]),
    };
    let mut image = YuyvImage::new(width, height);
    let rows = data.chunks_exact(width as usize * channels);
    for (row, bytes) in rows.zip(image.data.chunks_exact_mut(image.width as usize * 2)) {
        let pairs = row.chunks(2 * channels).zip(bytes.chunks_exact_mut(4));
        for (pair, bytes) in pairs {
            let mut pixels = pair.chunks_exact(channels).map(color);
            let first = pixels.next().unwrap_or(Yuv {
                y: 0,
                u: 128,
                v: 128,
            });
            let second = pixels.next().unwrap_or(first);
            bytes.copy_from_slice(&[
                first.y,
                first.u.midpoint(second.u),
                second.y,
                first.v.midpoint(second.v),
            ]);
        }
    }
    Ok(image)
}

/// Where the overlay of a photograph stands.
pub(super) fn overlay_of(folder: &Path, photograph: &Path) -> PathBuf {
    let name = photograph.file_stem().unwrap_or_default();
    folder.join(format!("{}.seen.png", name.to_string_lossy()))
}

/// Writes a photograph's overlay into a folder, which is made if it is not there.
///
/// # Errors
/// Where that cannot be written.
pub(super) fn write(folder: &Path, photograph: &Path, image: &Rgb) -> Result<()> {
    let path = overlay_of(folder, photograph);
    let written = std::fs::create_dir_all(folder)
        .map_err(Error::from)
        .and_then(|()| {
            let mut encoder = Encoder::new(
                BufWriter::new(File::create(&path)?),
                image.width,
                image.height,
            );
            encoder.set_color(ColorType::Rgb);
            encoder.set_depth(BitDepth::Eight);
            encoder.write_header()?.write_image_data(&image.data)?;
            Ok(())
        });
    written.map_err(|error| error.context(format!("cannot write {}", path.display())))
}

impl Rgb {
    pub(super) fn of(image: &YuyvImage) -> Self {
        let rows = 0..image.height;
        let pixels =
            rows.flat_map(|row| (0..image.width).filter_map(move |column| image.rgb(column, row)));
        Self {
            width: image.width,
            height: image.height,
            data: pixels.flatten().collect(),
        }
    }

    /// Colours a pixel, if it lies in the image.
    pub(super) fn set(&mut self, column: f32, row: f32, color: [u8; 3]) {
        let (column, row) = (column.round(), row.round());
        if column >= 0.0 && row >= 0.0 && column < self.width as f32 && row < self.height as f32 {
            let offset = (row as usize * self.width as usize + column as usize) * 3;
            self.data[offset..offset + 3].copy_from_slice(&color);
        }
    }
}
