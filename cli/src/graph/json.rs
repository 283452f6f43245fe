//! The graph as JSON, and the hash by which recordings and clients recognise it.

use hulkgen_mcap::fnv;
use serde_json::{Map, Value};

use super::Graph;
use crate::model::DO_NOT_EDIT;

/// The JSON form, one key a line.
pub fn render(graph: &Graph) -> String {
    let mut text = serde_json::to_string_pretty(graph).expect("a graph has only string keys");
    text.push('\n');
    text
}

/// The JSON form without lines of fields, for the robot's own program: a comment in a node's file changes nothing. One
/// entry of a list a line, so that a change of the robot is a change of its lines.
pub fn render_for_clients(graph: &Graph) -> String {
    let mut graph = serde_json::to_value(graph).expect("a graph has only string keys");
    remove_key(&mut graph, "line");
    // JSON has no comments: a key says it.
    let mut entries = Map::from_iter([("generated".to_owned(), DO_NOT_EDIT.into())]);
    if let Value::Object(graph) = graph {
        entries.extend(graph);
    }
    let value = Value::Object(entries);
    let mut text = String::new();
    write_lines(&value, 2, "", &mut text);
    text.push('\n');
    text
}

/// Lists and objects down to a depth have a line for each entry, all below stands in one.
fn write_lines(value: &Value, depth: usize, indentation: &str, text: &mut String) {
    let inner = format!("{indentation} ");
    let mut entries: Vec<(String, &Value)> = Vec::new();
    let (open, close) = match value {
        Value::Object(object) if depth > 0 && !object.is_empty() => {
            let keyed = object.iter();
            entries.extend(
                keyed.map(|(key, value)| (format!("{}: ", Value::from(key.as_str())), value)),
            );
            ('{', '}')
        }
        Value::Array(list) if depth > 0 && !list.is_empty() => {
            entries.extend(list.iter().map(|value| (String::new(), value)));
            ('[', ']')
        }
        _ => {
            text.push_str(&value.to_string());
            return;
        }
    };
    text.push(open);
    for (position, (key, value)) in entries.into_iter().enumerate() {
        text.push_str(if position == 0 { "\n" } else { ",\n" });
        text.push_str(&inner);
        text.push_str(&key);
        write_lines(value, depth - 1, &inner, text);
    }
    text.push('\n');
    text.push_str(indentation);
    text.push(close);
}

/// FNV-1a (64 bit, hexadecimal) of the compact JSON form without the key `hash` and without the
/// lines of fields: a comment in a node's file is no other graph.
pub fn hash(graph: &Graph) -> String {
    let mut value = serde_json::to_value(graph).expect("a graph has only string keys");
    remove_key(&mut value, "hash");
    remove_key(&mut value, "line");
    format!("{:016x}", fnv(value.to_string().as_bytes()))
}

fn remove_key(value: &mut Value, key: &str) {
    match value {
        Value::Object(entries) => {
            entries.shift_remove(key);
            entries
                .values_mut()
                .for_each(|value| remove_key(value, key));
        }
        Value::Array(values) => values.iter_mut().for_each(|value| remove_key(value, key)),
        Value::Null | Value::Bool(_) | Value::Number(_) | Value::String(_) => {}
    }
}

#[cfg(test)]
mod tests {
    use serde_json::{Value, json};

    use super::write_lines;

    #[test]
    fn lines_are_the_same_json() {
        let value = json!({ "a": [1, { "b": [2] }], "c": {}, "d": null, "e": [] });
        let mut text = String::new();
        write_lines(&value, 2, "", &mut text);
        let read: Value = serde_json::from_str(&text).expect("JSON");
        assert_eq!(read, value);
        let lines =
            "{\n \"a\": [\n  1,\n  {\"b\":[2]}\n ],\n \"c\": {},\n \"d\": null,\n \"e\": []\n}";
        assert_eq!(text, lines);
    }
}
