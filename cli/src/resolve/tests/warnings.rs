//! What is allowed but probably not meant.

use super::{ACTS, two_cyclers, with_field, writes};
use crate::scan::fixture::{Fixture, Node, cycler};

#[test]
fn outputs_that_nobody_reads_are_told_in_the_manifest() {
    let fixture = Fixture::control(&["a"]).node("a", writes("x: MainOutput<u8>,"));
    fixture.expect(
        "unread-outputs",
        &[
            "nobody reads what `nodes::a` writes in cycler `Control`",
            "hulk.toml:7:",
        ],
    );
}

#[test]
fn a_setup_node_is_there_to_pace_its_cycler() {
    let paced = |nodes: &[&str]| {
        Fixture::new(&cycler("Control", "real-time", "", &["pace"], nodes))
            .node("pace", writes("x: MainOutput<u8>,"))
            .node("think", writes("y: MainOutput<u8>,"))
    };
    paced(&[]).robot();
    let told = "nobody reads what `nodes::think` writes";
    paced(&["think"]).expect("unread-outputs", &[told]);
}

#[test]
fn a_cycler_that_nothing_paces_is_told() {
    let target = "[[target]]\nname = \"bench\"\nhardware = \"hardware::Hardware\"\n";
    let robot = |setup: &[&str], nodes: &[&str], more: &str, target: &str| {
        let control = cycler("Control", "real-time", "", &[], &["a"]);
        let lonely = cycler("Lonely", "perception", more, setup, nodes);
        let reads = Node {
            cycle: "hardware: HardwareInterface, x: LatestInput<u8, \"Lonely\", \"x\">,",
            ..ACTS
        };
        Fixture::new(&format!("{control}{lonely}{target}"))
            .node("a", reads)
            .node("b", writes("x: MainOutput<u8>,"))
    };
    robot(&[], &["b"], "", target).expect(
        "unpaced-cycler",
        &[
            "nothing paces cycler `Lonely`",
            "hulk.toml:",
            "its `setup_nodes`",
        ],
    );
    robot(&["b"], &[], "", target).robot();
    robot(&[], &["b"], "remote = true", target).robot();
    robot(&[], &["b"], "", "").robot();
}

#[test]
fn who_acts_through_a_supertrait_is_there_for_that() {
    let asking = |definitions: &str| {
        let hardware = format!(
            "pub struct Hardware; pub trait Eyes {{ fn look(&self) -> f32; }}
             pub trait Wheels {{ fn turn(&self, speed: f32) -> Result<()>; }} {definitions}"
        );
        let node = Node {
            cycle: "hardware: HardwareInterface,",
            asks: "hardware::Body",
            ..writes("x: MainOutput<u8>,")
        };
        Fixture::new(&cycler("Control", "real-time", "", &[], &["a"]))
            .node("a", node)
            .file("crates/hardware/src/lib.rs", &hardware)
            .answer()
    };
    for acts in [
        "pub trait Body: Eyes + Wheels {}",
        "pub trait Body: Wheels { fn look(&self) -> f32; }",
        "pub trait Body: Eyes + Limbs {} pub trait Limbs: Wheels {}",
        "pub trait Body: Eyes { fn turn(&self, speed: f32); }",
        "pub trait Body: framework::Elsewhere { fn look(&self) -> f32; }",
        "pub trait Body where Self: Wheels { fn look(&self) -> f32; }",
        "pub trait Body: std::io::Write { fn look(&self) -> f32; }",
        "pub trait Body: Fn(f32) { fn look(&self) -> f32; }",
        "pub trait Body: Eyes + Legs<()> {} pub trait Legs<T> { fn turn(&self, speed: f32) -> T; }",
        "pub trait Body: Eyes + Legs<()> {} pub trait Legs<T> { fn turn(&self) -> Result<T>; }",
        "pub trait Body: Eyes + Legs<A = ()> {} pub trait Legs { type A; fn turn(&self) -> Self::A; }",
    ] {
        let answer = asking(acts);
        assert!(
            !answer.codes.contains(&"unread-outputs"),
            "{acts}: {}",
            answer.text
        );
    }
    for reads in [
        "pub trait Body: Eyes + Send {}",
        "pub trait Body: Eyes + std::fmt::Debug { fn listen(&self) -> f32; }",
        "pub trait Body: Clone + std::any::Any where Self: Eyes + PartialEq, u8: Into<u16> {}",
        "pub trait Body<T = u8> { fn look(&self) -> Option<T>; fn copy(&self) -> Self; }",
    ] {
        let answer = asking(reads);
        assert!(
            answer.codes.contains(&"unread-outputs"),
            "{reads}: {}",
            answer.text
        );
    }
}

#[test]
fn a_state_of_one_node_is_told() {
    with_field(
        Fixture::control(&["a"]),
        "a",
        "x: CyclerState<u8, \"count\">",
    )
    .expect(
        "state-of-one-node",
        &["only `nodes::a` uses the cycler state `count`", "a.rs:15"],
    );
}

#[test]
fn a_state_that_is_not_stored_needs_restore() {
    let skips = Node {
        state: "#[serde(skip)] cache: Vec<u8>,",
        ..ACTS
    };
    Fixture::control(&["a"]).node("a", skips).expect(
        "state-not-restorable",
        &["`cache` of `Node` is not recorded"],
    );
    let restores = "pub fn restore(&mut self, context: CreationContext) -> Result<()> {}";
    Fixture::control(&["a"])
        .node(
            "a",
            Node {
                more: restores,
                ..skips
            },
        )
        .robot();
    let reading = "pub fn restore(&mut self, context: CreationContext<impl hardware::Camera>) -> Result<()> {}";
    let reads = Node {
        more: reading,
        creation: "hardware: HardwareInterface,",
        ..skips
    };
    let fixture = Fixture::control(&["a"]).node("a", reads);
    let text = fixture.text("crates/nodes/src/a.rs");
    let text = text.replace(
        "new(context: CreationContext)",
        "new(context: CreationContext<impl hardware::Camera>)",
    );
    fixture.file("crates/nodes/src/a.rs", &text).expect(
        "state-not-restorable",
        &["`restore` reads from the hardware: `hardware::Camera`"],
    );
}

#[test]
fn reading_the_hardware_outside_of_setup_is_told() {
    let reads = Node {
        asks: "hardware::Camera",
        outputs: "x: MainOutput<u8>,",
        ..ACTS
    };
    let fixture = |manifest: &str| {
        let fixture = Fixture::new(manifest).node("a", reads);
        with_field(fixture, "b", "x: PreviousInput<u8, \"x\">")
    };
    fixture(&cycler("Control", "real-time", "", &["a"], &["b"])).robot();
    fixture(&cycler("Control", "real-time", "", &[], &["a", "b"])).expect(
        "hardware-read-outside-setup",
        &["`hardware::Camera`", "this is not recorded"],
    );
}

/// A node that asks for `Drive` of a crate that also says this.
fn asks_to_drive(definitions: &str) -> Fixture {
    let node = Node {
        cycle: "hardware: HardwareInterface,",
        asks: "hardware::Drive",
        ..Node::default()
    };
    let hardware = format!("pub struct Hardware; {definitions}");
    Fixture::control(&["a"])
        .node("a", node)
        .file("crates/hardware/src/lib.rs", &hardware)
}

#[test]
fn a_trait_that_nothing_can_stand_in_for_is_told() {
    let asking = |definition: &str| {
        asks_to_drive(&format!(
            "pub trait Wheels {{ fn turn(&self); }} {definition}"
        ))
    };
    asking("pub trait Drive: Send { fn drive(&self, speed: f32) -> Result<()>; }").robot();
    for definition in [
        "pub trait Drive: Wheels { fn drive(&self); }",
        "pub trait Drive { type Unit; fn drive(&self); }",
        "pub trait Drive { fn drive<T>(&self, value: T); }",
    ] {
        asking(definition).expect(
            "not-replayable",
            &["`hardware::Drive`", "`Control` is not replayed"],
        );
    }
}

#[test]
fn a_lifetime_that_a_method_declares_is_what_keeps_a_trait_from_replays() {
    let asking = |method: &str| {
        asks_to_drive(&format!(
            "pub struct Line<'a>(pub &'a str); pub trait Drive {{ {method} }}"
        ))
    };
    for declared in [
        "fn say<'a>(&self, line: Line<'a>);",
        "fn say<'a>(&self, text: &'a str);",
    ] {
        asking(declared).expect(
            "not-replayable",
            &["declare neither types nor lifetimes: `text: &str`, `line: Line<'_>`"],
        );
    }
    for (plain, signature) in [
        ("fn say(&self, line: Line<'_>);", "line: hardware::Line<'_>"),
        ("fn say(&self, text: &str);", "text: &str"),
    ] {
        let robot = asking(plain).robot();
        let methods = robot.cyclers[0].nodes[0].cycle_bounds[0].methods.clone();
        let methods = methods.expect("something can stand in");
        assert!(methods[0].signature.contains(signature), "{methods:?}");
    }
}

#[test]
fn an_actuator_that_may_take_a_default_is_told() {
    let fixture = |output: &str, field: &str| {
        let output = format!("command: MainOutput<{output}>,");
        with_field(
            Fixture::control(&["a", "b"]).node("a", writes(&output)),
            "b",
            field,
        )
    };
    fixture("u8", "x: Input<u8, \"command\">").expect(
        "actuator-takes-default",
        &[
            "`nodes::b` may receive a `command` that nobody computed",
            "acts through `hardware::Motors`",
        ],
    );
    fixture("Option<u8>", "x: RequiredInput<Option<u8>, \"command?\">").robot();
    fixture("Option<u8>", "x: Input<Option<u8>, \"command\">").robot();
}

#[test]
fn a_measurement_that_may_be_a_default_is_told() {
    let fixture = |data: &str| {
        let vision = "[[cycler]]\nname = \"Vision\"\nkind = \"perception\"\n\
                      nodes = [{ node = \"nodes::eye\", on_failure = \"skip\" }]\n";
        let control = cycler("Control", "real-time", "", &[], &["hand"]);
        let output = format!("x: MainOutput<{data}>,");
        let fixture = Fixture::new(&format!("{vision}{control}")).node("eye", writes(&output));
        with_field(
            fixture,
            "hand",
            &format!("x: PerceptionInput<{data}, \"Vision\", \"x\">"),
        )
    };
    fixture("u8").expect(
        "measurement-takes-default",
        &["`x` is a default when `nodes::eye` fails"],
    );
    fixture("Option<u8>").robot();
}

#[test]
fn a_warning_is_silenced_with_a_reason_at_its_line() {
    let field = |comment: &str| {
        with_field(
            Fixture::control(&["a"]),
            "a",
            &format!("{comment}\nx: CyclerState<u8, \"count\">"),
        )
    };
    field("// hulkgen: allow(state-of-one-node) read by a tool").robot();
    field("// hulkgen: allow(state-of-one-node)").expect("state-of-one-node", &[]);
    field("// hulkgen: allow(unread-outputs) for people").expect("state-of-one-node", &[]);
}

#[test]
fn a_node_that_someone_reads_is_not_told() {
    with_field(
        two_cyclers(),
        "hand",
        "x: PerceptionInput<Option<Ball>, \"VisionTop\", \"ball\">",
    )
    .robot();
}

/// A real-time cycler that records while this is true, and its one node.
fn recorded_while(path: &str) -> Fixture {
    let record = format!("record = {{ while = \"{path}\" }}");
    Fixture::new(&cycler("Control", "real-time", &record, &[], &["a"])).node(
        "a",
        writes(
            "is_playing: MainOutput<bool>, ball: MainOutput<Option<Ball>>, mode: MainOutput<Mode>,",
        ),
    )
    .file("crates/types/src/lib.rs", MODES)
    .file(
        "crates/types/Cargo.toml",
        "[package]\nname = \"types\"\n[dependencies]\nnalgebra = \"0.35\"\n",
    )
}

const MODES: &str = "
    pub struct Ball { pub x: f32 }
    #[derive(Deserialize)]
    #[serde(rename_all = \"camelCase\")]
    pub struct Mode {
        pub is_playing: bool,
        pub place: nalgebra::Point2<f32>,
        half: Half,
        #[serde(with = \"by_hand\")]
        pub odd: u8,
    }
    #[derive(Deserialize)]
    pub struct Half { first: Option<bool>, #[serde(rename = \"2nd\")] second: bool }
";

#[test]
fn an_output_that_says_what_is_recorded_is_read() {
    recorded_while("is_playing").robot();
    recorded_while("Control.is_playing").robot();
    // By the names of serde, as the robot looks for it.
    for path in ["mode.isPlaying", "Control.mode.half.2nd", "mode.odd.on"] {
        recorded_while(path).robot();
    }
}

#[test]
fn what_is_recorded_is_asked_of_an_output_that_is_there_and_a_bool() {
    for (path, code, parts) in [
        (
            "is_plaing",
            "unknown-output",
            ["`Control` writes `is_plaing`", "did you mean `is_playing`?"],
        ),
        (
            "Contrl.is_playing",
            "unknown-instance",
            ["there is no instance `Contrl`", "did you mean `Control`?"],
        ),
        (
            "ball",
            "type-mismatch",
            ["`ball` is no `bool`", "`ball` is `Option<types::Ball>`"],
        ),
        (
            "mode.is_playing",
            "type-mismatch",
            [
                "`types::Mode` has no part `is_playing`",
                "did you mean `isPlaying`?",
            ],
        ),
        (
            "mode.half.first",
            "type-mismatch",
            ["`mode.half.first` is no `bool`", "`mode` is `types::Mode`"],
        ),
        (
            "mode.place.x",
            "type-mismatch",
            ["`mode.place.x` is no `bool`", "`mode` is `types::Mode`"],
        ),
    ] {
        recorded_while(path).expect(code, &parts);
    }
}
