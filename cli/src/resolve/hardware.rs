//! Hardware: the traits that nodes ask for, and the types of targets that serve them.

mod served;

use std::collections::BTreeSet;

use camino::Utf8Path;
use syn::spanned::Spanned as _;

use super::robot::{Interface, Target};
use super::scene::OTHER_NAME;
use crate::diagnostics::{Code, Diagnostic, Diagnostics, nearest};
use crate::manifest::{self, Manifest};
use crate::scan::traits::Bound;
use crate::scan::{Library, NodeSource, Sources, range};
use crate::workspace::{MANIFEST, Workspace};

pub(super) use served::check_served;

/// The nodes that the robot's own crate runs, each once: those of other machines are theirs.
pub(super) fn running_here<'a>(
    manifest: &'a Manifest,
    sources: &'a Sources<'_>,
) -> impl Iterator<Item = &'a NodeSource> {
    let cyclers = manifest.cyclers.iter();
    let here: BTreeSet<&str> = cyclers
        .filter(|cycler| !cycler.declared.remote)
        .flat_map(|cycler| &cycler.nodes)
        .map(|node| node.path.as_str())
        .collect();
    let nodes = sources.nodes.iter();
    nodes
        .filter(move |(path, _)| here.contains(path.as_str()))
        .map(|(_, node)| node)
}

/// How many bounds of nodes name what is no trait of the workspace, so that nobody sees who implements it.
pub(super) fn foreign_bounds<'a>(
    nodes: impl Iterator<Item = &'a NodeSource>,
    library: &Library<'_>,
) -> usize {
    let is_foreign = |node: &NodeSource, bound: &syn::Path| {
        matches!(library.hardware_trait(&node.module, bound), Bound::Trait(_))
            && library.trait_of_workspace(&node.module, bound).is_none()
    };
    let bounds = nodes.map(|node| {
        let signatures = &node.signatures;
        let all = [
            Some(&signatures.new),
            Some(&signatures.cycle),
            signatures.restore.as_ref(),
        ];
        let bounds = all.into_iter().flatten().flat_map(|one| &one.bounds);
        bounds.filter(|bound| is_foreign(node, bound)).count()
    });
    bounds.sum()
}

/// What a node asks of its hardware that every hardware is, and generated functions have to ask for, too: `Send`,
/// `Sync` and `'static`, sorted.
pub(super) fn markers(library: &Library<'_>, source: &NodeSource) -> Vec<String> {
    let signatures = &source.signatures;
    let functions = [&signatures.new, &signatures.cycle].into_iter();
    let mut markers = BTreeSet::new();
    for function in functions.chain(&signatures.restore) {
        markers.extend(function.is_static.then(|| "'static".to_owned()));
        for bound in &function.bounds {
            if let Bound::Marker(name) = library.hardware_trait(&source.module, bound) {
                markers.insert(name);
            }
        }
    }
    // Every type parameter is that anyway.
    markers.remove("Sized");
    markers.into_iter().collect()
}

/// The traits of one function, sorted by path.
pub(super) fn interfaces(
    library: &Library<'_>,
    source: &NodeSource,
    signature: &grammar::Signature,
    diagnostics: &mut Diagnostics,
) -> Vec<Interface> {
    let mut interfaces = Vec::new();
    for bound in &signature.bounds {
        let found = match library.hardware_trait(&source.module, bound) {
            Bound::Marker(_) => continue,
            Bound::Refused(name) => {
                let message = format!("`{name}` is nothing that a hardware does");
                let error = Diagnostic::new(Code::InvalidSignature, message)
                    .at(
                        source.file(),
                        range(bound.span()),
                        "generated code cannot pass it on",
                    )
                    .help("name the hardware's own traits alone");
                diagnostics.add(error);
                continue;
            }
            Bound::Trait(found) => found,
        };
        for name in &found.lost {
            let message = format!("`{name}` cannot be followed to where it is defined");
            let error = Diagnostic::new(Code::InvalidSignature, message)
                .at(
                    source.file(),
                    range(signature.span),
                    "the generated crate has to write this bound, too",
                )
                .help(format!(
                    "bring `{name}` in with a `use` of its own; {OTHER_NAME}"
                ));
            diagnostics.add(error);
        }
        if let Some(item) = &found.private {
            let error = Diagnostic::new(Code::NotPublic, format!("`{}` is private", item.path()))
                .at(
                    &item.module.file,
                    library.name_range(item),
                    "not visible for the generated crate",
                )
                .at(
                    source.file(),
                    range(signature.span),
                    format!("asked for by `{}`", source.path),
                )
                .help(format!("write `pub` at `{}` and its modules", item.name));
            diagnostics.add(error);
        }
        interfaces.push(found.interface);
    }
    interfaces.sort();
    interfaces.dedup();
    interfaces
}

/// Targets whose hardware type can be found; another is `unknown-hardware`.
pub(super) fn targets(
    workspace: &Workspace,
    manifest: &Manifest,
    library: &Library<'_>,
    diagnostics: &mut Diagnostics,
) -> Vec<Target> {
    let mut targets = Vec::new();
    for target in &manifest.targets {
        let declared = &target.declared;
        if let Some((message, help)) = unknown(workspace, library, declared) {
            let error = Diagnostic::new(Code::UnknownHardware, message)
                .at(Utf8Path::new(MANIFEST), target.hardware_range.clone(), "")
                .help(help);
            diagnostics.add(error);
        }
        targets.push(robot_target(workspace, target));
    }
    targets
}

fn robot_target(workspace: &Workspace, target: &manifest::Target) -> Target {
    let declared = &target.declared;
    Target {
        name: declared.name.to_string(),
        hardware: workspace.members().by_library(declared.hardware.as_str()),
        triple: declared.triple.clone(),
        cpu: declared.cpu.clone(),
        profile: declared.profile.clone(),
        location: declared.location.clone(),
    }
}

/// What is wrong with a hardware path, and what to do.
fn unknown(
    workspace: &Workspace,
    library: &Library<'_>,
    target: &schema::Target,
) -> Option<(String, String)> {
    let path = workspace.members().by_library(target.hardware.as_str());
    let name = path.split("::").next()?;
    if library.member(name).is_none() {
        if workspace.members().is_shared(name) {
            return None;
        }
        let members: Vec<&str> = workspace
            .members()
            .libraries()
            .map(|one| one.library.as_str())
            .collect();
        let help = match nearest(name, members) {
            Some(near) => format!("did you mean `{}`?", path.replacen(name, near, 1)),
            None => format!("add a package with a library `{name}` to the workspace"),
        };
        return Some((
            format!("no crate of the workspace is called `{name}`"),
            help,
        ));
    }
    library.missing_type(&path)
}
