//! Which pixels of an image show the field: looked at when somebody asks, and once.
//!
//! Places where a ball may be lie close together, and each is looked at from several middles: what one asks of a pixel, others ask, too.

use std::cell::OnceCell;

use types::image::YuyvImage;

use crate::field_color::FieldColor;

/// Pixels of a row that are looked at together.
const BLOCK: u32 = u64::BITS;

/// Remembers what it has seen of one image.
pub(super) struct FieldMask<'a> {
    image: &'a YuyvImage,
    color: &'a FieldColor,
    columns: u32,
    /// Row by row; the lowest bit is the left pixel. In most images of the lower camera nobody asks.
    blocks: OnceCell<Vec<OnceCell<u64>>>,
}

impl<'a> FieldMask<'a> {
    /// Has seen nothing yet.
    pub(super) fn new(image: &'a YuyvImage, color: &'a FieldColor) -> Self {
        Self {
            image,
            color,
            columns: image.columns(),
            blocks: OnceCell::new(),
        }
    }

    /// Whether a pixel shows the field; `None` outside of the image.
    #[inline]
    pub(super) fn is_field(&self, x: u32, y: u32) -> Option<bool> {
        if x >= self.columns {
            return None;
        }
        let in_row = self.columns.div_ceil(BLOCK) as usize;
        let blocks = self
            .blocks
            .get_or_init(|| vec![OnceCell::new(); in_row * self.image.rows() as usize]);
        let block = blocks.get(y as usize * in_row + (x / BLOCK) as usize)?;
        let block = block.get_or_init(|| self.look(x / BLOCK * BLOCK, y));
        Some(block >> (x % BLOCK) & 1 == 1)
    }

    /// The block that begins there; of pixels that the image does not have nobody asks.
    #[inline(never)]
    fn look(&self, first: u32, y: u32) -> u64 {
        let pixel = y as usize * self.columns as usize + first as usize;
        let pixels = BLOCK.min(self.columns - first) as usize;
        let bytes = &self.image.data[2 * pixel..2 * (pixel + pixels)];
        self.color.matching(bytes.as_chunks().0)
    }
}

#[cfg(test)]
mod tests {
    use types::image::Yuv;

    use super::*;
    use crate::field_color::tests::{GREEN, field_color};

    #[test]
    fn it_says_of_every_pixel_what_its_colour_says_and_of_others_nothing() {
        let color = field_color();
        // Wider than a block, and no multiple of one.
        let mut image = YuyvImage::new(70, 3);
        let Yuv { y, u, v } = Yuv::from_rgb(GREEN);
        for (index, pair) in image.data.chunks_exact_mut(4).enumerate() {
            if index % 3 != 0 {
                pair.copy_from_slice(&[y, u, y, v]);
            }
        }
        let mask = FieldMask::new(&image, &color);
        let mut field = 0;
        // Twice: the second time out of what it has seen.
        for (x, y) in (0..2).flat_map(|_| (0..5).flat_map(|y| (0..130).map(move |x| (x, y)))) {
            let told = image.yuv(x, y).map(|pixel| color.matches(pixel));
            assert_eq!(mask.is_field(x, y), told, "{x}, {y}");
            field += usize::from(told == Some(true));
        }
        assert_eq!(field, 2 * 70 * 2);
        assert_eq!(mask.is_field(u32::MAX, u32::MAX), None);
        let nothing = YuyvImage::default();
        assert_eq!(FieldMask::new(&nothing, &color).is_field(0, 0), None);
    }
}
