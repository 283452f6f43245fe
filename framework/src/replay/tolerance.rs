//! Whether two values are the same but for how a machine rounds.

use serde_json::Value;

/// Whether all numbers differ by no more than `tolerance`, relative to the larger of 1 and their size, and all else is equal.
pub(super) fn is_within(one: &Value, other: &Value, tolerance: f64) -> bool {
    match (one, other) {
        (Value::Number(one), Value::Number(other)) if one != other => {
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

    use super::is_within;

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
}
