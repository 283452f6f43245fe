//! A small robot made by hand for tests: two cyclers, three instances, every kind of edge.

use std::time::Duration;

use crate::resolve::robot::{
    Access, Branch, Content, CreationBinding, CycleBinding, Cycler, CyclerKind, DataType, Field,
    Instance, InstanceId, Interface, Node, OnFailure, Output, OutputBinding, Reader, Record, Robot,
    Scheduling, Segment, StateUse, Target, Tree, Writer,
};
use crate::schedule::{CyclerSchedule, Schedule};

const TOP: InstanceId = InstanceId {
    cycler: 0,
    instance: 0,
};
const BOTTOM: InstanceId = InstanceId {
    cycler: 0,
    instance: 1,
};
const CONTROL: InstanceId = InstanceId {
    cycler: 1,
    instance: 0,
};

/// Vision (top and bottom) finds balls with the camera matrix that Control computes.
pub(crate) fn robot() -> Robot {
    Robot {
        name: "walker".to_owned(),
        generated: "generated".into(),
        parameters: "parameters".into(),
        identities: vec!["body".to_owned()],
        recording_budget: 2 << 30,
        cyclers: vec![vision(), control()],
        partial: None,
        targets: vec![target("simulated"), target("nao")],
        parameter_tree: parameter_tree(),
        parameter_hints: Default::default(),
        bridges: Vec::new(),
        inherited: Vec::new(),
        crates: Vec::new(),
        left_to_rustc: 1,
        besides_edges: 0,
    }
}

/// In Control the head runs after the filter although it stands before it.
pub(crate) fn schedule() -> Schedule {
    let cycler = |order: &[usize]| CyclerSchedule {
        order: order.to_vec(),
        creation: (0..order.len()).collect(),
        edges: Vec::new(),
    };
    Schedule {
        cyclers: vec![cycler(&[0, 1]), cycler(&[0, 2, 1, 3])],
    }
}

fn vision() -> Cycler {
    let mut receiver = node("vision::image_receiver", "ImageReceiver", true);
    receiver.creation = vec![field("hardware", CreationBinding::HardwareInterface)];
    let camera = Access {
        written: "$cycler_instance.camera".to_owned(),
        ..access("x.camera")
    };
    let data = data("types::CameraPosition");
    receiver.cycle = vec![
        field(
            "image",
            CycleBinding::MainOutput {
                data: self::data("types::Image"),
            },
        ),
        field(
            "camera",
            CycleBinding::Parameter {
                access: camera,
                data,
            },
        ),
        field("hardware", CycleBinding::HardwareInterface),
    ];
    receiver.outputs = vec![field("captured_at", OutputBinding::CaptureTime)];
    receiver.cycle_bounds = vec![Interface {
        path: "hardware::CameraInterface".to_owned(),
        reading: Some(true),
        acting: false,
        methods: None,
    }];

    let mut detection = node("vision::ball_detection", "BallDetection", false);
    detection.cycle = vec![
        field("image", own("image", "types::Image", 0)),
        field(
            "matrix",
            CycleBinding::RequiredOutputOf {
                instance: CONTROL,
                access: access("matrix?"),
                data: self::data("Option<types::CameraMatrix>"),
                producer: 2,
                checked: true,
            },
        ),
        field(
            "candidates",
            CycleBinding::AdditionalOutput {
                access: access("ball_candidates"),
                data: self::data("Vec<types::Ball>"),
            },
        ),
    ];
    detection.outputs = vec![output_field("balls", "Vec<types::Ball>")];
    Cycler {
        additional_outputs: Tree {
            branches: vec![Branch {
                name: "ball_candidates".to_owned(),
                content: Content::Leaf {
                    data: self::data("Vec<types::Ball>"),
                    users: vec![Writer {
                        node: "vision::ball_detection".to_owned(),
                    }],
                },
            }],
            open: false,
        },
        outputs: vec![
            output("balls", "Vec<types::Ball>", 1),
            output("image", "types::Image", 0),
        ],
        ..cycler(
            "Vision",
            CyclerKind::Perception,
            &["VisionTop", "VisionBottom"],
            vec![receiver, detection],
        )
    }
}

fn control() -> Cycler {
    let mut receiver = node("control::sensor_receiver", "SensorReceiver", true);
    receiver.outputs = vec![output_field("sensors", "types::Sensors")];
    receiver.cycle_bounds = vec![Interface {
        path: "hardware::SensorInterface".to_owned(),
        reading: Some(true),
        acting: false,
        methods: None,
    }];
    Cycler {
        states: Tree {
            branches: vec![Branch {
                name: "calibration".to_owned(),
                content: Content::Leaf {
                    data: data("types::Calibration"),
                    users: vec![
                        StateUse {
                            node: "control::ball_filter".to_owned(),
                            shared: false,
                        },
                        StateUse {
                            node: "control::head".to_owned(),
                            shared: true,
                        },
                    ],
                },
            }],
            open: false,
        },
        outputs: vec![
            output("ball", "Option<types::Ball>", 2),
            output("command", "types::Command", 1),
            output("matrix", "Option<types::CameraMatrix>", 2),
            output("sensors", "types::Sensors", 0),
        ],
        ..cycler(
            "Control",
            CyclerKind::RealTime,
            &["Control"],
            vec![receiver, head(), filter(), sender()],
        )
    }
}

fn head() -> Node {
    let mut head = node("control::head", "Head", false);
    head.cycle = vec![
        field("ball", own("ball", "Option<types::Ball>", 2)),
        field(
            "last_command",
            CycleBinding::Previous {
                access: access("command"),
                data: data("types::Command"),
                producer: 1,
                checked: true,
            },
        ),
        field("calibration", state("calibration", true)),
        field(
            "walk",
            CycleBinding::Procedure {
                name: "walk".to_owned(),
                request: data("types::Step"),
                response: data("bool"),
            },
        ),
    ];
    head.outputs = vec![output_field("command", "types::Command")];
    head
}

fn filter() -> Node {
    let mut filter = node("control::ball_filter", "BallFilter", false);
    filter.cycle = vec![
        field(
            "sensors",
            CycleBinding::Historic {
                access: access("sensors"),
                data: data("types::Sensors"),
                producer: 0,
                checked: true,
            },
        ),
        field(
            "balls",
            CycleBinding::Perception {
                instances: vec![TOP, BOTTOM],
                interleaved: true,
                access: access("balls"),
                data: data("Vec<types::Ball>"),
                producer: 1,
                checked: true,
            },
        ),
        field("calibration", state("calibration", false)),
        field("cycle_time", CycleBinding::CycleTime),
    ];
    filter.outputs = vec![
        output_field("ball", "Option<types::Ball>"),
        output_field("matrix", "Option<types::CameraMatrix>"),
    ];
    filter
}

fn sender() -> Node {
    let mut sender = node("control::command_sender", "CommandSender", false);
    sender.cycle = vec![
        field("command", own("command", "types::Command", 1)),
        field(
            "image",
            CycleBinding::Latest {
                instance: TOP,
                access: access("image"),
                data: data("types::Image"),
                producer: 0,
                checked: false,
            },
        ),
    ];
    sender.cycle_bounds = vec![Interface {
        path: "hardware::ActuatorInterface".to_owned(),
        reading: Some(false),
        acting: true,
        methods: None,
    }];
    sender
}

fn parameter_tree() -> Tree<Reader> {
    let reader = Reader {
        cycler: 0,
        node: "vision::image_receiver".to_owned(),
    };
    let tree = Tree {
        branches: vec![Branch {
            name: "camera".to_owned(),
            content: Content::Leaf {
                data: data("types::CameraPosition"),
                users: vec![reader],
            },
        }],
        open: false,
    };
    let instance = |name: &str| Branch {
        name: name.to_owned(),
        content: Content::Instance {
            cycler: 0,
            tree: tree.clone(),
        },
    };
    Tree {
        branches: vec![instance("vision_bottom"), instance("vision_top")],
        open: false,
    }
}

fn cycler(name: &str, kind: CyclerKind, instances: &[&str], nodes: Vec<Node>) -> Cycler {
    Cycler {
        name: name.to_owned(),
        left_out: false,
        remote: false,
        kind,
        instances: instances.iter().map(|name| instance(name)).collect(),
        nodes,
        outputs: Vec::new(),
        additional_outputs: Tree {
            branches: Vec::new(),
            open: false,
        },
        states: Tree {
            branches: Vec::new(),
            open: false,
        },
        on_failure: OnFailure::Stop,
        pending_timeout: Duration::from_secs(1),
        queue: 32,
        watchdog: Duration::from_millis(300),
        history: Duration::from_secs(1),
        lockstep_duration: None,
    }
}

fn instance(name: &str) -> Instance {
    let deadline = Some(Duration::from_millis(12));
    Instance {
        name: name.to_owned(),
        deadline,
        scheduling: Scheduling::default(),
        record: Record::default(),
    }
}

fn target(name: &str) -> Target {
    Target {
        name: name.to_owned(),
        hardware: format!("{name}::Hardware"),
        triple: None,
        cpu: None,
        profile: None,
        location: None,
    }
}

fn node(path: &str, type_name: &str, setup: bool) -> Node {
    Node {
        path: path.to_owned(),
        type_name: type_name.to_owned(),
        setup,
        on_failure: OnFailure::Stop,
        file: format!("{}.rs", path.replace("::", "/src/")).into(),
        summary: None,
        creation: Vec::new(),
        cycle: Vec::new(),
        outputs: Vec::new(),
        restores: false,
        new_bounds: Vec::new(),
        cycle_bounds: Vec::new(),
        restore_bounds: Vec::new(),
        markers: Vec::new(),
    }
}

fn field<B>(name: &str, binding: B) -> Field<B> {
    Field {
        name: name.to_owned(),
        binding,
        line: 7,
        range: 0..0,
    }
}

fn output_field(name: &str, text: &str) -> Field<OutputBinding> {
    field(name, OutputBinding::MainOutput { data: data(text) })
}

fn output(name: &str, text: &str, producer: usize) -> Output {
    Output {
        name: name.to_owned(),
        data: data(text),
        producer,
        in_place: false,
        shared: false,
        historic: false,
        previous: false,
    }
}

fn own(path: &str, text: &str, producer: usize) -> CycleBinding {
    CycleBinding::OwnOutput {
        access: access(path),
        data: data(text),
        producer,
        checked: true,
    }
}

fn state(path: &str, shared: bool) -> CycleBinding {
    CycleBinding::CyclerState {
        access: access(path),
        data: data("types::Calibration"),
        shared,
    }
}

fn data(text: &str) -> DataType {
    DataType {
        text: text.to_owned(),
        resolved: true,
    }
}

fn access(written: &str) -> Access {
    let segments = written.split('.').map(|segment| Segment {
        name: segment.trim_end_matches('?').to_owned(),
        optional: segment.ends_with('?'),
        instance: false,
    });
    Access {
        segments: segments.collect(),
        written: written.to_owned(),
    }
}
