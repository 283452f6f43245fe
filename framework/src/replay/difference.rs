//! Where two values differ.

use serde_json::Value;

/// Path of the first part that differs, empty for the whole.
pub(crate) fn first_difference(one: &Value, other: &Value) -> String {
    first_unlike(one, other, &|one, other| one == other)
}

/// As [`first_difference`], of two values that are not alike, where parts are that this says so of.
pub(super) fn first_unlike(
    one: &Value,
    other: &Value,
    is_alike: &dyn Fn(&Value, &Value) -> bool,
) -> String {
    let below = match (one, other) {
        (Value::Object(one), Value::Object(other)) if one.len() == other.len() => {
            let mut parts = one.iter();
            parts.find_map(|(key, part)| match other.get(key) {
                Some(same) if is_alike(part, same) => None,
                Some(changed) => Some(Some((key.clone(), part, changed))),
                None => Some(None),
            })
        }
        (Value::Array(one), Value::Array(other)) if one.len() == other.len() => {
            let mut parts = one.iter().zip(other).enumerate();
            parts.find_map(|(index, (part, changed))| {
                (!is_alike(part, changed)).then(|| Some((index.to_string(), part, changed)))
            })
        }
        _ => None,
    };
    let Some((name, part, changed)) = below.flatten() else {
        return String::new();
    };
    match first_unlike(part, changed, is_alike) {
        rest if rest.is_empty() => name,
        rest => format!("{name}.{rest}"),
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::first_difference;

    #[test]
    fn the_first_part_that_differs_is_named() {
        let one = json!({"a": {"b": [1, 2, 3]}, "c": 1});
        for (other, path) in [
            (json!({"a": {"b": [1, 2, 4]}, "c": 2}), "a.b.2"),
            (json!({"a": {"b": [1, 2]}, "c": 1}), "a.b"),
            (json!({"a": {"x": [1, 2, 3]}, "c": 1}), "a"),
            (json!(null), ""),
        ] {
            assert_eq!(first_difference(&one, &other), path);
        }
    }
}
