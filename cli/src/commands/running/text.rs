//! Values, durations and tables as people read them.

use serde_json::Value;

/// A value: one line if it is no more, else its parts, each on a line of its own.
pub(super) fn tree(value: &Value) -> String {
    let mut text = String::new();
    match value {
        Value::Object(_) | Value::Array(_) if !is_short(value) => parts(value, "", &mut text),
        value => text = format!("{}\n", leaf(value)),
    }
    text
}

/// A value on one line.
pub(super) fn leaf(value: &Value) -> String {
    match value {
        Value::Null => "none".to_owned(),
        Value::String(text) => text.clone(),
        value => value.to_string(),
    }
}

/// Short lists of numbers, such as vectors, stay on one line; so does what has no parts.
fn is_short(value: &Value) -> bool {
    match value {
        Value::Array(items) => {
            items.len() <= 6
                && items
                    .iter()
                    .all(|item| !item.is_object() && !item.is_array())
        }
        Value::Object(entries) => entries.is_empty(),
        _ => true,
    }
}

fn parts(value: &Value, indentation: &str, text: &mut String) {
    let mut part = |name: &str, value: &Value| {
        if is_short(value) {
            text.push_str(&format!("{indentation}{name}: {}\n", leaf(value)));
        } else {
            text.push_str(&format!("{indentation}{name}:\n"));
            parts(value, &format!("{indentation}  "), text);
        }
    };
    match value {
        Value::Object(entries) => entries.iter().for_each(|(name, value)| part(name, value)),
        Value::Array(items) => {
            for (index, item) in items.iter().enumerate() {
                part(&index.to_string(), item);
            }
        }
        _ => {}
    }
}

/// A time of the robot's clock.
pub(super) fn seconds(nanoseconds: u64) -> String {
    format!("{:.3} s", nanoseconds as f64 / 1e9)
}

/// Where numbers must lie, as Rust writes it.
pub(super) fn range(range: &protocol::Range) -> String {
    let bound = |bound: Option<f64>| bound.map(|bound| bound.to_string()).unwrap_or_default();
    let is_closed = range.maximum.is_some() && !range.is_half_open;
    let between = if is_closed { "..=" } else { ".." };
    format!("{}{between}{}", bound(range.minimum), bound(range.maximum))
}

/// Rows below each other: the first column to the left, the others to the right if they are numbers' columns.
pub(super) fn columns(rows: &[Vec<String>], are_numbers: bool) -> String {
    let number = rows.iter().map(Vec::len).max().unwrap_or(0);
    let width = |column: usize| {
        let cells = rows.iter().filter_map(|row| row.get(column));
        cells.map(|cell| cell.chars().count()).max().unwrap_or(0)
    };
    let widths: Vec<usize> = (0..number).map(width).collect();
    let mut text = String::new();
    for row in rows {
        let mut line = String::new();
        for (column, (cell, width)) in row.iter().zip(&widths).enumerate() {
            if column > 0 {
                line.push_str("  ");
            }
            if are_numbers && column > 0 {
                line.push_str(&format!("{cell:>width$}"));
            } else {
                line.push_str(&format!("{cell:width$}"));
            }
        }
        text.push_str(line.trim_end());
        text.push('\n');
    }
    text
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::{columns, tree};

    #[test]
    fn a_value_is_a_line_or_a_tree() {
        assert_eq!(tree(&json!(0.5)), "0.5\n");
        assert_eq!(tree(&json!(null)), "none\n");
        assert_eq!(tree(&json!("Soft")), "Soft\n");
        assert_eq!(tree(&json!([1, 2])), "[1,2]\n");
        let value = json!({ "at": [1.0, 2.0], "balls": [{ "x": 1 }], "name": "a", "none": {} });
        let expected = "at: [1.0,2.0]\nballs:\n  0:\n    x: 1\nname: a\nnone: {}\n";
        assert_eq!(tree(&value), expected);
    }

    #[test]
    fn columns_stand_below_each_other() {
        let rows = [
            vec!["node".to_owned(), "p50".to_owned()],
            vec!["a".to_owned(), "1234".to_owned()],
        ];
        assert_eq!(columns(&rows, true), "node   p50\na     1234\n");
        assert_eq!(columns(&rows, false), "node  p50\na     1234\n");
    }
}
