//! What all checks of the stage look at: the manifest's cyclers with the sources of their nodes, and who writes what.

use std::collections::BTreeMap;
use std::ops::Range;

use camino::Utf8Path;
use grammar::{CycleField, OutputField};

use super::robot::{DataType, InstanceId};
use crate::diagnostics::{Code, Diagnostic, Diagnostics};
use crate::manifest::{self, Manifest};
use crate::scan::types::Resolved;
use crate::scan::{NodeSource, Sources, range};

/// Manifest and sources, joined.
pub(super) struct Scene<'a> {
    pub(super) sources: &'a Sources<'a>,
    pub(super) cyclers: Vec<SceneCycler<'a>>,
}

/// A cycler with its nodes.
pub(super) struct SceneCycler<'a> {
    pub(super) declared: &'a manifest::Cycler,
    /// In the order of `declared.nodes`.
    pub(super) nodes: Vec<SceneNode<'a>>,
    /// Main outputs by name.
    pub(super) outputs: BTreeMap<String, Producer<'a>>,
}

/// A node in a cycler.
#[derive(Clone, Copy)]
pub(super) struct SceneNode<'a> {
    pub(super) entry: &'a manifest::NodeEntry,
    pub(super) source: &'a NodeSource,
}

/// A main output and the field that declares it.
pub(super) struct Producer<'a> {
    /// Position in the cycler's nodes.
    pub(super) node: usize,
    pub(super) data: Resolved,
    pub(super) in_place: bool,
    pub(super) source: &'a NodeSource,
    /// Of the field's type.
    pub(super) range: Range<usize>,
}

impl<'a> Scene<'a> {
    /// Joins both; two nodes with one output are a `duplicate-output`.
    pub(super) fn new(
        manifest: &'a Manifest,
        sources: &'a Sources<'a>,
        diagnostics: &mut Diagnostics,
    ) -> Self {
        let cyclers = manifest.cyclers.iter().map(|declared| {
            let nodes = declared.nodes.iter().filter_map(|entry| {
                let source = sources.nodes.get(entry.path.as_str())?;
                Some(SceneNode { entry, source })
            });
            let nodes: Vec<SceneNode> = nodes.collect();
            let outputs = collect_outputs(declared, &nodes, sources, diagnostics);
            SceneCycler {
                declared,
                nodes,
                outputs,
            }
        });
        Self {
            sources,
            cyclers: cyclers.collect(),
        }
    }

    /// The instance of this name.
    pub(super) fn instance(&self, name: &str) -> Option<InstanceId> {
        self.cyclers.iter().enumerate().find_map(|(cycler, scene)| {
            let instances = &scene.declared.instances;
            let instance = instances.iter().position(|one| one.name.as_str() == name)?;
            Some(InstanceId { cycler, instance })
        })
    }

    /// The cycler of this name.
    pub(super) fn cycler(&self, name: &str) -> Option<usize> {
        self.cyclers
            .iter()
            .position(|scene| scene.declared.name() == name)
    }

    /// Every instance's name, in manifest order.
    pub(super) fn instance_names(&self) -> impl Iterator<Item = &str> {
        let instances = self
            .cyclers
            .iter()
            .flat_map(|scene| &scene.declared.instances);
        instances.map(|instance| instance.name.as_str())
    }
}

impl NodeSource {
    /// Its file, relative to the workspace root.
    pub fn file(&self) -> &Utf8Path {
        &self.module.file
    }
}

impl From<&Resolved> for DataType {
    fn from(resolved: &Resolved) -> Self {
        Self {
            text: resolved.text.clone(),
            resolved: resolved.is_known(),
        }
    }
}

fn collect_outputs<'a>(
    cycler: &manifest::Cycler,
    nodes: &[SceneNode<'a>],
    sources: &Sources<'_>,
    diagnostics: &mut Diagnostics,
) -> BTreeMap<String, Producer<'a>> {
    let mut outputs: BTreeMap<String, Producer> = BTreeMap::new();
    for (node, SceneNode { source, .. }) in nodes.iter().enumerate() {
        for (name, data, in_place, range) in declared_outputs(source) {
            let data = sources.library.resolve(&source.module, data);
            report_unnameable(&data, source, &range, sources, diagnostics);
            if let Some(first) = outputs.get(&name) {
                let error = match first.node == node {
                    true => declared_twice(source, &name, range, first),
                    false => written_by_two(cycler, source, &name, range, first),
                };
                diagnostics.add(error);
                continue;
            }
            outputs.insert(
                name,
                Producer {
                    node,
                    data,
                    in_place,
                    source,
                    range,
                },
            );
        }
    }
    outputs
}

fn written_by_two(
    cycler: &manifest::Cycler,
    source: &NodeSource,
    name: &str,
    range: Range<usize>,
    first: &Producer<'_>,
) -> Diagnostic {
    let cycler = cycler.name();
    let message = format!("two nodes of cycler `{cycler}` write `{name}`");
    Diagnostic::new(Code::DuplicateOutput, message)
        .at(
            source.file(),
            range,
            format!("written by `{}`", source.path),
        )
        .at(
            first.source.file(),
            first.range.clone(),
            format!("and by `{}`", first.source.path),
        )
        .help("rename one of the two outputs, or remove one of the nodes")
}

/// One node has two fields for it: of one struct, or one that it returns and one that it writes in place.
fn declared_twice(
    source: &NodeSource,
    name: &str,
    range: Range<usize>,
    first: &Producer<'_>,
) -> Diagnostic {
    let message = format!("`{}` declares the output `{name}` twice", source.path);
    Diagnostic::new(Code::DuplicateOutput, message)
        .at(source.file(), range, "declared here, too")
        .at(first.source.file(), first.range.clone(), "declared here")
        .help("rename one of the two fields, or remove it")
}

/// Name, type, whether it is written in place, and the place of every main output of a node.
fn declared_outputs(
    source: &NodeSource,
) -> impl Iterator<Item = (String, &syn::Type, bool, Range<usize>)> {
    let returned = source
        .outputs
        .fields
        .iter()
        .filter_map(|field| match &field.kind {
            OutputField::MainOutput(data) => Some((&field.name, data, false, field.span)),
            OutputField::CaptureTime => None,
        });
    let in_place = source
        .cycle
        .fields
        .iter()
        .filter_map(|field| match &field.kind {
            CycleField::MainOutput(data) => Some((&field.name, data, true, field.span)),
            _ => None,
        });
    returned
        .chain(in_place)
        .map(|(name, data, in_place, span)| (name.to_string(), data, in_place, range(span)))
}

/// What helps where a name of the code stands nowhere in Cargo.toml.
pub(super) const OTHER_NAME: &str = "a library that is not called as its package needs its own name in Cargo.toml: `NAME = { package = \"…\", … }`";

/// Types that are declared in a node file have to be public for the generated crate, and to have names that it can write.
pub(super) fn report_unnameable(
    data: &Resolved,
    source: &NodeSource,
    range_of_field: &Range<usize>,
    sources: &Sources<'_>,
    diagnostics: &mut Diagnostics,
) {
    for name in &data.lost {
        let message = format!("`{name}` cannot be followed to where it is defined");
        let error = Diagnostic::new(Code::InvalidField, message)
            .at(
                source.file(),
                range_of_field.clone(),
                "the generated crate has to write this type, too",
            )
            .help(format!(
                "bring `{name}` in with a `use` of its own, or give the type a name with `pub type` and write that; {OTHER_NAME}"
            ));
        diagnostics.add(error);
    }
    for item in &data.private {
        let message = format!("`{}` is private", item.path());
        let name = &item.name;
        let defined = sources.library.name_range(item);
        let error = Diagnostic::new(Code::NotPublic, message)
            .at(
                &item.module.file,
                defined,
                "not visible for the generated crate",
            )
            .at(
                source.file(),
                range_of_field.clone(),
                format!("used by `{}`", source.path),
            )
            .help(format!(
                "write `pub` at `{name}` and its modules, or re-export it with `pub use`"
            ));
        diagnostics.add(error);
    }
}

/// A type as the crate of a node writes it: its own modules begin with `crate`.
pub(super) fn written_within(source: &NodeSource, text: &str) -> String {
    let own = format!("{}::", source.module.library());
    let mut written = String::new();
    for (index, part) in text.split(&own).enumerate() {
        if index > 0 {
            // `other_nodes::` and `types::nodes::` end alike and are others.
            let before = written.chars().next_back();
            let is_whole = before.is_none_or(|one| !(one.is_alphanumeric() || "_:#".contains(one)));
            written.push_str(if is_whole { "crate::" } else { &own });
        }
        written.push_str(part);
    }
    written
}
