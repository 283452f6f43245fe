//! What the nodes of a cycler write, keep and answer.

use super::{AdditionalOutput, OutputField, ProcedureField};
use crate::model::names::{Names, plain, snake_case};
use crate::model::sentences;
use crate::model::structs::{Struct, Structs};
use crate::resolve::robot::{
    Access, CycleBinding, Cycler, Instance, Robot, StateUse, Tree, Writer,
};

/// Main outputs, sorted by name.
pub(in crate::model) fn outputs(cycler: &Cycler) -> Vec<OutputField> {
    let outputs = cycler.outputs.iter().map(|output| {
        let producer = &cycler.nodes[output.producer];
        OutputField {
            name: plain(&output.name).to_owned(),
            data: output.data.text.clone(),
            node: producer.path.clone(),
            shared: output.shared,
            historic: output.historic,
            setup: producer.setup,
            previous: output.previous,
        }
    });
    outputs.collect()
}

/// Names of the main outputs in manifest order of their nodes.
pub(super) fn output_names(cycler: &Cycler) -> Vec<String> {
    let mut outputs: Vec<_> = cycler.outputs.iter().collect();
    outputs.sort_by_key(|output| output.producer);
    outputs
        .into_iter()
        .map(|output| plain(&output.name).to_owned())
        .collect()
}

/// Structs of the additional outputs; none if there are no such outputs.
pub(super) fn additional_structs(robot: &Robot, cycler: &Cycler) -> Vec<Struct> {
    structs(
        robot,
        "AdditionalOutputs",
        &cycler.additional_outputs,
        &writers,
    )
}

/// Structs of the cycler states; none if there are no states.
pub(super) fn state_structs(robot: &Robot, cycler: &Cycler) -> Vec<Struct> {
    structs(robot, "CyclerState", &cycler.states, &users)
}

fn structs<U>(
    robot: &Robot,
    root: &str,
    tree: &Tree<U>,
    docs: &dyn Fn(&[U]) -> String,
) -> Vec<Struct> {
    if tree.branches.is_empty() {
        return Vec::new();
    }
    Structs::new(robot, root, docs).describe(root, tree)
}

fn writers(writers: &[Writer]) -> String {
    sentences::list(writers.iter().map(|writer| writer.node.as_str()))
}

fn users(users: &[StateUse]) -> String {
    let readers: Vec<String> = users
        .iter()
        .filter(|one| one.shared)
        .map(|one| format!("{} (reads)", one.node))
        .collect();
    let writers = users
        .iter()
        .filter(|one| !one.shared)
        .map(|one| one.node.as_str());
    sentences::list(writers.chain(readers.iter().map(String::as_str)))
}

/// Every additional output once, sorted by place.
pub(super) fn additional_outputs(cycler: &Cycler) -> Vec<AdditionalOutput> {
    let mut flags = Names::default();
    let mut found: Vec<AdditionalOutput> = Vec::new();
    let fields = cycler.nodes.iter().flat_map(|node| {
        let fields = node.cycle.iter();
        fields.map(|field| (node.setup, field))
    });
    for (setup, field) in fields {
        let CycleBinding::AdditionalOutput { access, .. } = &field.binding else {
            continue;
        };
        if found.iter().any(|known| known.written == access.written) {
            continue;
        }
        let names = access.segments.iter().map(|segment| segment.name.clone());
        let place: Vec<String> = names.collect();
        found.push(AdditionalOutput {
            written: access.written.clone(),
            flag: flags.give(&place.join("_")),
            names: client_names(cycler, access),
            place,
            setup,
        });
    }
    found.sort_by(|left, right| left.place.cmp(&right.place));
    found
}

/// What clients call an additional output, one name for each instance if they differ.
fn client_names(cycler: &Cycler, access: &Access) -> Vec<String> {
    let by_instance = access.segments.iter().any(|segment| segment.instance);
    let instances = if by_instance {
        &cycler.instances[..]
    } else {
        &cycler.instances[..1]
    };
    let name = |instance: &Instance| {
        let names = access.segments.iter().map(|segment| {
            if segment.instance {
                snake_case(&instance.name)
            } else {
                plain(&segment.name).to_owned()
            }
        });
        names.collect::<Vec<_>>().join(".")
    };
    instances.iter().map(name).collect()
}

/// Procedures that the nodes answer, sorted by name.
pub(super) fn procedures(cycler: &Cycler) -> Vec<ProcedureField> {
    let mut procedures: Vec<ProcedureField> = cycler
        .nodes
        .iter()
        .flat_map(|node| node.cycle.iter().map(move |field| (node, field)))
        .filter_map(|(node, field)| match &field.binding {
            CycleBinding::Procedure {
                name,
                request,
                response,
            } => Some(ProcedureField {
                name: name.clone(),
                request: request.text.clone(),
                response: response.text.clone(),
                node: node.path.clone(),
            }),
            _ => None,
        })
        .collect();
    procedures.sort_by(|left, right| left.name.cmp(&right.name));
    procedures
}
