//! Values as rows of a table (RFC 4180).

use serde_json::Value;

use crate::recording::values::{Found, part};

/// Lists of more values stand in one cell.
const LONGEST: usize = 16;

/// A table whose columns the first value gives.
#[derive(Default)]
pub(super) struct Table {
    columns: Option<Vec<String>>,
}

impl Table {
    /// A row; before the first one the names of the columns.
    pub(super) fn row(&mut self, found: &Found) -> String {
        let mut text = String::new();
        let columns = self.columns.get_or_insert_with(|| {
            let mut columns = Vec::new();
            collect(&found.value, "", &mut columns);
            let named = columns.iter().map(|column: &String| {
                let name = if column.is_empty() { "value" } else { column };
                quoted(name)
            });
            let head = ["cycle".to_owned(), "time".to_owned()];
            let head: Vec<_> = head.into_iter().chain(named).collect();
            text = head.join(",") + "\r\n";
            columns
        });
        let time = format!("{:.9}", found.time as f64 / 1e9);
        let mut cells = vec![found.cycle.to_string(), time];
        cells.extend(columns.iter().map(|column| cell(&found.value, column)));
        text + &cells.join(",") + "\r\n"
    }
}

fn collect(value: &Value, path: &str, columns: &mut Vec<String>) {
    let below = |name: &str| match path {
        "" => name.to_owned(),
        path => format!("{path}.{name}"),
    };
    match value {
        Value::Object(fields) if !fields.is_empty() => {
            for (name, value) in fields {
                collect(value, &below(name), columns);
            }
        }
        Value::Array(items) if (1..=LONGEST).contains(&items.len()) => {
            for (index, value) in items.iter().enumerate() {
                collect(value, &below(&index.to_string()), columns);
            }
        }
        _ => columns.push(path.to_owned()),
    }
}

fn cell(value: &Value, column: &str) -> String {
    match part(value, column) {
        None | Some(Value::Null) => String::new(),
        Some(Value::String(text)) => quoted(text),
        Some(other) => quoted(&other.to_string()),
    }
}

fn quoted(text: &str) -> String {
    match text.contains(['"', ',', '\n', '\r']) {
        true => format!("\"{}\"", text.replace('"', "\"\"")),
        false => text.to_owned(),
    }
}
