//! From builders to a robot, as the resolver would: producers, readers, trees.

use std::time::Duration;

use super::CyclerBuilder;
use crate::model::names::snake_case;
use crate::resolve::robot::{
    Access, Branch, Content, CreationBinding, CycleBinding, Cycler, CyclerKind, DataType,
    Dependency, Instance, InstanceId, Node, OnFailure, Output, OutputBinding, Reader, Record,
    Robot, Scheduling, StateUse, Target, Tree, Writer,
};

/// The robot `walker` with these cyclers and two targets.
pub(crate) fn robot(cyclers: Vec<CyclerBuilder>) -> Robot {
    let mut resolved: Vec<Cycler> = cyclers.iter().map(resolve_cycler).collect();
    let outputs: Vec<Vec<Output>> = resolved
        .iter()
        .map(|cycler| cycler.outputs.clone())
        .collect();
    for (position, builder) in cyclers.iter().enumerate() {
        for (node, from) in builder.nodes.iter().enumerate() {
            let bind = |field: usize| {
                let name = from.foreign.iter().find(|(foreign, _)| *foreign == field)?;
                Some(instances(&cyclers, &name.1))
            };
            for (field, declared) in resolved[position].nodes[node].cycle.iter_mut().enumerate() {
                bind_producer(&mut declared.binding, &outputs, position, bind(field));
            }
        }
    }
    mark_outputs(&mut resolved);
    let target = |name: &str, hardware: &str| Target {
        name: name.to_owned(),
        hardware: hardware.to_owned(),
        triple: None,
        cpu: None,
        profile: None,
        location: (name == "nao").then(|| "nao".to_owned()),
    };
    Robot {
        name: "walker".to_owned(),
        generated: "generated".into(),
        parameters: "robotics/parameters".into(),
        identities: vec!["body".to_owned(), "head".to_owned()],
        recording_budget: 2 << 30,
        parameter_tree: parameter_tree(&resolved),
        parameter_hints: Default::default(),
        bridges: Vec::new(),
        cyclers: resolved,
        partial: None,
        targets: vec![
            target("simulated", "simulated_nao::Hardware"),
            target("nao", "nao::Hardware"),
        ],
        crates: vec![
            dependency("framework", &[]),
            dependency("nao", &["nao"]),
            dependency("serde", &[]),
            dependency("simulated_nao", &["simulated"]),
        ],
        inherited: vec!["edition".to_owned(), "version".to_owned()],
        left_to_rustc: 0,
        besides_edges: 0,
    }
}

fn dependency(name: &str, targets: &[&str]) -> Dependency {
    Dependency {
        name: name.to_owned(),
        key: name.to_owned(),
        requirement: "{ workspace = true }".to_owned(),
        targets: targets.iter().map(|target| (*target).to_owned()).collect(),
    }
}

fn resolve_cycler(builder: &CyclerBuilder) -> Cycler {
    let nodes: Vec<Node> = builder.nodes.iter().map(|node| node.node.clone()).collect();
    let mut additional = Tree {
        branches: Vec::new(),
        open: false,
    };
    let mut states = Tree {
        branches: Vec::new(),
        open: false,
    };
    for node in &nodes {
        for field in &node.cycle {
            match &field.binding {
                CycleBinding::AdditionalOutput { access, data } => {
                    insert(
                        &mut additional,
                        &names(access),
                        data,
                        Writer {
                            node: node.path.clone(),
                        },
                    );
                }
                CycleBinding::CyclerState {
                    access,
                    data,
                    shared,
                } => {
                    let user = StateUse {
                        node: node.path.clone(),
                        shared: *shared,
                    };
                    insert(&mut states, &names(access), data, user);
                }
                _ => {}
            }
        }
        for field in &node.creation {
            if let CreationBinding::CyclerState {
                access,
                data,
                shared,
            } = &field.binding
            {
                let user = StateUse {
                    node: node.path.clone(),
                    shared: *shared,
                };
                insert(&mut states, &names(access), data, user);
            }
        }
    }
    let instance = |name: &String| Instance {
        name: name.clone(),
        deadline: (builder.kind == CyclerKind::RealTime).then_some(Duration::from_millis(12)),
        scheduling: Scheduling::default(),
        record: Record::default(),
    };
    Cycler {
        name: builder.name.clone(),
        left_out: false,
        remote: false,
        kind: builder.kind,
        instances: builder.instances.iter().map(instance).collect(),
        outputs: outputs(&nodes),
        nodes,
        additional_outputs: additional,
        states,
        on_failure: OnFailure::Stop,
        pending_timeout: Duration::from_millis(500),
        queue: 32,
        watchdog: Duration::from_millis(300),
        history: Duration::from_secs(1),
        lockstep_duration: None,
    }
}

fn outputs(nodes: &[Node]) -> Vec<Output> {
    let mut outputs = Vec::new();
    for (producer, node) in nodes.iter().enumerate() {
        let in_place = node.cycle.iter().filter_map(|field| match &field.binding {
            CycleBinding::MainOutput { data } => Some((&field.name, data, true)),
            _ => None,
        });
        let by_value = node
            .outputs
            .iter()
            .filter_map(|field| match &field.binding {
                OutputBinding::MainOutput { data } => Some((&field.name, data, false)),
                OutputBinding::CaptureTime => None,
            });
        outputs.extend(
            in_place
                .chain(by_value)
                .map(|(name, data, in_place)| Output {
                    name: name.clone(),
                    data: data.clone(),
                    producer,
                    in_place,
                    shared: false,
                    historic: false,
                    previous: node.on_failure == OnFailure::Hold && !node.setup,
                }),
        );
    }
    outputs.sort_by(|left, right| left.name.cmp(&right.name));
    outputs
}

fn bind_producer(
    binding: &mut CycleBinding,
    outputs: &[Vec<Output>],
    own: usize,
    foreign: Option<(Vec<InstanceId>, bool)>,
) {
    let find = |cycler: usize, access: &Access| {
        let name = &access.segments[0].name;
        let output = outputs[cycler].iter().find(|output| output.name == *name);
        output
            .unwrap_or_else(|| panic!("no node writes `{name}`"))
            .producer
    };
    let foreign = foreign.unwrap_or_default();
    match binding {
        CycleBinding::OwnOutput {
            access, producer, ..
        }
        | CycleBinding::RequiredOwnOutput {
            access, producer, ..
        }
        | CycleBinding::Previous {
            access, producer, ..
        }
        | CycleBinding::Historic {
            access, producer, ..
        } => *producer = find(own, access),
        CycleBinding::OutputOf {
            instance,
            access,
            producer,
            ..
        }
        | CycleBinding::RequiredOutputOf {
            instance,
            access,
            producer,
            ..
        }
        | CycleBinding::Latest {
            instance,
            access,
            producer,
            ..
        } => {
            *instance = foreign.0[0];
            *producer = find(instance.cycler, access);
        }
        CycleBinding::Perception {
            instances,
            interleaved,
            access,
            producer,
            ..
        } => {
            (*instances, *interleaved) = foreign;
            *producer = find(instances[0].cycler, access);
        }
        _ => {}
    }
}

fn instances(cyclers: &[CyclerBuilder], name: &str) -> (Vec<InstanceId>, bool) {
    for (cycler, builder) in cyclers.iter().enumerate() {
        let id = |instance| InstanceId { cycler, instance };
        if let Some(instance) = builder.instances.iter().position(|known| known == name) {
            return (vec![id(instance)], false);
        }
        if builder.name == name {
            return ((0..builder.instances.len()).map(id).collect(), true);
        }
    }
    panic!("no instance `{name}`")
}

type Mark = fn(&mut Output);

/// How outputs are read decides where they live.
fn mark_outputs(cyclers: &mut [Cycler]) {
    let mut marks: Vec<(usize, String, Mark)> = Vec::new();
    for (own, cycler) in cyclers.iter().enumerate() {
        for field in cycler.nodes.iter().flat_map(|node| &node.cycle) {
            let root = |access: &Access| access.segments[0].name.clone();
            match &field.binding {
                CycleBinding::Previous { access, .. } => {
                    marks.push((own, root(access), |output| output.previous = true));
                }
                CycleBinding::Historic { access, .. } => {
                    marks.push((own, root(access), |output| output.historic = true));
                }
                CycleBinding::OutputOf {
                    instance, access, ..
                }
                | CycleBinding::RequiredOutputOf {
                    instance, access, ..
                }
                | CycleBinding::Latest {
                    instance, access, ..
                } => {
                    marks.push((instance.cycler, root(access), |output| output.shared = true));
                }
                CycleBinding::Perception {
                    instances, access, ..
                } => {
                    marks.push((instances[0].cycler, root(access), |output| {
                        output.shared = true
                    }));
                }
                _ => {}
            }
        }
    }
    for (cycler, name, mark) in marks {
        cyclers[cycler]
            .outputs
            .iter_mut()
            .filter(|output| output.name == name)
            .for_each(mark);
    }
}

fn parameter_tree(cyclers: &[Cycler]) -> Tree<Reader> {
    let mut tree = Tree {
        branches: Vec::new(),
        open: false,
    };
    for (position, cycler) in cyclers.iter().enumerate() {
        for node in &cycler.nodes {
            for (access, data) in node.parameters() {
                for instance in &cycler.instances {
                    let names: Vec<(String, Option<usize>)> = access
                        .segments
                        .iter()
                        .map(|segment| match segment.instance {
                            true => (snake_case(&instance.name), Some(position)),
                            false => (segment.name.clone(), None),
                        })
                        .collect();
                    let reader = Reader {
                        cycler: position,
                        node: node.path.clone(),
                    };
                    insert(&mut tree, &names, data, reader);
                }
            }
        }
    }
    tree
}

fn names(access: &Access) -> Vec<(String, Option<usize>)> {
    access
        .segments
        .iter()
        .map(|segment| (segment.name.clone(), None))
        .collect()
}

fn insert<U: PartialEq>(
    tree: &mut Tree<U>,
    path: &[(String, Option<usize>)],
    data: &DataType,
    user: U,
) {
    let Some(((name, instance), below)) = path.split_first() else {
        return;
    };
    let position = tree.branches.iter().position(|branch| branch.name == *name);
    let position = position.unwrap_or_else(|| {
        let content = match (below, instance) {
            ([], _) => Content::Leaf {
                data: data.clone(),
                users: Vec::new(),
            },
            (_, Some(cycler)) => Content::Instance {
                cycler: *cycler,
                tree: Tree {
                    branches: Vec::new(),
                    open: false,
                },
            },
            _ => Content::Inner(Tree {
                branches: Vec::new(),
                open: false,
            }),
        };
        tree.branches.push(Branch {
            name: name.clone(),
            content,
        });
        tree.branches
            .sort_by(|left, right| left.name.cmp(&right.name));
        tree.branches
            .iter()
            .position(|branch| branch.name == *name)
            .expect("it was added")
    });
    match &mut tree.branches[position].content {
        Content::Leaf { users, .. } if users.contains(&user) => {}
        Content::Leaf { users, .. } => users.push(user),
        Content::Inner(tree) | Content::Instance { tree, .. } => insert(tree, below, data, user),
    }
}
