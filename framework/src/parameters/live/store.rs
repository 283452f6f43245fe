//! Values into the file of a layer, in which everything else stays as it is.

mod array;
mod layout;
mod tables;
mod text;

use std::fs::{self, File};
use std::io::Write;
use std::path::{Path as FilePath, PathBuf};

use serde::Serialize;
use toml_edit::{InlineTable, Item, Table, TableLike};

use super::refusal::{Refusal, Refusals};
use super::{Parameters, State, files};
use crate::error::Result;
use crate::parameters::tree::{self, Tree, Value};
use crate::parameters::{Origin, exact};
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
        let files = self.files.as_ref().ok_or_else(|| whole(files::without()))?;
        let file = files
            .file(layer)
            .map_err(|message| Refusal::new("", message))?;
        let before = fs::read_to_string(&file).or_else(|error| match error.kind() {
            std::io::ErrorKind::NotFound => Ok(String::new()),
            _ => Err(whole(format!("cannot read {}: {error}", file.display()))),
        })?;
        let without = files.layers.load_with(Some((&file, ""))).map_err(whole)?;
        let entries = paths.iter().map(|path| {
            let part = shape.at(path).map_err(whole)?;
            Ok(Entry {
                path,
                value: exact::part(self.values.current(), path)
                    .ok_or_else(|| Refusal::new(&path.to_string(), "it has no form"))?,
                is_replaced_whole: !is_table(&part),
                others: without.tree.get(&path.to_string()),
            })
        });
        let entries: Vec<Entry<'_>> = entries.collect::<Result<_, Refusals>>()?;
        let text = text::with(&before, &file, |root| {
            entries.iter().try_for_each(|entry| entry.write(root))
        })?;
        let after = self.check_stored(&file, &before, &text)?;
        write(&file, &text).map_err(whole)?;
        let files = self.files.as_mut().ok_or_else(|| whole(files::without()))?;
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

    /// What all layers are with that text, under which the next start succeeds, also without what it may have beside the
    /// files: later layers must not hide what the file lost.
    fn check_stored(
        &mut self,
        file: &FilePath,
        before: &str,
        text: &str,
    ) -> Result<Parameters, Refusals> {
        let files = self.files.as_ref().ok_or_else(|| whole(files::without()))?;
        let layers = &files.layers;
        let values = &mut self.values;
        let mut check = |loaded: Result<Parameters>| -> Result<Parameters> {
            let loaded = loaded?;
            let checked = values.load(&loaded).map(drop);
            values.discard();
            checked.map(|()| loaded)
        };
        let refused = |error| whole(format!("with it the next start would fail: {error}"));
        let after = check(layers.load_with(Some((file, text)))).map_err(refused)?;
        for last in [Some(file), None] {
            // Alone, a layer need not have everything.
            if check(layers.load_files(Some((file, before)), last)).is_ok() {
                check(layers.load_files(Some((file, text)), last)).map_err(refused)?;
            }
        }
        Ok(after)
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
        // Other edits of the files wait for a reload or a poll. What could not be adopted stays a change.
        let _ = self.values.adopt(&files.loaded, paths);
        self.forget_what_is_stored();
    }
}

fn whole(message: impl ToString) -> Refusals {
    Refusal::new("", message.to_string()).into()
}

/// Whether layers merge it key by key.
fn is_table(shape: &Shape) -> bool {
    let opened = shape.opened();
    opened.is_some_and(|opened| matches!(opened.content, Content::Struct(_) | Content::Map(_)))
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
    value: Tree,
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
        self.put(
            table,
            last,
            &self.value,
            self.others,
            self.is_replaced_whole,
        )
    }

    fn put(
        &self,
        table: &mut dyn TableLike,
        key: &str,
        value: &Tree,
        others: Option<&Tree>,
        is_replaced_whole: bool,
    ) -> Result<(), Refusal> {
        if matches!(value.value, Value::Absent) {
            match others {
                Some(_) => layout::set(table, key, unset()),
                None => _ = table.remove(key),
            }
            return Ok(());
        }
        let Value::Table(entries) = &value.value else {
            return self.replace(table, key, value);
        };
        if is_replaced_whole {
            return self.replace(table, key, value);
        }
        if !table.get(key).is_some_and(Item::is_table_like) {
            layout::set(table, key, InlineTable::new().into());
        }
        let known = table.get_mut(key).and_then(Item::as_table_like_mut);
        let known = known.ok_or_else(|| self.refuse("its key in the file is no table"))?;
        let old: Vec<String> = known.iter().map(|(key, _)| key.to_owned()).collect();
        for key in old.iter().filter(|key| !entries.contains_key(*key)) {
            known.remove(key);
        }
        for key in others.into_iter().flat_map(Tree::keys) {
            if !entries.contains_key(key) {
                layout::set(known, key, unset());
            }
        }
        for (key, value) in entries {
            let others = others.and_then(|others| others.get(key));
            self.put(known, key, value, others, false)?;
        }
        Ok(())
    }

    fn replace(&self, table: &mut dyn TableLike, key: &str, value: &Tree) -> Result<(), Refusal> {
        layout::replace(table, key, value).map_err(|message| self.refuse(message))
    }

    fn refuse(&self, message: impl Into<String>) -> Refusal {
        Refusal::new(&self.path.to_string(), message)
    }
}

fn unset() -> toml_edit::Value {
    InlineTable::from_iter([(tree::UNSET, true)]).into()
}

/// Where a later layer than the file has a value at the path or below it.
fn shadows(loaded: &Parameters, file: &FilePath, path: &Path) -> Vec<String> {
    // Those up to the file itself.
    let files = loaded.files();
    let end = files.iter().position(|known| known == file);
    let earlier = &files[..end.map_or(0, |end| end + 1)];
    let is_earlier = |origin: &Origin| match origin {
        Origin::File { path, .. } => earlier
            .iter()
            .any(|file| *file.display().to_string() == **path),
        _ => false,
    };
    let text = path.to_string();
    let mut leaves = Vec::new();
    if let Some(tree) = loaded.tree.get(&text) {
        tree.leaves(text, &mut leaves);
    }
    let foreign = leaves.into_iter().filter(|(_, origin)| !is_earlier(origin));
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
    let written = File::create(&beside).and_then(|mut new| {
        new.write_all(text.as_bytes())?;
        if let Ok(known) = fs::metadata(&file) {
            fs::set_permissions(&beside, known.permissions())?;
        }
        // Before it takes the place of what is safe: a battery may be pulled.
        new.sync_all()?;
        fs::rename(&beside, &file)
    });
    if written.is_ok() {
        // The file has its text by now; a folder that cannot be synchronised is no reason to say otherwise.
        let folder = file.parent().map(File::open);
        let _ = folder.map(|folder| folder.and_then(|folder| folder.sync_all()));
    }
    written.map_err(|error| {
        // Perhaps it is not even there.
        let _ = fs::remove_file(&beside);
        format!("cannot write {}: {error}", file.display())
    })
}
