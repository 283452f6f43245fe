//! Values in the place and the layout of those that were there.

use toml_edit::{InlineTable, Item, TableLike, Value as Written};

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

pub(super) fn replace(table: &mut dyn TableLike, key: &str, value: &Tree) -> Result<(), Untold> {
    set(table, key, to_toml(value)?);
    Ok(())
}

fn put(known: &mut Written, mut value: Written) {
    *value.decor_mut() = known.decor().clone();
    *known = value;
}
