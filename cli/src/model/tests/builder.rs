//! A robot in a few lines, resolved as the resolver would.

mod resolve;

use crate::model::names::{last, plain, upper_camel_case};
use crate::resolve::robot::{
    Access, CreationBinding, CycleBinding, CyclerKind, DataType, Field, InstanceId, Interface,
    Node, OnFailure, OutputBinding, Segment,
};
pub(crate) use resolve::robot;

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
    let name = plain(last(path));
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
        markers: Vec::new(),
    };
    NodeBuilder {
        node,
        foreign: Vec::new(),
    }
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
    let instances = suffixes
        .iter()
        .map(|suffix| format!("{name}{suffix}"))
        .collect();
    CyclerBuilder {
        name: name.to_owned(),
        kind,
        instances,
        nodes: Vec::new(),
    }
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
const UNKNOWN: InstanceId = InstanceId {
    cycler: usize::MAX,
    instance: 0,
};

impl NodeBuilder {
    pub(crate) fn new_parameter(mut self, name: &str, data: &str, path: &str) -> Self {
        let binding = CreationBinding::Parameter {
            access: access(path),
            data: data_type(data),
        };
        self.node.creation.push(field(name, binding));
        self
    }

    pub(crate) fn new_state(self, name: &str, data: &str, path: &str) -> Self {
        self.state_of_creation(name, data, path, false)
    }

    pub(crate) fn new_reads_state(self, name: &str, data: &str, path: &str) -> Self {
        self.state_of_creation(name, data, path, true)
    }

    fn state_of_creation(mut self, name: &str, data: &str, path: &str, shared: bool) -> Self {
        let (access, data) = (access(path), data_type(data));
        let binding = CreationBinding::CyclerState {
            access,
            data,
            shared,
        };
        self.node.creation.push(field(name, binding));
        self
    }

    pub(crate) fn new_hardware(mut self, traits: &[(&str, bool)]) -> Self {
        self.node
            .creation
            .push(field("hardware", CreationBinding::HardwareInterface));
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
        self.cycle(
            name,
            CycleBinding::OwnOutput {
                access,
                data,
                producer: 0,
                checked: true,
            },
        )
    }

    pub(crate) fn required(self, name: &str, data: &str, path: &str) -> Self {
        let (access, data) = (access(path), data_type(data));
        self.cycle(
            name,
            CycleBinding::RequiredOwnOutput {
                access,
                data,
                producer: 0,
                checked: true,
            },
        )
    }

    pub(crate) fn previous(self, name: &str, data: &str, path: &str) -> Self {
        let (access, data) = (access(path), data_type(data));
        self.cycle(
            name,
            CycleBinding::Previous {
                access,
                data,
                producer: 0,
                checked: true,
            },
        )
    }

    pub(crate) fn historic(self, name: &str, data: &str, path: &str) -> Self {
        let (access, data) = (access(path), data_type(data));
        self.cycle(
            name,
            CycleBinding::Historic {
                access,
                data,
                producer: 0,
                checked: true,
            },
        )
    }

    pub(crate) fn input_of(self, name: &str, data: &str, instance: &str, path: &str) -> Self {
        let (access, data, checked) = (access(path), data_type(data), true);
        let binding = CycleBinding::OutputOf {
            instance: UNKNOWN,
            access,
            data,
            producer: 0,
            checked,
        };
        self.foreign(instance).cycle(name, binding)
    }

    pub(crate) fn required_of(self, name: &str, data: &str, instance: &str, path: &str) -> Self {
        let (access, data, checked) = (access(path), data_type(data), true);
        let binding = CycleBinding::RequiredOutputOf {
            instance: UNKNOWN,
            access,
            data,
            producer: 0,
            checked,
        };
        self.foreign(instance).cycle(name, binding)
    }

    pub(crate) fn latest(self, name: &str, data: &str, instance: &str, path: &str) -> Self {
        let (access, data, checked) = (access(path), data_type(data), true);
        let binding = CycleBinding::Latest {
            instance: UNKNOWN,
            access,
            data,
            producer: 0,
            checked,
        };
        self.foreign(instance).cycle(name, binding)
    }

    pub(crate) fn perception(self, name: &str, data: &str, whose: &str, path: &str) -> Self {
        let (access, data, checked) = (access(path), data_type(data), true);
        let (instances, interleaved) = (Vec::new(), false);
        let binding = CycleBinding::Perception {
            instances,
            interleaved,
            access,
            data,
            producer: 0,
            checked,
        };
        self.foreign(whose).cycle(name, binding)
    }

    pub(crate) fn parameter(self, name: &str, data: &str, path: &str) -> Self {
        self.cycle(
            name,
            CycleBinding::Parameter {
                access: access(path),
                data: data_type(data),
            },
        )
    }

    pub(crate) fn state(self, name: &str, data: &str, path: &str) -> Self {
        let (access, data) = (access(path), data_type(data));
        self.cycle(
            name,
            CycleBinding::CyclerState {
                access,
                data,
                shared: false,
            },
        )
    }

    pub(crate) fn reads_state(self, name: &str, data: &str, path: &str) -> Self {
        let (access, data) = (access(path), data_type(data));
        self.cycle(
            name,
            CycleBinding::CyclerState {
                access,
                data,
                shared: true,
            },
        )
    }

    pub(crate) fn cycle_time(self, name: &str) -> Self {
        self.cycle(name, CycleBinding::CycleTime)
    }

    pub(crate) fn additional(self, name: &str, data: &str, path: &str) -> Self {
        self.cycle(
            name,
            CycleBinding::AdditionalOutput {
                access: access(path),
                data: data_type(data),
            },
        )
    }

    pub(crate) fn procedure(self, field: &str, request: &str, response: &str, name: &str) -> Self {
        let (request, response) = (data_type(request), data_type(response));
        self.cycle(
            field,
            CycleBinding::Procedure {
                name: name.to_owned(),
                request,
                response,
            },
        )
    }

    pub(crate) fn hardware(mut self, traits: &[(&str, bool)]) -> Self {
        self.node.cycle_bounds = interfaces(traits);
        self.cycle("hardware_interface", CycleBinding::HardwareInterface)
    }

    pub(crate) fn in_place(self, name: &str, data: &str) -> Self {
        self.cycle(
            name,
            CycleBinding::MainOutput {
                data: data_type(data),
            },
        )
    }

    pub(crate) fn output(mut self, name: &str, data: &str) -> Self {
        self.node.outputs.push(field(
            name,
            OutputBinding::MainOutput {
                data: data_type(data),
            },
        ));
        self
    }

    pub(crate) fn capture_time(mut self, name: &str) -> Self {
        self.node
            .outputs
            .push(field(name, OutputBinding::CaptureTime));
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

fn interfaces(traits: &[(&str, bool)]) -> Vec<Interface> {
    let interface = |(path, reading): &(&str, bool)| Interface {
        path: (*path).to_owned(),
        reading: Some(*reading),
        acting: !*reading,
        methods: Some(Vec::new()),
    };
    traits.iter().map(interface).collect()
}

fn data_type(text: &str) -> DataType {
    DataType {
        text: text.to_owned(),
        resolved: true,
    }
}

fn access(written: &str) -> Access {
    let segment = |text: &str| {
        let name = text.trim_end_matches('?');
        let instance = name == "$cycler_instance";
        let name = if instance { "cycler_instance" } else { name };
        Segment {
            name: name.to_owned(),
            optional: text.ends_with('?'),
            instance,
        }
    };
    Access {
        segments: written.split('.').map(segment).collect(),
        written: written.to_owned(),
    }
}

fn field<B>(name: &str, binding: B) -> Field<B> {
    Field {
        name: name.to_owned(),
        binding,
        line: 1,
        range: 0..1,
    }
}
