//! A robot in a few lines, resolved as the resolver would.

use std::time::Duration;

use crate::model::names::{snake_case, upper_camel_case};
use crate::resolve::robot::{
    Access, Branch, Content, CreationBinding, CycleBinding, Cycler, CyclerKind, DataType,
    Dependency, Field, Instance, InstanceId, Interface, Node, OnFailure, Output, OutputBinding,
    Reader, Robot, Scheduling, Segment, StateUse, Target, Tree, Writer,
};

pub(crate) struct CyclerBuilder {
    name: String,
    kind: CyclerKind,
    instances: Vec<String>,
    nodes: Vec<NodeBuilder>,
}

pub(crate) struct NodeBuilder {
    node: Node,
    /// Reads of other instances: position of the field, and the instance or cycler by name.
    foreign: Vec<(usize, String)>,
}

/// A node whose type is called like its module.
pub(crate) fn node(path: &str) -> NodeBuilder {
    let name = crate::model::names::last(path);
    let node = Node {
        path: path.to_owned(),
        type_name: upper_camel_case(name),
        setup: false,
        on_failure: OnFailure::Stop,
        file: format!("{}.rs", path.replace("::", "/")).into(),
        summary: None,
        creation: Vec::new(),
        cycle: Vec::new(),
        outputs: Vec::new(),
        restores: false,
        new_bounds: Vec::new(),
        cycle_bounds: Vec::new(),
        restore_bounds: Vec::new(),
    };
    NodeBuilder { node, foreign: Vec::new() }
}

/// A perception cycler; without suffixes it has one instance of its own name.
pub(crate) fn perception(name: &str, suffixes: &[&str]) -> CyclerBuilder {
    cycler(name, suffixes, CyclerKind::Perception)
}

/// A real-time cycler with one instance.
pub(crate) fn real_time(name: &str) -> CyclerBuilder {
    cycler(name, &[], CyclerKind::RealTime)
}

fn cycler(name: &str, suffixes: &[&str], kind: CyclerKind) -> CyclerBuilder {
    let suffixes = if suffixes.is_empty() { &[""] } else { suffixes };
    let instances = suffixes.iter().map(|suffix| format!("{name}{suffix}")).collect();
    CyclerBuilder { name: name.to_owned(), kind, instances, nodes: Vec::new() }
}

impl CyclerBuilder {
    pub(crate) fn setup(mut self, mut node: NodeBuilder) -> Self {
        node.node.setup = true;
        self.nodes.push(node);
        self
    }

    pub(crate) fn node(mut self, node: NodeBuilder) -> Self {
        self.nodes.push(node);
        self
    }
}

/// Positions of producers and instances are filled in by [`robot`].
const UNKNOWN: InstanceId = InstanceId { cycler: usize::MAX, instance: 0 };

impl NodeBuilder {
    pub(crate) fn new_parameter(mut self, name: &str, data: &str, path: &str) -> Self {
        let binding = CreationBinding::Parameter { access: access(path), data: data_type(data) };
        self.node.creation.push(field(name, binding));
        self
    }

    pub(crate) fn new_state(mut self, name: &str, data: &str, path: &str) -> Self {
        let (access, data) = (access(path), data_type(data));
        let binding = CreationBinding::CyclerState { access, data, shared: false };
        self.node.creation.push(field(name, binding));
        self
    }

    pub(crate) fn new_hardware(mut self, traits: &[(&str, bool)]) -> Self {
        self.node.creation.push(field("hardware", CreationBinding::HardwareInterface));
        self.node.new_bounds = interfaces(traits);
        self
    }

    pub(crate) fn restores(mut self) -> Self {
        self.node.restores = true;
        self.node.restore_bounds = self.node.new_bounds.clone();
        self
    }

    pub(crate) fn on_failure(mut self, on_failure: OnFailure) -> Self {
        self.node.on_failure = on_failure;
        self
    }

    pub(crate) fn input(self, name: &str, data: &str, path: &str) -> Self {
        let (access, data) = (access(path), data_type(data));
        self.cycle(name, CycleBinding::OwnOutput { access, data, producer: 0, checked: true })
    }

    pub(crate) fn required(self, name: &str, data: &str, path: &str) -> Self {
        let (access, data) = (access(path), data_type(data));
        self.cycle(name, CycleBinding::RequiredOwnOutput { access, data, producer: 0, checked: true })
    }

    pub(crate) fn previous(self, name: &str, data: &str, path: &str) -> Self {
        let (access, data) = (access(path), data_type(data));
        self.cycle(name, CycleBinding::Previous { access, data, producer: 0, checked: true })
    }

    pub(crate) fn historic(self, name: &str, data: &str, path: &str) -> Self {
        let (access, data) = (access(path), data_type(data));
        self.cycle(name, CycleBinding::Historic { access, data, producer: 0, checked: true })
    }

    pub(crate) fn input_of(self, name: &str, data: &str, instance: &str, path: &str) -> Self {
        let (access, data, checked) = (access(path), data_type(data), true);
        let binding = CycleBinding::OutputOf { instance: UNKNOWN, access, data, producer: 0, checked };
        self.foreign(instance).cycle(name, binding)
    }

    pub(crate) fn required_of(self, name: &str, data: &str, instance: &str, path: &str) -> Self {
        let (access, data, checked) = (access(path), data_type(data), true);
        let binding =
            CycleBinding::RequiredOutputOf { instance: UNKNOWN, access, data, producer: 0, checked };
        self.foreign(instance).cycle(name, binding)
    }

    pub(crate) fn latest(self, name: &str, data: &str, instance: &str, path: &str) -> Self {
        let (access, data, checked) = (access(path), data_type(data), true);
        let binding = CycleBinding::Latest { instance: UNKNOWN, access, data, producer: 0, checked };
        self.foreign(instance).cycle(name, binding)
    }

    pub(crate) fn perception(self, name: &str, data: &str, whose: &str, path: &str) -> Self {
        let (access, data, checked) = (access(path), data_type(data), true);
        let (instances, interleaved) = (Vec::new(), false);
        let binding =
            CycleBinding::Perception { instances, interleaved, access, data, producer: 0, checked };
        self.foreign(whose).cycle(name, binding)
    }

    pub(crate) fn parameter(self, name: &str, data: &str, path: &str) -> Self {
        self.cycle(name, CycleBinding::Parameter { access: access(path), data: data_type(data) })
    }

    pub(crate) fn state(self, name: &str, data: &str, path: &str) -> Self {
        let (access, data) = (access(path), data_type(data));
        self.cycle(name, CycleBinding::CyclerState { access, data, shared: false })
    }

    pub(crate) fn reads_state(self, name: &str, data: &str, path: &str) -> Self {
        let (access, data) = (access(path), data_type(data));
        self.cycle(name, CycleBinding::CyclerState { access, data, shared: true })
    }

    pub(crate) fn cycle_time(self, name: &str) -> Self {
        self.cycle(name, CycleBinding::CycleTime)
    }

    pub(crate) fn additional(self, name: &str, data: &str, path: &str) -> Self {
        self.cycle(name, CycleBinding::AdditionalOutput { access: access(path), data: data_type(data) })
    }

    pub(crate) fn procedure(self, field: &str, request: &str, response: &str, name: &str) -> Self {
        let (request, response) = (data_type(request), data_type(response));
        self.cycle(field, CycleBinding::Procedure { name: name.to_owned(), request, response })
    }

    pub(crate) fn hardware(mut self, traits: &[(&str, bool)]) -> Self {
        self.node.cycle_bounds = interfaces(traits);
        self.cycle("hardware_interface", CycleBinding::HardwareInterface)
    }

    pub(crate) fn in_place(self, name: &str, data: &str) -> Self {
        self.cycle(name, CycleBinding::MainOutput { data: data_type(data) })
    }

    pub(crate) fn output(mut self, name: &str, data: &str) -> Self {
        self.node.outputs.push(field(name, OutputBinding::MainOutput { data: data_type(data) }));
        self
    }

    pub(crate) fn capture_time(mut self, name: &str) -> Self {
        self.node.outputs.push(field(name, OutputBinding::CaptureTime));
        self
    }

    fn cycle(mut self, name: &str, binding: CycleBinding) -> Self {
        self.node.cycle.push(field(name, binding));
        self
    }

    fn foreign(mut self, whose: &str) -> Self {
        self.foreign.push((self.node.cycle.len(), whose.to_owned()));
        self
    }
}

/// The robot `walker` with these cyclers and two targets.
pub(crate) fn robot(cyclers: Vec<CyclerBuilder>) -> Robot {
    let mut resolved: Vec<Cycler> = cyclers.iter().map(resolve_cycler).collect();
    let outputs: Vec<Vec<Output>> = resolved.iter().map(|cycler| cycler.outputs.clone()).collect();
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
        parameter_tree: parameter_tree(&resolved),
        cyclers: resolved,
        targets: vec![target("simulated", "simulated_nao::Hardware"), target("nao", "nao::Hardware")],
        crates: vec![
            dependency("framework", &[]),
            dependency("nao", &["nao"]),
            dependency("serde", &[]),
            dependency("simulated_nao", &["simulated"]),
        ],
        inherited: vec!["edition".to_owned(), "version".to_owned()],
        left_to_rustc: 0,
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
    let mut additional = Tree { branches: Vec::new() };
    let mut states = Tree { branches: Vec::new() };
    for node in &nodes {
        for field in &node.cycle {
            match &field.binding {
                CycleBinding::AdditionalOutput { access, data } => {
                    insert(&mut additional, &names(access), data, Writer { node: node.path.clone() });
                }
                CycleBinding::CyclerState { access, data, shared } => {
                    let user = StateUse { node: node.path.clone(), shared: *shared };
                    insert(&mut states, &names(access), data, user);
                }
                _ => {}
            }
        }
        for field in &node.creation {
            if let CreationBinding::CyclerState { access, data, shared } = &field.binding {
                let user = StateUse { node: node.path.clone(), shared: *shared };
                insert(&mut states, &names(access), data, user);
            }
        }
    }
    let instance = |name: &String| Instance {
        name: name.clone(),
        deadline: (builder.kind == CyclerKind::RealTime).then_some(Duration::from_millis(12)),
        scheduling: Scheduling::default(),
    };
    Cycler {
        name: builder.name.clone(),
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
        let by_value = node.outputs.iter().filter_map(|field| match &field.binding {
            OutputBinding::MainOutput { data } => Some((&field.name, data, false)),
            OutputBinding::CaptureTime => None,
        });
        outputs.extend(in_place.chain(by_value).map(|(name, data, in_place)| Output {
            name: name.clone(),
            data: data.clone(),
            producer,
            in_place,
            shared: false,
            historic: false,
            previous: node.on_failure == OnFailure::Hold && !node.setup,
        }));
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
        output.unwrap_or_else(|| panic!("no node writes `{name}`")).producer
    };
    let foreign = foreign.unwrap_or_default();
    match binding {
        CycleBinding::OwnOutput { access, producer, .. }
        | CycleBinding::RequiredOwnOutput { access, producer, .. }
        | CycleBinding::Previous { access, producer, .. }
        | CycleBinding::Historic { access, producer, .. } => *producer = find(own, access),
        CycleBinding::OutputOf { instance, access, producer, .. }
        | CycleBinding::RequiredOutputOf { instance, access, producer, .. }
        | CycleBinding::Latest { instance, access, producer, .. } => {
            *instance = foreign.0[0];
            *producer = find(instance.cycler, access);
        }
        CycleBinding::Perception { instances, interleaved, access, producer, .. } => {
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

/// How outputs are read decides where they live.
fn mark_outputs(cyclers: &mut [Cycler]) {
    let mut marks: Vec<(usize, String, fn(&mut Output))> = Vec::new();
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
                CycleBinding::OutputOf { instance, access, .. }
                | CycleBinding::RequiredOutputOf { instance, access, .. }
                | CycleBinding::Latest { instance, access, .. } => {
                    marks.push((instance.cycler, root(access), |output| output.shared = true));
                }
                CycleBinding::Perception { instances, access, .. } => {
                    marks.push((instances[0].cycler, root(access), |output| output.shared = true));
                }
                _ => {}
            }
        }
    }
    for (cycler, name, mark) in marks {
        cyclers[cycler].outputs.iter_mut().filter(|output| output.name == name).for_each(mark);
    }
}

fn parameter_tree(cyclers: &[Cycler]) -> Tree<Reader> {
    let mut tree = Tree { branches: Vec::new() };
    for (position, cycler) in cyclers.iter().enumerate() {
        for node in &cycler.nodes {
            let created = node.creation.iter().filter_map(|field| match &field.binding {
                CreationBinding::Parameter { access, data } => Some((access, data)),
                _ => None,
            });
            let cycled = node.cycle.iter().filter_map(|field| match &field.binding {
                CycleBinding::Parameter { access, data } => Some((access, data)),
                _ => None,
            });
            for (access, data) in created.chain(cycled) {
                for instance in &cycler.instances {
                    let names: Vec<(String, Option<usize>)> = access
                        .segments
                        .iter()
                        .map(|segment| match segment.instance {
                            true => (snake_case(&instance.name), Some(position)),
                            false => (segment.name.clone(), None),
                        })
                        .collect();
                    let reader = Reader { cycler: position, node: node.path.clone() };
                    insert(&mut tree, &names, data, reader);
                }
            }
        }
    }
    tree
}

fn names(access: &Access) -> Vec<(String, Option<usize>)> {
    access.segments.iter().map(|segment| (segment.name.clone(), None)).collect()
}

fn insert<U: PartialEq>(
    tree: &mut Tree<U>,
    path: &[(String, Option<usize>)],
    data: &DataType,
    user: U,
) {
    let ((name, instance), below) = path.split_first().expect("a path has a segment");
    let position = tree.branches.iter().position(|branch| branch.name == *name);
    let position = position.unwrap_or_else(|| {
        let content = match (below, instance) {
            ([], _) => Content::Leaf { data: data.clone(), users: Vec::new() },
            (_, Some(cycler)) => {
                Content::Instance { cycler: *cycler, tree: Tree { branches: Vec::new() } }
            }
            _ => Content::Inner(Tree { branches: Vec::new() }),
        };
        tree.branches.push(Branch { name: name.clone(), content });
        tree.branches.sort_by(|left, right| left.name.cmp(&right.name));
        tree.branches.iter().position(|branch| branch.name == *name).expect("it was added")
    });
    match &mut tree.branches[position].content {
        Content::Leaf { users, .. } if users.contains(&user) => {}
        Content::Leaf { users, .. } => users.push(user),
        Content::Inner(tree) | Content::Instance { tree, .. } => insert(tree, below, data, user),
    }
}

fn interfaces(traits: &[(&str, bool)]) -> Vec<Interface> {
    let interface = |(path, reading): &(&str, bool)| Interface {
        path: (*path).to_owned(),
        reading: Some(*reading),
    };
    traits.iter().map(interface).collect()
}

fn data_type(text: &str) -> DataType {
    DataType { text: text.to_owned(), resolved: true }
}

fn access(written: &str) -> Access {
    let segment = |text: &str| {
        let name = text.trim_end_matches('?');
        let instance = name == "$cycler_instance";
        let name = if instance { "cycler_instance" } else { name };
        Segment { name: name.to_owned(), optional: text.ends_with('?'), instance }
    };
    Access { segments: written.split('.').map(segment).collect(), written: written.to_owned() }
}

fn field<B>(name: &str, binding: B) -> Field<B> {
    Field { name: name.to_owned(), binding, line: 1, range: 0..1 }
}
