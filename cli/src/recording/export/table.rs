//! Values as rows of a table (RFC 4180).
//!
//! Invariant: every part of every value that was observed has a cell; a column is there for all rows.

use serde_json::Value;

use crate::recording::values::Found;

/// Lists of more values stand in one cell.
const LONGEST: usize = 16;

/// Objects with more names, of all rows together, stand in one cell: a map whose keys always change would be columns without end.
const MOST_NAMES: usize = 256;

/// The columns of a table: what its values consist of, of all rows together.
#[derive(Default)]
pub(super) struct Columns {
    /// Whether a value has stood here that is not taken apart.
    is_cell: bool,
    /// Whether no value that stands here is taken apart.
    is_whole: bool,
    /// Fields as they are declared, items of lists by their number.
    parts: Vec<(String, Columns)>,
}

impl Columns {
    /// Has columns for this value, too.
    pub(super) fn observe(&mut self, value: &Value) {
        if self.is_whole {
            return;
        }
        match value {
            // Its cells are empty, whichever they are.
            Value::Null => {}
            Value::Array(items) if items.len() > LONGEST => self.take_whole(),
            Value::Array(items) if !items.is_empty() => {
                let names = (0..items.len()).map(|index| index.to_string());
                self.observe_parts(names.zip(items));
            }
            Value::Object(fields) if !fields.is_empty() => self.observe_parts(fields),
            _ => self.is_cell = true,
        }
    }

    fn observe_parts<'v, N>(&mut self, values: impl IntoIterator<Item = (N, &'v Value)>)
    where
        N: AsRef<str> + Into<String>,
    {
        // A new name stands behind the one that it follows in its value.
        let mut next = 0;
        for (name, value) in values {
            let is_next = (self.parts.get(next)).is_some_and(|(known, _)| known == name.as_ref());
            let found = match is_next {
                true => Some(next),
                false => self
                    .parts
                    .iter()
                    .position(|(known, _)| known == name.as_ref()),
            };
            let place = found.unwrap_or_else(|| {
                let place = if next == 0 { self.parts.len() } else { next };
                self.parts.insert(place, (name.into(), Self::default()));
                place
            });
            self.parts[place].1.observe(value);
            next = place + 1;
        }
        if self.parts.len() > MOST_NAMES {
            self.take_whole();
        }
    }

    fn take_whole(&mut self) {
        self.is_whole = true;
        self.parts = Vec::new();
    }

    /// The names of the columns.
    pub(super) fn head(&self) -> String {
        let mut names = vec!["cycle".to_owned(), "time".to_owned()];
        self.collect("", &mut names);
        line(names)
    }

    fn collect(&self, path: &str, names: &mut Vec<String>) {
        if self.is_column() {
            names.push(if path.is_empty() { "value" } else { path }.to_owned());
        }
        for (name, part) in &self.parts {
            let below = match path {
                "" => name.clone(),
                path => format!("{path}.{name}"),
            };
            part.collect(&below, names);
        }
    }

    /// Whether what stands here has a cell of its own; where nothing ever stood it is empty in all rows.
    fn is_column(&self) -> bool {
        self.is_cell || self.parts.is_empty()
    }

    /// One of the values that were observed.
    pub(super) fn row(&self, found: &Found) -> String {
        let time = format!("{:.9}", found.time as f64 / 1e9);
        let mut cells = vec![found.cycle.to_string(), time];
        self.fill(Some(&found.value), &mut cells);
        line(cells)
    }

    fn fill(&self, value: Option<&Value>, cells: &mut Vec<String>) {
        if self.is_column() {
            cells.push(value.map_or_else(String::new, |value| self.cell(value)));
        }
        for (name, part) in &self.parts {
            let value = value.and_then(|value| match value {
                Value::Array(items) => items.get(name.parse::<usize>().ok()?),
                value => value.get(name),
            });
            part.fill(value, cells);
        }
    }

    fn cell(&self, value: &Value) -> String {
        match value {
            Value::Null => String::new(),
            Value::String(text) => text.clone(),
            // Its parts have their own cells.
            Value::Array(items) if !self.is_whole && !items.is_empty() => String::new(),
            Value::Object(fields) if !self.is_whole && !fields.is_empty() => String::new(),
            other => other.to_string(),
        }
    }
}

fn line(cells: Vec<String>) -> String {
    let cells: Vec<_> = cells.into_iter().map(quoted).collect();
    cells.join(",") + "\r\n"
}

fn quoted(text: String) -> String {
    match text.contains(['"', ',', '\n', '\r']) {
        true => format!("\"{}\"", text.replace('"', "\"\"")),
        false => text,
    }
}

#[cfg(test)]
mod tests {
    use serde_json::{Value, json};

    use super::Columns;
    use crate::recording::Found;

    /// The lines of the table, without cycle and time.
    fn table(values: &[Value]) -> Vec<String> {
        let mut columns = Columns::default();
        values.iter().for_each(|value| columns.observe(value));
        let rows = values.iter().map(|value| {
            let value = value.clone();
            columns.row(&Found {
                path: String::new(),
                cycle: 0,
                time: 0,
                value,
            })
        });
        let lines = std::iter::once(columns.head()).chain(rows);
        let third = |line: String| line.trim_end().splitn(3, ',').nth(2).map(str::to_owned);
        lines.filter_map(third).collect()
    }

    #[test]
    fn a_list_that_grows_keeps_its_items() {
        let item = |x: i32| json!({ "x": x, "y": -x });
        let rows = [
            json!([item(1)]),
            json!([]),
            json!([item(2), item(3), item(4)]),
        ];
        assert_eq!(
            table(&rows),
            [
                "value,0.x,0.y,1.x,1.y,2.x,2.y",
                ",1,-1,,,,",
                "[],,,,,,",
                ",2,-2,3,-3,4,-4"
            ]
        );
    }

    #[test]
    fn what_is_absent_at_first_is_taken_apart_when_it_comes() {
        let ball = json!({ "position": [1.5, 2.5], "name": "a" });
        let rows = [
            json!(null),
            ball,
            json!({ "position": null, "name": "b" }),
            json!(null),
        ];
        assert_eq!(
            table(&rows),
            ["position.0,position.1,name", ",,", "1.5,2.5,a", ",,b", ",,"]
        );
        assert_eq!(table(&[json!(null), json!(null)]), ["value", "", ""]);
    }

    #[test]
    fn variants_stand_beside_each_other() {
        let rows = [
            json!("Standing"),
            json!({ "Walking": { "step": 1 } }),
            json!({ "Falling": 0.5 }),
        ];
        assert_eq!(
            table(&rows),
            ["value,Walking.step,Falling", "Standing,,", ",1,", ",,0.5"]
        );
    }

    #[test]
    fn fields_that_come_later_stand_where_they_are_declared() {
        let rows = [
            json!({ "a": 1, "d": 4 }),
            json!({ "a": 1, "b": 2, "c": 3, "d": 4 }),
        ];
        assert_eq!(table(&rows), ["a,b,c,d", "1,,,4", "1,2,3,4"]);
    }

    #[test]
    fn keys_of_maps_may_have_full_stops() {
        assert_eq!(table(&[json!({ "1.5": 7 })]), ["1.5", "7"]);
    }

    #[test]
    fn a_list_that_once_is_long_stands_in_one_cell_in_all_rows() {
        let long: Vec<_> = (0..17).collect();
        let text = json!(long).to_string();
        assert_eq!(
            table(&[json!([1, 2]), json!(long), json!(null)]),
            [
                "value".to_owned(),
                "\"[1,2]\"".to_owned(),
                format!("\"{text}\""),
                String::new()
            ]
        );
    }

    #[test]
    fn a_map_whose_keys_always_change_stands_in_one_cell() {
        let rows: Vec<_> = (0..300).map(|key| json!({ key.to_string(): 1 })).collect();
        let table = table(&rows);
        assert_eq!(table[0], "value");
        assert_eq!(table[300], "\"{\"\"299\"\":1}\"");
    }
}
