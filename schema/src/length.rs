//! Lengths of time and sizes as people write them.

use std::borrow::Cow;
use std::fmt;
use std::str::FromStr;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use crate::spelling::SpellingError;

/// A length of time greater than zero, written "33ms", "1.5s", "250us".
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Duration(std::time::Duration);

/// A number of bytes, written "2GiB", "500MB", "64KiB".
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Size(u64);

/// Units of time in nanoseconds, longest first; the last two are read alone, as other programs write them.
const TIMES: &[(&str, u64)] = &[
    ("min", 60_000_000_000),
    ("s", 1_000_000_000),
    ("ms", 1_000_000),
    ("us", 1_000),
    ("µs", 1_000),
    ("ns", 1),
    ("m", 60_000_000_000),
    ("h", 3_600_000_000_000),
];

/// Units of size in bytes, largest first.
const SIZES: &[(&str, u64)] = &[
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

impl Duration {
    /// The length.
    pub fn get(self) -> std::time::Duration {
        self.0
    }
}

impl From<Duration> for std::time::Duration {
    fn from(duration: Duration) -> Self {
        duration.0
    }
}

impl Size {
    /// So many times 2³⁰ bytes.
    pub const fn from_gibibytes(gibibytes: u64) -> Self {
        Self(gibibytes << 30)
    }

    /// In bytes.
    pub fn bytes(self) -> u64 {
        self.0
    }
}

impl FromStr for Duration {
    type Err = SpellingError;

    fn from_str(text: &str) -> Result<Self, SpellingError> {
        let nanoseconds = parse(text, TIMES).ok_or_else(|| SpellingError {
            text: text.to_owned(),
            kind: "length of time",
            rule: "write a number greater than zero and `ns`, `us`, `ms`, `s`, `min` (or `m`) or `h`, as in \"33ms\"",
        })?;
        Ok(Self(std::time::Duration::from_nanos(nanoseconds)))
    }
}

impl FromStr for Size {
    type Err = SpellingError;

    fn from_str(text: &str) -> Result<Self, SpellingError> {
        let bytes = parse(text, SIZES).ok_or_else(|| SpellingError {
            text: text.to_owned(),
            kind: "size",
            rule: "write a number greater than zero and a unit from `B` to `TiB`, as in \"2GiB\"",
        })?;
        Ok(Self(bytes))
    }
}

impl fmt::Display for Duration {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        // Nanoseconds of any length that can be written fit: see `parse`.
        print(
            u64::try_from(self.0.as_nanos()).unwrap_or(u64::MAX),
            TIMES,
            formatter,
        )
    }
}

impl fmt::Display for Size {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        print(self.0, SIZES, formatter)
    }
}

/// A number, perhaps with decimals, and a unit; `None` also for zero, for what does not fit and for parts of the smallest unit.
fn parse(text: &str, units: &[(&str, u64)]) -> Option<u64> {
    let unit_start = text.find(|letter: char| !letter.is_ascii_digit() && letter != '.')?;
    let (number, unit) = text.split_at(unit_start);
    let factor = units.iter().find(|(name, _)| *name == unit.trim_start())?.1;
    let (whole, decimals) = number.split_once('.').unwrap_or((number, ""));
    if whole.is_empty() || decimals.len() > 15 || number.ends_with('.') {
        return None;
    }
    let scale = 10_u128.pow(u32::try_from(decimals.len()).ok()?);
    let digits: u128 = format!("{whole}{decimals}").parse().ok()?;
    let scaled = digits.checked_mul(u128::from(factor))?;
    let value = u64::try_from(scaled / scale).ok()?;
    (scaled % scale == 0 && value > 0).then_some(value)
}

/// In the largest unit that divides it.
fn print(value: u64, units: &[(&str, u64)], formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
    let divides = |(_, factor): &&(&str, u64)| value.is_multiple_of(*factor);
    let (unit, factor) = units.iter().find(divides).copied().unwrap_or(("", 1));
    write!(formatter, "{}{unit}", value / factor)
}

/// Serde and schema of a length: a string.
macro_rules! as_string {
    ($name:ident, $pattern:literal, $description:literal) => {
        impl Serialize for $name {
            fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                serializer.collect_str(self)
            }
        }

        impl<'de> Deserialize<'de> for $name {
            fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                let text = String::deserialize(deserializer)?;
                text.parse().map_err(serde::de::Error::custom)
            }
        }

        impl JsonSchema for $name {
            fn schema_name() -> Cow<'static, str> {
                stringify!($name).into()
            }

            fn json_schema(_: &mut SchemaGenerator) -> Schema {
                json_schema!({ "type": "string", "description": $description, "pattern": $pattern })
            }
        }
    };
}

as_string!(
    Duration,
    r"^[0-9]+(\.[0-9]+)? *(ns|us|µs|ms|s|min|m|h)$",
    "A length of time greater than zero, for example \"33ms\" or \"1.5s\"."
);
as_string!(
    Size,
    r"^[0-9]+(\.[0-9]+)? *(B|kB|KiB|MB|MiB|GB|GiB|TB|TiB)$",
    "A number of bytes, for example \"2GiB\"."
);
