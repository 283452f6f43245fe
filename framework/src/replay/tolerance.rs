//! Whether two values are the same but for how a machine rounds.

use serde_json::Value;

use super::difference::first_unlike;

/// Within which numbers are compared that another machine computed, unless something else is asked for: some of the last bits
/// of an `f32`.
pub const TOLERANCE: f64 = 1e-6;

/// Path of the first part that is not the same within a tolerance, empty for the whole.
pub(super) fn first_beyond(one: &Value, other: &Value, tolerance: f64) -> String {
    first_unlike(one, other, &|one, other| is_within(one, other, tolerance))
}

/// Whether all numbers but whole ones differ by no more than `tolerance`, relative to the larger of 1 and their size, and all
/// else is equal.
pub(super) fn is_within(one: &Value, other: &Value, tolerance: f64) -> bool {
    match (one, other) {
        // No rounding makes another whole number.
        (Value::Number(one), Value::Number(other)) if one.is_f64() || other.is_f64() => {
            let (Some(one), Some(other)) = (one.as_f64(), other.as_f64()) else {
                return false;
            };
            (one - other).abs() <= tolerance * one.abs().max(other.abs()).max(1.0)
        }
        (Value::Array(one), Value::Array(other)) => {
            let mut parts = one.iter().zip(other);
            one.len() == other.len() && parts.all(|(one, other)| is_within(one, other, tolerance))
        }
        (Value::Object(one), Value::Object(other)) => {
            let mut parts = one.iter();
            one.len() == other.len()
                && parts.all(|(key, one)| {
                    let other = other.get(key);
                    other.is_some_and(|other| is_within(one, other, tolerance))
                })
        }
        (one, other) => one == other,
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::{first_beyond, is_within};

    #[test]
    fn only_numbers_may_differ_and_only_so_much() {
        let one = json!({"a": [1.0, 2000.0], "b": "x", "c": null});
        for (other, expected) in [
            (json!({"a": [1.0009, 2001.0], "b": "x", "c": null}), true),
            (json!({"a": [1.002, 2000.0], "b": "x", "c": null}), false),
            (json!({"a": [1.0], "b": "x", "c": null}), false),
            (json!({"a": [1.0, 2000.0], "b": "y", "c": null}), false),
            (json!({"a": [1.0, 2000.0], "b": "x", "c": 0.0}), false),
            (json!({"a": [1.0, 2000.0], "b": "x", "d": null}), false),
        ] {
            assert_eq!(is_within(&one, &other, 1e-3), expected, "{other}");
        }
    }

    #[test]
    fn whole_numbers_are_the_same_or_are_not() {
        for (one, other, expected) in [
            (json!(2_000_000), json!(2_000_001), false),
            (json!(u64::MAX), json!(u64::MAX - 1), false),
            (json!(u64::MAX), json!(u64::MAX), true),
            (json!(2_000_000.0), json!(2_000_001.0), true),
            (json!(2_000_000), json!(2_000_001.0), true),
        ] {
            assert_eq!(is_within(&one, &other, 1e-6), expected, "{one} {other}");
        }
    }

    #[test]
    fn the_first_part_that_differs_by_more_is_named() {
        let one = json!({"a": [1.0, {"x": 2.0, "y": 2.0}], "b": "x"});
        for (other, path) in [
            (
                json!({"a": [1.0009, {"x": 2.001, "y": 2.1}], "b": "y"}),
                "a.1.y",
            ),
            (
                json!({"a": [1.0009, {"x": 2.001, "y": 2.001}], "b": "y"}),
                "b",
            ),
            (json!({"a": [1.0009], "b": "x"}), "a"),
            (json!(1.0), ""),
        ] {
            assert_eq!(first_beyond(&one, &other, 1e-3), path, "{other}");
        }
    }
}
