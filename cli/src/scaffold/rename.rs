//! A main output gets another name, and everybody who reads it follows.

mod elsewhere;

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

use camino::{Utf8Path, Utf8PathBuf};
use grammar::{CycleField, DataPath, OutputField};
use toml_edit::{Item, TableLike};

use super::{Changes, document, manifest_change, read, read_manifest, unknown, uses};
use crate::diagnostics::{Diagnostics, position};
use crate::manifest;
use crate::outcome::Refusal;
use crate::resolve::record::instance_in_front;
use crate::resolve::robot::{Cycler, Robot};
use crate::scan::library::places;
use crate::scan::{self, NodeSource, Sources, range};
use crate::workspace::Workspace;
use elsewhere::{Sought, Unclear};

/// What is asked for.
#[derive(Clone, Debug)]
pub struct Rename<'a> {
    pub cycler: &'a str,
    pub old: &'a str,
    pub new: &'a str,
}

/// What has to change, and what a person has to look at.
#[derive(Clone, Debug)]
pub struct Renamed {
    pub changes: Changes,
    /// File and line of what has the old name and may be the output or something else.
    pub unclear: BTreeSet<(Utf8PathBuf, usize)>,
}

/// Between an instance and an output in the paths of clients.
const MAIN_OUTPUTS: &str = ".main_outputs.";

/// New texts by file and place.
type Edits = BTreeMap<Utf8PathBuf, BTreeMap<(usize, usize), String>>;

/// Renames an output of a robot that is right.
pub fn rename_output(
    workspace: &Workspace,
    robot: &Robot,
    rename: &Rename<'_>,
) -> Result<Renamed, Refusal> {
    let producer = producer(robot, rename)?;
    // Read once more: the places of names are forgotten when the next robot is scanned.
    let mut found = Diagnostics::new();
    let sources = manifest::load(workspace, &mut found)
        .and_then(|manifest| scan::scan(workspace, &manifest, &mut found))
        .map_err(|_| Refusal::bad("the robot changed while it was read"))?;
    let affected: Vec<usize> = (0..robot.cyclers.len())
        .filter(|index| writes(&robot.cyclers[*index], rename.old) == Some(producer))
        .collect();
    let mut edits = Edits::new();
    for (index, cycler) in robot.cyclers.iter().enumerate() {
        for node in &cycler.nodes {
            if let Some(source) = sources.nodes.get(&node.path) {
                let reads = |field: &str| {
                    let bound = node.cycle.iter().find(|one| one.name == field);
                    let read = bound.and_then(|bound| bound.binding.read());
                    read.is_some_and(|read| {
                        let of = read
                            .instances
                            .first()
                            .map_or(index, |instance| instance.cycler);
                        affected.contains(&of) && read.access.segments[0].name == rename.old
                    })
                };
                rename_reads(workspace, source, reads, rename, &mut edits)?;
            }
        }
    }
    let (structure, mut unclear) = rename_field(workspace, &sources, producer, rename, &mut edits)?;
    let instances = affected.iter().flat_map(|index| {
        let instances = robot.cyclers[*index].instances.iter();
        instances.map(|instance| instance.name.as_str())
    });
    let own = own_files(workspace, &sources.nodes[producer])?;
    let sought = Sought {
        workspace,
        robot,
        rename,
        producer,
        structure,
        instances: instances.collect(),
        own: own.into_iter().map(|(file, _)| file).collect(),
    };
    unclear.extend(sought.find(&mut edits));
    let mut changes = apply(workspace, edits)?;
    changes.extend(renamed_in_manifest(workspace, robot, &affected, rename)?);
    Ok(Renamed { changes, unclear })
}

/// Path of the node that writes the output.
fn producer<'r>(robot: &'r Robot, rename: &Rename<'_>) -> Result<&'r str, Refusal> {
    let Rename { cycler, old, new } = rename;
    let found = robot.cyclers.iter().find(|one| one.name == *cycler);
    let found = found.ok_or_else(|| {
        let names = || robot.cyclers.iter().map(|one| one.name.as_str());
        unknown(
            &format!("the robot has no cycler `{cycler}`"),
            cycler,
            names,
            "the cyclers are",
        )
    })?;
    let names = || found.outputs.iter().map(|output| output.name.as_str());
    let producer = writes(found, old).ok_or_else(|| {
        let message = format!("no node of cycler `{cycler}` writes `{old}`");
        unknown(&message, old, names, "its outputs are")
    })?;
    if !is_name_of_output(new) {
        let message = format!("`{new}` cannot be the name of an output");
        return Err(Refusal::wrong_usage(message)
            .help("write it in snake_case, and let it be no keyword of Rust"));
    }
    if names().any(|name| name == *new) {
        let message = format!("cycler `{cycler}` has an output `{new}` already");
        return Err(Refusal::wrong_usage(message).help("choose another name"));
    }
    Ok(producer)
}

/// Outputs are fields and no files: they have all the letters of Rust that paths have.
fn is_name_of_output(name: &str) -> bool {
    let is_bare = name.chars().all(|one| one.is_alphanumeric() || one == '_');
    let is_name = schema::is_identifier(name) || !name.is_ascii();
    let is_name = is_name && is_bare && syn::parse_str::<syn::Ident>(name).is_ok();
    is_name && name == name.to_lowercase()
}

fn writes<'c>(cycler: &'c Cycler, output: &str) -> Option<&'c str> {
    let output = cycler.outputs.iter().find(|one| one.name == output)?;
    Some(&cycler.nodes[output.producer].path)
}

/// The first name of every path that reads the output.
fn rename_reads(
    workspace: &Workspace,
    source: &NodeSource,
    reads: impl Fn(&str) -> bool,
    rename: &Rename<'_>,
    edits: &mut Edits,
) -> Result<(), Refusal> {
    let fields = source.cycle.fields.iter();
    for field in fields.filter(|field| reads(&field.name.to_string())) {
        let Some(path) = path_of(&field.kind) else {
            continue;
        };
        let literal = range(path.span);
        let text = read(workspace, source.file())?;
        let written = text.get(literal.clone()).unwrap_or_default();
        let start = written.find('"').map_or(0, |quote| quote + 1);
        if !written[start..].starts_with(rename.old) {
            return Err(Refusal::bad(format!(
                "cannot rename the path {written} in `{}`: it is written in an unusual way",
                source.file()
            ))
            .help("write it as a plain string"));
        }
        let start = literal.start + start;
        let place = (start, start + rename.old.len());
        edits
            .entry(source.file().to_owned())
            .or_default()
            .insert(place, rename.new.to_owned());
    }
    Ok(())
}

fn path_of(field: &CycleField) -> Option<&DataPath> {
    match field {
        CycleField::Input(input) | CycleField::RequiredInput(input) => Some(&input.path),
        CycleField::LatestInput(input) | CycleField::PerceptionInput(input) => Some(&input.path),
        CycleField::PreviousInput(input) | CycleField::HistoricInput(input) => Some(&input.path),
        _ => None,
    }
}

/// The field and its uses in the node's own files; answers with the struct that has it, and with what may be a use.
fn rename_field(
    workspace: &Workspace,
    sources: &Sources<'_>,
    producer: &str,
    rename: &Rename<'_>,
    edits: &mut Edits,
) -> Result<(&'static str, Unclear), Refusal> {
    let source = sources.nodes.get(producer);
    let source =
        source.ok_or_else(|| Refusal::bad(format!("the file of `{producer}` cannot be read")))?;
    let returned =
        source.outputs.fields.iter().find(|field| {
            matches!(field.kind, OutputField::MainOutput(_)) && field.name == rename.old
        });
    let in_place = source
        .cycle
        .fields
        .iter()
        .find(|field| field.name == rename.old);
    let of_outputs: Vec<String> = source
        .outputs
        .fields
        .iter()
        .map(|field| field.name.to_string())
        .collect();
    let of_cycle: Vec<String> = source
        .cycle
        .fields
        .iter()
        .map(|field| field.name.to_string())
        .collect();
    let (structure, name, siblings) = match (returned, in_place) {
        (Some(field), _) => ("MainOutputs", &field.name, of_outputs),
        (None, Some(field)) => ("CycleContext", &field.name, of_cycle),
        (None, None) => {
            return Err(Refusal::bad(format!(
                "`{producer}` has no field `{}`",
                rename.old
            )));
        }
    };
    if siblings.iter().any(|name| name == rename.new) {
        let message = format!(
            "`{structure}` of `{producer}` has a field `{}` already",
            rename.new
        );
        return Err(Refusal::wrong_usage(message).help("choose another name"));
    }
    let mut insert = |file: &Utf8Path, range: Range<usize>, text: String| {
        edits
            .entry(file.to_owned())
            .or_default()
            .insert((range.start, range.end), text);
    };
    insert(source.file(), range(name.span()), rename.new.to_owned());
    let mut unclear = Unclear::new();
    for (file, syntax) in own_files(workspace, source)? {
        let found = uses::find(&syntax, structure, rename.old);
        for one in found.names {
            insert(&file, one, rename.new.to_owned());
        }
        for one in found.shorthands {
            insert(&file, one..one, format!("{}: ", rename.new));
        }
        let text = read(workspace, &file)?;
        unclear.extend(
            found
                .unclear
                .into_iter()
                .map(|one| (file.clone(), position(&text, one).line)),
        );
    }
    Ok((structure, unclear))
}

/// The node's file and those of modules that it declares, such as its tests.
fn own_files(
    workspace: &Workspace,
    source: &NodeSource,
) -> Result<Vec<(Utf8PathBuf, syn::File)>, Refusal> {
    let mut files = vec![source.file().to_owned()];
    for item in &source.module.syntax.items {
        if let syn::Item::Mod(item) = item
            && item.content.is_none()
        {
            let folder = source.file().parent().unwrap_or(Utf8Path::new(""));
            let places = places(folder, &source.module.folder, item);
            files.extend(places.into_iter().find(|file| workspace.is_file(file)));
        }
    }
    let parsed = files.into_iter().map(|file| {
        let text = read(workspace, &file)?;
        let syntax = scan::parse(&text)
            .map_err(|error| Refusal::bad(format!("`{file}` cannot be parsed: {error}")))?;
        Ok((file, syntax))
    });
    parsed.collect()
}

fn apply(workspace: &Workspace, edits: Edits) -> Result<Changes, Refusal> {
    let mut changes = Changes::new();
    for (file, edits) in edits {
        let mut text = read(workspace, &file)?.to_string();
        for ((start, end), new) in edits.into_iter().rev() {
            text.replace_range(start..end, &new);
        }
        changes.insert(file, Some(text));
    }
    Ok(changes)
}

/// `record = { while = "…" }` of every cycler and instance that names the output, and every `[[bridge]]`.
fn renamed_in_manifest(
    workspace: &Workspace,
    robot: &Robot,
    affected: &[usize],
    rename: &Rename<'_>,
) -> Result<Option<(Utf8PathBuf, Option<String>)>, Refusal> {
    let mut manifest = read_manifest(workspace)?;
    let mut changed = false;
    let is_of = |instance: &str| {
        affected.iter().any(|cycler| {
            let mut instances = robot.cyclers[*cycler].instances.iter();
            instances.any(|one| one.name == instance)
        })
    };
    for bridge in document::tables(manifest.as_table_mut(), "bridge") {
        changed |= rename_bridge(bridge, rename, is_of);
    }
    for (index, cycler) in robot.cyclers.iter().enumerate() {
        let Some(table) = document::cycler(&mut manifest, &cycler.name) else {
            continue;
        };
        // An instance in front says whose output it is, else it is the own one.
        let is_meant = |instance: Option<&str>| match instance {
            None => affected.contains(&index),
            Some(instance) => is_of(instance),
        };
        changed |= rename_condition(table, rename, is_meant);
        for instance in document::tables(table, "instances") {
            changed |= rename_condition(instance, rename, is_meant);
        }
    }
    match changed {
        true => manifest_change(workspace, &manifest).map(Some),
        false => Ok(None),
    }
}

fn rename_bridge(
    bridge: &mut dyn TableLike,
    rename: &Rename<'_>,
    is_of: impl Fn(&str) -> bool,
) -> bool {
    let Some(value) = bridge.get_mut("path").and_then(Item::as_value_mut) else {
        return false;
    };
    let written = value.as_str().unwrap_or_default();
    let renamed = written
        .split_once(MAIN_OUTPUTS)
        .filter(|(instance, _)| is_of(instance))
        .and_then(|(instance, path)| {
            let rest = behind_name(path, rename.old)?;
            Some(format!("{instance}{MAIN_OUTPUTS}{}{rest}", rename.new))
        });
    if let Some(renamed) = &renamed {
        document::replace(value, renamed);
    }
    renamed.is_some()
}

/// What follows in a path behind the output's name, if that is its first one.
fn behind_name<'p>(path: &'p str, name: &str) -> Option<&'p str> {
    let rest = path.strip_prefix(name)?;
    (rest.is_empty() || rest.starts_with('.')).then_some(rest)
}

fn rename_condition(
    table: &mut dyn TableLike,
    rename: &Rename<'_>,
    is_meant: impl Fn(Option<&str>) -> bool,
) -> bool {
    let record = table.get_mut("record").and_then(Item::as_table_like_mut);
    let condition = record.and_then(|record| record.get_mut("while"));
    let Some(value) = condition.and_then(Item::as_value_mut) else {
        return false;
    };
    let written = value.as_str().unwrap_or_default().to_owned();
    let (instance, path) = instance_in_front(&written);
    let rest = behind_name(path, rename.old);
    let Some(rest) = rest.filter(|_| is_meant(instance)) else {
        return false;
    };
    let before = written.strip_suffix(path).unwrap_or_default();
    document::replace(value, &format!("{before}{}{rest}", rename.new));
    true
}

#[cfg(test)]
mod tests {
    use super::is_name_of_output;

    #[test]
    fn an_output_is_called_whatever_a_path_can_name() {
        for name in ["speed", "größe", "_x1", "скорость"] {
            assert!(is_name_of_output(name), "{name}");
        }
        for name in [
            "Größe",
            "gen",
            "type",
            "a-b",
            "2d",
            "r#type",
            "",
            "_",
            "größe²",
            "gro\u{308}ße",
        ] {
            assert!(!is_name_of_output(name), "{name}");
        }
    }
}
