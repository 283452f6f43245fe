//! What is allowed but is probably not meant.

use std::collections::BTreeSet;
use std::ops::Range;

use camino::Utf8Path;
use grammar::CycleField;
use proc_macro2::Span;

use super::robot::{
    Bridge, BridgeKind, Content, CreationBinding, CycleBinding, Cycler, CyclerKind, Interface,
    Node, OnFailure, Record, Robot, StateUse, Tree,
};
use crate::diagnostics::{Code, Diagnostic, Diagnostics};
use crate::manifest::{self, Manifest};
use crate::scan::{NodeSource, Sources, range};
use crate::workspace::MANIFEST;

/// Adds every warning of this stage.
pub(super) fn warn(
    robot: &Robot,
    manifest: &Manifest,
    sources: &Sources<'_>,
    diagnostics: &mut Diagnostics,
) {
    let read = read_nodes(robot);
    for (index, cycler) in robot.cyclers.iter().enumerate() {
        lonely_states(cycler, &cycler.states, &mut Vec::new(), diagnostics);
        if !robot.targets.is_empty() && !cycler.left_out && !cycler.remote {
            unpaced(cycler, &manifest.cyclers[index], diagnostics);
        }
        for (position, node) in cycler.nodes.iter().enumerate() {
            let Some(source) = sources.nodes.get(&node.path) else {
                continue;
            };
            if !read.contains(&(index, position)) {
                let entry = &manifest.cyclers[index].nodes[position];
                unread_outputs(cycler, node, entry.range.clone(), diagnostics);
            }
            not_restorable(node, source, diagnostics);
            not_replayable(cycler, node, source, diagnostics);
            read_outside_setup(cycler, node, source, diagnostics);
            actuator_takes_default(cycler, node, diagnostics);
            measurement_takes_default(robot, node, diagnostics);
        }
    }
    nondeterminism(sources, diagnostics);
}

fn nondeterminism(sources: &Sources<'_>, diagnostics: &mut Diagnostics) {
    for place in sources.nondeterminism() {
        let message = format!("`{}` is not the same in every run", place.name);
        let warning = Diagnostic::new(Code::Nondeterminism, message)
            .at(&place.file, place.range, place.chance.label())
            .help(place.chance.deed());
        diagnostics.add(warning);
    }
}

/// Nodes of which some main output is read: cycler and position.
fn read_nodes(robot: &Robot) -> BTreeSet<(usize, usize)> {
    let mut read = BTreeSet::new();
    for (index, cycler) in robot.cyclers.iter().enumerate() {
        let fields = cycler.nodes.iter().flat_map(|node| &node.cycle);
        for one in fields.filter_map(|field| field.binding.read()) {
            let cycler = one
                .instances
                .first()
                .map_or(index, |instance| instance.cycler);
            read.insert((cycler, one.producer));
        }
        for instance in &cycler.instances {
            if let Record::While(condition) = &instance.record {
                let cycler = condition.instance.map_or(index, |instance| instance.cycler);
                read.insert((cycler, condition.producer));
            }
        }
    }
    let bridged = robot.bridges.iter();
    read.extend(bridged.filter_map(|bridge| producer(robot, bridge)));
    read
}

/// Who writes the main output that a bridge carries: cycler and position.
fn producer(robot: &Robot, bridge: &Bridge) -> Option<(usize, usize)> {
    let mut names = bridge.path.split('.');
    let instance = names.next()?;
    if bridge.kind != BridgeKind::MainOutput {
        return None;
    }
    let output = names.nth(1)?;
    let mut cyclers = robot.cyclers.iter();
    let index = cyclers.position(|one| one.instances.iter().any(|own| own.name == instance))?;
    let mut outputs = robot.cyclers[index].outputs.iter();
    let output = outputs.find(|one| one.name == output)?;
    Some((index, output.producer))
}

/// A cycler in which nothing can wait: there is no setup node, and no node touches the hardware.
fn unpaced(cycler: &Cycler, declared: &manifest::Cycler, diagnostics: &mut Diagnostics) {
    let touches = |node: &Node| {
        let mut fields = node.cycle.iter();
        fields.any(|field| matches!(field.binding, CycleBinding::HardwareInterface))
    };
    if cycler.nodes.iter().any(|node| node.setup || touches(node)) {
        return;
    }
    let message = format!("nothing paces cycler `{}`", cycler.name);
    let place = declared.name_range.clone();
    let warning = Diagnostic::new(Code::UnpacedCycler, message)
        .at(Utf8Path::new(MANIFEST), place, "its cycles follow each other without a rest")
        .help("add a node to its `setup_nodes` that waits for the data of a cycle, or for the next period");
    diagnostics.add(warning);
}

fn unread_outputs(
    cycler: &Cycler,
    node: &Node,
    place: Range<usize>,
    diagnostics: &mut Diagnostics,
) {
    let acts = node.cycle_bounds.iter().any(|interface| interface.acting);
    let speaks = node.cycle.iter().any(|field| {
        matches!(
            field.binding,
            CycleBinding::CyclerState { shared: false, .. } | CycleBinding::Procedure { .. }
        )
    });
    let prepares = node.creation.iter().any(|field| {
        matches!(
            field.binding,
            CreationBinding::CyclerState { shared: false, .. }
        )
    });
    // A setup node waits, and so paces its cycler, whoever reads what it writes.
    if node.setup || acts || speaks || prepares {
        return;
    }
    let message = format!(
        "nobody reads what `{}` writes in cycler `{}`",
        node.path, cycler.name
    );
    let warning = Diagnostic::new(Code::UnreadOutputs, message)
        .at(Utf8Path::new(MANIFEST), place, "")
        .help("remove it from the manifest, or read one of its main outputs");
    diagnostics.add(warning);
}

/// Leaves of the state tree with one user.
fn lonely_states(
    cycler: &Cycler,
    tree: &Tree<StateUse>,
    path: &mut Vec<String>,
    diagnostics: &mut Diagnostics,
) {
    for branch in &tree.branches {
        path.push(branch.name.clone());
        match &branch.content {
            Content::Leaf { users, .. } => {
                if let [user] = users.as_slice() {
                    lonely_state(cycler, &user.node, path, diagnostics);
                }
            }
            Content::Inner(tree) | Content::Instance { tree, .. } => {
                lonely_states(cycler, tree, path, diagnostics);
            }
        }
        path.pop();
    }
}

fn lonely_state(cycler: &Cycler, user: &str, path: &[String], diagnostics: &mut Diagnostics) {
    let Some(node) = cycler.nodes.iter().find(|node| node.path == user) else {
        return;
    };
    let creation = node
        .creation
        .iter()
        .filter_map(|field| match &field.binding {
            CreationBinding::CyclerState { access, .. } => Some((access, &field.range)),
            _ => None,
        });
    let cycle = node.cycle.iter().filter_map(|field| match &field.binding {
        CycleBinding::CyclerState { access, .. } => Some((access, &field.range)),
        _ => None,
    });
    let mut fields = creation.chain(cycle);
    let place = fields.find(|(access, _)| {
        let names: Vec<&String> = access.segments.iter().map(|one| &one.name).collect();
        names.iter().zip(path).all(|(a, b)| *a == b)
    });
    let path = path.join(".");
    let message = format!("only `{user}` uses the cycler state `{path}`");
    let warning = Diagnostic::new(Code::StateOfOneNode, message)
        .at(
            &node.file,
            place.map(|(_, range)| range.clone()).unwrap_or_default(),
            "",
        )
        .help("make it a field of the node's struct");
    diagnostics.add(warning);
}

fn not_restorable(node: &Node, source: &NodeSource, diagnostics: &mut Diagnostics) {
    if let (Some(state), false) = (&source.state, node.restores) {
        for (field, place) in &state.skipped {
            let message = format!(
                "`{field}` of `{}` is not recorded and nothing rebuilds it",
                node.type_name
            );
            let warning = Diagnostic::new(Code::StateNotRestorable, message)
                .at(&node.file, place.clone(), "replay of this node is off")
                .help("add `pub fn restore(&mut self, context: CreationContext) -> Result<()>`");
            diagnostics.add(warning);
        }
    }
    let reading = node
        .restore_bounds
        .iter()
        .find(|interface| interface.reading == Some(true));
    if let (Some(interface), Some(restore)) = (reading, &source.signatures.restore) {
        let message = format!("`restore` reads from the hardware: `{}`", interface.path);
        let warning = Diagnostic::new(Code::StateNotRestorable, message)
            .at(&node.file, range(restore.span), "a replay has no hardware")
            .help("rebuild the state from parameters alone");
        diagnostics.add(warning);
    }
}

/// One for each node: all its instances are not replayed for the first trait already.
fn not_replayable(
    cycler: &Cycler,
    node: &Node,
    source: &NodeSource,
    diagnostics: &mut Diagnostics,
) {
    let mut asked = [&node.new_bounds, &node.cycle_bounds, &node.restore_bounds]
        .into_iter()
        .flatten();
    let Some(interface) = asked.find(|one| one.methods.is_none()) else {
        return;
    };
    let message = format!("nothing can stand in for `{}` in a replay", interface.path);
    let label = format!("`{}` is not replayed", cycler.name);
    let warning = Diagnostic::new(Code::NotReplayable, message)
        .at(&node.file, range(hardware_place(source)), label)
        .help(
            "let it be a trait of the workspace without supertraits, parameters and associated items, and its methods \
             plain ones that declare neither types nor lifetimes: `text: &str`, `line: Line<'_>`",
        );
    diagnostics.add(warning);
}

/// Where a node asks for the hardware.
fn hardware_place(source: &NodeSource) -> Span {
    let fields = &source.cycle.fields;
    let field = fields
        .iter()
        .find(|field| matches!(field.kind, CycleField::HardwareInterface));
    field.map_or(source.signatures.cycle.span, |field| field.span)
}

fn read_outside_setup(
    cycler: &Cycler,
    node: &Node,
    source: &NodeSource,
    diagnostics: &mut Diagnostics,
) {
    if node.setup {
        return;
    }
    let Some(interface) = node
        .cycle_bounds
        .iter()
        .find(|one| one.reading == Some(true))
    else {
        return;
    };
    let place = hardware_place(source);
    let message = format!(
        "`{}` reads from the hardware in its cycle: `{}`",
        node.path, interface.path
    );
    let warning = Diagnostic::new(Code::HardwareReadOutsideSetup, message)
        .at(&node.file, range(place), "this is not recorded")
        .help(format!(
            "read it in a setup node of `{}` and hand it on as a main output",
            cycler.name
        ));
    diagnostics.add(warning);
}

/// Outputs of setup nodes are always written before other nodes run; all others may be defaults.
fn actuator_takes_default(cycler: &Cycler, node: &Node, diagnostics: &mut Diagnostics) {
    let writes = |interface: &Interface| interface.reading == Some(false);
    let Some(interface) = node.cycle_bounds.iter().find(|one| writes(one)) else {
        return;
    };
    for field in &node.cycle {
        let (data, access, always_written) = match &field.binding {
            CycleBinding::OwnOutput {
                data,
                access,
                producer,
                ..
            } => (data, access, cycler.nodes[*producer].setup),
            CycleBinding::OutputOf { data, access, .. } => (data, access, false),
            _ => continue,
        };
        if always_written || data.text.starts_with("Option<") {
            continue;
        }
        let written = &access.written;
        let message = format!(
            "`{}` may receive a `{written}` that nobody computed",
            node.path
        );
        let warning = Diagnostic::new(Code::ActuatorTakesDefault, message)
            .at(
                &node.file,
                field.range.clone(),
                format!("the node acts through `{}`", interface.path),
            )
            .help(format!(
                "let the output be an `Option` and write `RequiredInput<Option<…>, \"{written}?\">`"
            ));
        diagnostics.add(warning);
    }
}

fn measurement_takes_default(robot: &Robot, node: &Node, diagnostics: &mut Diagnostics) {
    for field in &node.cycle {
        let CycleBinding::Perception {
            instances,
            data,
            producer,
            access,
            ..
        } = &field.binding
        else {
            continue;
        };
        let Some(cycler) = instances
            .first()
            .map(|instance| &robot.cyclers[instance.cycler])
        else {
            continue;
        };
        let writer = &cycler.nodes[*producer];
        let may_default = writer.on_failure == OnFailure::Skip && !writer.setup;
        if !may_default || data.text.starts_with("Option<") || cycler.kind != CyclerKind::Perception
        {
            continue;
        }
        let message = format!(
            "`{}` is a default when `{}` fails",
            access.written, writer.path
        );
        let warning = Diagnostic::new(Code::MeasurementTakesDefault, message)
            .at(
                &node.file,
                field.range.clone(),
                "delivered like a measurement",
            )
            .help("let the output be an `Option`, or give its node another `on_failure`");
        diagnostics.add(warning);
    }
}
