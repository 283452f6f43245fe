//! Whether another machine computes the same bits.

use std::env::consts::{ARCH, OS};
use std::hint::black_box;

use crate::digest::Digest;

/// Text that is the same where elementary functions give the same bits: what was recorded there is recomputed exactly here.
pub fn fingerprint() -> String {
    let mut digest = Digest::new();
    for step in 1..=64_u32 {
        let (wide, narrow) = (f64::from(step) * 0.173, step as f32 * 0.173);
        let (wide, narrow) = (black_box(wide), black_box(narrow));
        let of_wide = [
            wide.sin(),
            wide.cos(),
            wide.tan(),
            wide.exp(),
            wide.ln(),
            wide.atan2(1.7),
            wide.powf(1.3),
            wide.mul_add(wide, 0.1),
        ];
        let of_narrow = [
            narrow.sin(),
            narrow.cos(),
            narrow.tan(),
            narrow.exp(),
            narrow.ln(),
            narrow.atan2(1.7),
            narrow.powf(1.3),
            narrow.mul_add(narrow, 0.1),
        ];
        // Numbers can always be part of a digest.
        let _ = digest.add(&(of_wide, of_narrow));
    }
    format!("{ARCH}-{OS}-{digest}")
}
