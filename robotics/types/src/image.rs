//! Owns camera images as the cameras deliver them.

use framework::foxglove::{Base64, RawImage};
use framework::{Clear, Reflect, Timestamp};
use serde::{Deserialize, Serialize};

/// An image in YUYV 4:2:2: bytes Y0 Cb Y1 Cr for two neighbouring pixels, rows from the top.
///
/// Full-range BT.601. Outside of the image every reading is `None`, also where `data` is shorter
/// than `width * height * 2` bytes.
#[derive(Clear, Clone, Debug, Default, Deserialize, Eq, PartialEq, Reflect, Serialize)]
#[reflect(image = "yuyv", foxglove = Self::to_raw_image)]
pub struct YuyvImage {
    /// Pixels in a row, even.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// `width * height * 2` bytes.
    #[serde(with = "framework::bytes")]
    pub data: Vec<u8>,
}

/// Colour of a pixel: luminance and the two chrominances, 128 is no colour.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub struct Yuv {
    /// Luminance.
    pub y: u8,
    /// Blue chrominance (Cb).
    pub u: u8,
    /// Red chrominance (Cr).
    pub v: u8,
}

impl YuyvImage {
    /// A black image; an odd `width` is rounded up.
    pub fn new(width: u32, height: u32) -> Self {
        let mut image = Self::default();
        image.resize(width, height);
        image
    }

    /// Makes this a black image of that size, keeping what heap it has; an odd `width` is rounded up.
    pub fn resize(&mut self, width: u32, height: u32) {
        self.width = width.next_multiple_of(2);
        self.height = height;
        let pairs = self.width as usize / 2 * height as usize;
        self.data.clear();
        self.data.extend((0..pairs).flat_map(|_| [0, 128, 0, 128]));
    }

    /// Whether `data` has as many bytes as width and height ask for.
    pub fn is_complete(&self) -> bool {
        self.width.is_multiple_of(2)
            && self.data.len() as u128 == u128::from(self.width) * u128::from(self.height) * 2
    }

    /// Pixels in a row; none in an image that is not complete, whatever it says of itself.
    pub fn columns(&self) -> u32 {
        if self.has_pixels() { self.width } else { 0 }
    }

    /// Rows; none in an image that is not complete.
    pub fn rows(&self) -> u32 {
        if self.has_pixels() { self.height } else { 0 }
    }

    /// Of no rows there may be ever so many columns.
    fn has_pixels(&self) -> bool {
        !self.data.is_empty() && self.is_complete()
    }

    /// Luminance of a pixel, 0 (black) to 255.
    pub fn luminance(&self, x: u32, y: u32) -> Option<u8> {
        let pixel = self.pixel(x, y)?;
        self.data.get(pixel * 2).copied()
    }

    /// Luminance and chrominance of a pixel; the latter is shared with its neighbour.
    pub fn yuv(&self, x: u32, y: u32) -> Option<Yuv> {
        let pixel = self.pixel(x, y)?;
        let pair = self.data.get(pixel / 2 * 4..pixel / 2 * 4 + 4)?;
        Some(Yuv {
            y: pair[pixel % 2 * 2],
            u: pair[1],
            v: pair[3],
        })
    }

    /// Red, green, and blue of a pixel.
    pub fn rgb(&self, x: u32, y: u32) -> Option<[u8; 3]> {
        self.yuv(x, y).map(Yuv::to_rgb)
    }

    /// As tools draw it.
    fn to_raw_image(&self, timestamp: Timestamp) -> RawImage {
        RawImage {
            timestamp: timestamp.into(),
            frame_id: "camera".to_owned(),
            width: self.width,
            height: self.height,
            encoding: "yuyv",
            step: self.width.saturating_mul(2),
            data: Base64(self.data.clone()),
        }
    }

    fn pixel(&self, x: u32, y: u32) -> Option<usize> {
        (x < self.width && y < self.height).then(|| y as usize * self.width as usize + x as usize)
    }
}

impl Yuv {
    /// Red, green, and blue by full-range BT.601.
    pub fn to_rgb(self) -> [u8; 3] {
        let y = f32::from(self.y);
        let u = f32::from(self.u) - 128.0;
        let v = f32::from(self.v) - 128.0;
        // `as` saturates: colours outside of the cube go to its faces.
        [
            (y + 1.402 * v).round() as u8,
            (y - 0.344_14 * u - 0.714_14 * v).round() as u8,
            (y + 1.772 * u).round() as u8,
        ]
    }

    /// From red, green, and blue by full-range BT.601.
    pub fn from_rgb([red, green, blue]: [u8; 3]) -> Self {
        let (r, g, b) = (f32::from(red), f32::from(green), f32::from(blue));
        Self {
            y: (0.299 * r + 0.587 * g + 0.114 * b).round() as u8,
            u: (128.0 - 0.168_736 * r - 0.331_264 * g + 0.5 * b).round() as u8,
            v: (128.0 + 0.5 * r - 0.418_688 * g - 0.081_312 * b).round() as u8,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_neighbours_share_their_chrominance() {
        let image = YuyvImage {
            width: 2,
            height: 1,
            data: vec![10, 20, 30, 40],
        };
        assert_eq!(image.luminance(1, 0), Some(30));
        assert_eq!(
            image.yuv(0, 0),
            Some(Yuv {
                y: 10,
                u: 20,
                v: 40
            })
        );
        assert_eq!(
            image.yuv(1, 0),
            Some(Yuv {
                y: 30,
                u: 20,
                v: 40
            })
        );
    }

    #[test]
    fn outside_of_the_image_there_is_nothing() {
        let image = YuyvImage::new(4, 2);
        assert_eq!(image.yuv(4, 0), None);
        assert_eq!(image.luminance(0, 2), None);
        assert_eq!(image.rgb(3, 1), Some([0, 0, 0]));
    }

    #[test]
    fn a_cut_image_gives_nothing_instead_of_a_panic() {
        let mut image = YuyvImage::new(4, 2);
        image.data.truncate(9);
        assert!(!image.is_complete());
        assert_eq!((image.columns(), image.rows()), (0, 0));
        assert_eq!(image.yuv(3, 1), None);
        // As a client may say it.
        (image.width, image.height) = (u32::MAX - 1, u32::MAX);
        assert_eq!((image.columns(), image.rows()), (0, 0));
        image.data.clear();
        image.height = 0;
        assert!(image.is_complete());
        assert_eq!((image.columns(), image.rows()), (0, 0));
        let whole = YuyvImage::new(4, 2);
        assert_eq!((whole.columns(), whole.rows()), (4, 2));
    }

    #[test]
    fn resizing_keeps_the_heap() {
        let mut image = YuyvImage::new(640, 480);
        let heap = image.data.as_ptr();
        image.resize(320, 240);
        assert_eq!(image.data.as_ptr(), heap);
        assert!(image.is_complete());
    }

    #[test]
    fn colours_survive_the_way_there_and_back() {
        for rgb in [[0, 0, 0], [255, 255, 255], [30, 140, 40], [200, 90, 20]] {
            for (there, back) in rgb.into_iter().zip(Yuv::from_rgb(rgb).to_rgb()) {
                assert!(there.abs_diff(back) <= 2, "{rgb:?}");
            }
        }
    }
}
