//! What stands under a `#[cfg]`: rustc alone knows whether it is there.

use super::{ACTS, writes};
use crate::scan::fixture::{Fixture, Node, cycler};

fn control() -> Fixture {
    Fixture::control(&["a"]).node("a", ACTS)
}

#[test]
fn a_conditional_node_is_counted() {
    assert_eq!(control().robot().besides_edges, 0);
    for library in [
        "#[cfg(feature = \"no\")] pub mod a;",
        "#![cfg(feature = \"no\")] pub mod a;",
    ] {
        let robot = control().file("crates/nodes/src/lib.rs", library).robot();
        assert_eq!(
            (robot.besides_edges, robot.left_to_rustc),
            (1, 1),
            "{library}"
        );
    }
}

#[test]
fn conditional_functions_and_derives_of_a_node_are_counted() {
    const RESTORE: &str = "pub fn restore(&mut self, context: CreationContext) -> Result<()> {}";
    let text = control().text("crates/nodes/src/a.rs");
    let with = |more: &str| format!("{text}{more}");
    let within = |from: &str, to: &str| text.replacen(from, to, 1);
    let derive = "#[derive(Deserialize, Serialize)]";
    for (text, left, restores) in [
        (
            with(&format!("#[cfg(test)] impl Node {{ {RESTORE} }}")),
            0,
            false,
        ),
        (
            with(&format!("impl Node {{ #[cfg(test)] {RESTORE} }}")),
            0,
            false,
        ),
        (
            with(&format!("#[cfg(any())] impl Node {{ {RESTORE} }}")),
            1,
            true,
        ),
        (
            with(&format!("impl Node {{ #[cfg(any())] {RESTORE} }}")),
            1,
            true,
        ),
        (
            with("#[cfg(any())] impl Node { fn help(&self) {} }"),
            0,
            false,
        ),
        (within("impl Node {", "#[cfg(any())] impl Node {"), 1, false),
        (
            within("pub fn cycle", "#[cfg(any())] pub fn cycle"),
            1,
            false,
        ),
        (
            within(
                derive,
                &format!("#[cfg_attr(any(), {})]", &derive[2..derive.len() - 1]),
            ),
            1,
            false,
        ),
        // The macro may derive, and it may change the fields.
        (within(derive, "#[written]"), 2, false),
        (within(derive, &format!("#[cfg(any())] {derive}")), 1, false),
        (
            within(
                derive,
                &format!("#[cfg_attr(any(), derive(Debug))] {derive}"),
            ),
            0,
            false,
        ),
        (
            within(
                "pub struct Node {",
                "#[cfg(test)] struct Node; #[derive(Deserialize, Serialize)] pub struct Node {",
            )
            .replacen(derive, "", 1),
            0,
            false,
        ),
    ] {
        let robot = control().file("crates/nodes/src/a.rs", &text).robot();
        assert_eq!(robot.besides_edges, left, "{text}");
        assert_eq!(robot.left_to_rustc, left, "{text}");
        assert_eq!(robot.cyclers[0].nodes[0].restores, restores, "{text}");
    }
    let tested = within(derive, "#[cfg_attr(test, derive(Deserialize, Serialize))]");
    control()
        .file("crates/nodes/src/a.rs", &tested)
        .expect("missing-derive", &["`Serialize` and `Deserialize`"]);
}

#[test]
fn a_conditional_context_is_told_at_the_condition() {
    let text = control().text("crates/nodes/src/a.rs");
    let other = "#[cfg(any())]\n#[context]\npub struct CycleContext {}\n#[context]\npub struct CycleContext";
    let twice = text.replace("#[context]\npub struct CycleContext", other);
    control().file("crates/nodes/src/a.rs", &twice).expect(
        "invalid-context",
        &["`CycleContext` cannot be conditional", "remove `#[cfg(…)]`"],
    );
    let tested = twice.replace("cfg(any())", "cfg(test)");
    control().file("crates/nodes/src/a.rs", &tested).robot();
}

#[test]
fn a_context_that_no_other_crate_can_make_is_told() {
    let text = control().text("crates/nodes/src/a.rs");
    for (name, is_made) in [
        ("CreationContext", true),
        ("CycleContext", true),
        ("MainOutputs", false),
    ] {
        let line = format!("pub struct {name}");
        let closed = text.replace(&line, &format!("#[non_exhaustive]\n{line}"));
        let fixture = control().file("crates/nodes/src/a.rs", &closed);
        if is_made {
            fixture.expect(
                "invalid-context",
                &[
                    &format!("`{name}` is `#[non_exhaustive]`"),
                    "remove the attribute",
                ],
            );
        } else {
            fixture.robot();
        }
    }
}

#[test]
fn a_conditional_field_is_left_to_rustc() {
    let library = "
        pub struct Outer { #[cfg(any())] pub x: f32, pub y: f32 }
    ";
    for (field, left) in [("x", 1), ("y", 0)] {
        let cycle = format!("v: Input<f32, \"outer.{field}\">, hardware: HardwareInterface,");
        let reader = Node {
            cycle: &cycle,
            ..ACTS
        };
        let robot = Fixture::control(&["a", "b"])
            .file("crates/types/src/lib.rs", library)
            .node("a", writes("outer: MainOutput<types::Outer>,"))
            .node("b", reader)
            .answer()
            .robot
            .expect("there are only warnings");
        assert_eq!(robot.left_to_rustc, left, "{field}");
        // It is an edge, and counted as such.
        assert_eq!(robot.besides_edges, 0);

        let cycle = format!(
            "s: CyclerState<types::Outer, \"s\">, t: CyclerState<&f32, \"s.{field}\">, hardware: HardwareInterface,"
        );
        let (first, second) = cycle.split_at(cycle.find(" t:").expect("it is there"));
        let state = |cycle| Node { cycle, ..ACTS };
        let first = format!("{first} hardware: HardwareInterface,");
        let robot = Fixture::control(&["a", "b"])
            .file("crates/types/src/lib.rs", library)
            .node("a", state(&first))
            .node("b", state(second))
            .robot();
        assert_eq!(robot.besides_edges, left, "{field}");
    }
}

#[test]
fn a_conditional_impl_of_the_hardware_is_counted() {
    let target = "[[target]]\nname = \"bench\"\nhardware = \"hardware::Hardware\"\n";
    let control = cycler("Control", "real-time", "", &[], &["a"]);
    for (condition, unknown) in [("", 0), ("#[cfg(any())]", 1)] {
        let library = format!(
            "pub struct Hardware; impl framework::Hardware for Hardware {{}} pub trait Motors {{ fn write(&self); }} {condition} impl Motors for Hardware {{}}"
        );
        let robot = Fixture::new(&format!("{control}{target}"))
            .node("a", ACTS)
            .file("crates/hardware/src/lib.rs", &library)
            .robot();
        assert_eq!(robot.besides_edges, unknown, "{condition}");
    }
}

#[test]
fn a_hardware_that_is_there_under_a_condition_is_counted() {
    let control = cycler("Control", "real-time", "", &[], &["a"]);
    let rest = "pub trait Motors { fn write(&self); } impl Motors for Hardware {}";
    let serves = "impl framework::Hardware for Hardware {}";
    let manifest = "[package]\nname = \"hardware\"\n[dependencies]\nframework = \"1\"\n";
    for (library, name, unknown) in [
        (format!("pub struct Hardware; {serves}"), "Hardware", 0),
        (
            format!("pub struct Hardware; #[cfg(any())] {serves}"),
            "Hardware",
            1,
        ),
        (
            format!(
                "pub struct Hardware; #[cfg(any())] mod inner {{ use crate::Hardware; {serves} }}"
            ),
            "Hardware",
            1,
        ),
        (
            format!("pub struct Hardware; mod inner {{ use crate::Hardware; {serves} }}"),
            "Hardware",
            0,
        ),
        (
            format!("#[cfg(any())] pub struct Hardware; {serves}"),
            "Hardware",
            2,
        ),
        (
            format!("pub struct Hardware; {serves} #[cfg(any())] pub type Hw = Hardware;"),
            "Hw",
            1,
        ),
        (
            format!("pub struct Hardware; {serves} #[cfg(any())] pub use crate::Hardware as Hw;"),
            "Hw",
            1,
        ),
        (
            format!(
                "pub struct Hardware; {serves} pub use inner::Hw; mod inner {{ #[cfg(any())] pub use crate::Hardware as Hw; }}"
            ),
            "Hw",
            1,
        ),
        (
            format!("pub struct Hardware; {serves} pub use crate::Hardware as Hw;"),
            "Hw",
            0,
        ),
    ] {
        let target = format!("[[target]]\nname = \"bench\"\nhardware = \"hardware::{name}\"\n");
        let robot = Fixture::new(&format!("{control}{target}"))
            .node("a", ACTS)
            .file("crates/hardware/Cargo.toml", manifest)
            .file("crates/hardware/src/lib.rs", &format!("{library} {rest}"))
            .robot();
        assert_eq!(robot.besides_edges, unknown, "{library}");
    }
    let tested = format!("pub struct Hardware; #[cfg(test)] {serves} {rest}");
    let target = "[[target]]\nname = \"bench\"\nhardware = \"hardware::Hardware\"\n";
    Fixture::new(&format!("{control}{target}"))
        .node("a", ACTS)
        .file("crates/hardware/src/lib.rs", &tested)
        .expect(
            "unknown-hardware",
            &["does not implement `framework::Hardware`"],
        );
}

#[test]
fn bounds_that_are_no_trait_of_the_workspace() {
    let asking = |asks| Fixture::control(&["a"]).node("a", Node { asks, ..ACTS });
    assert_eq!(
        asking("hardware::Motors + Send + std::marker::Sync")
            .robot()
            .besides_edges,
        0
    );
    let answer = asking("hardware::Motors + std::fmt::Debug")
        .expect("not-replayable", &["`std::fmt::Debug`"]);
    assert_eq!(answer.robot.map(|robot| robot.besides_edges), Some(1));
    asking("hardware::Motors + Unpin").expect(
        "invalid-signature",
        &[
            "`Unpin` is nothing that a hardware does",
            "crates/nodes/src/a.rs:",
        ],
    );
}

#[test]
fn files_of_modules_with_raw_names_are_called_without_the_mark() {
    let answer = Fixture::control(&["a"])
        .node("a", writes("x: MainOutput<crate::r#type::Foo>,"))
        .node(
            "b",
            Node {
                cycle: "x: Input<crate::r#type::Foo, \"x\">, hardware: HardwareInterface,",
                ..ACTS
            },
        )
        .file(
            "hulk.toml",
            &format!(
                "[robot]\nname = \"test\"\n{}",
                cycler("Control", "real-time", "", &[], &["a", "b"])
            ),
        )
        .file(
            "crates/nodes/src/lib.rs",
            "pub mod a; pub mod b; pub mod r#type;",
        )
        .file("crates/nodes/src/type.rs", "pub struct Foo;")
        .answer();
    assert_eq!(answer.codes, ["actuator-takes-default"], "{}", answer.text);
    let robot = answer.robot.expect("there are only warnings");
    let crates = robot.crates.iter().map(|one| one.name.as_str());
    assert_eq!(
        crates.collect::<Vec<_>>(),
        ["framework", "hardware", "nodes", "serde"]
    );
}
