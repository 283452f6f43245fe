//! Parameters of each instance, whose name stands anywhere in their paths.

use super::NAO;
use crate::scan::fixture::{Fixture, Node, cycler};

const DEFAULT: &str = "parameters/default.toml";

/// Two arms and their control; `a` is a node of the arms, `b` of the control.
fn robot(a: &str, b: &str) -> Fixture {
    let arms = cycler(
        "Arms",
        "real-time",
        "instances = [\"Left\", \"Right\"]",
        &[],
        &["a"],
    );
    let control = cycler("Control", "real-time", "", &[], &["b"]);
    let manifest = format!("identities = [\"head\"]\n{arms}{control}{NAO}");
    let node = |fixture: Fixture, name, fields: &str| {
        let cycle = format!("{fields}\nhardware: HardwareInterface,");
        fixture.node(
            name,
            Node {
                head: "use types::*;",
                cycle: &cycle,
                asks: "hardware::Motors",
                ..Node::default()
            },
        )
    };
    let fixture = Fixture::new(&manifest).file("parameters/field/default.toml", "");
    node(node(fixture, "a", a), "b", b)
}

/// Below a table of all.
fn below(files: &str) -> Fixture {
    robot("x: Parameter<f32, \"control_a.$cycler_instance.x\">,", "").file(DEFAULT, files)
}

#[test]
fn every_instance_needs_its_own_value_below_the_table() {
    below("[control_a]\narms_left.x = 1\narms_right.x = 2\n").robot();
    below("[control_a.arms_left]\nx = 1\n").expect(
        "missing-parameter",
        &[
            "no file gives the parameter `control_a.arms_right.x`\n",
            "parameters/default.toml:1:2",
            "a.rs:15:4",
            "read here",
            "add `control_a.arms_right.x = …`",
        ],
    );
    below("").answer().expect_all(
        &["missing-parameter", "missing-parameter"],
        &["`control_a.arms_left.x`", "`control_a.arms_right.x`"],
    );
    let given = "[control_a]\narms_left.x = 1\n";
    below(given)
        .file(
            "parameters/field/default.toml",
            "control_a.arms_right.x = 2\n",
        )
        .robot();
    below(given)
        .file(
            "parameters/lab/default.toml",
            "control_a.arms_right.x = 2\n",
        )
        .expect(
            "missing-parameter",
            &[
                "`control_a.arms_right.x`",
                "parameters/lab/default.toml:1:22",
                "given for location `lab`",
            ],
        );
}

#[test]
fn a_table_of_no_instance_is_told() {
    let both = "[control_a]\narms_left.x = 1\narms_right.x = 2\n";
    for (more, unknown, help) in [
        (
            "arms_rihgt.x = 3\n",
            "`control_a.arms_rihgt`",
            "did you mean `arms_right`?",
        ),
        ("left.x = 3\n", "`control_a.left`", "remove it"),
        ("control.x = 3\n", "`control_a.control`", "remove it"),
        (
            "arms_left.y = 3\n",
            "`control_a.arms_left.y`",
            "did you mean `x`?",
        ),
    ] {
        below(&format!("{both}{more}"))
            .expect("unknown-parameter", &["nobody declares", unknown, help]);
    }
    below("[control_a]\narms_left.x = 1\narms_right.x = 'a'\n").expect(
        "mistyped-parameter",
        &["`control_a.arms_right.x` is a string, not a number"],
    );
    below("[control_a]\narms_left.x = 1\narms_right = 2\n")
        .answer()
        .expect_all(
            &["missing-parameter", "mistyped-parameter"],
            &["`control_a.arms_right` is a number, not a table"],
        );
}

#[test]
fn what_another_node_reads_of_one_instance_is_that_of_this_instance() {
    let read = "x: Parameter<f32, \"control_a.arms_left.x\">,";
    let fixture = || robot("x: Parameter<f32, \"control_a.$cycler_instance.x\">,", read);
    let both = "[control_a]\narms_left.x = 1\narms_right.x = 2\n";
    fixture().file(DEFAULT, both).robot();
    fixture()
        .file(DEFAULT, "[control_a]\narms_left.x = 1\n")
        .expect(
            "missing-parameter",
            &["`control_a.arms_right.x`", "a.rs:15:4", "read here"],
        );
}

#[test]
fn an_optional_value_may_be_given_to_one_instance_alone() {
    robot(
        "x: Parameter<Option<f32>, \"control_a.$cycler_instance.x\">,",
        "",
    )
    .file(DEFAULT, "[control_a]\narms_left.x = 1\n")
    .robot();
    robot(
        "limits: Parameter<Limits, \"control_a.$cycler_instance.limits\">,",
        "",
    )
    .file(
        DEFAULT,
        "[control_a]\narms_left.limits = { low = 1 }\narms_right.limits = { high = 1 }\n",
    )
    .expect(
        "missing-parameter",
        &["`control_a.arms_right.limits.low`", "a.rs:15:"],
    );
}

#[test]
fn what_is_taken_from_one_instance_is_missed_there() {
    below("[control_a]\narms_left.x = 1\narms_right.x = 2\n")
        .file(
            "parameters/field/default.toml",
            "control_a.arms_right = { unset = true }\n",
        )
        .expect("missing-parameter", &["`control_a.arms_right.x`"]);
}
