//! Whether another machine computes the same bits.

use std::env::consts::{ARCH, OS};
use std::hint::black_box;

use crate::digest::Digest;
use crate::math;

/// Text that is the same where [`math`] gives the same bits: what nodes computed there is recomputed exactly here, if they use
/// nothing else.
pub fn fingerprint() -> String {
    fingerprint_of(|wide, narrow| {
        (
            [
                math::sin(wide),
                math::cos(wide),
                math::tan(wide),
                math::exp(wide),
                math::ln(wide),
                math::atan2(wide, 1.7),
                math::powf(wide, 1.3),
                wide.mul_add(wide, 0.1),
            ],
            [
                math::sin(narrow),
                math::cos(narrow),
                math::tan(narrow),
                math::exp(narrow),
                math::ln(narrow),
                math::atan2(narrow, 1.7),
                math::powf(narrow, 1.3),
                narrow.mul_add(narrow, 0.1),
            ],
        )
    })
}

/// Text that is the same where std's functions, those of the system's library, give the same bits.
pub fn fingerprint_of_std() -> String {
    fingerprint_of(|wide, narrow| {
        (
            [
                wide.sin(),
                wide.cos(),
                wide.tan(),
                wide.exp(),
                wide.ln(),
                wide.atan2(1.7),
                wide.powf(1.3),
                wide.mul_add(wide, 0.1),
            ],
            [
                narrow.sin(),
                narrow.cos(),
                narrow.tan(),
                narrow.exp(),
                narrow.ln(),
                narrow.atan2(1.7),
                narrow.powf(1.3),
                narrow.mul_add(narrow, 0.1),
            ],
        )
    })
}

fn fingerprint_of(results: impl Fn(f64, f32) -> ([f64; 8], [f32; 8])) -> String {
    let mut digest = Digest::new();
    for step in 1..=64_u32 {
        let (wide, narrow) = (f64::from(step) * 0.173, step as f32 * 0.173);
        // Numbers can always be part of a digest.
        let _ = digest.add(&results(black_box(wide), black_box(narrow)));
    }
    format!("{ARCH}-{OS}-{digest}")
}
