//! `key = { unset = true }`: what earlier layers say of the key is gone.

use toml::de::{DeTable, DeValue};

/// What one layer has at a place.
#[derive(Clone, Copy)]
pub(super) struct Part<'a> {
    pub(super) table: &'a DeTable<'a>,
    /// Every robot at the location has this layer, not only those of some identity.
    pub(super) is_certain: bool,
}

/// A value that no later layer takes away.
#[derive(Clone, Copy)]
pub(super) struct Left<'a> {
    value: &'a DeValue<'a>,
    is_certain: bool,
}

/// Whether a value takes away what earlier layers say.
pub(super) fn is_unset(value: &DeValue<'_>) -> bool {
    let Some(table) = value.as_table() else {
        return false;
    };
    let value = table.get("unset").map(|value| value.get_ref());
    table.len() == 1 && matches!(value, Some(DeValue::Boolean(true)))
}

/// What is left of the values under a key, which has these names, in the order in which layers are merged.
///
/// A layer of some robots takes nothing away: the others still have it.
pub(super) fn left<'a>(parts: &[Part<'a>], names: &[&str]) -> Vec<Left<'a>> {
    let mut left = Vec::new();
    for part in parts {
        let Some(value) = names.iter().find_map(|name| part.table.get(*name)) else {
            continue;
        };
        match is_unset(value.get_ref()) {
            true if part.is_certain => left.clear(),
            true => {}
            false => left.push(Left {
                value: value.get_ref(),
                is_certain: part.is_certain,
            }),
        }
    }
    left
}

impl<'a> Left<'a> {
    /// As a place that has more below it.
    pub(super) fn part(&self) -> Option<Part<'a>> {
        Some(Part {
            table: self.value.as_table()?,
            is_certain: self.is_certain,
        })
    }
}
