//! Tables and arrays of tables, whose comments stay with what stays.

use std::collections::BTreeMap;

use toml_edit::{ArrayOfTables, Item, Table, TableLike};

use super::layout::{self, Untold};
use crate::parameters::tree::{Tree, Value};

pub(super) type Entries = BTreeMap<String, Tree>;

/// Whether an array of tables can have them; an empty one has no form.
pub(super) fn are_all(items: &[Tree]) -> bool {
    !items.is_empty()
        && items
            .iter()
            .all(|item| matches!(item.value, Value::Table(_)))
}

/// These entries and no others.
pub(super) fn rewrite(known: &mut dyn TableLike, entries: &Entries) -> Result<(), Untold> {
    let old: Vec<String> = known.iter().map(|(key, _)| key.to_owned()).collect();
    let is_there = |key: &String| {
        let value = entries.get(key).map(|tree| &tree.value);
        value.is_some_and(|value| !matches!(value, Value::Absent))
    };
    for key in old.iter().filter(|key| !is_there(key)) {
        known.remove(key);
    }
    for (key, value) in entries {
        if !matches!(value.value, Value::Absent) {
            layout::replace(known, key, value)?;
        }
    }
    Ok(())
}

/// By index: surplus tables go, new ones are like the last.
pub(super) fn rewrite_all(known: &mut ArrayOfTables, items: &[Tree]) -> Result<(), Untold> {
    while known.len() > items.len() {
        known.remove(known.len() - 1);
    }
    for (index, item) in items.iter().enumerate() {
        let Value::Table(entries) = &item.value else {
            continue;
        };
        if known.get(index).is_none() {
            let new = known.iter().last().map_or_else(Table::new, like);
            known.push(new);
        }
        if let Some(table) = known.get_mut(index) {
            rewrite(table, entries)?;
        }
    }
    Ok(())
}

/// An empty table that keeps the distance to the one before, in the order of keys and without comments.
fn like(last: &Table) -> Table {
    let mut new = Table::new();
    let before = last.decor().prefix().and_then(|prefix| prefix.as_str());
    let is_apart = before.is_none_or(|before| before.starts_with('\n'));
    new.decor_mut().set_prefix(if is_apart { "\n" } else { "" });
    for (key, item) in last.iter() {
        if let Item::Value(value) = item {
            let mut value = value.clone();
            value.decor_mut().clear();
            if !value.to_string().contains('#') {
                new.insert(key, Item::Value(value));
            }
        }
    }
    new
}
