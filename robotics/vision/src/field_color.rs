//! Says whether a pixel has the colour of the field.
//!
//! By chromaticity, the share of a channel in the sum of red, green and blue, which shade and light
//! change little.

use framework::{Clear, Reflect};
use serde::{Deserialize, Serialize};
use types::image::Yuv;

/// What counts as field.
#[derive(Clear, Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct FieldColor {
    /// The least share of green.
    pub minimum_green: f32,
    /// The largest share of red.
    pub maximum_red: f32,
    /// The largest share of blue.
    pub maximum_blue: f32,
    /// The least luminance: below it shares are noise.
    pub minimum_luminance: u8,
}

/// Pixels that are looked at in one step.
const LANES: usize = 4;

impl FieldColor {
    /// Whether a pixel of this colour shows the field.
    pub fn matches(&self, color: Yuv) -> bool {
        let [red, green, blue] = channels(numbers(color));
        let sum = red + green + blue;
        color.y >= self.minimum_luminance
            && green >= self.minimum_green * sum
            && red <= self.maximum_red * sum
            && blue <= self.maximum_blue * sum
    }

    /// Of up to 32 pairs of pixels as images have them: a bit for each pixel, the first is the lowest.
    pub(crate) fn matching(&self, pairs: &[[u8; 4]]) -> u64 {
        let (steps, rest) = pairs.as_chunks();
        let mut bits = 0;
        for (index, step) in steps.iter().enumerate() {
            bits |= self.matching_step(step) << (2 * LANES * index);
        }
        let first = 2 * LANES * steps.len();
        for (index, &[left, u, right, v]) in rest.iter().enumerate() {
            for (side, y) in [left, right].into_iter().enumerate() {
                bits |= u64::from(self.matches(Yuv { y, u, v })) << (first + 2 * index + side);
            }
        }
        bits
    }

    // Written so that one instruction does the same with all lanes.
    #[inline(always)]
    fn matching_step(&self, step: &[[u8; 4]; LANES]) -> u64 {
        let words = step.map(u32::from_le_bytes);
        let [left, u, right, v] =
            [0, 8, 16, 24].map(|shift| words.map(|word| (word >> shift & 0xff) as i32 as f32));
        let of = |y: [f32; LANES]| -> [u32; LANES] {
            std::array::from_fn(|lane| u32::from(self.shows([y[lane], u[lane], v[lane]])))
        };
        let (left, right) = (of(left), of(right));
        let bits = (0..LANES).map(|lane| (left[lane] | right[lane] << 1) << (2 * lane));
        u64::from(bits.fold(0, |all, bits| all | bits))
    }

    /// As [`Self::matches`], without a way out in between.
    #[inline(always)]
    fn shows(&self, yuv: [f32; 3]) -> bool {
        let [red, green, blue] = channels(yuv);
        let sum = red + green + blue;
        (yuv[0] >= f32::from(self.minimum_luminance))
            & (green >= self.minimum_green * sum)
            & (red <= self.maximum_red * sum)
            & (blue <= self.maximum_blue * sum)
    }
}

/// Luminance and the two chrominances.
fn numbers(color: Yuv) -> [f32; 3] {
    [color.y, color.u, color.v].map(f32::from)
}

/// Red, green and blue of those, 0 or more.
#[inline(always)]
fn channels([luminance, u, v]: [f32; 3]) -> [f32; 3] {
    let blue_difference = u - 128.0;
    let red_difference = v - 128.0;
    [
        (luminance + 1.402 * red_difference).max(0.0),
        (luminance - 0.344_14 * blue_difference - 0.714_14 * red_difference).max(0.0),
        (luminance + 1.772 * blue_difference).max(0.0),
    ]
}

/// The shares of red, green and blue in their sum; no colour where there is no light.
pub(crate) fn shares(color: Yuv) -> [f32; 3] {
    let channels = channels(numbers(color));
    let sum: f32 = channels.iter().sum();
    if sum > 0.0 {
        channels.map(|channel| channel / sum)
    } else {
        [1.0 / 3.0; 3]
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use crate::sampler::Sampler;

    pub(crate) const GREEN: [u8; 3] = [38, 128, 52];

    pub(crate) fn field_color() -> FieldColor {
        FieldColor {
            minimum_green: 0.45,
            maximum_red: 0.37,
            maximum_blue: 0.38,
            minimum_luminance: 16,
        }
    }

    #[test]
    fn green_is_field_in_light_and_shade() {
        for share in [0.3, 0.6, 1.0, 1.5] {
            let green = GREEN.map(|channel| (f32::from(channel) * share) as u8);
            assert!(field_color().matches(Yuv::from_rgb(green)), "{green:?}");
        }
    }

    #[test]
    fn lines_ball_and_floor_are_no_field() {
        for color in [
            [220, 220, 220],
            [90, 90, 90],
            [30, 30, 30],
            [140, 120, 100],
            [0, 0, 0],
        ] {
            assert!(!field_color().matches(Yuv::from_rgb(color)), "{color:?}");
        }
    }

    #[test]
    fn many_pixels_at_once_are_as_each_by_itself() {
        let color = field_color();
        let mut numbers = Sampler::new();
        let (mut field, mut pixels) = (0, 0);
        for length in 0..=32 {
            let mut byte = || numbers.pair(256).0 as u8;
            let pairs: Vec<[u8; 4]> = (0..length)
                .map(|_| {
                    let other = std::array::from_fn(|_| byte());
                    let Yuv { y, u, v } = Yuv::from_rgb(GREEN);
                    if byte() < 128 { [y, u, y, v] } else { other }
                })
                .collect();
            let each = pairs.iter().flat_map(|&[left, u, right, v]| {
                [left, right].map(|y| color.matches(Yuv { y, u, v }))
            });
            let each = each.enumerate().map(|(index, is)| u64::from(is) << index);
            let bits = color.matching(&pairs);
            assert_eq!(bits, each.sum::<u64>(), "{pairs:?}");
            field += bits.count_ones();
            pixels += 2 * length;
        }
        assert!((pixels / 3..2 * pixels / 3).contains(&field), "{field}");
    }
}
