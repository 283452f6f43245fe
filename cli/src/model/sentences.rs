//! Sentences for doc comments.

use std::collections::BTreeSet;

use crate::resolve::robot::{
    CycleBinding, Cycler, CyclerKind, Interface, Node, OutputBinding, Robot,
};

/// Words joined by commas, sorted and each once.
pub(super) fn list<'a>(words: impl IntoIterator<Item = &'a str>) -> String {
    let words: BTreeSet<&str> = words.into_iter().collect();
    words.into_iter().collect::<Vec<_>>().join(", ")
}

/// What the generated crate is, for its first lines.
pub(super) fn crate_title(robot: &Robot) -> String {
    let name = &robot.name;
    match &robot.partial {
        None => format!("The robot `{name}`: its parameters, databases, cyclers and runtime."),
        Some(partial) => format!(
            "The robot `{name}` with {} alone: parameters, databases, cyclers and runtime.",
            and(&partial.only)
        ),
    }
}

/// What the generated crate is, for its package.
pub(super) fn crate_description(robot: &Robot) -> String {
    let name = &robot.name;
    match &robot.partial {
        None => format!("Runtime of the robot `{name}`"),
        Some(partial) => format!(
            "Runtime of the robot `{name}` with {} alone",
            and(&partial.only)
        ),
    }
}

/// Names in a sentence: `Vision`, `Network` and `Control`.
pub(super) fn and(names: &[String]) -> String {
    let names: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
    match names.as_slice() {
        [] => "nothing".to_owned(),
        [only] => only.clone(),
        [all @ .., last] => format!("{} and {last}", all.join(", ")),
    }
}

/// `Cycler `Vision` (perception), instances `VisionTop` and `VisionBottom`.`
pub(super) fn cycler_title(cycler: &Cycler) -> String {
    let instances = cycler.instances.iter();
    let names: Vec<String> = instances.map(|instance| instance.name.clone()).collect();
    let instances = match names.as_slice() {
        [name] if *name == cycler.name => "one instance".to_owned(),
        [_] => format!("instance {}", and(&names)),
        _ => format!("instances {}", and(&names)),
    };
    format!(
        "Cycler `{}` ({}), {instances}.",
        cycler.name,
        kind(cycler.kind)
    )
}

/// The kind as the manifest writes it.
pub(super) fn kind(kind: CyclerKind) -> &'static str {
    match kind {
        CyclerKind::Perception => "perception",
        CyclerKind::RealTime => "real-time",
    }
}

/// The data flow of a node in one line:
/// `camera_matrix (required), image -> balls; when subscribed: ball_candidates`.
pub(super) fn flow(robot: &Robot, node: &Node) -> String {
    let mut reads = Vec::new();
    let mut writes = Vec::new();
    if asks(&node.cycle_bounds, |reading| reading == Some(true)) {
        reads.push("hardware".to_owned());
    }
    for read in node
        .cycle
        .iter()
        .filter_map(|field| read(robot, &field.binding))
    {
        if !reads.contains(&read) {
            reads.push(read);
        }
    }
    writes.extend(node.cycle.iter().filter_map(|field| match field.binding {
        CycleBinding::MainOutput { .. } => Some(field.name.clone()),
        _ => None,
    }));
    writes.extend(node.outputs.iter().filter_map(|field| match field.binding {
        OutputBinding::MainOutput { .. } => Some(field.name.clone()),
        OutputBinding::CaptureTime => None,
    }));
    if asks(&node.cycle_bounds, |reading| reading != Some(true)) {
        writes.push("hardware".to_owned());
    }
    let writes = if writes.is_empty() {
        "nothing".to_owned()
    } else {
        writes.join(", ")
    };
    let mut flow = format!("{} -> {writes}", reads.join(", "))
        .trim_start()
        .to_owned();
    let additional: Vec<&str> = node
        .cycle
        .iter()
        .filter_map(|field| additional(&field.binding))
        .collect();
    if !additional.is_empty() {
        flow.push_str(&format!("; when subscribed: {}", additional.join(", ")));
    }
    flow
}

/// What a node reads through this field, if that is data of a cycle.
fn read(robot: &Robot, binding: &CycleBinding) -> Option<String> {
    let instance_name = |id: &crate::resolve::robot::InstanceId| {
        robot.cyclers[id.cycler].instances[id.instance]
            .name
            .as_str()
    };
    let path = |written: &str| written.replace('?', "");
    Some(match binding {
        CycleBinding::OwnOutput { access, .. } => path(&access.written),
        CycleBinding::RequiredOwnOutput { access, .. } => {
            format!("{} (required)", path(&access.written))
        }
        CycleBinding::OutputOf {
            instance, access, ..
        }
        | CycleBinding::Latest {
            instance, access, ..
        } => {
            format!(
                "latest {}.{}",
                instance_name(instance),
                path(&access.written)
            )
        }
        CycleBinding::RequiredOutputOf {
            instance, access, ..
        } => {
            format!(
                "latest {}.{} (required)",
                instance_name(instance),
                path(&access.written)
            )
        }
        CycleBinding::Previous { access, .. } => format!("previous {}", path(&access.written)),
        CycleBinding::Historic { access, .. } => format!("historic {}", path(&access.written)),
        CycleBinding::Perception {
            instances,
            interleaved,
            access,
            ..
        } => {
            let from = if *interleaved {
                &robot.cyclers[instances[0].cycler].name
            } else {
                instance_name(&instances[0])
            };
            format!("perception {from}.{}", path(&access.written))
        }
        CycleBinding::CyclerState { access, .. } => format!("state {}", access.written),
        CycleBinding::Procedure { name, .. } => format!("procedure {name}"),
        CycleBinding::Parameter { .. }
        | CycleBinding::CycleTime
        | CycleBinding::AdditionalOutput { .. }
        | CycleBinding::HardwareInterface
        | CycleBinding::MainOutput { .. } => return None,
    })
}

fn additional(binding: &CycleBinding) -> Option<&str> {
    match binding {
        CycleBinding::AdditionalOutput { access, .. } => Some(&access.written),
        _ => None,
    }
}

fn asks(bounds: &[Interface], reading: impl Fn(Option<bool>) -> bool) -> bool {
    bounds.iter().any(|interface| reading(interface.reading))
}
