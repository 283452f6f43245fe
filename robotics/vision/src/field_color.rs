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

impl FieldColor {
    /// Whether a pixel of this colour shows the field.
    pub fn matches(&self, color: Yuv) -> bool {
        let [red, green, blue] = channels(color);
        let sum = red + green + blue;
        color.y >= self.minimum_luminance
            && green >= self.minimum_green * sum
            && red <= self.maximum_red * sum
            && blue <= self.maximum_blue * sum
    }
}

/// Red, green and blue, 0 or more.
fn channels(color: Yuv) -> [f32; 3] {
    let luminance = f32::from(color.y);
    let blue_difference = f32::from(color.u) - 128.0;
    let red_difference = f32::from(color.v) - 128.0;
    [
        (luminance + 1.402 * red_difference).max(0.0),
        (luminance - 0.344_14 * blue_difference - 0.714_14 * red_difference).max(0.0),
        (luminance + 1.772 * blue_difference).max(0.0),
    ]
}

/// The shares of red, green and blue in their sum; no colour where there is no light.
pub(crate) fn shares(color: Yuv) -> [f32; 3] {
    let channels = channels(color);
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
}
