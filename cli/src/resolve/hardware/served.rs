//! Whether every target's hardware serves what the nodes ask, where that can be known.

use std::collections::{BTreeMap, BTreeSet};

use camino::Utf8Path;
use syn::spanned::Spanned as _;

use super::running_here;
use crate::diagnostics::{Code, Diagnostic, Diagnostics};
use crate::manifest::{Manifest, Target};
use crate::scan::lookup::ItemId;
use crate::scan::served::{Arguments, Hardware, Serves};
use crate::scan::{Library, NodeSource, Sources, range};
use crate::workspace::MANIFEST;

/// A bound of a node.
struct Asked<'a> {
    node: &'a NodeSource,
    bound: &'a syn::Path,
}

/// A trait, and every bound that names it; each node once.
struct Union<'a> {
    definition: ItemId,
    /// Each that some bound gives it.
    arguments: BTreeSet<Arguments>,
    asked: Vec<Asked<'a>>,
}

/// Adds an error for each trait that some node asks for and a hardware type does not implement; the number of those of
/// which nobody can tell.
pub(in crate::resolve) fn check_served(
    manifest: &Manifest,
    sources: &Sources<'_>,
    diagnostics: &mut Diagnostics,
) -> usize {
    let mut unknown = 0;
    let union = union_of_bounds(manifest, sources);
    let mut targets: BTreeMap<&str, Vec<&Target>> = BTreeMap::new();
    for target in &manifest.targets {
        let hardware = target.declared.hardware.as_str();
        targets.entry(hardware).or_default().push(target);
    }
    for (path, targets) in targets {
        let Some(mut hardware) = sources.library.hardware(path) else {
            unknown += 1 + union.len();
            continue;
        };
        if let Some(error) = useless(&mut hardware, &targets, &sources.library) {
            diagnostics.add(error);
            continue;
        }
        unknown += usize::from(hardware.is_conditional());
        unknown += usize::from(hardware.serves_framework(&sources.library) == Serves::Perhaps);
        for one in union.values() {
            let mut serves = |arguments: &Arguments| {
                hardware.serves(&sources.library, &one.definition, arguments)
            };
            let answers: Vec<Serves> = one.arguments.iter().map(&mut serves).collect();
            if answers.contains(&Serves::Never) {
                diagnostics.add(unserved(one, &hardware, &targets, &sources.library));
            } else if answers.contains(&Serves::Perhaps) {
                unknown += 1;
            }
        }
    }
    unknown
}

/// Traits of the workspace by their definition, as far as nodes ask for them that run with the hardware.
fn union_of_bounds<'a>(
    manifest: &'a Manifest,
    sources: &'a Sources<'_>,
) -> BTreeMap<String, Union<'a>> {
    let mut union: BTreeMap<String, Union> = BTreeMap::new();
    for node in running_here(manifest, sources) {
        let signatures = &node.signatures;
        let all = [
            Some(&signatures.cycle),
            Some(&signatures.new),
            signatures.restore.as_ref(),
        ];
        for bound in all.into_iter().flatten().flat_map(|one| &one.bounds) {
            let found = sources.library.trait_of_workspace(&node.module, bound);
            let Some(definition) = found else { continue };
            let entry = union.entry(definition.path()).or_insert_with(|| Union {
                definition,
                arguments: BTreeSet::new(),
                asked: Vec::new(),
            });
            let arguments = sources.library.trait_arguments(&node.module, bound);
            entry.arguments.insert(arguments);
            if entry.asked.iter().all(|asked| asked.node.path != node.path) {
                entry.asked.push(Asked { node, bound });
            }
        }
    }
    union
}

/// A type that is no hardware for the framework, or of which nobody says which one it is.
fn useless(
    hardware: &mut Hardware,
    targets: &[&Target],
    library: &Library<'_>,
) -> Option<Diagnostic> {
    let name = hardware.name().to_owned();
    let path = targets
        .first()
        .map_or("", |one| one.declared.hardware.as_str());
    let (message, label, help) = if let Some(parameter) = hardware.open_parameter() {
        (
            format!("nothing tells what `{parameter}` of `{path}` is"),
            "it has parameters",
            format!(
                "name it with its arguments by `pub type`, and write that name, or give `{parameter}` a default"
            ),
        )
    } else if hardware.serves_framework(library) == Serves::Never {
        (
            format!("`{path}` does not implement `framework::Hardware`"),
            "has no such `impl`",
            format!(
                "write `impl framework::Hardware for {name} {{ … }}`, or name the type that has it"
            ),
        )
    } else {
        return None;
    };
    let mut error = Diagnostic::new(Code::UnknownHardware, message);
    for target in targets {
        let label = format!("target `{}`", target.declared.name);
        let place = target.hardware_range.clone();
        error = error.at(Utf8Path::new(MANIFEST), place, label);
    }
    let (file, place) = hardware.place(library);
    Some(error.at(&file, place, label).help(help))
}

fn unserved(
    union: &Union<'_>,
    hardware: &Hardware,
    targets: &[&Target],
    library: &Library<'_>,
) -> Diagnostic {
    let name = &union.definition.name;
    let hardware_path = targets
        .first()
        .map_or("", |one| one.declared.hardware.as_str());
    let nodes: Vec<&str> = union
        .asked
        .iter()
        .map(|one| one.node.path.as_str())
        .collect();
    let who = match nodes.as_slice() {
        [node] => format!("`{node}` asks for"),
        nodes => format!("{} nodes ask for", nodes.len()),
    };
    let message = format!("`{hardware_path}` does not serve `{name}`, which {who}");
    let mut error = Diagnostic::new(Code::UnservedTrait, message);
    for Asked { node, bound } in &union.asked {
        let label = format!("asked for by `{}`", node.path);
        error = error.at(node.file(), range(bound.span()), label);
    }
    for target in targets {
        let label = format!("target `{}`", target.declared.name);
        error = error.at(
            Utf8Path::new(MANIFEST),
            target.hardware_range.clone(),
            label,
        );
    }
    let (file, place) = hardware.place(library);
    let deed = format!("write `impl {name} for {} {{ … }}`", hardware.name());
    error.at(&file, place, "has no such `impl`").help(deed)
}
