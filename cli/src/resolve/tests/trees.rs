//! Parameters, cycler states, additional outputs.

use super::{ACTS, with_field};
use crate::resolve::robot::{Content, Tree};
use crate::scan::fixture::{Fixture, Node, cycler};

/// Paths of a tree with their types.
fn leaves<U>(tree: &Tree<U>) -> Vec<String> {
    let branches = tree.branches.iter();
    branches
        .flat_map(|branch| match &branch.content {
            Content::Leaf { data, users } => {
                vec![format!("{}: {} {}", branch.name, data.text, users.len())]
            }
            Content::Inner(tree) => leaves(tree)
                .iter()
                .map(|leaf| format!("{}.{leaf}", branch.name))
                .collect(),
            Content::Instance { cycler, tree } => leaves(tree)
                .iter()
                .map(|leaf| format!("{}#{cycler}.{leaf}", branch.name))
                .collect(),
        })
        .collect()
}

/// Nodes `a` and `b` with these fields.
fn two(a: &str, b: &str) -> Fixture {
    with_field(with_field(Fixture::control(&["a", "b"]), "a", a), "b", b)
}

#[test]
fn parameters_make_one_tree_with_instances() {
    let vision = cycler(
        "Vision",
        "perception",
        "instances = [\"Top\", \"Bottom\"]",
        &[],
        &["eye"],
    );
    let control = cycler("Control", "real-time", "", &[], &["hand"]);
    let eye = Node {
        creation: "p: Parameter<u8, \"$cycler_instance.pitch\">,\nq: Parameter<Side, \"side\">,\n\
                   r: Parameter<Ball, \"filter.$cycler_instance\">,",
        ..ACTS
    };
    let fixture = Fixture::new(&(vision + &control)).node("eye", eye);
    let hand = "a: Parameter<Wrapper<u8>, \"walk.step\">,\nb: Parameter<u8, \"walk.step.value\">,\n\
        c: Parameter<Option<u8>, \"maybe?\">,\nd: Parameter<Side, \"side\">,\ne: Parameter<u8, \"vision_top.pitch\">";
    let fixture = with_field(fixture, "hand", hand).file(
        "parameters/default.toml",
        "side = \"Left\"\nvision_top.pitch = 1\nvision_bottom.pitch = 2\n\
         [walk.step]\nvalue = 1\n[filter.vision_top]\n[filter.vision_bottom]\n",
    );
    assert_eq!(
        leaves(&fixture.robot().parameter_tree),
        [
            "filter.vision_bottom: types::Ball 1",
            "filter.vision_top: types::Ball 1",
            "maybe: Option<u8> 1",
            "side: types::Side 2",
            "vision_bottom#0.pitch: u8 1",
            "vision_top#0.pitch: u8 2",
            "walk.step: types::Wrapper<u8> 1",
        ]
    );
}

#[test]
fn units_and_ranges_stand_at_a_field_that_reads_the_parameter() {
    let eye = Node {
        creation: "#[reflect(unit = \"px\")]\np: Parameter<u8, \"$cycler_instance.pitch\">,",
        ..ACTS
    };
    let vision = cycler(
        "Vision",
        "perception",
        "instances = [\"Top\", \"Bottom\"]",
        &[],
        &["eye"],
    );
    let control = cycler("Control", "real-time", "", &[], &["hand", "foot"]);
    let fixture = Fixture::new(&(vision + &control)).node("eye", eye);
    let hand = "#[reflect(range = -1..=2.50)]\na: Parameter<f32, \"walk.step\">,\nb: Parameter<u8, \"plain\">";
    let fixture = with_field(fixture, "hand", hand);
    let foot = "#[reflect(unit = \"m\", range = -1.0..=2.5)]\na: Parameter<f32, \"walk.step\">";
    let fixture = with_field(fixture, "foot", foot);
    let file = |step: &str| {
        let text = format!(
            "plain = 1\nwalk.step = {step}\nvision_top.pitch = 1\nvision_bottom.pitch = 2\n"
        );
        fixture.clone().file("parameters/default.toml", &text)
    };
    let hints = file("2.5").robot().parameter_hints;
    let hints: Vec<_> = hints
        .iter()
        .map(|(path, it)| {
            (
                path.as_str(),
                it.unit.as_deref(),
                it.range.as_deref(),
                it.creation_only,
            )
        })
        .collect();
    assert_eq!(
        hints,
        [
            ("vision_bottom.pitch", Some("px"), None, true),
            ("vision_top.pitch", Some("px"), None, true),
            ("walk.step", Some("m"), Some("-1..=2.5"), false),
        ]
    );
    file("2.6").expect(
        "mistyped-parameter",
        &["`walk.step` is 2.6, not within -1..=2.5"],
    );
}

#[test]
fn units_and_ranges_are_said_once_and_where_the_type_is() {
    two(
        "#[reflect(unit = \"m\")]\nx: Parameter<f32, \"a\">",
        "#[reflect(unit = \"mm\")]\nx: Parameter<f32, \"a\">",
    )
    .expect(
        "parameter-conflict",
        &[
            "two nodes say different things about the parameter `a`",
            "`mm`",
            "`m`",
        ],
    );
    two(
        "x: Parameter<Wrapper<u8>, \"a\">",
        "#[reflect(unit = \"m\")]\nx: Parameter<u8, \"a.value\">",
    )
    .expect(
        "parameter-conflict",
        &[
            "`a.value` is a part of the parameter `a`",
            "move `#[reflect(…)]`",
        ],
    );
}

#[test]
fn clashing_parameters_show_both_places() {
    two("x: Parameter<u8, \"a.b\">", "x: Parameter<u16, \"a.b\">").expect(
        "parameter-conflict",
        &[
            "parameter `a.b` is declared with two types",
            "`a.b` as `u16`",
            "`a.b` as `u8`",
            "a.rs:15",
            "b.rs:15",
        ],
    );
    two("x: Parameter<Ball, \"a\">", "x: Parameter<u8, \"a.z\">")
        .expect("parameter-conflict", &["`types::Ball` has no field `z`"]);
    two(
        "x: Parameter<Ball, \"a\">",
        "x: Parameter<f32, \"a.position.x\">",
    )
    .expect("option-mismatch", &["write `?` behind `position`"]);
    two("x: Parameter<Option<u8>, \"a?.b\">", "y: CycleTime").expect(
        "option-mismatch",
        &["nobody declares parameter `a` as an `Option`"],
    );
}

#[test]
fn nobody_adds_a_parameter_to_one_instance_alone() {
    two(
        "x: Parameter<u8, \"$cycler_instance.a\">",
        "x: Parameter<u8, \"control.b\">",
    )
    .expect(
        "parameter-conflict",
        &["`control` holds what `$cycler_instance` declares"],
    );
}

#[test]
fn nobody_adds_all_instances_of_another_cycler_to_one_instance_alone() {
    let arms = cycler(
        "Arms",
        "real-time",
        "instances = [\"Left\", \"Right\"]",
        &[],
        &["a"],
    );
    let control = cycler("Control", "real-time", "", &[], &["b"]);
    let read = |path: &str| format!("x: Parameter<u8, {path:?}>");
    let fixture = |a: &str, b: &str| {
        let fixture = Fixture::new(&format!("{arms}{control}"));
        with_field(with_field(fixture, "a", &read(a)), "b", &read(b))
    };
    fixture("$cycler_instance.a", "arms_left.$cycler_instance").expect(
        "parameter-conflict",
        &[
            "`arms_left` holds what `$cycler_instance` declares in cycler `Arms`",
            "b.rs:15",
            "a.rs:15",
        ],
    );
    fixture("control.$cycler_instance", "$cycler_instance.b").expect(
        "parameter-conflict",
        &["`control` holds what `$cycler_instance` declares in cycler `Control`"],
    );
    // Nothing is wrong but that no file gives the values.
    fixture("arms.$cycler_instance", "control.$cycler_instance")
        .expect("missing-parameter-file", &[]);
}

#[test]
fn a_crate_that_only_a_part_of_what_is_read_whole_comes_from_is_named() {
    let vision = "instances = [\"Top\", \"Bottom\"]";
    let vision = cycler("Vision", "perception", vision, &[], &["eye"]);
    let control = cycler("Control", "real-time", "", &[], &["hand"]);
    let cameras = "pub struct Cameras { pub vision_top: Camera, pub vision_bottom: Camera }\n\
                   pub struct Camera { pub offset: nalgebra::Vector3<f32> }";
    let part = "p: Parameter<nalgebra::Vector3<f32>, \"cameras.$cycler_instance.offset\">,";
    let hardware = "hardware: HardwareInterface,";
    for (creation, cycle) in [(part, String::new()), ("", part.to_owned())] {
        let cycle = cycle + hardware;
        let eye = Node {
            creation,
            cycle: &cycle,
            ..ACTS
        };
        let fixture = Fixture::new(&format!("{vision}{control}")).node("eye", eye);
        let answer = with_field(fixture, "hand", "c: Parameter<Cameras, \"cameras\">")
            .file("crates/types/src/lib.rs", cameras)
            .answer();
        let robot = answer.robot.unwrap_or_else(|| panic!("{}", answer.text));
        let crates: Vec<&str> = robot.crates.iter().map(|one| one.name.as_str()).collect();
        assert!(crates.contains(&"nalgebra"), "{crates:?}");
    }
}

#[test]
fn a_mark_needs_an_option_whoever_else_reads_what_lies_below() {
    for (first, second) in [
        ("Parameter<u8, \"a.b\">", "Parameter<Option<u8>, \"a?.b\">"),
        ("Parameter<Option<u8>, \"a?.b\">", "Parameter<u8, \"a.b\">"),
        (
            "Parameter<Option<Point>, \"a.b\">",
            "Parameter<Option<f32>, \"a?.b?.x\">",
        ),
    ] {
        two(&format!("x: {first}"), &format!("y: {second}")).expect(
            "option-mismatch",
            &["nobody declares parameter `a` as an `Option`"],
        );
    }
}

#[test]
fn what_is_read_whole_at_creation_and_in_part_later_is_no_parameter_of_creation_alone() {
    for (part, creation_only) in [
        ("", true),
        ("p: Parameter<f32, \"ball.x\">,", false),
        ("p: Parameter<f32, \"other\">,", true),
    ] {
        let cycle = format!("{part}\nhardware: HardwareInterface,");
        let hand = Node {
            creation: "b: Parameter<Ball, \"ball\">,",
            cycle: &cycle,
            ..ACTS
        };
        let robot = Fixture::control(&["hand"])
            .node("hand", hand)
            .file("parameters/default.toml", "other = 1\n[ball]\n");
        let answer = robot.answer();
        let robot = answer.robot.unwrap_or_else(|| panic!("{}", answer.text));
        let hints = robot.parameter_hints.get("ball");
        let found = hints.is_some_and(|hints| hints.creation_only);
        assert_eq!(found, creation_only, "{part}");
    }
}

#[test]
fn states_are_shared_by_path() {
    let fixture = two(
        "x: CyclerState<Ball, \"ball\">,\ny: CyclerState<u8, \"count.a\">",
        "x: CyclerState<&f32, \"ball.x\">,\ny: CyclerState<&u8, \"count.a\">",
    );
    let robot = fixture.robot();
    assert_eq!(
        leaves(&robot.cyclers[0].states),
        ["ball: types::Ball 2", "count.a: u8 2"]
    );
}

#[test]
fn clashing_states_show_both_places() {
    two("x: CyclerState<u8, \"a\">", "x: CyclerState<u16, \"a\">").expect(
        "state-conflict",
        &["cycler state `a` is declared with two types"],
    );
    two(
        "x: CyclerState<u8, \"a\">,\ny: CyclerState<&u8, \"a\">",
        "x: CyclerState<u8, \"a\">",
    )
    .expect("overlapping-states", &["`a` and `a` are one cycler state"]);
    let pose = "x: CyclerState<nalgebra::Isometry3<f32>, \"pose\">";
    two(pose, "x: CyclerState<f32, \"pose.rotation.i\">").expect(
        "state-conflict",
        &[
            "`pose.rotation.i` cannot be changed alone",
            "change `rotation` as a whole",
        ],
    );
    two(pose, "x: CyclerState<&f32, \"pose.rotation.i\">").robot();
    two(pose, "x: CyclerState<f32, \"pose.translation.z\">").robot();
    two(
        "x: CyclerState<&u8, \"a\">",
        "x: CyclerState<u8, \"b\">,\ny: CycleTime",
    )
    .answer()
    .expect_error(
        "unwritten-state",
        &["no node of cycler `Control` writes the cycler state `a`"],
    );
}

#[test]
fn parts_behind_a_deref_are_borrowed_with_the_whole() {
    let pose = |parts: &str| two("x: CyclerState<nalgebra::Isometry3<f32>, \"pose\">", parts);
    for (a, b) in [
        ("f32, \"pose.translation.x\"", "f32, \"pose.translation.y\""),
        (
            "f32, \"pose.translation.x\"",
            "&f32, \"pose.translation.y\"",
        ),
        (
            "&nalgebra::Vector3<f32>, \"pose.translation.vector\"",
            "f32, \"pose.translation.y\"",
        ),
    ] {
        pose(&format!("a: CyclerState<{a}>,\nb: CyclerState<{b}>")).expect(
            "overlapping-states",
            &[
                "both borrow `pose.translation` as a whole",
                "ask for `pose.translation` in their place",
            ],
        );
    }
    let complex = "x: CyclerState<nalgebra::Vector2<nalgebra::Complex<f32>>, \"pair\">";
    let parts = "a: CyclerState<f32, \"pair.x.re\">,\nb: CyclerState<f32, \"pair.x.im\">";
    two(complex, parts).expect(
        "overlapping-states",
        &["`pair.x.re` and `pair.x.im` both borrow `pair` as a whole"],
    );
    // Both only read, and fields that each are borrowed alone.
    pose("a: CyclerState<&f32, \"pose.translation.x\">,\nb: CyclerState<&f32, \"pose.translation.y\">")
        .robot();
    pose("a: CyclerState<f32, \"pose.translation.x\">,\nb: CyclerState<nalgebra::UnitQuaternion<f32>, \"pose.rotation\">")
        .robot();
    // Nobody has the two as one value.
    let parts = "a: CyclerState<f32, \"place.x\">,\nb: CyclerState<f32, \"place.y\">";
    let codes = two(parts, "y: CycleTime").answer().codes;
    assert_eq!(codes, ["state-of-one-node"; 2]);
}

#[test]
fn states_that_only_rustc_can_compare_are_counted() {
    let fixture = |a: &str, b: &str| {
        let fixture = two(a, b);
        let types = fixture.text("crates/types/src/lib.rs");
        let fixture = fixture.file("crates/types/src/lib.rs", &format!("{types}\nmake!(Made);"));
        let robot = fixture.robot();
        (robot.left_to_rustc, robot.besides_edges)
    };
    let write = "x: CyclerState<types::Made, \"a\">";
    // One is whether the macro makes it public.
    assert_eq!(fixture(write, "x: CyclerState<u8, \"a\">"), (2, 2));
    // The graph has an edge for it.
    assert_eq!(fixture(write, "x: CyclerState<&u8, \"a\">"), (2, 1));
}

#[test]
fn additional_outputs_are_unique() {
    let robot = two(
        "x: AdditionalOutput<u8, \"a.b\">",
        "x: AdditionalOutput<u8, \"a.c\">",
    )
    .robot();
    assert_eq!(
        leaves(&robot.cyclers[0].additional_outputs),
        ["a.b: u8 1", "a.c: u8 1"]
    );
    two(
        "x: AdditionalOutput<u8, \"a\">",
        "x: AdditionalOutput<u8, \"a\">",
    )
    .expect(
        "duplicate-output",
        &["the additional output `a` of cycler `Control` is written twice"],
    );
    two(
        "x: AdditionalOutput<Ball, \"a\">",
        "x: AdditionalOutput<f32, \"a.x\">",
    )
    .expect("duplicate-output", &["one lies below the other"]);
    for (instance, message) in [
        (
            "a.$cycler_instance",
            "`a.control` and `a.$cycler_instance` of cycler `Control` are one in one of its instances",
        ),
        ("a.$cycler_instance.x", "one lies below the other"),
        ("$cycler_instance", ""),
    ] {
        let fixture = two(
            "x: AdditionalOutput<f32, \"a.control\">",
            &format!("x: AdditionalOutput<f32, {instance:?}>"),
        );
        if message.is_empty() {
            fixture.robot();
        } else {
            fixture.expect("duplicate-output", &[message]);
        }
    }
}

#[test]
fn additional_outputs_of_no_instance_are_one() {
    let arms = cycler(
        "Arms",
        "real-time",
        "instances = [\"Left\", \"Right\"]",
        &[],
        &["a", "b"],
    );
    let write = |path: &str| format!("x: AdditionalOutput<u8, {path:?}>");
    let fixture = |path: &str| {
        let fixture = with_field(
            Fixture::new(&arms),
            "a",
            &write("arms_left.$cycler_instance"),
        );
        with_field(fixture, "b", &write(path))
    };
    fixture("$cycler_instance.arms_right").robot();
    fixture("$cycler_instance.arms_left").expect("duplicate-output", &["in one of its instances"]);
}

#[test]
fn an_instance_is_not_called_like_the_table_of_the_targets() {
    let fixture = |instances: &str, path: &str| {
        let manifest = cycler("Hardware", "real-time", instances, &[], &["a"]);
        let field = format!("x: Parameter<f32, {path:?}>");
        with_field(Fixture::new(&manifest), "a", &field)
    };
    let answer = fixture("", "$cycler_instance.x").answer();
    let parts = ["`Hardware`", "hulk.toml", "crates/nodes/src/a.rs", "help: "];
    answer.expect_error("invalid-name", &parts);
    for (instances, path) in [
        ("", "arms.$cycler_instance.x"),
        ("instances = [\"Left\", \"Hardware\"]", "$cycler_instance.x"),
    ] {
        let answer = fixture(instances, path).answer();
        assert!(!answer.codes.contains(&"invalid-name"), "{}", answer.text);
    }
}
