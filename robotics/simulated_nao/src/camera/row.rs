//! One row of an image before the sensor: light as numbers, and how near what gives it is.

use std::ops::RangeInclusive;

use super::WIDTH;
use super::color::Color;

/// Colours of a row's pixels, and one over the depth of what they show.
pub(super) struct Row {
    pub(super) luminance: [f32; WIDTH],
    pub(super) blue: [f32; WIDTH],
    pub(super) red: [f32; WIDTH],
    /// In 1/m along the optical axis; 0 where ground or background is.
    pub(super) nearness: [f32; WIDTH],
}

/// Some neighbouring pixels of a row; all slices are as long.
pub(super) struct Span<'row> {
    pub(super) first: usize,
    luminance: &'row mut [f32],
    blue: &'row mut [f32],
    red: &'row mut [f32],
    nearness: &'row mut [f32],
}

/// What something adds to one pixel.
#[derive(Clone, Copy, Debug)]
pub(super) struct Touch {
    /// How much of the pixel it covers.
    pub(super) part: f32,
    /// Factor on its colour.
    pub(super) light: f32,
    /// In 1/m.
    pub(super) nearness: f32,
}

impl Row {
    pub(super) fn new() -> Self {
        Self {
            luminance: [0.0; WIDTH],
            blue: [0.0; WIDTH],
            red: [0.0; WIDTH],
            nearness: [0.0; WIDTH],
        }
    }

    pub(super) fn set(&mut self, column: usize, color: Color) {
        self.luminance[column] = color.luminance;
        self.blue[column] = color.blue;
        self.red[column] = color.red;
    }

    /// What is smeared: colours, not depths.
    pub(super) fn channels(&self) -> [&[f32; WIDTH]; 3] {
        [&self.luminance, &self.blue, &self.red]
    }

    pub(super) fn channels_mut(&mut self) -> [&mut [f32; WIDTH]; 3] {
        [&mut self.luminance, &mut self.blue, &mut self.red]
    }

    pub(super) fn span(&mut self, columns: RangeInclusive<usize>) -> Span<'_> {
        Span {
            first: *columns.start(),
            luminance: &mut self.luminance[columns.clone()],
            blue: &mut self.blue[columns.clone()],
            red: &mut self.red[columns.clone()],
            nearness: &mut self.nearness[columns],
        }
    }
}

impl Span<'_> {
    /// Paints a solid thing over whatever is farther away.
    pub(super) fn paint(&mut self, color: Color, touch: impl Fn(f32) -> Touch) {
        self.mix(color, touch, true);
    }

    /// As [`Self::paint`], for what one can look through.
    pub(super) fn veil(&mut self, color: Color, touch: impl Fn(f32) -> Touch) {
        self.mix(color, touch, false);
    }

    #[inline(always)]
    fn mix(&mut self, color: Color, touch: impl Fn(f32) -> Touch, is_solid: bool) {
        let count = self.luminance.len();
        let (luminance, blue) = (&mut self.luminance[..count], &mut self.blue[..count]);
        let (red, nearness) = (&mut self.red[..count], &mut self.nearness[..count]);
        let first = self.first as f32;
        for index in 0..count {
            let touch = touch(first + index as u32 as i32 as f32);
            let is_nearer = touch.nearness > nearness[index];
            let part = if is_nearer { touch.part } else { 0.0 };
            luminance[index] += (color.luminance * touch.light - luminance[index]) * part;
            blue[index] += (color.blue * touch.light - blue[index]) * part;
            red[index] += (color.red * touch.light - red[index]) * part;
            if is_solid {
                let covers = part > 0.5;
                nearness[index] = if covers {
                    touch.nearness
                } else {
                    nearness[index]
                };
            }
        }
    }
}
