//! Everything that has a path: outputs, procedures and parameters, as a tree.

mod meant;

use std::collections::BTreeSet;

use framework::OutputKind;
use framework::procedure::CallAny;
use framework::reflect::{Content, Limits, Path, Shape, VariantContent};
use protocol::{Entry, EntryKind, Range};

use crate::hub::Hub;
use crate::sources::Source;

pub(crate) use meant::{near, shortened};

/// Root of the parameters.
pub(crate) const PARAMETERS: &str = "parameters";

/// Gives the nodes the actuators back.
pub(crate) const REARM: &str = "framework.procedures.rearm";

/// Elements of a list that are listed one by one.
const LISTED: usize = 64;

/// What is listed before it is asked whether there is too much.
struct Listing {
    entries: Vec<Entry>,
    most: usize,
}

/// One name, and what is below it.
struct Place<'hub> {
    name: &'hub str,
    path: String,
    kind: EntryKind,
    /// Of a value.
    shape: Option<Shape>,
    /// Of a procedure: the names of its request's type and its response's.
    types: Option<(&'static str, &'static str)>,
    below: Vec<Place<'hub>>,
}

/// What a field says beside its type.
#[derive(Clone, Copy, Default)]
struct Told {
    docs: &'static str,
    unit: Option<&'static str>,
    range: Option<Limits>,
}

/// Everything below a path, so many levels down.
pub(crate) fn list(hub: &Hub, below: &str, depth: usize) -> Result<Vec<Entry>, String> {
    let root = tree(hub);
    let mut listing = Listing {
        entries: Vec::new(),
        most: hub.limits.entries,
    };
    let mut place = &root;
    let mut rest = below;
    // Names of places have no dots, but those of values below them may be anything.
    while !rest.is_empty() {
        let (name, further) = rest.split_once('.').unwrap_or((rest, ""));
        match place.below.iter().find(|inner| inner.name == name) {
            Some(inner) => (place, rest) = (inner, further),
            None => break,
        }
    }
    if rest.is_empty() {
        listing.below_place(place, depth);
    } else {
        let shape = place
            .shape
            .as_ref()
            .ok_or_else(|| unknown(below, rest, place))?;
        let path: Path = rest.parse().map_err(|error| format!("{error}"))?;
        let parts = shape
            .inside(&path)
            .map_err(|unknown| format!("`{below}`: {unknown}"))?;
        for part in &parts {
            listing.below_shape(below, place.kind, part, Told::default(), depth);
        }
        let mut listed = BTreeSet::new();
        listing
            .entries
            .retain(|entry| listed.insert(entry.path.clone()));
    }
    if listing.is_full() {
        let most = listing.most;
        return Err(format!(
            "more than {most} paths: ask for less depth, or below a longer path"
        ));
    }
    Ok(listing.entries)
}

/// What clients send, or a part of it: what a procedure is asked (`INSTANCE.procedures.NAME.request`) or answers, what a
/// cycle of another machine writes (`INSTANCE`).
pub(crate) fn message<'path>(hub: &Hub, path: &'path str) -> Option<(Shape, &'path str)> {
    let fits = |message: &Place<'_>| -> Option<(Shape, &'path str)> {
        let rest = path.strip_prefix(message.path.as_str())?;
        let rest = match rest {
            "" => rest,
            _ => rest.strip_prefix('.')?,
        };
        Some((message.shape.clone()?, rest))
    };
    let root = tree(hub);
    let folders = root.below.iter().flat_map(|place| &place.below);
    let procedures = folders.flat_map(|folder| &folder.below);
    let messages = procedures
        .filter(|place| place.kind == EntryKind::Procedure)
        .flat_map(|procedure| &procedure.below);
    let remotes = root.below.iter();
    let remotes = remotes.filter(|place| place.kind == EntryKind::Message);
    messages.chain(remotes).find_map(fits)
}

/// The output that a path names, with what follows behind its name.
pub(crate) fn find<'path>(sources: &[Source], path: &'path str) -> Option<(usize, &'path str)> {
    let fits = |source: &Source| -> Option<&'path str> {
        let rest = path.strip_prefix(source.path.as_str())?;
        if rest.is_empty() {
            return Some(rest);
        }
        rest.strip_prefix('.')
    };
    let found = sources.iter().enumerate();
    let found = found.filter_map(|(index, source)| Some((index, fits(source)?)));
    // Names may have dots themselves, so the longest that fits is the output.
    found.min_by_key(|(_, rest)| rest.len())
}

/// What answers at a path.
pub(crate) fn procedure<'hub>(hub: &'hub Hub, path: &str) -> Result<&'hub dyn CallAny, String> {
    let instances = hub.link.instances.iter();
    let of_instances = instances.map(|it| (it.description.name, &it.access.procedures));
    let folders = of_instances.chain([("framework", &hub.link.procedures)]);
    let mut all = folders.flat_map(|(folder, procedures)| {
        procedures
            .iter()
            .map(move |(name, caller)| (format!("{folder}.procedures.{name}"), caller))
    });
    let found = all.find(|(known, _)| known == path);
    found.map(|(_, caller)| caller.as_ref()).ok_or_else(|| {
        let near = meant::procedure(hub, path);
        let near = near.map_or_else(String::new, |near| format!("; did you mean `{near}`?"));
        format!(
            "no procedure `{path}`: expected `INSTANCE.procedures.NAME` or `framework.procedures.NAME`; `hulkgen call` lists them{near}"
        )
    })
}

fn unknown(path: &str, rest: &str, place: &Place<'_>) -> String {
    let name = rest.split('.').next().unwrap_or(rest);
    let known: Vec<_> = place.below.iter().map(|inner| inner.name).collect();
    format!(
        "no `{path}`: there is no `{name}`, only {}",
        known.join(", ")
    )
}

fn tree(hub: &Hub) -> Place<'_> {
    let mut root = Place::folder("", String::new());
    for (index, instance) in hub.link.instances.iter().enumerate() {
        let name = instance.description.name;
        let mut place = Place::folder(name, name.to_owned());
        for (part, kind) in [
            ("main_outputs", OutputKind::Main),
            ("additional_outputs", OutputKind::Additional),
        ] {
            let mut outputs = Place::folder(part, format!("{name}.{part}"));
            let sources = hub.sources.iter();
            for source in sources.filter(|it| it.instance == index && it.kind() == kind) {
                outputs.add(source.name(), source);
            }
            place.below.extend(outputs.unless_empty());
        }
        let path = format!("{name}.procedures");
        let mut procedures = Place::folder("procedures", path);
        for (procedure, caller) in &instance.access.procedures {
            procedures.add_procedure(procedure, caller.types(), caller.shapes());
        }
        place.below.extend(procedures.unless_empty());
        root.below.push(place);
    }
    for remote in &hub.link.remotes {
        let name = remote.instance();
        let mut place = Place::folder(name, name.to_owned());
        place.kind = EntryKind::Message;
        place.shape = Some(remote.shape());
        root.below.push(place);
    }
    let mut parameters = Place::folder(PARAMETERS, PARAMETERS.to_owned());
    parameters.kind = EntryKind::Parameter;
    parameters.shape = Some(hub.link.parameters.shape().clone());
    root.below.push(parameters);
    let mut framework = Place::folder("framework", "framework".to_owned());
    let mut procedures = Place::folder("procedures", "framework.procedures".to_owned());
    procedures.add_procedure("rearm", ("()", "()"), None);
    for (procedure, caller) in &hub.link.procedures {
        procedures.add_procedure(procedure, caller.types(), caller.shapes());
    }
    framework.below.push(procedures);
    root.below.push(framework);
    root
}

impl<'hub> Place<'hub> {
    fn folder(name: &'hub str, path: String) -> Self {
        Self {
            name,
            path,
            kind: EntryKind::Folder,
            shape: None,
            types: None,
            below: Vec::new(),
        }
    }

    fn unless_empty(self) -> Option<Self> {
        (!self.below.is_empty()).then_some(self)
    }

    /// An output under its name, with a folder for each part of the name before the last.
    fn add(&mut self, name: &'hub str, source: &Source) {
        let (first, rest) = match name.split_once('.') {
            Some((first, rest)) => (first, Some(rest)),
            None => (name, None),
        };
        let known = self.below.iter().position(|inner| inner.name == first);
        let position = known.unwrap_or_else(|| {
            let path = format!("{}.{first}", self.path);
            self.below.push(Self::folder(first, path));
            self.below.len() - 1
        });
        let inner = &mut self.below[position];
        match rest {
            Some(rest) => inner.add(rest, source),
            None => {
                inner.kind = match source.kind() {
                    OutputKind::Main => EntryKind::MainOutput,
                    OutputKind::Additional => EntryKind::AdditionalOutput,
                };
                inner.shape = Some(source.shape.clone());
            }
        }
    }

    fn add_procedure(
        &mut self,
        name: &'hub str,
        types: (&'static str, &'static str),
        shapes: Option<(Shape, Shape)>,
    ) {
        let mut procedure = Self::folder(name, format!("{}.{name}", self.path));
        procedure.kind = EntryKind::Procedure;
        procedure.types = Some(types);
        if let Some((request, response)) = shapes {
            let below = [("request", request), ("response", response)];
            procedure.below = below
                .map(|(name, shape)| procedure.message(name, shape))
                .into();
        }
        self.below.push(procedure);
    }

    fn message(&self, name: &'hub str, shape: Shape) -> Self {
        let mut message = Self::folder(name, format!("{}.{name}", self.path));
        message.kind = EntryKind::Message;
        message.shape = Some(shape);
        message
    }
}

impl Listing {
    fn is_full(&self) -> bool {
        self.entries.len() > self.most
    }

    fn below_place(&mut self, place: &Place<'_>, depth: usize) {
        if depth == 0 || self.is_full() {
            return;
        }
        for inner in &place.below {
            let of_shape = inner.shape.as_ref();
            self.entries.push(match of_shape {
                Some(shape) => entry(&inner.path, inner.kind, shape, Told::default()),
                None => Entry {
                    request: inner.types.map(|(request, _)| short(request)),
                    response: inner.types.map(|(_, response)| short(response)),
                    ..without_value(&inner.path, inner.kind, !inner.below.is_empty())
                },
            });
            self.below_place(inner, depth - 1);
            if let Some(shape) = of_shape {
                self.below_shape(&inner.path, inner.kind, shape, Told::default(), depth - 1);
            }
        }
        // Only where it was asked for itself: else it was listed above.
        if place.below.is_empty()
            && let Some(shape) = &place.shape
            && self.entries.is_empty()
        {
            self.below_shape(&place.path, place.kind, shape, Told::default(), depth);
        }
    }

    fn below_shape(
        &mut self,
        path: &str,
        kind: EntryKind,
        shape: &Shape,
        told: Told,
        depth: usize,
    ) {
        if depth == 0 || self.is_full() {
            return;
        }
        let mut list = |name: &str, shape: &Shape, told: Told| {
            let path = format!("{path}.{name}");
            self.entries.push(entry(&path, kind, shape, told));
            self.below_shape(&path, kind, shape, told, depth - 1);
        };
        // What is said about a field holds for what is in it.
        let inside = Told { docs: "", ..told };
        match &shape.content {
            Content::Leaf(_) | Content::Set(_) | Content::Map(_) => {}
            Content::Option(_) | Content::Recursive(_) => {
                if let Some(opened) = shape.opened() {
                    self.below_shape(path, kind, &opened, told, depth);
                }
            }
            Content::Struct(fields) => {
                for field in fields {
                    let told = Told {
                        docs: field.docs,
                        unit: field.unit.or(told.unit),
                        range: field.range.or(told.range),
                    };
                    list(field.name, &field.shape, told);
                }
            }
            Content::Tuple(items) => {
                for (index, item) in items.iter().enumerate() {
                    list(&index.to_string(), item, inside);
                }
            }
            Content::List { names, item, .. } if !names.is_empty() => {
                names.iter().for_each(|name| list(name, item, inside));
            }
            Content::List { length, item, .. } => {
                for index in 0..length.unwrap_or_default().min(LISTED) {
                    list(&index.to_string(), item, inside);
                }
            }
            Content::Enum(variants) => {
                for variant in variants {
                    let told = Told {
                        docs: variant.docs,
                        ..told
                    };
                    match &variant.content {
                        VariantContent::Unit => {}
                        VariantContent::Value(shape) => list(variant.name, shape, told),
                        VariantContent::Fields(content) => {
                            let inside = Shape {
                                content: content.clone(),
                                ..shape.clone()
                            };
                            list(variant.name, &inside, told);
                        }
                    }
                }
            }
        }
    }
}

fn without_value(path: &str, kind: EntryKind, has_children: bool) -> Entry {
    Entry {
        path: path.to_owned(),
        kind,
        type_name: None,
        documentation: None,
        unit: None,
        range: None,
        has_children,
        length: None,
        choices: Vec::new(),
        image: None,
        request: None,
        response: None,
    }
}

fn entry(path: &str, kind: EntryKind, shape: &Shape, told: Told) -> Entry {
    let docs = match told.docs {
        "" => shape.docs,
        docs => docs,
    };
    Entry {
        type_name: Some(short(shape.type_name)),
        documentation: (!docs.is_empty()).then(|| docs.to_owned()),
        unit: told.unit.map(str::to_owned),
        range: told.range.map(|range| Range {
            minimum: range.minimum,
            maximum: range.maximum,
            is_half_open: range.is_half_open,
        }),
        length: length(shape),
        choices: choices(shape),
        image: shape.image().map(|pixels| pixels.name().to_owned()),
        ..without_value(path, kind, has_children(shape))
    }
}

fn has_children(shape: &Shape) -> bool {
    match &shape.content {
        Content::Leaf(_) | Content::Set(_) => false,
        Content::Option(inner) => has_children(inner),
        Content::Recursive(_) | Content::Map(_) => true,
        Content::List { length, .. } => *length != Some(0),
        Content::Struct(fields) => !fields.is_empty(),
        Content::Tuple(items) => !items.is_empty(),
        Content::Enum(variants) => {
            let mut contents = variants.iter().map(|variant| &variant.content);
            contents.any(|content| !matches!(content, VariantContent::Unit))
        }
    }
}

fn length(shape: &Shape) -> Option<u64> {
    match &shape.content {
        Content::Option(inner) => length(inner),
        Content::List { length, .. } => length.map(|length| length as u64),
        _ => None,
    }
}

/// All values of an enum whose variants are names alone.
fn choices(shape: &Shape) -> Vec<String> {
    match &shape.content {
        Content::Option(inner) => choices(inner),
        Content::Enum(variants) if !has_children(shape) => variants
            .iter()
            .map(|variant| variant.name.to_owned())
            .collect(),
        _ => Vec::new(),
    }
}

/// A type as people write it: without the modules that it and its arguments are from.
fn short(type_name: &str) -> String {
    let mut short = String::new();
    let mut word = String::new();
    for character in type_name.chars() {
        if character.is_alphanumeric() || character == '_' || character == ':' {
            word.push(character);
        } else {
            short.push_str(word.rsplit("::").next().unwrap_or_default());
            word.clear();
            short.push(character);
        }
    }
    short.push_str(word.rsplit("::").next().unwrap_or_default());
    short
}

#[cfg(test)]
mod tests;
