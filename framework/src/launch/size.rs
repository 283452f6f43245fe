//! How people write a number of bytes.

use crate::error::{Error, Result};

/// The units of the manifest, largest first.
const UNITS: [(&str, u64); 9] = [
    ("TiB", 1 << 40),
    ("TB", 1_000_000_000_000),
    ("GiB", 1 << 30),
    ("GB", 1_000_000_000),
    ("MiB", 1 << 20),
    ("MB", 1_000_000),
    ("KiB", 1 << 10),
    ("kB", 1_000),
    ("B", 1),
];

/// A number with its unit, as the manifest's `recording_budget` has it: `512MiB`, `1.5 GiB`, `2GB`.
pub(super) fn size(text: &str) -> Result<u64> {
    bytes(text).ok_or_else(|| {
        Error::new(format!(
            "`{text}` is no size: write a number greater than zero and a unit from `B` to `TiB`, as in 512MiB or 2GB"
        ))
    })
}

/// `None` also for zero, for what does not fit and for parts of a byte.
fn bytes(text: &str) -> Option<u64> {
    let end = text.find(|letter: char| !letter.is_ascii_digit() && letter != '.')?;
    let (number, unit) = text.split_at(end);
    let of_unit = UNITS.iter().find(|(name, _)| *name == unit.trim_start())?.1;
    let (whole, decimals) = match number.split_once('.') {
        Some((_, "")) => return None,
        Some(parts) => parts,
        None => (number, ""),
    };
    let parts_of_one = 10_u128.pow(u32::try_from(decimals.len()).ok().filter(|it| *it <= 15)?);
    if whole.is_empty() {
        return None;
    }
    let parts: u128 = format!("{whole}{decimals}").parse().ok()?;
    let parts = parts.checked_mul(of_unit.into())?;
    let bytes = u64::try_from(parts / parts_of_one).ok()?;
    (parts.is_multiple_of(parts_of_one) && bytes > 0).then_some(bytes)
}

/// In the largest unit that divides it.
pub(super) fn written(bytes: u64) -> String {
    let mut units = UNITS.iter();
    let unit = units.find(|(_, of_unit)| bytes.is_multiple_of(*of_unit));
    let (name, of_unit) = unit.unwrap_or(&("B", 1));
    format!("{}{name}", bytes / of_unit)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_are_those_of_the_manifest() {
        for (text, expected) in [
            ("2GiB", 2 << 30),
            ("2GB", 2_000_000_000),
            ("1.5GiB", 3 << 29),
            ("1TiB", 1 << 40),
            ("500MB", 500_000_000),
            ("1.5 kB", 1500),
            ("64 KiB", 64 << 10),
            ("7B", 7),
        ] {
            assert_eq!(size(text).expect("valid"), expected, "{text}");
            let again = size(&written(expected)).expect("valid");
            assert_eq!(again, expected, "{text}");
        }
        for wrong in [
            "",
            "2",
            "GiB",
            "0MiB",
            "1.GiB",
            ".5GiB",
            "1.2.3GiB",
            "1.5B",
            "-1GiB",
            "2gib",
            "2GiB ",
            "99999999999TiB",
        ] {
            assert!(size(wrong).is_err(), "{wrong}");
        }
        assert_eq!(written(2 << 30), "2GiB");
        assert_eq!(written(2_000_000_000), "2GB");
    }
}
