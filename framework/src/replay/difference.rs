//! Where two values differ.

use serde_json::Value;

/// Path of the first part that differs, empty for the whole.
pub(crate) fn first_difference(one: &Value, other: &Value) -> String {
    let below = match (one, other) {
        (Value::Object(one), Value::Object(other)) if one.len() == other.len() => {
            let mut parts = one.iter();
            parts.find_map(|(key, part)| match other.get(key) {
                Some(same) if same == part => None,
                Some(changed) => Some(Some((key.clone(), first_difference(part, changed)))),
                None => Some(None),
            })
        }
        (Value::Array(one), Value::Array(other)) if one.len() == other.len() => {
            let mut parts = one.iter().zip(other).enumerate();
            parts.find_map(|(index, (part, changed))| {
                (part != changed)
                    .then(|| Some((index.to_string(), first_difference(part, changed))))
            })
        }
        _ => None,
    };
    match below.flatten() {
        Some((name, rest)) if rest.is_empty() => name,
        Some((name, rest)) => format!("{name}.{rest}"),
        None => String::new(),
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
