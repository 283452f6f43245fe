//! Colours of the world in full range YCbCr (BT.601), and the noise of the sensor.

/// Luminance 0 to 255, chromaticities relative to grey.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Color {
    pub(crate) luminance: f32,
    pub(crate) blue: f32,
    pub(crate) red: f32,
}

impl Color {
    /// RGB (38, 128, 52).
    pub(crate) const CARPET: Self = Self {
        luminance: 92.4,
        blue: -22.8,
        red: -38.8,
    };
    pub(crate) const LINE: Self = Self {
        luminance: 205.0,
        blue: -1.0,
        red: -1.0,
    };
    /// The floor around the carpet.
    pub(crate) const FLOOR: Self = Self {
        luminance: 118.0,
        blue: -9.0,
        red: 8.0,
    };
    /// Walls at the height of the horizon.
    pub(crate) const HORIZON: Self = Self {
        luminance: 150.0,
        blue: 3.0,
        red: -2.0,
    };

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
}

/// Rounds and saturates.
pub(crate) fn to_byte(value: f32) -> u8 {
    to_bits(value.clamp(0.0, 255.0)) as u8
}

/// The nearest integer in the low bits, for numbers up to four millions. `as` would look for
/// numbers that do not fit, which keeps loops from being vectorised.
pub(crate) fn to_bits(value: f32) -> u32 {
    // The first float whose neighbour is one away.
    const UNIT_SPACED: f32 = 8_388_608.0;
    (value + UNIT_SPACED).to_bits()
}

/// Noise of the sensor: a sequence of small numbers fixed by where it starts.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Grain(u32);

impl Grain {
    pub(crate) fn new(image: u64, row: usize) -> Self {
        let seed =
            (image as u32).wrapping_mul(0x9e37_79b1) ^ (row as u32).wrapping_mul(0x85eb_ca77);
        Self(seed | 1)
    }

    /// Four values between -2.25 and 2.25.
    pub(crate) fn next(&mut self) -> [f32; 4] {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 17;
        self.0 ^= self.0 << 5;
        [0, 8, 16, 24].map(|shift| {
            let bits = self.0 >> shift;
            ((bits & 3) + (bits >> 2 & 3)) as f32 * 0.75 - 2.25
        })
    }
}
