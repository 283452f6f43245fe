//! Which files give a parameter a value, and which of them wins for which robot.

use std::sync::Arc;

use camino::{Utf8Path, Utf8PathBuf};
use serde::Serialize;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::keys::{self, Key};
use super::unset::is_unset;
use super::{choice, layer};
use crate::diagnostics::{Diagnostics, position};
use crate::manifest::Manifest;
use crate::resolve::robot::Hints;
use crate::scan::types::{Definition, Resolved, Shape};
use crate::scan::{Sources, doc};
use crate::workspace::Workspace;

/// A value that is merged as one: a parameter, or a field of it.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Value {
    pub path: String,
    /// None where its type cannot be seen.
    #[serde(rename = "type")]
    pub data: Option<String>,
    /// What the struct says about the field.
    pub docs: Option<String>,
    /// Of its numbers, as the field's `#[reflect(unit = …)]` says.
    pub unit: Option<String>,
    /// Where they must lie, as `#[reflect(range = …)]` says.
    pub range: Option<String>,
    /// Later ones win.
    pub given: Vec<Given>,
}

/// What one file says.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Given {
    pub file: Utf8PathBuf,
    pub line: usize,
    /// As it is written there.
    pub value: String,
    /// The comment behind it.
    pub comment: Option<String>,
    #[serde(flatten)]
    pub robots: Robots,
}

/// For which robots a file is read; what is None does not matter.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Robots {
    pub location: Option<String>,
    pub identity: Option<Identity>,
}

/// What the hardware reports.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
pub struct Identity {
    pub name: String,
    pub id: String,
}

/// A declared parameter, or a field of one.
#[derive(Clone, Copy, Debug)]
pub struct Asked<'a> {
    /// The declared path.
    pub declared: &'a str,
    /// The declared type.
    pub data: &'a str,
    /// A node that reads it.
    pub node: &'a str,
    /// What else is known of it.
    pub hints: Option<&'a Hints>,
    /// The way to the field; empty for the parameter itself.
    pub below: &'a [&'a str],
}

/// A parameter or a field of one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Answer {
    /// The way to the field as code writes it; empty for the parameter itself.
    pub fields: Vec<String>,
    /// As files write them.
    pub values: Vec<Value>,
}

/// Every value of a parameter with the files that give it. `None`: the parameter has no such field.
pub fn given(
    workspace: &Workspace,
    manifest: &Manifest,
    sources: &Sources<'_>,
    asked: Asked<'_>,
) -> Option<Answer> {
    let texts = layers(workspace, manifest);
    let tables: Vec<Layer<'_>> = texts.iter().filter_map(Layer::parse).collect();
    let node = sources.nodes.get(asked.node);
    let data = node.map(|node| (sources.library).resolve_absolute(&node.module, asked.data));
    let mut place = Place {
        path: asked.declared.to_owned(),
        data,
        docs: None,
        unit: asked.hints.and_then(|hints| hints.unit.clone()),
        range: asked.hints.and_then(|hints| hints.range.clone()),
        found: tables
            .iter()
            .filter_map(|it| it.at(asked.declared))
            .collect(),
    };
    let mut fields = Vec::new();
    for name in asked.below {
        let key = place.key(sources, name);
        fields.push(key.map_or_else(|| (*name).to_owned(), |key| key.field.name));
        place = place.below(sources, name)?;
    }
    let mut values = Vec::new();
    place.collect(sources, &mut values);
    Some(Answer { fields, values })
}

/// The files in the order in which they are merged.
fn layers(workspace: &Workspace, manifest: &Manifest) -> Vec<(Utf8PathBuf, Robots, Arc<str>)> {
    let folder = &manifest.robot.parameters;
    // What is wrong with them was said before.
    let mut said = Diagnostics::new();
    let choice = choice::load(workspace, folder, &mut said);
    let files = layer::find(workspace, manifest, choice.as_ref(), &mut said);
    let mut layers: Vec<_> = files
        .into_iter()
        .filter_map(|(file, text)| Some((Robots::of(file.strip_prefix(folder).ok()?)?, file, text)))
        .map(|(robots, file, text)| (file, robots, text))
        .collect();
    let place = |identity: &Identity| {
        let mut names = manifest.robot.identities.iter();
        names.position(|name| name.as_str() == identity.name)
    };
    layers.sort_by_key(|(file, robots, _)| {
        let identity = robots.identity.as_ref();
        let is_located = robots.location.is_some();
        (
            identity.is_some(),
            is_located,
            identity.and_then(place),
            file.clone(),
        )
    });
    layers
}

impl Robots {
    /// `default.toml`, `head.P1.toml`, `field/default.toml`, `field/head.P1.toml`.
    pub(super) fn of(file: &Utf8Path) -> Option<Self> {
        let location = file.parent().map(Utf8Path::as_str);
        let stem = file.file_name()?.strip_suffix(".toml")?;
        let identity = stem.split_once('.').map(|(name, id)| Identity {
            name: name.to_owned(),
            id: id.to_owned(),
        });
        Some(Self {
            location: location.filter(|it| !it.is_empty()).map(str::to_owned),
            identity,
        })
    }

    /// Whether some robot is of both kinds.
    pub(super) fn overlap(&self, other: &Self) -> bool {
        let may_be_both = |(one, other): (&String, &String)| one == other;
        let locations = self.location.as_ref().zip(other.location.as_ref());
        let identities = self.identity.as_ref().zip(other.identity.as_ref());
        locations.is_none_or(may_be_both)
            && identities.is_none_or(|(one, other)| one.name != other.name || one.id == other.id)
    }
}

struct Layer<'a> {
    file: &'a Utf8Path,
    robots: &'a Robots,
    text: &'a str,
    table: Spanned<DeTable<'a>>,
}

/// A value of a layer.
#[derive(Clone)]
struct Found<'a> {
    layer: &'a Layer<'a>,
    value: &'a Spanned<DeValue<'a>>,
}

impl<'a> Layer<'a> {
    fn parse((file, robots, text): &'a (Utf8PathBuf, Robots, Arc<str>)) -> Option<Self> {
        Some(Self {
            file,
            robots,
            text,
            table: DeTable::parse(text).ok()?,
        })
    }

    fn at(&'a self, path: &str) -> Option<Found<'a>> {
        let mut names = path.split('.');
        let mut value = self.table.get_ref().get(names.next()?)?;
        for name in names {
            value = value.get_ref().as_table()?.get(name)?;
        }
        Some(Found { layer: self, value })
    }
}

impl Found<'_> {
    fn describe(&self) -> Given {
        let text = self.layer.text;
        let span = self.value.span();
        let line = text.get(span.end..).and_then(|rest| rest.lines().next());
        let comment = line.and_then(comment_in);
        Given {
            file: self.layer.file.to_owned(),
            line: position(text, span.start).line,
            value: on_one_line(text.get(span).unwrap_or_default()),
            comment: comment.map(|comment| comment.trim().to_owned()),
            robots: self.layer.robots.clone(),
        }
    }
}

/// A path with what is known about it, and what the layers have there.
struct Place<'a> {
    path: String,
    data: Option<Resolved>,
    docs: Option<String>,
    unit: Option<String>,
    range: Option<String>,
    found: Vec<Found<'a>>,
}

impl<'a> Place<'a> {
    fn collect(self, sources: &Sources<'_>, values: &mut Vec<Value>) {
        let names = self.names(sources);
        if !names.is_empty() {
            for name in names {
                if let Some(below) = self.below(sources, &name) {
                    below.collect(sources, values);
                }
            }
            return;
        }
        values.push(Value {
            path: self.path,
            data: self.data.map(|data| data.text),
            docs: self.docs,
            unit: self.unit,
            range: self.range,
            given: self.found.iter().map(Found::describe).collect(),
        });
    }

    /// Fields that are merged one by one: those of the struct, else what the tables have.
    fn names(&self, sources: &Sources<'_>) -> Vec<String> {
        let given = self.found.iter().map(|found| found.value.get_ref());
        let given = given.filter(|value| !is_unset(value));
        let tables: Vec<_> = given.filter_map(DeValue::as_table).collect();
        if tables.is_empty() || self.is_replaced_whole(sources) {
            return Vec::new();
        }
        let known = self.keys(sources);
        let mut names: Vec<String> = known.iter().map(|key| key.name.clone()).collect();
        for key in tables.iter().flat_map(|table| table.keys()) {
            let name = key.get_ref();
            let is_known = known.iter().any(|key| key.names().any(|one| one == name));
            if !is_known && !names.iter().any(|one| one == name) {
                names.push(name.to_string());
            }
        }
        names
    }

    /// Values of enums are, although variants with fields are tables.
    fn is_replaced_whole(&self, sources: &Sources<'_>) -> bool {
        self.inner().is_some_and(|data| {
            let is_own = matches!(
                &data.shape,
                Shape::Named {
                    definition: Definition::Workspace(_),
                    ..
                }
            );
            is_own && sources.library.fields(data).is_none()
        })
    }

    /// None: the type has no such field and no file names it.
    fn below(&self, sources: &Sources<'_>, name: &str) -> Option<Self> {
        let key = self.key(sources, name);
        let names: Vec<&str> = match &key {
            Some(key) => key.names().collect(),
            None => vec![name],
        };
        let found: Vec<Found<'a>> = (self.found.iter())
            .filter_map(|found| {
                // What takes everything away takes this away.
                if is_unset(found.value.get_ref()) {
                    return Some(found.clone());
                }
                let table = found.value.get_ref().as_table()?;
                let value = names.iter().find_map(|name| table.get(*name))?;
                Some(Found {
                    layer: found.layer,
                    value,
                })
            })
            .collect();
        if key.is_none() && found.is_empty() {
            return None;
        }
        let written = names.first().copied().unwrap_or(name);
        let hints = key
            .as_ref()
            .map(|key| grammar::Hints::read(&key.field.attributes));
        let hints = hints.and_then(Result::ok).unwrap_or_default();
        Some(Self {
            path: format!("{}.{written}", self.path),
            docs: key.as_ref().and_then(|key| docs(&key.field.attributes)),
            unit: hints.unit.map(|unit| unit.value()),
            range: hints.range.map(|range| range.to_string()),
            data: key.filter(|key| !key.by_function).map(|key| key.field.data),
            found,
        })
    }

    /// What files may give below; nothing where that cannot be seen.
    fn keys(&self, sources: &Sources<'_>) -> Vec<Key> {
        let structure = (self.inner()).and_then(|data| sources.library.fields(data));
        structure.and_then(keys::keys).unwrap_or_default()
    }

    /// The field that files or code call so.
    fn key(&self, sources: &Sources<'_>, name: &str) -> Option<Key> {
        let keys = self.keys(sources);
        let by_files = keys.iter().find(|key| key.names().any(|one| one == name));
        let found = by_files.or_else(|| keys.iter().find(|key| key.field.name == name));
        found.cloned()
    }

    fn inner(&self) -> Option<&Resolved> {
        let data = self.data.as_ref()?;
        Some(data.option_argument().unwrap_or(data))
    }
}

/// The text of `///`.
fn docs(attributes: &[syn::Attribute]) -> Option<String> {
    let lines = attributes.iter().filter_map(doc);
    let lines: Vec<String> = lines.map(|line| line.trim().to_owned()).collect();
    (!lines.is_empty()).then(|| lines.join(" "))
}

/// The comment at the end of a line of TOML: a `#` in quotes begins none.
fn comment_in(line: &str) -> Option<&str> {
    let mut quote = None;
    let mut letters = line.char_indices();
    while let Some((at, letter)) = letters.next() {
        match (quote, letter) {
            (None, '#') => return Some(&line[at + 1..]),
            (None, '"' | '\'') => quote = Some(letter),
            (Some('"'), '\\') => drop(letters.next()),
            (Some(open), letter) if open == letter => quote = None,
            _ => {}
        }
    }
    None
}

fn on_one_line(value: &str) -> String {
    let lines = value.lines().map(str::trim);
    lines.collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests;
