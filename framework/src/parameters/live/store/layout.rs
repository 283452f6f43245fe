//! Values in the place and the layout of those that were there.

use toml_edit::{InlineTable, Item, TableLike, Value as Written};

use super::{array, tables};
use crate::parameters::tree::{Tree, Value};

/// Why TOML cannot say it.
pub(super) type Untold = String;

/// In the layout that new values have.
pub(super) fn to_toml(value: &Tree) -> Result<Written, Untold> {
    Ok(match &value.value {
        Value::Absent => return Err("TOML has no word for what is absent within a list".to_owned()),
        Value::Boolean(flag) => (*flag).into(),
        Value::String(text) | Value::Datetime(text) => in_a_line(text),
        Value::Integer(integer) => i64::try_from(*integer)
            .map_err(|_| format!("{integer} is too large for TOML"))?
            .into(),
        Value::Float(float) => (*float).into(),
        Value::Array(items) => Written::Array(items.iter().map(to_toml).collect::<Result<_, _>>()?),
        Value::Table(entries) => {
            let mut table = InlineTable::new();
            for (key, value) in entries {
                if !matches!(value.value, Value::Absent) {
                    table.insert(key, to_toml(value)?);
                }
            }
            Written::InlineTable(table)
        }
    })
}

/// The file's line ends must not become the text's.
fn in_a_line(text: &str) -> Written {
    let escaped = serde_json::Value::from(text).to_string();
    let escaped = escaped.replace('\u{7f}', "\\u007F");
    match escaped.parse() {
        Ok(value) if text.contains('\n') => value,
        _ => text.into(),
    }
}

/// In place of the value that is there, whose comments stay.
pub(super) fn set(table: &mut dyn TableLike, key: &str, value: Written) {
    match table.get_mut(key) {
        Some(Item::Value(old)) => put(old, value),
        Some(item) => {
            *item = Item::Value(value);
            // It was a header's, which has another spacing.
            if let Some(mut key) = table.key_mut(key) {
                key.leaf_decor_mut().clear();
                key.dotted_decor_mut().clear();
            }
        }
        None => _ = table.insert(key, Item::Value(value)),
    }
}

/// The whole value, in which what can stay stays.
pub(super) fn replace(table: &mut dyn TableLike, key: &str, value: &Tree) -> Result<(), Untold> {
    match (table.get_mut(key), &value.value) {
        (Some(Item::Table(known)), Value::Table(entries)) => tables::rewrite(known, entries),
        (Some(Item::ArrayOfTables(known)), Value::Array(items)) if tables::are_all(items) => {
            tables::rewrite_all(known, items)
        }
        (Some(Item::Value(known)), _) => rewrite(known, value),
        _ => {
            set(table, key, to_toml(value)?);
            Ok(())
        }
    }
}

/// As [`replace`], of a value that stands in a line.
pub(super) fn rewrite(known: &mut Written, value: &Tree) -> Result<(), Untold> {
    // As it was written: `1e3`, `0x10`, `'text'`.
    if is_written_as(known, value) {
        return Ok(());
    }
    match (&mut *known, &value.value) {
        (Written::Array(known), Value::Array(items)) => array::rewrite(known, items),
        (Written::InlineTable(known), Value::Table(entries)) => {
            // The space in front of the brace is that of whichever key is the last.
            let end = take_end(known);
            let result = tables::rewrite(known, entries);
            give_end(known, end);
            result
        }
        _ => {
            put(known, to_toml(value)?);
            Ok(())
        }
    }
}

fn put(known: &mut Written, mut value: Written) {
    *value.decor_mut() = known.decor().clone();
    *known = value;
}

#[expect(
    clippy::cast_precision_loss,
    reason = "what is rounded is written anew"
)]
fn is_written_as(known: &Written, value: &Tree) -> bool {
    match (known, &value.value) {
        (Written::String(known), Value::String(text)) => known.value() == text,
        (Written::Integer(known), Value::Integer(integer)) => {
            i128::from(*known.value()) == *integer
        }
        // A float may be written without a point.
        (Written::Integer(known), Value::Float(float)) => *known.value() as f64 == *float,
        (Written::Float(known), Value::Float(float)) => {
            known.value().total_cmp(float).is_eq() || (known.value().is_nan() && float.is_nan())
        }
        (Written::Boolean(known), Value::Boolean(flag)) => known.value() == flag,
        (Written::Datetime(known), Value::String(text)) => known.value().to_string() == *text,
        _ => false,
    }
}

fn take_end(table: &mut InlineTable) -> Option<String> {
    let (_, value) = table.iter_mut().last()?;
    let end = value.decor().suffix()?.as_str()?.to_owned();
    if end.contains('#') {
        return None;
    }
    value.decor_mut().set_suffix("");
    Some(end)
}

fn give_end(table: &mut InlineTable, end: Option<String>) {
    if let (Some(end), Some((_, value))) = (end, table.iter_mut().last()) {
        value.decor_mut().set_suffix(end);
    }
}
