//! TOML with the place of every value, and how two layers merge.

use std::collections::BTreeMap;
use std::sync::Arc;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::error::{Origin, ParameterError};

/// The key of the table that takes a value away.
pub(super) const UNSET: &str = "unset";

/// A value and where it was written.
#[derive(Clone, Debug)]
pub(super) struct Tree {
    pub(super) origin: Origin,
    /// The last layer that has anything here.
    pub(super) layer: Layer,
    pub(super) value: Value,
}

/// Where in the merge order something stands.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Layer {
    pub(super) number: usize,
    /// Among what is given one by one and is one layer, as all variables of the environment are.
    step: usize,
}

#[derive(Clone, Debug)]
pub(super) enum Value {
    Table(BTreeMap<String, Tree>),
    Array(Vec<Tree>),
    String(String),
    Integer(i128),
    Float(f64),
    Boolean(bool),
    /// As TOML writes it.
    Datetime(String),
    /// An `Option` that has no value: no file says so.
    Absent,
}

/// What was taken away, by path, and where.
pub(super) type Removed = Vec<(String, Origin)>;

/// The tree of one file.
pub(super) fn parse(path: &str, text: &str) -> Result<Tree, ParameterError> {
    let lines = Lines::new(path, text);
    let table = DeTable::parse(text).map_err(|error| {
        let start = error.span().map_or(0, |span| span.start);
        ParameterError::new(lines.origin(start), "", error.message())
    })?;
    let entries = lines.table(table.get_ref())?;
    Ok(Tree {
        origin: lines.origin(0),
        layer: Layer::default(),
        value: Value::Table(entries),
    })
}

/// A value as on the right of `key = …`, or else the text itself: for the environment and the command line.
pub(super) fn parse_setting(text: &str, origin: &Origin) -> Tree {
    Tree::from_value(&setting(text), origin)
}

/// The value itself: what is none is a text.
pub(super) fn setting(text: &str) -> toml::Value {
    let value = toml::from_str::<toml::Table>(&format!("value = {text}"));
    let value = value
        .ok()
        .filter(|table| table.len() == 1)
        .and_then(|mut table| table.remove("value"));
    value.unwrap_or_else(|| toml::Value::String(text.to_owned()))
}

impl Tree {
    /// Every part of the value comes from the same place.
    pub(super) fn from_value(value: &toml::Value, origin: &Origin) -> Self {
        let below = |value| Self::from_value(value, origin);
        let value = match value {
            toml::Value::Table(table) => Value::Table(
                table
                    .iter()
                    .map(|(key, value)| (key.clone(), below(value)))
                    .collect(),
            ),
            toml::Value::Array(array) => Value::Array(array.iter().map(below).collect()),
            toml::Value::String(text) => Value::String(text.clone()),
            toml::Value::Integer(integer) => Value::Integer((*integer).into()),
            toml::Value::Float(float) => Value::Float(*float),
            toml::Value::Boolean(boolean) => Value::Boolean(*boolean),
            toml::Value::Datetime(datetime) => Value::Datetime(datetime.to_string()),
        };
        Self {
            origin: origin.clone(),
            layer: Layer::default(),
            value,
        }
    }

    /// The value without its places.
    pub(super) fn to_value(&self) -> toml::Value {
        match &self.value {
            Value::Table(entries) => toml::Value::Table(
                entries
                    .iter()
                    .map(|(key, tree)| (key.clone(), tree.to_value()))
                    .collect(),
            ),
            Value::Array(items) => toml::Value::Array(items.iter().map(Self::to_value).collect()),
            Value::String(text) | Value::Datetime(text) => toml::Value::String(text.clone()),
            Value::Integer(integer) => match i64::try_from(*integer) {
                Ok(integer) => toml::Value::Integer(integer),
                // Only values that no file gave are so large.
                Err(_) => toml::Value::String(integer.to_string()),
            },
            Value::Float(float) => toml::Value::Float(*float),
            Value::Boolean(boolean) => toml::Value::Boolean(*boolean),
            Value::Absent => toml::Value::String(String::new()),
        }
    }

    /// A table without entries.
    pub(super) fn empty(origin: Origin) -> Self {
        Self {
            origin,
            layer: Layer::default(),
            value: Value::Table(BTreeMap::new()),
        }
    }

    /// Puts a later layer over this one; adds to what was taken away.
    pub(super) fn overlay(&mut self, mut later: Self, removed: &mut Removed) {
        let number = self.layer.number + 1;
        later.mark(Layer { number, step: 0 });
        self.merge(later, "", removed);
    }

    /// Adds to the last layer.
    pub(super) fn overlay_more(&mut self, mut later: Self, removed: &mut Removed) {
        let step = self.layer.step + 1;
        later.mark(Layer { step, ..self.layer });
        self.merge(later, "", removed);
    }

    fn merge(&mut self, later: Self, path: &str, removed: &mut Removed) {
        self.layer = later.layer;
        match (&mut self.value, later) {
            (
                Value::Table(entries),
                Self {
                    value: Value::Table(later),
                    ..
                },
            ) => {
                for (key, mut tree) in later {
                    let path = below(path, &key);
                    if tree.is_unset() {
                        entries.remove(&key);
                        removed.push((path, tree.origin));
                        continue;
                    }
                    match entries.get_mut(&key) {
                        Some(entry) => entry.merge(tree, &path, removed),
                        None => {
                            tree.drop_unset(&path, removed);
                            entries.insert(key, tree);
                        }
                    }
                }
            }
            (_, mut later) => {
                later.drop_unset(path, removed);
                *self = later;
            }
        }
    }

    /// `{ unset = true }`: no value, also if earlier layers have one.
    fn is_unset(&self) -> bool {
        let Value::Table(entries) = &self.value else {
            return false;
        };
        let unset = entries.get(UNSET).map(|tree| &tree.value);
        entries.len() == 1 && matches!(unset, Some(Value::Boolean(true)))
    }

    /// What would take away values of earlier layers, where there are none.
    fn drop_unset(&mut self, path: &str, removed: &mut Removed) {
        if let Value::Table(entries) = &mut self.value {
            entries.retain(|key, tree| {
                let path = below(path, key);
                let is_unset = tree.is_unset();
                match is_unset {
                    true => removed.push((path, tree.origin.clone())),
                    false => tree.drop_unset(&path, removed),
                }
                !is_unset
            });
        }
    }

    fn mark(&mut self, layer: Layer) {
        self.layer = layer;
        match &mut self.value {
            Value::Table(entries) => entries.values_mut().for_each(|tree| tree.mark(layer)),
            Value::Array(items) => items.iter_mut().for_each(|tree| tree.mark(layer)),
            _ => {}
        }
    }

    /// This value at a path of keys, all from the same place.
    pub(super) fn below(self, path: &str, separator: &str) -> Self {
        path.rsplit(separator).fold(self, |tree, key| Self {
            origin: tree.origin.clone(),
            layer: Layer::default(),
            value: Value::Table(BTreeMap::from([(key.to_owned(), tree)])),
        })
    }

    /// What stands at a path of keys.
    pub(super) fn get(&self, path: &str) -> Option<&Self> {
        path.split('.')
            .filter(|key| !key.is_empty())
            .try_fold(self, |tree, key| match &tree.value {
                Value::Table(entries) => entries.get(key),
                Value::Array(items) => items.get(key.parse::<usize>().ok()?),
                _ => None,
            })
    }

    /// The keys of a table.
    pub(super) fn keys(&self) -> impl Iterator<Item = &str> {
        let entries = match &self.value {
            Value::Table(entries) => Some(entries),
            _ => None,
        };
        entries.into_iter().flatten().map(|(key, _)| key.as_str())
    }

    /// Every value that is replaced whole, with its path; `path` is that of this one.
    pub(super) fn leaves(&self, path: String, leaves: &mut Vec<(String, Origin)>) {
        match &self.value {
            Value::Table(entries) => {
                for (key, below) in entries {
                    below.leaves(format!("{path}.{key}"), leaves);
                }
            }
            _ => leaves.push((path, self.origin.clone())),
        }
    }

    /// What kind of value it is, for messages.
    pub(super) fn kind(&self) -> &'static str {
        match self.value {
            Value::Table(_) => "a table",
            Value::Array(_) => "an array",
            Value::String(_) => "a string",
            Value::Integer(_) => "an integer",
            Value::Float(_) => "a float",
            Value::Boolean(_) => "a boolean",
            Value::Datetime(_) => "a date or time",
            Value::Absent => "nothing",
        }
    }
}

fn below(path: &str, key: &str) -> String {
    match path {
        "" => key.to_owned(),
        _ => format!("{path}.{key}"),
    }
}

/// Finds the line of a place in one file.
struct Lines {
    path: Arc<str>,
    /// Where lines end, in order: the text has thousands of values, each of which asks for its line.
    ends: Vec<usize>,
}

impl Lines {
    fn new(path: &str, text: &str) -> Self {
        Self {
            path: path.into(),
            ends: text.match_indices('\n').map(|(end, _)| end).collect(),
        }
    }

    fn origin(&self, start: usize) -> Origin {
        let line = 1 + self.ends.partition_point(|end| *end < start);
        Origin::File {
            path: self.path.clone(),
            line,
        }
    }

    fn table(&self, table: &DeTable<'_>) -> Result<BTreeMap<String, Tree>, ParameterError> {
        let entries = table.iter().map(|(key, value)| {
            // The key's line, not the value's: where one looks first.
            let origin = self.origin(key.span().start);
            Ok((key.get_ref().to_string(), self.tree(value, origin)?))
        });
        entries.collect()
    }

    fn tree(&self, value: &Spanned<DeValue<'_>>, origin: Origin) -> Result<Tree, ParameterError> {
        let value = match value.get_ref() {
            DeValue::Table(table) => Value::Table(self.table(table)?),
            DeValue::Array(array) => {
                let items = array
                    .iter()
                    .map(|item| self.tree(item, self.origin(item.span().start)));
                Value::Array(items.collect::<Result<_, _>>()?)
            }
            DeValue::String(text) => Value::String(text.to_string()),
            DeValue::Integer(integer) => {
                let parsed = i64::from_str_radix(integer.as_str(), integer.radix());
                let parsed: i64 = parsed.map_err(|error| {
                    ParameterError::new(
                        origin.clone(),
                        "",
                        format!("{}: {error}", integer.as_str()),
                    )
                })?;
                Value::Integer(parsed.into())
            }
            DeValue::Float(float) => {
                let text = float.as_str();
                let wrong =
                    |why: String| ParameterError::new(origin.clone(), "", format!("{text}{why}"));
                let parsed: f64 = text.parse().map_err(|error| wrong(format!(": {error}")))?;
                if parsed.is_infinite() && !text.ends_with("inf") {
                    return Err(wrong(" is outside of what f64 holds".to_owned()));
                }
                Value::Float(parsed)
            }
            DeValue::Boolean(boolean) => Value::Boolean(*boolean),
            DeValue::Datetime(datetime) => Value::Datetime(datetime.to_string()),
        };
        Ok(Tree {
            origin,
            layer: Layer::default(),
            value,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_end_of_a_line_belongs_to_it() {
        let text = "\na = 1\n\nb = 2\r\nc = 3";
        let lines = Lines::new("default.toml", text);
        for start in 0..=text.len() {
            let before = text.bytes().take(start);
            let line = 1 + before.filter(|byte| *byte == b'\n').count();
            let place = format!("default.toml:{line}");
            assert_eq!(lines.origin(start).to_string(), place, "{start}");
        }
    }
}
