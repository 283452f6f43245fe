//! The one parameter tree of the robot.

use std::collections::BTreeMap;

use camino::Utf8Path;
use grammar::{CreationField, CycleField, Pathed};
use syn::LitStr;

use super::hints::{self, Hinted};
use super::robot::{Access, Hints, Reader, Tree};
use super::scene::{Scene, SceneCycler, SceneNode};
use super::tree::{Declaration, Rules, merge};
use crate::diagnostics::{Code, Diagnostic, Diagnostics};
use crate::scan::range;
use crate::workspace::MANIFEST;

/// The parameters of a robot.
pub(super) struct Parameters {
    /// Every declared parameter, instances in place of `$cycler_instance`.
    pub(super) tree: Tree<Reader>,
    /// What else is known of some, by path.
    pub(super) hints: BTreeMap<String, Hints>,
    /// How many paths could not be compared.
    pub(super) unchecked: usize,
}

/// The table of the parameter files that only a target's hardware reads.
const TARGETS: &str = "hardware";

/// A field that reads a parameter.
struct Declared<'a> {
    parameter: &'a Pathed,
    span: proc_macro2::Span,
    hints: &'a grammar::Hints,
    at_creation: bool,
}

/// Everything that nodes declare.
pub(super) fn parameters(scene: &Scene<'_>, diagnostics: &mut Diagnostics) -> Parameters {
    let mut hinted = Vec::new();
    for (index, cycler) in scene.cyclers.iter().enumerate() {
        for node in &cycler.nodes {
            for declared in declared(node) {
                let declarations = expand(scene, (index, cycler), node, &declared);
                hinted.extend(declarations.into_iter().map(|declaration| Hinted {
                    declaration,
                    unit: declared.hints.unit.as_ref().map(LitStr::value),
                    range: declared.hints.range.map(|range| range.to_string()),
                    at_creation: declared.at_creation,
                }));
            }
        }
    }
    let hints = hints::collect(&hinted, diagnostics);
    let declarations: Vec<_> = hinted.into_iter().map(|one| one.declaration).collect();
    report_strangers(scene, &declarations, diagnostics);
    report_table_of_targets(scene, &declarations, diagnostics);
    let rules = Rules {
        conflict: Code::ParameterConflict,
        what: "parameter",
    };
    let merged = merge(&scene.sources.library, declarations, &rules, diagnostics);
    Parameters {
        tree: merged.tree,
        hints,
        unchecked: merged.unchecked,
    }
}

/// Parameters that a node reads.
pub(super) fn of_node<'a>(node: &SceneNode<'a>) -> impl Iterator<Item = &'a Pathed> {
    declared(node).map(|declared| declared.parameter)
}

fn declared<'a>(node: &SceneNode<'a>) -> impl Iterator<Item = Declared<'a>> {
    let creation = node.source.creation.fields.iter();
    let creation = creation.filter_map(|field| match &field.kind {
        CreationField::Parameter(parameter) => Some(Declared {
            parameter,
            span: field.span,
            hints: &field.hints,
            at_creation: true,
        }),
        _ => None,
    });
    let cycle = node.source.cycle.fields.iter();
    let cycle = cycle.filter_map(|field| match &field.kind {
        CycleField::Parameter(parameter) => Some(Declared {
            parameter,
            span: field.span,
            hints: &field.hints,
            at_creation: false,
        }),
        _ => None,
    });
    creation.chain(cycle)
}

/// One declaration, or one for each instance.
fn expand<'a>(
    scene: &Scene<'a>,
    (index, cycler): (usize, &SceneCycler<'a>),
    node: &SceneNode<'a>,
    declared: &Declared<'_>,
) -> Vec<Declaration<'a, Reader>> {
    let declaration = Declaration {
        segments: Access::of(&declared.parameter.path).segments,
        data: scene
            .sources
            .library
            .resolve(&node.source.module, &declared.parameter.data),
        user: Reader {
            cycler: index,
            node: node.source.path.clone(),
        },
        writes: false,
        drawn: false,
        instance: None,
        source: node.source,
        range: range(declared.span),
    };
    let Some(place) = declaration
        .segments
        .iter()
        .position(|segment| segment.instance)
    else {
        return vec![declaration];
    };
    let instances = cycler.declared.instances.iter();
    instances
        .map(|instance| {
            let mut one = declaration.clone();
            one.segments[place].name = schema::snake_case(instance.name.as_str());
            one.instance = Some((place, index));
            one
        })
        .collect()
}

/// What stands below an instance's name is the same for all instances of a cycler, so nobody adds to one of them alone.
fn report_strangers(
    scene: &Scene<'_>,
    declarations: &[Declaration<'_, Reader>],
    diagnostics: &mut Diagnostics,
) {
    let expanded: Vec<_> = declarations
        .iter()
        .filter(|one| one.instance.is_some())
        .collect();
    for stranger in declarations {
        // Two cyclers may name each other's instances.
        let mut others = expanded
            .iter()
            .filter(|one| one.instance != stranger.instance);
        let beside = others.clone().find(|one| {
            let (place, _) = one.instance.unwrap_or_default();
            stranger.segments.len() > place
                && one.segments[..=place]
                    .iter()
                    .zip(&stranger.segments)
                    .all(|(a, b)| a.name == b.name)
        });
        let Some(beside) = beside else {
            continue;
        };
        let known = others.any(|one| {
            stranger.segments.len() >= one.segments.len()
                && one
                    .segments
                    .iter()
                    .zip(&stranger.segments)
                    .all(|(a, b)| a.name == b.name)
        });
        if known {
            continue;
        }
        let (place, cycler) = beside.instance.unwrap_or_default();
        let instance = &stranger.segments[place].name;
        let cycler = scene.cyclers[cycler].declared.name();
        let message =
            format!("`{instance}` holds what `$cycler_instance` declares in cycler `{cycler}`");
        let error = Diagnostic::new(Code::ParameterConflict, message)
            .at(
                stranger.source.file(),
                stranger.range.clone(),
                "adds to one instance alone",
            )
            .at(
                beside.source.file(),
                beside.range.clone(),
                "for all instances of the cycler",
            )
            .help(format!(
                "declare it with `$cycler_instance` in a node of `{cycler}`, or elsewhere"
            ));
        diagnostics.add(error);
    }
}

/// `[hardware]` of the parameter files is read by the targets, so no instance may have its parameters there.
fn report_table_of_targets(
    scene: &Scene<'_>,
    declarations: &[Declaration<'_, Reader>],
    diagnostics: &mut Diagnostics,
) {
    for (index, cycler) in scene.cyclers.iter().enumerate() {
        let instances = cycler.declared.instances.iter();
        let mut instances =
            instances.filter(|one| schema::snake_case(one.name.as_str()) == TARGETS);
        let declared = declarations
            .iter()
            .find(|one| one.instance == Some((0, index)) && one.segments[0].name == TARGETS);
        let Some((instance, declared)) = instances.next().zip(declared) else {
            continue;
        };
        let name = instance.name.as_str();
        let message = format!(
            "the parameters of instance `{name}` would stand in `{TARGETS}`, which belongs to the targets"
        );
        let error = Diagnostic::new(Code::InvalidName, message)
            .at(Utf8Path::new(MANIFEST), instance.range.clone(), "")
            .at(
                declared.source.file(),
                declared.range.clone(),
                "`$cycler_instance` is the name of the instance",
            )
            .help("rename the instance, or begin the path with another name, as in `arms.$cycler_instance`");
        diagnostics.add(error);
    }
}
