//! Colours of the world in full range YCbCr (BT.601), and the noise of the sensor.

/// Luminance 0 to 255, chromaticities relative to grey.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Color {
    pub(crate) luminance: f32,
    pub(crate) blue: f32,
    pub(crate) red: f32,
}

impl Color {
    pub(crate) const LINE: Self = Self::new(205.0, -1.0, -1.0);
    /// The floor around the carpet.
    pub(crate) const FLOOR: Self = Self::new(118.0, -9.0, 8.0);
    /// The walls of the hall.
    pub(crate) const WALL: Self = Self::new(150.0, 3.0, -2.0);
    /// The boards before the walls.
    pub(crate) const BOARD: Self = Self::new(96.0, 6.0, -1.0);
    pub(crate) const GOAL: Self = Self::new(218.0, 0.0, 0.0);
    pub(crate) const NET: Self = Self::new(196.0, 0.0, 0.0);
    pub(crate) const SHELL: Self = Self::new(212.0, 1.0, -1.0);
    pub(crate) const JOINT: Self = Self::new(120.0, 2.0, -1.0);
    pub(crate) const DARK: Self = Self::new(45.0, 3.0, -2.0);
    /// RGB (25, 60, 190).
    pub(crate) const BLUE_SHIRT: Self = Self::new(64.4, 70.9, -28.1);
    /// RGB (190, 30, 35).
    pub(crate) const RED_SHIRT: Self = Self::new(78.4, -24.5, 79.6);
    pub(crate) const BALL: Self = Self::new(225.0, 0.0, 0.0);

    pub(crate) const fn new(luminance: f32, blue: f32, red: f32) -> Self {
        Self {
            luminance,
            blue,
            red,
        }
    }

    /// Of red, green and blue, 0 to 255.
    pub(crate) fn from_rgb([red, green, blue]: [f32; 3]) -> Self {
        let luminance = 0.299 * red + 0.587 * green + 0.114 * blue;
        Self::new(
            luminance,
            (blue - luminance) / 1.772,
            (red - luminance) / 1.402,
        )
    }

    pub(crate) fn mixed(self, other: Self, part: f32) -> Self {
        Self {
            luminance: self.luminance + (other.luminance - self.luminance) * part,
            blue: self.blue + (other.blue - self.blue) * part,
            red: self.red + (other.red - self.red) * part,
        }
    }

    pub(crate) fn brightened(self, luminance: f32) -> Self {
        Self {
            luminance: self.luminance + luminance,
            ..self
        }
    }

    /// Less light, same hue.
    pub(crate) fn shaded(self, factor: f32) -> Self {
        Self {
            luminance: self.luminance * factor,
            blue: self.blue * factor,
            red: self.red * factor,
        }
    }

    /// With its red, green and blue multiplied.
    pub(crate) fn balanced(self, [red, green, blue]: [f32; 3]) -> Self {
        let red = red * (self.luminance + 1.402 * self.red);
        let green = green * (self.luminance - 0.344_136 * self.blue - 0.714_136 * self.red);
        let blue = blue * (self.luminance + 1.772 * self.blue);
        Self::from_rgb([red, green, blue])
    }
}

/// The nearest integer in the low bits, for numbers up to four millions. `as` would look for
/// numbers that do not fit, which keeps loops from being vectorised.
pub(crate) fn to_bits(value: f32) -> u32 {
    // The first float whose neighbour is one away.
    const UNIT_SPACED: f32 = 8_388_608.0;
    (value + UNIT_SPACED).to_bits()
}

/// How many sequences of noise run side by side.
pub(crate) const LANES: usize = 8;

/// Noise of the sensor: numbers with variance 1, fixed by the seed, the image and the pixel.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Grain([u32; LANES]);

impl Grain {
    pub(crate) fn new(seed: u32, image: u64, row: usize) -> Self {
        let start = hash(seed ^ hash(image as u32 ^ hash((image >> 32) as u32)));
        let row = hash(start.wrapping_add(row as u32));
        Self(std::array::from_fn(|lane| {
            hash(row.wrapping_add(lane as u32)) | 1
        }))
    }

    /// Four numbers for each of the lanes.
    pub(crate) fn next(&mut self) -> [[f32; LANES]; 4] {
        // Marsaglia (2003), Xorshift RNGs.
        for state in &mut self.0 {
            *state ^= *state << 13;
            *state ^= *state >> 17;
            *state ^= *state << 5;
        }
        [0, 8, 16, 24].map(|shift| {
            self.0.map(|state| {
                // Two even numbers from 0 to 15: their sum has mean 15 and variance 42.5.
                let bits = state >> shift;
                let sum = (bits & 15) + (bits >> 4 & 15);
                (sum as i32 as f32 - 15.0) * 0.153_393
            })
        })
    }
}

/// Every bit depends on every bit (finaliser of MurmurHash3).
fn hash(mut bits: u32) -> u32 {
    bits ^= bits >> 16;
    bits = bits.wrapping_mul(0x85eb_ca6b);
    bits ^= bits >> 13;
    bits = bits.wrapping_mul(0xc2b2_ae35);
    bits ^ bits >> 16
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn noise_has_variance_one_and_no_mean() {
        let mut grain = Grain::new(1, 2, 3);
        let values: Vec<f32> = (0..10_000)
            .flat_map(|_| grain.next().into_iter().flatten())
            .collect();
        let count = values.len() as f32;
        let mean = values.iter().sum::<f32>() / count;
        let variance = values.iter().map(|value| value * value).sum::<f32>() / count;
        assert!(mean.abs() < 0.01, "{mean}");
        assert!((variance - 1.0).abs() < 0.01, "{variance}");
    }

    #[test]
    fn neutral_white_balance_changes_nothing() {
        let carpet = Color::from_rgb([38.0, 128.0, 52.0]);
        let color = carpet.balanced([1.0; 3]);
        assert!((color.luminance - carpet.luminance).abs() < 1e-3);
        assert!((color.blue - carpet.blue).abs() < 1e-3);
        assert!((color.red - carpet.red).abs() < 1e-3);
    }
}
