//! How people write durations.

use std::time::Duration;

use crate::error::{Error, Result};

/// A number with its unit, in those of the manifest: `10s`, `1.5s`, `500ms`, `2m`, `1h`.
pub(crate) fn duration(text: &str) -> Result<Duration> {
    let end = text
        .find(|character: char| character.is_alphabetic())
        .unwrap_or(text.len());
    let (number, unit) = text.split_at(end);
    let seconds = match unit {
        "ns" => Some(1e-9),
        "us" | "µs" => Some(1e-6),
        "ms" => Some(1e-3),
        "s" => Some(1.0),
        "m" | "min" => Some(60.0),
        "h" => Some(3600.0),
        _ => None,
    };
    let parsed = seconds.zip(number.trim().parse::<f64>().ok());
    parsed
        .and_then(|(seconds, number)| Duration::try_from_secs_f64(number * seconds).ok())
        .ok_or_else(|| {
            Error::new(format!(
                "`{text}` is no duration: expected e.g. 10s, 500ms or 2m"
            ))
        })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn durations_need_a_number_and_a_unit() {
        assert_eq!(duration("2m").expect("valid"), Duration::from_secs(120));
        assert_eq!(
            duration("500ms").expect("valid"),
            Duration::from_millis(500)
        );
        for (text, seconds) in [
            ("1 min", 60),
            ("1h", 3600),
            ("2000000µs", 2),
            ("3000000000ns", 3),
        ] {
            assert_eq!(
                duration(text).expect("valid"),
                Duration::from_secs(seconds),
                "{text}"
            );
        }
        for wrong in ["", "10", "s", "-1s", "10 parsecs", "1e400s"] {
            assert!(duration(wrong).is_err(), "{wrong}");
        }
    }
}
