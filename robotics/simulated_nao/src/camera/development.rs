//! What the sensor makes of light: exposure, white balance, noise, and bytes.

use super::WIDTH;
use super::color::{Color, Grain, LANES, to_bits};
use super::row::Row;
use crate::scene::ImageSettings;

/// Pixels that get their noise together.
const BLOCK: usize = 2 * LANES;

/// How light becomes bytes.
pub(super) struct Development {
    /// Luminance, blue and red that a unit of each becomes.
    luminance: Color,
    blue: Color,
    red: Color,
    noise: f32,
    seed: u32,
}

impl Development {
    pub(super) fn new(settings: &ImageSettings) -> Self {
        let gains = settings.white_balance.map(|gain| gain * settings.exposure);
        let developed = |luminance, blue, red| {
            Color {
                luminance,
                blue,
                red,
            }
            .balanced(gains)
        };
        Self {
            luminance: developed(1.0, 0.0, 0.0),
            blue: developed(0.0, 1.0, 0.0),
            red: developed(0.0, 0.0, 1.0),
            noise: settings.noise,
            seed: settings.seed,
        }
    }

    /// Writes a row of a YUYV image.
    pub(super) fn develop(&self, image: u64, number: usize, row: &Row, bytes: &mut [u8]) {
        let mut grain = Grain::new(self.seed, image, number);
        let blocks = bytes.chunks_exact_mut(2 * BLOCK);
        for (bytes, first) in blocks.zip((0..WIDTH).step_by(BLOCK)) {
            let pairs = self.block(row, first, &grain.next());
            for (bytes, pair) in bytes.chunks_exact_mut(4).zip(pairs) {
                bytes.copy_from_slice(&pair.to_le_bytes());
            }
        }
    }

    /// Pairs of pixels from a column on, as their bytes Y0 Cb Y1 Cr.
    #[inline(always)]
    fn block(&self, row: &Row, first: usize, noise: &[[f32; LANES]; 4]) -> [u32; LANES] {
        let pixels = first..first + BLOCK;
        let luminance = &row.luminance[pixels.clone()];
        let blue = &row.blue[pixels.clone()];
        let red = &row.red[pixels];
        let mut bright = [0.0; BLOCK];
        for index in 0..BLOCK {
            bright[index] = luminance[index] * self.luminance.luminance
                + blue[index] * self.blue.luminance
                + red[index] * self.red.luminance;
        }
        let half = self.noise * 0.5;
        let mut pairs = [0; LANES];
        for lane in 0..LANES {
            let (even, odd) = (2 * lane, 2 * lane + 1);
            let luminance = (luminance[even] + luminance[odd]) * 0.5;
            let blue = (blue[even] + blue[odd]) * 0.5;
            let red = (red[even] + red[odd]) * 0.5;
            let bluish =
                luminance * self.luminance.blue + blue * self.blue.blue + red * self.red.blue;
            let reddish =
                luminance * self.luminance.red + blue * self.blue.red + red * self.red.red;
            pairs[lane] = byte(bright[even] + self.noise * noise[0][lane])
                | byte(128.0 + bluish + half * noise[1][lane]) << 8
                | byte(bright[odd] + self.noise * noise[2][lane]) << 16
                | byte(128.0 + reddish + half * noise[3][lane]) << 24;
        }
        pairs
    }
}

/// Rounds and saturates.
fn byte(value: f32) -> u32 {
    let value = if value > 0.0 { value } else { 0.0 };
    to_bits(if value < 255.0 { value } else { 255.0 }) & 0xff
}
