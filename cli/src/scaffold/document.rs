//! Edits of TOML files that keep comments, order and layout.

use camino::Utf8Path;
use toml_edit::{Array, DocumentMut, Item, Table, TableLike, Value};

use crate::outcome::Refusal;

/// The file as a document.
pub(super) fn parse(file: &Utf8Path, text: &str) -> Result<DocumentMut, Refusal> {
    text.parse().map_err(|error: toml_edit::TomlError| {
        Refusal::bad(format!("`{file}`: {}", error.message()))
    })
}

/// The text of a document that was read from a text, with the line ends of that.
pub(super) fn written(document: &DocumentMut, before: &str) -> String {
    let text = document.to_string();
    match before.contains("\r\n") {
        true => text.replace("\r\n", "\n").replace('\n', "\r\n"),
        false => text,
    }
}

/// The tables of a list such as `[[cycler]]`, however it is written.
pub(super) fn tables<'d>(document: &'d mut dyn TableLike, key: &str) -> Vec<&'d mut dyn TableLike> {
    match document.get_mut(key) {
        Some(Item::ArrayOfTables(tables)) => tables
            .iter_mut()
            .map(|table| table as &mut dyn TableLike)
            .collect(),
        Some(Item::Value(Value::Array(array))) => array
            .iter_mut()
            .filter_map(|value| value.as_inline_table_mut())
            .map(|table| table as &mut dyn TableLike)
            .collect(),
        _ => Vec::new(),
    }
}

/// The `[[cycler]]` of this name.
pub(super) fn cycler<'d>(
    document: &'d mut DocumentMut,
    name: &str,
) -> Option<&'d mut dyn TableLike> {
    let mut cyclers = tables(document.as_table_mut(), "cycler").into_iter();
    cyclers.find(|table| table.get("name").and_then(Item::as_str) == Some(name))
}

/// The list at a key, which is made if it is not there.
pub(super) fn list<'t>(table: &'t mut dyn TableLike, key: &str) -> Option<&'t mut Array> {
    if !table.contains_key(key) {
        table.insert(key, toml_edit::value(Array::new()));
    }
    table.get_mut(key)?.as_array_mut()
}

/// Adds a text at the end of a list, in the layout of the list.
pub(super) fn push(list: &mut Array, text: &str) {
    let own_lines = list
        .iter()
        .last()
        .is_some_and(|last| prefix(last).contains('\n'));
    let indentation = match list.iter().last() {
        Some(last) if own_lines => prefix(last)
            .rsplit('\n')
            .next()
            .unwrap_or_default()
            .to_owned(),
        _ => "    ".to_owned(),
    };
    let mut behind = String::new();
    if let Some(last) = list.iter_mut().last() {
        behind.push_str(suffix(last));
        last.decor_mut().set_suffix("");
    }
    behind.push_str(list.trailing().as_str().unwrap_or_default());
    let (before, trailing) = match behind.rsplit_once('\n') {
        // A comment there belongs to the line before.
        Some((comment, end)) => (format!("{comment}\n{indentation}"), format!("\n{end}")),
        None if own_lines => (format!("\n{indentation}"), behind),
        None if list.is_empty() => (String::new(), behind),
        None if list.len() == 1 => (" ".to_owned(), behind),
        None => (list.iter().last().map_or(" ", prefix).to_owned(), behind),
    };
    list.push_formatted(Value::from(text).decorated(before, ""));
    list.set_trailing(trailing);
}

/// Removes an element of a list with the comment beside it. Comments on lines of their own stay: nobody knows whether
/// they are the element's, the list's, or other elements for later.
pub(super) fn remove(list: &mut Array, index: usize) {
    let removed = list.remove(index);
    let is_alone = list.is_empty();
    let (line_before, below) = split(prefix(&removed));
    let (comments, _) = below.rsplit_once('\n').unwrap_or_default();
    match list.get_mut(index) {
        Some(next) => {
            let joined = match split(prefix(next)) {
                // It stood on the same line, and takes the place.
                (_, "") => format!("{line_before}{below}"),
                (_, own) => format!("{line_before}{comments}{own}"),
            };
            next.decor_mut().set_prefix(joined);
        }
        None => {
            let behind = format!(
                "{}{}",
                suffix(&removed),
                list.trailing().as_str().unwrap_or_default()
            );
            let (own, rest) = split(&behind);
            if below.is_empty() && rest.is_empty() {
                list.set_trailing(own);
            } else {
                let left = format!("{line_before}{comments}{rest}");
                list.set_trailing(match (left.contains('#'), rest) {
                    (true, "") => format!("{left}\n"),
                    (false, _) if is_alone => String::new(),
                    _ => left,
                });
            }
        }
    }
    if list.is_empty() {
        list.set_trailing_comma(false);
    }
}

/// Replaces a text value where it stands.
pub(super) fn replace(value: &mut Value, text: &str) {
    let decor = value.decor().clone();
    *value = Value::from(text);
    *value.decor_mut() = decor;
}

/// Adds a `[[key]]` behind those that are there.
pub(super) fn push_table(document: &mut DocumentMut, key: &str, table: Table) -> Option<()> {
    let tables = document
        .entry(key)
        .or_insert(Item::ArrayOfTables(toml_edit::ArrayOfTables::new()));
    tables.as_array_of_tables_mut()?.push(table);
    Some(())
}

fn prefix(value: &Value) -> &str {
    value
        .decor()
        .prefix()
        .and_then(|text| text.as_str())
        .unwrap_or_default()
}

fn suffix(value: &Value) -> &str {
    value
        .decor()
        .suffix()
        .and_then(|text| text.as_str())
        .unwrap_or_default()
}

/// The rest of the line before, and the lines after it with their line break.
fn split(text: &str) -> (&str, &str) {
    match text.find('\n') {
        Some(end) => text.split_at(end),
        None => (text, ""),
    }
}

#[cfg(test)]
mod tests;
