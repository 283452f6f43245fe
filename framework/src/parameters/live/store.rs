//! Values into the file of a layer, in which everything else stays as it is.

use std::fs;
use std::path::{Path as FilePath, PathBuf};

use serde::Serialize;
use serde_json::Value;
use toml_edit::{DocumentMut, InlineTable, Item, Table, TableLike};

use super::refusal::{Refusal, Refusals};
use super::values::plain;
use super::{Parameters, State, files};
use crate::parameters::Origin;
use crate::parameters::tree::{self, Tree};
use crate::reflect::{Content, Path, Segment, Shape};

/// What was written.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Stored {
    pub file: PathBuf,
    /// What the file now says, as far as it was asked for: a list or an enum is always stored whole.
    pub paths: Vec<String>,
    /// Values that a later layer gives, too: they have no effect at the next start.
    pub warnings: Vec<String>,
}

impl State {
    pub(super) fn store(
        &mut self,
        shape: &Shape,
        layer: &str,
        paths: &[&str],
    ) -> Result<Stored, Refusals> {
        self.check_frozen()?;
        let paths = self.paths_to_store(shape, paths)?;
        let files = self.files.as_mut().ok_or_else(|| whole(files::without()))?;
        let file = files
            .file(layer)
            .map_err(|message| Refusal::new("", message))?;
        let before = fs::read_to_string(&file).or_else(|error| match error.kind() {
            std::io::ErrorKind::NotFound => Ok(String::new()),
            _ => Err(whole(format!("cannot read {}: {error}", file.display()))),
        })?;
        let without = files.layers.load_with(Some((&file, ""))).map_err(whole)?;
        let mut document: DocumentMut = before
            .parse()
            .map_err(|error| whole(format!("{}: {error}", file.display())))?;
        // Comments in front of nothing stay in front.
        let is_new = document.is_empty() && (before.is_empty() || before.ends_with('\n'));
        if is_new {
            document = DocumentMut::new();
        }
        for path in &paths {
            let part = shape.at(path).map_err(whole)?;
            let value = plain(self.values.current(), path).unwrap_or_default();
            let entry = Entry {
                path,
                value: &value,
                is_replaced_whole: !is_table(&part),
                others: without.tree.get(&path.to_string()),
            };
            entry.write(document.as_table_mut())?;
        }
        let text = match is_new {
            true => format!("{before}{document}"),
            false => document.to_string(),
        };
        // Nothing is written that the next start would refuse.
        let after = files
            .layers
            .load_with(Some((&file, &text)))
            .map_err(whole)?;
        self.values.discard();
        self.values.load(&after).map_err(whole)?;
        self.values.discard();
        write(&file, &text).map_err(whole)?;
        files.wrote(&file, &before, &text);
        let warnings = paths
            .iter()
            .flat_map(|path| shadows(&after, &file, path))
            .collect();
        files.loaded = after;
        self.adopt(&paths);
        Ok(Stored {
            file,
            paths: paths.iter().map(ToString::to_string).collect(),
            warnings,
        })
    }

    /// Without any: everything that was changed and not stored.
    fn paths_to_store(&self, shape: &Shape, paths: &[&str]) -> Result<Vec<Path>, Refusals> {
        let asked: Result<Vec<Path>, Refusal> = match paths {
            [] => Ok(self.changes.iter().map(|(path, _)| path.clone()).collect()),
            _ => paths.iter().map(|path| Refusal::parse(path)).collect(),
        };
        let mut storable: Vec<Path> = Vec::new();
        for path in asked? {
            let text = path.to_string();
            crate::reflect::at(self.values.current(), &path)
                .map_err(|unknown| Refusal::new(&text, unknown.to_string()))?;
            let path = replaced_whole(shape, &path);
            if path.segments().is_empty() {
                return Err(Refusal::new("", "all parameters are no value: name a part").into());
            }
            if !storable.contains(&path) {
                storable.push(path);
            }
        }
        Ok(storable)
    }

    /// What the layers now have is no longer a change, where they have the same.
    fn adopt(&mut self, paths: &[Path]) {
        let Some(files) = &self.files else {
            return;
        };
        // Other edits of the files wait for a reload or a poll.
        if self.values.adopt(&files.loaded, paths).is_ok() {
            self.forget_what_is_stored();
        }
    }
}

fn whole(message: impl ToString) -> Refusals {
    Refusal::new("", message.to_string()).into()
}

/// Whether layers merge it key by key.
fn is_table(shape: &Shape) -> bool {
    match &shape.content {
        Content::Struct(_) | Content::Map(_) => true,
        Content::Option(inner) => is_table(inner),
        Content::Recursive(expand) => is_table(&expand()),
        _ => false,
    }
}

/// Up to the first part on the way that layers replace whole.
fn replaced_whole(shape: &Shape, path: &Path) -> Path {
    let mut storable = Path::WHOLE;
    for segment in path.segments() {
        match shape.at(&storable) {
            Ok(part) if is_table(&part) => {
                let upper = storable.segments().iter().cloned();
                storable = upper.chain([segment.clone()]).collect();
            }
            _ => break,
        }
    }
    storable
}

/// A value on its way into a file.
struct Entry<'all> {
    path: &'all Path,
    value: &'all Value,
    is_replaced_whole: bool,
    /// What all other layers have at the path.
    others: Option<&'all Tree>,
}

impl Entry<'_> {
    fn write(&self, root: &mut Table) -> Result<(), Refusal> {
        let keys: Vec<String> = self
            .path
            .segments()
            .iter()
            .map(Segment::to_string)
            .collect();
        let Some((last, upper)) = keys.split_last() else {
            return Ok(());
        };
        let mut table: &mut dyn TableLike = root;
        for key in upper {
            let item = table.entry(key).or_insert_with(|| {
                let mut table = Table::new();
                table.set_implicit(true);
                Item::Table(table)
            });
            if !item.is_table_like() {
                *item = Item::Table(Table::new());
            }
            table = item
                .as_table_like_mut()
                .ok_or_else(|| self.refuse("its key in the file is no table"))?;
        }
        self.put(table, last, self.value, self.others, self.is_replaced_whole)
    }

    fn put(
        &self,
        table: &mut dyn TableLike,
        key: &str,
        value: &Value,
        others: Option<&Tree>,
        is_replaced_whole: bool,
    ) -> Result<(), Refusal> {
        if value.is_null() {
            match others {
                Some(_) => set(table, key, unset()),
                None => _ = table.remove(key),
            }
            return Ok(());
        }
        let known = table.get_mut(key).and_then(Item::as_table_like_mut);
        match (value, known) {
            (Value::Object(entries), Some(known)) if !is_replaced_whole => {
                let old: Vec<String> = known.iter().map(|(key, _)| key.to_owned()).collect();
                for key in old.iter().filter(|key| !entries.contains_key(*key)) {
                    known.remove(key);
                }
                for key in others.into_iter().flat_map(Tree::keys) {
                    if !entries.contains_key(key) {
                        set(known, key, unset());
                    }
                }
                for (key, value) in entries {
                    let others = others.and_then(|others| others.get(key));
                    self.put(known, key, value, others, false)?;
                }
            }
            _ => {
                let mut new = self.to_toml(value)?;
                if let (toml_edit::Value::InlineTable(new), Value::Object(entries)) =
                    (&mut new, value)
                    && !is_replaced_whole
                {
                    for key in others.into_iter().flat_map(Tree::keys) {
                        if !entries.contains_key(key) {
                            new.insert(key, unset());
                        }
                    }
                }
                set(table, key, new);
            }
        }
        Ok(())
    }

    fn to_toml(&self, value: &Value) -> Result<toml_edit::Value, Refusal> {
        Ok(match value {
            Value::Null => {
                return Err(self.refuse("TOML has no word for what is absent within a list"));
            }
            Value::Bool(flag) => (*flag).into(),
            Value::String(text) => text.as_str().into(),
            Value::Number(number) => match (number.as_i64(), number.as_f64()) {
                (Some(integer), _) => integer.into(),
                (None, Some(float)) if number.is_f64() => float.into(),
                _ => return Err(self.refuse(format!("{number} is too large for TOML"))),
            },
            Value::Array(items) => {
                let items = items.iter().map(|item| self.to_toml(item));
                toml_edit::Value::Array(items.collect::<Result<_, _>>()?)
            }
            Value::Object(entries) => {
                let mut table = InlineTable::new();
                for (key, value) in entries.iter().filter(|(_, value)| !value.is_null()) {
                    table.insert(key, self.to_toml(value)?);
                }
                toml_edit::Value::InlineTable(table)
            }
        })
    }

    fn refuse(&self, message: impl Into<String>) -> Refusal {
        Refusal::new(&self.path.to_string(), message)
    }
}

fn unset() -> toml_edit::Value {
    InlineTable::from_iter([(tree::UNSET, true)]).into()
}

/// In place of the value that is there, whose comments stay.
fn set(table: &mut dyn TableLike, key: &str, mut value: toml_edit::Value) {
    match table.get_mut(key) {
        Some(item) => {
            if let Some(old) = item.as_value() {
                *value.decor_mut() = old.decor().clone();
            }
            *item = Item::Value(value);
        }
        None => _ = table.insert(key, Item::Value(value)),
    }
}

/// Where a later layer than the file has a value at the path or below it.
fn shadows(loaded: &Parameters, file: &FilePath, path: &Path) -> Vec<String> {
    let own = file.display().to_string();
    let text = path.to_string();
    let mut leaves = Vec::new();
    if let Some(tree) = loaded.tree.get(&text) {
        tree.leaves(text, &mut leaves);
    }
    let foreign = leaves
        .into_iter()
        .filter(|(_, origin)| !matches!(origin, Origin::File { path, .. } if **path == *own));
    foreign
        .map(|(path, origin)| {
            format!("`{path}` has no effect at the next start: {origin} comes later")
        })
        .collect()
}

/// All or nothing: written beside the file, then moved into its place.
fn write(file: &FilePath, text: &str) -> Result<(), String> {
    // What a link leads to is replaced, not the link.
    let file = fs::canonicalize(file).unwrap_or_else(|_| file.to_owned());
    let name = file.file_name().unwrap_or_default().to_string_lossy();
    let beside = file.with_file_name(format!(".{name}.{}", std::process::id()));
    let written = fs::write(&beside, text).and_then(|()| {
        if let Ok(known) = fs::metadata(&file) {
            fs::set_permissions(&beside, known.permissions())?;
        }
        fs::rename(&beside, &file)
    });
    written.map_err(|error| {
        // Perhaps it is not even there.
        let _ = fs::remove_file(&beside);
        format!("cannot write {}: {error}", file.display())
    })
}
