//! Chains, the manifest, setup nodes, and nodes that nothing orders.

use super::{explain, text};
use crate::diagnostics::Diagnostics;
use crate::graph;
use crate::model::tests::{node, real_time, robot};
use crate::pipeline::Understood;
use crate::resolve::parameter_files::Unchecked;
use crate::resolve::robot::Robot;
use crate::schedule::schedule;

fn ordered(robot: Robot, one: &str, other: &str) -> String {
    let schedule = schedule(&robot, &mut Diagnostics::new()).expect("the robot has no ring");
    let understood = Understood {
        robot,
        schedule,
        unchecked: Unchecked::default(),
    };
    let graph = graph::describe(&understood.robot, &understood.schedule);
    text(&explain(&understood, &graph, [one, other]).expect("the nodes are there"))
}

fn chained() -> Robot {
    robot(vec![
        real_time("Control")
            .setup(node("control::sensors").output("x", "f32"))
            .node(node("control::last").input("z", "f32", "z"))
            .node(node("control::free"))
            .node(
                node("control::first")
                    .input("x", "f32", "x")
                    .output("y", "f32"),
            )
            .node(
                node("control::middle")
                    .historic("y", "f32", "y")
                    .output("z", "f32"),
            ),
        real_time("Other").node(node("other::reader")),
    ])
}

#[test]
fn a_chain_of_edges_is_told_from_its_beginning() {
    let text = ordered(chained(), "last", "control::first");
    assert_eq!(
        text,
        "\
control::first runs before control::last in Control, as 2 and 4
  control::middle reads y of control::first: y (HistoricInput, control/middle.rs:1)
  control::last reads z of control::middle: z (Input, control/last.rs:1)
"
    );
}

#[test]
fn without_edges_the_manifest_orders() {
    let text = ordered(chained(), "free", "first");
    assert!(
        text.ends_with(
            "nothing orders control::free and control::first: control::free stands first in hulk.toml\n"
        ),
        "{text}"
    );
}

#[test]
fn a_node_that_stands_first_and_runs_later_waits_for_another() {
    let text = ordered(chained(), "free", "last");
    assert!(text.starts_with("control::free runs before control::last in Control, as 1 and 4"));
    assert!(
        text.contains("nothing orders control::free and control::middle"),
        "{text}"
    );
    assert!(
        text.contains("control::last reads z of control::middle"),
        "{text}"
    );
}

#[test]
fn setup_nodes_run_first() {
    let text = ordered(chained(), "sensors", "free");
    assert!(text.contains("control::sensors is a setup node"), "{text}");
}

#[test]
fn nothing_orders_nodes_of_different_cyclers() {
    let text = ordered(chained(), "sensors", "reader");
    assert_eq!(
        text,
        "control::sensors is in Control and other::reader in Other: \
         nothing orders nodes of different cyclers\n"
    );
}

#[test]
fn a_writer_of_the_same_state_that_stands_first_is_told() {
    let robot = robot(vec![
        real_time("Control")
            .node(node("a::n1").input("x", "f32", "x").state("s", "f32", "s"))
            .node(node("a::n2").state("s", "f32", "s"))
            .node(node("a::n3").output("x", "f32")),
    ]);
    let text = ordered(robot, "n2", "n3");
    assert_eq!(
        text,
        "\
a::n3 runs before a::n2 in Control, as 0 and 2
  a::n1 reads x of a::n3: x (Input, a/n1.rs:1)
  a::n2 writes the state s as a::n1 does: s (CyclerState, a/n2.rs:1); a::n1 stands first in hulk.toml
"
    );
}
