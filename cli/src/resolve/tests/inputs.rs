//! Outputs, instances, kinds, setup nodes.

use camino::Utf8Path;

use super::{ACTS, two_cyclers, with_field, writes};
use crate::diagnostics::Diagnostics;
use crate::pipeline;
use crate::resolve::robot::{CycleBinding, InstanceId, OutputBinding};
use crate::scan::fixture::{Fixture, Node, cycler};
use crate::workspace::Workspace;

#[test]
fn an_input_may_be_called_like_a_keyword() {
    let fields = "r#type: Input<Option<u8>, \"x\">,\nr#match: CycleTime";
    let writer = Fixture::control(&["a", "b"]).node("a", writes("x: MainOutput<Option<u8>>,"));
    let fixture = with_field(writer, "b", fields);
    let robot = fixture.robot();
    let names = robot.cyclers[0].nodes[1].cycle.iter();
    let names: Vec<&str> = names.map(|field| field.name.as_str()).collect();
    assert_eq!(names, ["r#type", "r#match", "hardware"]);
    let workspace = Workspace::in_memory(fixture.files());
    let files = pipeline::generate(&workspace, &mut Diagnostics::new()).expect("it has no errors");
    let cycler = &files[Utf8Path::new("generated/src/cyclers/control.rs")];
    assert!(
        cycler.contains("r#type: ") && cycler.contains("r#match: "),
        "{cycler}"
    );
}

#[test]
fn every_field_is_bound() {
    let fields = "a: Input<Option<Ball>, \"VisionTop\", \"ball\">,\n\
        b: LatestInput<Option<f32>, \"VisionBottom\", \"ball?.x\">,\n\
        c: PerceptionInput<Option<Ball>, \"Vision\", \"ball\">,\n\
        d: RequiredInput<Option<Ball>, \"VisionTop\", \"ball?\">,\n\
        e: PreviousInput<u8, \"x\">,\nf: HistoricInput<u8, \"x\">,\ng: CycleTime,\n\
        h: Procedure<u8, Ball, \"kick\">,\n\
        i: AdditionalOutput<Vec<Ball>, \"seen.$cycler_instance\">,\nx: MainOutput<u8>";
    let robot = with_field(two_cyclers(), "hand", fields).robot();
    let hand = &robot.cyclers[1].nodes[0];
    let named: Vec<&str> = hand.cycle.iter().map(|field| field.name.as_str()).collect();
    assert_eq!(
        named,
        ["a", "b", "c", "d", "e", "f", "g", "h", "i", "x", "hardware"]
    );
    assert_eq!(hand.cycle[0].line, 15);
    let top = InstanceId {
        cycler: 0,
        instance: 0,
    };
    let CycleBinding::OutputOf {
        instance,
        producer: 0,
        checked: true,
        ..
    } = &hand.cycle[0].binding
    else {
        panic!("{:?}", hand.cycle[0]);
    };
    assert_eq!(*instance, top);
    let CycleBinding::Latest {
        access,
        data,
        checked: true,
        ..
    } = &hand.cycle[1].binding
    else {
        panic!("{:?}", hand.cycle[1]);
    };
    assert_eq!(
        (access.written.as_str(), data.text.as_str()),
        ("ball?.x", "Option<f32>")
    );
    let CycleBinding::Perception {
        instances,
        interleaved: true,
        ..
    } = &hand.cycle[2].binding
    else {
        panic!("{:?}", hand.cycle[2]);
    };
    assert_eq!(instances.len(), 2);
    assert!(
        matches!(&hand.cycle[7].binding, CycleBinding::Procedure { name, .. } if name == "kick")
    );
    let ball = &robot.cyclers[0].outputs[0];
    assert!(ball.shared && !ball.historic && !ball.previous && !ball.in_place);
    let x = &robot.cyclers[1].outputs[0];
    assert!(x.historic && x.previous && x.in_place && !x.shared);
    assert_eq!(robot.left_to_rustc, 0);
    let crates: Vec<&str> = robot.crates.iter().map(|one| one.name.as_str()).collect();
    assert_eq!(crates, ["framework", "hardware", "nodes", "serde", "types"]);
}

#[test]
fn durations_and_counts_have_their_defaults() {
    let vision = cycler(
        "Vision",
        "perception",
        "pending_timeout = \"2s\"\ndeadline = \"30ms\"",
        &[],
        &["eye"],
    );
    let control = cycler(
        "Control",
        "real-time",
        "on_failure = \"hold\"",
        &[],
        &["hand"],
    );
    let fixture = Fixture::new(&(vision + &control)).node("eye", ACTS).node(
        "hand",
        Node {
            outputs: "x: MainOutput<u8>,",
            ..ACTS
        },
    );
    let robot = fixture.robot();
    let control = &robot.cyclers[1];
    assert_eq!(
        (
            control.queue,
            control.watchdog.as_millis(),
            control.history.as_secs()
        ),
        (32, 300, 2)
    );
    assert_eq!(
        robot.cyclers[0].instances[0]
            .deadline
            .map(|one| one.as_millis()),
        Some(30)
    );
    assert!(control.outputs[0].previous, "its node holds");
    assert!(matches!(
        control.nodes[0].outputs[0].binding,
        OutputBinding::MainOutput { .. }
    ));
}

#[test]
fn an_unknown_instance_is_told_with_the_nearest() {
    let misspelled = with_field(
        two_cyclers(),
        "hand",
        "x: Input<Option<Ball>, \"VisionTpo\", \"ball\">",
    );
    misspelled.expect(
        "unknown-instance",
        &["no instance `VisionTpo`", "`VisionTop`?", "hand.rs:15:24"],
    );
    let of_cycler = with_field(
        two_cyclers(),
        "hand",
        "x: Input<Option<Ball>, \"Vision\", \"ball\">",
    );
    of_cycler.expect(
        "unknown-instance",
        &["is a cycler; name one of its instances: `VisionBottom` and `VisionTop`"],
    );
}

#[test]
fn an_unknown_output_is_told_with_the_deed() {
    let control = || Fixture::control(&["a", "b"]).node("a", writes("ball: MainOutput<u8>,"));
    with_field(control(), "b", "x: Input<u8, \"bal\">")
        .answer()
        .expect_error(
            "unknown-output",
            &[
                "no node of cycler `Control` writes `bal`",
                "did you mean `ball`?",
            ],
        );
    with_field(two_cyclers(), "hand", "x: Input<Option<Ball>, \"ball\">")
        .answer()
        .expect_error(
            "unknown-output",
            &["`nodes::eye` writes it in cycler `Vision`"],
        );
    with_field(control(), "b", "x: Input<u8, \"hidden\">")
        .node("unlisted", writes("hidden: MainOutput<u8>,"))
        .answer()
        .expect_error(
            "unknown-output",
            &["`nodes::unlisted` writes it; add it to the nodes of `Control`"],
        );
    let setup = "`nodes::unlisted` writes it; add it to the `setup_nodes` of `Control`";
    let reading = Node {
        cycle: "hardware: HardwareInterface,",
        asks: "hardware::Camera",
        ..writes("hidden: MainOutput<u8>,")
    };
    for unlisted in [
        writes("hidden: MainOutput<u8>, time: CaptureTime,"),
        reading,
    ] {
        with_field(control(), "b", "x: Input<u8, \"hidden\">")
            .node("unlisted", unlisted)
            .answer()
            .expect_error("unknown-output", &[setup]);
    }
    let manifest = cycler("Control", "real-time", "", &["a"], &[]);
    with_field(Fixture::new(&manifest), "a", "x: Input<u8, \"hidden\">")
        .node("unlisted", writes("hidden: MainOutput<u8>,"))
        .answer()
        .expect_error("unknown-output", &[setup]);
    let additional = Node {
        cycle: "extra: AdditionalOutput<u8, \"extra\">,",
        ..writes("ball: MainOutput<u8>,")
    };
    with_field(
        Fixture::control(&["a", "b"]).node("a", additional),
        "b",
        "x: Input<u8, \"extra\">",
    )
    .answer()
    .expect_error("unknown-output", &["is an additional output"]);
    with_field(
        two_cyclers(),
        "hand",
        "x: LatestInput<Option<f32>, \"VisionTop\", \"ball?.z\">",
    )
    .answer()
    .expect_error("unknown-output", &["has no field `z`"]);
}

#[test]
fn two_nodes_cannot_write_one_output() {
    let fixture = Fixture::control(&["a", "b"])
        .node("a", writes("ball: MainOutput<u8>,"))
        .node(
            "b",
            Node {
                cycle: "ball: MainOutput<u8>,",
                ..writes("")
            },
        );
    fixture.answer().expect_error(
        "duplicate-output",
        &[
            "two nodes of cycler `Control` write `ball`",
            "written by `nodes::b`",
            "and by `nodes::a`",
        ],
    );
}

#[test]
fn one_node_cannot_declare_an_output_twice() {
    let node = Node {
        cycle: "ball: MainOutput<u8>,",
        ..writes("ball: MainOutput<u8>,")
    };
    let fixture = Fixture::control(&["a"]).node("a", node);
    fixture.answer().expect_error(
        "duplicate-output",
        &[
            "`nodes::a` declares the output `ball` twice",
            "declared here, too",
            "rename one of the two fields, or remove it",
        ],
    );
}

#[test]
fn kinds_of_real_time_cyclers_mean_nothing_elsewhere() {
    for field in [
        "x: HistoricInput<u8, \"y\">",
        "x: PerceptionInput<u8, \"Vision\", \"y\">",
    ] {
        let fixture = Fixture::new(&cycler("Vision", "perception", "", &[], &["a"]));
        let cycle = format!("{field},\ny: MainOutput<u8>,\nhardware: HardwareInterface,");
        fixture
            .node(
                "a",
                Node {
                    cycle: &cycle,
                    ..ACTS
                },
            )
            .expect(
                "misplaced-kind",
                &["no meaning in the perception cycler `Vision`"],
            );
    }
    let manifest =
        cycler("A", "real-time", "", &[], &["a"]) + &cycler("B", "real-time", "", &[], &["b"]);
    let fixture = Fixture::new(&manifest).node(
        "a",
        Node {
            outputs: "y: MainOutput<u8>,",
            ..ACTS
        },
    );
    with_field(fixture, "b", "x: PerceptionInput<u8, \"A\", \"y\">").expect(
        "misplaced-kind",
        &["`A` is no instance of a perception cycler"],
    );
}

#[test]
fn an_instance_does_not_read_itself_by_name() {
    let fixture = with_field(
        Fixture::control(&["a"]),
        "a",
        "x: Input<u8, \"Control\", \"y\">,\ny: MainOutput<u8>",
    );
    fixture.expect(
        "misplaced-kind",
        &["reads its own instance", "PreviousInput<T, \"y\">"],
    );
}

#[test]
fn setup_nodes_have_only_what_is_there_before_the_cycle() {
    let setup = |field: &str| {
        let manifest = cycler("Control", "real-time", "", &["first", "a"], &["later"]);
        let fixture = Fixture::new(&manifest)
            .node(
                "first",
                Node {
                    outputs: "early: MainOutput<u8>,",
                    ..ACTS
                },
            )
            .node(
                "later",
                Node {
                    outputs: "late: MainOutput<u8>,",
                    ..ACTS
                },
            );
        with_field(fixture, "a", field)
    };
    setup("x: Input<u8, \"early\">").robot();
    setup("x: Input<u8, \"late\">").expect(
        "setup-order",
        &[
            "which is written after it",
            "`nodes::later` is no setup node",
        ],
    );
    for field in [
        "x: CycleTime",
        "x: PreviousInput<u8, \"early\">",
        "x: Input<u8, \"Control\", \"early\">",
    ] {
        setup(field).expect("misplaced-kind", &["has no meaning in a setup node"]);
    }
}

#[test]
fn a_cycler_has_one_capture_time_from_a_setup_node() {
    let time = Node {
        outputs: "at: CaptureTime,",
        ..ACTS
    };
    let two = Fixture::new(&cycler("Control", "real-time", "", &["a", "b"], &["c"]));
    two.node("a", time).node("b", time).node("c", ACTS).expect(
        "capture-time",
        &["has two capture times", "given by `nodes::b`"],
    );
    Fixture::control(&["a"])
        .node("a", time)
        .expect("capture-time", &["is no setup node"]);
}

#[test]
fn a_procedure_has_one_answer() {
    let fixture = with_field(
        Fixture::control(&["a", "b"]),
        "a",
        "x: Procedure<u8, u8, \"walk\">",
    );
    with_field(fixture, "b", "x: Procedure<u8, u8, \"walk\">").expect(
        "duplicate-procedure",
        &["answer the procedure `walk`", "answered by `nodes::b`"],
    );
}

#[test]
fn a_target_has_hardware_of_the_workspace() {
    let target = |hardware: &str| {
        let target = format!("[[target]]\nname = \"sim\"\nhardware = \"{hardware}\"\n");
        Fixture::new(&(cycler("Control", "real-time", "", &[], &["a"]) + &target)).node("a", ACTS)
    };
    let robot = target("hardware::Hardware").robot();
    assert_eq!(robot.targets[0].hardware, "hardware::Hardware");
    target("hadrware::Hardware")
        .expect("unknown-hardware", &["did you mean `hardware::Hardware`?"]);
    target("hardware::Hardwear")
        .expect("unknown-hardware", &["did you mean `hardware::Hardware`?"]);
    let shared = "[workspace]\nmembers = [\"crates/*\"]\n[workspace.dependencies]\nnao = \"1\"\n";
    let robot = target("nao::Hardware").file("Cargo.toml", shared).robot();
    let nao = robot
        .crates
        .iter()
        .find(|one| one.name == "nao")
        .expect("it is named");
    assert_eq!(
        (nao.requirement.as_str(), nao.targets.as_slice()),
        ("{ workspace = true }", &["sim".to_owned()][..])
    );
}

#[test]
fn private_traits_and_types_cannot_be_named_by_generated_code() {
    let secret = Node {
        asks: "hardware::Secret",
        ..ACTS
    };
    Fixture::control(&["a"])
        .node("a", secret)
        .expect("not-public", &["`hardware::Secret` is private"]);
    let own = Node {
        head: "struct Own;",
        outputs: "x: MainOutput<Own>,",
        ..ACTS
    };
    Fixture::control(&["a"]).node("a", own).expect(
        "not-public",
        &["`nodes::a::Own` is private", "used by `nodes::a`"],
    );
}

#[test]
fn a_path_into_a_type_that_doubles_is_left_to_rustc() {
    let types = "pub struct P<T> { pub v: T, pub n: Option<Box<P<(T, T)>>> }";
    let writer = Fixture::control(&["a", "b"])
        .file("crates/types/src/lib.rs", types)
        .node("a", writes("p: MainOutput<P<f32>>,"));
    let field = format!("x: Input<Option<f32>, \"p.{}v\">", "n?.".repeat(40));
    let answer = with_field(writer, "b", &field).answer();
    let robot = answer.robot.expect(&answer.text);
    assert_eq!(robot.left_to_rustc, 1);
}

#[test]
fn no_more_instances_take_every_cycle_than_a_slot_can_mark() {
    let vision = cycler("Vision", "perception", "", &[], &["eye"]);
    let read = |count: usize| {
        let instances: Vec<String> = (0..count).map(|number| number.to_string()).collect();
        let instances = format!("instances = {instances:?}");
        let control = cycler("Control", "real-time", &instances, &[], &["hand"]);
        let fixture = Fixture::new(&format!("{vision}{control}"));
        let fixture = fixture.node(
            "eye",
            writes("ball: MainOutput<f32>, point: MainOutput<f32>,"),
        );
        let balls = "balls: PerceptionInput<f32, \"Vision\", \"ball\">";
        let points = "points: PerceptionInput<f32, \"Vision\", \"point\">";
        with_field(fixture, "hand", &format!("{balls}, {points}"))
    };
    read(20).robot();
    let parts = [
        "21 instances take every cycle of `Vision`, and at most 20 can",
        "hulk.toml:4:8",
        "write `LatestInput`",
    ];
    read(21).expect("invalid-value", &parts);
}

#[test]
fn inside_of_a_node_names_have_every_letter() {
    let node = Node {
        cycle: "hardware: HardwareInterface, müde: CyclerState<u8, \"müde.seit\">,
            maß: Parameter<f32, \"größe.maß\">, frage: Procedure<u8, u8, \"prüfe\">,",
        outputs: "größe: MainOutput<Option<f32>>,",
        ..ACTS
    };
    let fixture = Fixture::control(&["a", "b"])
        .node("a", node)
        .file("parameters/default.toml", "[\"größe\"]\n\"maß\" = 1.0\n");
    let text = fixture.text("crates/nodes/src/a.rs");
    let text = text.replace("Node", "Fühler");
    let fixture = fixture.file("crates/nodes/src/a.rs", &text);
    let reads = "x: RequiredInput<Option<f32>, \"größe?\">, y: CyclerState<&u8, \"müde.seit\">";
    let robot = with_field(fixture, "b", reads).robot();
    let schedule =
        crate::schedule::schedule(&robot, &mut Diagnostics::new()).expect("it has an order");
    let files = crate::render::render(&crate::model::describe(&robot, &schedule));
    let text = &files[camino::Utf8Path::new("generated/src/cyclers/control.rs")];
    for part in ["Fühler", "frame.own.größe", "frame.parameters.größe.maß"] {
        assert!(text.contains(part), "{part}\n{text}");
    }
}
