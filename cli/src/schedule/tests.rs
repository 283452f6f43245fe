//! Orders, reasons and rings.

use super::*;
use crate::model::tests::{node, real_time, robot};

/// Paths of a cycler's nodes in the order they run.
fn order_of(robot: &Robot) -> Vec<&str> {
    let mut diagnostics = Diagnostics::new();
    let schedule = schedule(robot, &mut diagnostics).expect("the robot has no ring");
    let nodes = &robot.cyclers[0].nodes;
    schedule.cyclers[0]
        .order
        .iter()
        .map(|node| nodes[*node].path.as_str())
        .collect()
}

#[test]
fn nodes_without_reason_keep_the_order_of_the_manifest() {
    let robot = robot(vec![
        real_time("Control")
            .node(node("b"))
            .setup(node("s"))
            .node(node("a")),
    ]);
    assert_eq!(order_of(&robot), ["s", "b", "a"]);
}

#[test]
fn the_first_ready_node_of_the_manifest_runs_next() {
    let robot = robot(vec![
        real_time("Control")
            .node(node("late").input("x", "f32", "x"))
            .node(node("other"))
            .node(node("writer").output("x", "f32"))
            .node(node("last")),
    ]);
    assert_eq!(order_of(&robot), ["other", "writer", "late", "last"]);
}

#[test]
fn historic_inputs_order_and_previous_inputs_do_not() {
    let robot = robot(vec![
        real_time("Control")
            .node(node("historic").historic("x", "f32", "x"))
            .node(node("previous").previous("x", "f32", "x"))
            .node(node("writer").previous("y", "f32", "x").output("x", "f32")),
    ]);
    assert_eq!(order_of(&robot), ["previous", "writer", "historic"]);
}

#[test]
fn readers_of_a_state_run_after_its_writers_who_keep_their_order() {
    let robot = robot(vec![
        real_time("Control")
            .node(node("reader").reads_state("x", "f32", "filter.gain"))
            .node(node("second").state("x", "f32", "filter.gain"))
            .node(node("first").state("x", "types::Filter", "other")),
    ]);
    assert_eq!(order_of(&robot), ["second", "reader", "first"]);
}

#[test]
fn between_setup_nodes_and_nodes_state_orders_nothing() {
    let robot = robot(vec![
        real_time("Control")
            .setup(node("setup").reads_state("x", "f32", "gain"))
            .node(node("writer").state("x", "f32", "gain")),
    ]);
    assert_eq!(order_of(&robot), ["setup", "writer"]);
}

#[test]
fn edges_keep_the_field_that_caused_them() {
    let robot = robot(vec![
        real_time("Control")
            .node(node("writer").output("x", "Option<f32>"))
            .node(
                node("reader")
                    .cycle_time("time")
                    .required("x", "Option<f32>", "x?"),
            ),
    ]);
    let schedule = schedule(&robot, &mut Diagnostics::new()).expect("the robot has no ring");
    let edge = Edge {
        from: 0,
        to: 1,
        reason: Reason::RequiredInput,
        field: 1,
        path: "x?".to_owned(),
    };
    assert_eq!(schedule.cyclers[0].reasons(1).collect::<Vec<_>>(), [&edge]);
    assert_eq!(schedule.cyclers[0].place(1), Some(1));
}

#[test]
fn nodes_are_created_after_those_whose_states_they_read_then() {
    let robot = robot(vec![
        real_time("Control")
            .setup(node("setup").new_reads_state("x", "f32", "gain"))
            .node(node("early").new_reads_state("x", "f32", "filter.cutoff"))
            .node(
                node("second")
                    .new_reads_state("y", "f32", "gain")
                    .new_state("x", "u8", "count"),
            )
            .node(
                node("first")
                    .new_state("x", "f32", "gain")
                    .state("y", "f32", "filter"),
            )
            .node(node("third").new_state("x", "u8", "count"))
            .node(node("late").new_state("x", "types::Filter", "filter")),
    ]);
    let schedule = schedule(&robot, &mut Diagnostics::new()).expect("the robot has no ring");
    let nodes = &robot.cyclers[0].nodes;
    let created = schedule.cyclers[0].creation.iter();
    let created: Vec<&str> = created.map(|node| nodes[*node].path.as_str()).collect();
    assert_eq!(
        created,
        ["first", "setup", "second", "third", "late", "early"]
    );
}

#[test]
fn a_ring_of_creations_is_told() {
    let robot = robot(vec![
        real_time("Control")
            .setup(
                node("b")
                    .new_reads_state("y", "f32", "y")
                    .new_state("x", "f32", "x"),
            )
            .node(
                node("a")
                    .new_reads_state("x", "f32", "x")
                    .new_state("y", "f32", "y"),
            ),
    ]);
    assert_eq!(
        rings_of(&robot),
        [
            "nodes of cycler `Control` wait for each other when they are created: `b` → `a` → `b`\n\
          a.rs: `a` reads the state `x` after `b` wrote it\n\
          b.rs: `b` reads the state `y` after `a` wrote it"
        ]
    );
}

/// The messages and the places of all rings.
fn rings_of(robot: &Robot) -> Vec<String> {
    let mut diagnostics = Diagnostics::new();
    schedule(robot, &mut diagnostics).expect_err("the robot has a ring");
    let text = |one: &&crate::diagnostics::Diagnostic| {
        let places: Vec<String> = one
            .spans
            .iter()
            .map(|span| format!("{}: {}", span.file, span.text))
            .collect();
        format!("{}\n{}", one.message, places.join("\n"))
    };
    diagnostics.sorted().iter().map(text).collect()
}

#[test]
fn a_ring_is_told_whole_with_the_field_of_every_edge() {
    let robot = robot(vec![
        real_time("Control")
            .node(node("control::a").input("z", "f32", "z").output("x", "f32"))
            .node(
                node("control::b")
                    .historic("x", "f32", "x")
                    .state("s", "f32", "s"),
            )
            .node(
                node("control::c")
                    .reads_state("s", "f32", "s")
                    .output("z", "f32"),
            )
            .node(node("control::d").input("z", "f32", "z")),
    ]);
    assert_eq!(
        rings_of(&robot),
        ["nodes of cycler `Control` wait for each other: \
          `control::a` → `control::b` → `control::c` → `control::a`\n\
          control/b.rs: `control::b` reads `x` after `control::a` wrote it\n\
          control/c.rs: `control::c` reads the state `s` after `control::b` wrote it\n\
          control/a.rs: `control::a` reads `z` after `control::c` wrote it"]
    );
}

#[test]
fn a_ring_of_states_alone_has_a_help_of_its_own() {
    let help = |only_states: bool| {
        let second = match only_states {
            true => node("control::b").reads_state("y", "f32", "y"),
            false => node("control::b").input("z", "f32", "z"),
        };
        let robot = robot(vec![
            real_time("Control")
                .node(
                    node("control::a")
                        .reads_state("x", "f32", "x")
                        .state("y", "f32", "y")
                        .output("z", "f32"),
                )
                .node(second.state("x", "f32", "x")),
        ]);
        let mut diagnostics = Diagnostics::new();
        schedule(&robot, &mut diagnostics).expect_err("the robot has a ring");
        let helps = diagnostics.sorted();
        helps[0].help.clone().unwrap_or_default()
    };
    let states = help(true);
    assert!(
        states.contains("write one of these states as a `MainOutput`"),
        "{states}"
    );
    let inputs = help(false);
    assert!(
        inputs.contains("in place of one of these inputs"),
        "{inputs}"
    );
}

#[test]
fn every_ring_is_told_also_the_smallest() {
    let robot = robot(vec![
        real_time("Control")
            .node(node("a").input("x", "f32", "x").output("x", "f32"))
            .node(node("b").input("z", "f32", "z").output("y", "f32"))
            .node(node("c").input("y", "f32", "y").output("z", "f32")),
    ]);
    let rings = rings_of(&robot);
    assert_eq!(rings.len(), 2);
    assert!(rings[0].contains("`a` → `a`"), "{}", rings[0]);
    assert!(rings[1].contains("`b` → `c` → `b`"), "{}", rings[1]);
}

#[test]
fn writers_of_one_state_keep_the_order_of_the_manifest_when_one_of_them_waits() {
    let robot = robot(vec![
        real_time("Control")
            .node(node("n1").input("x", "f32", "x").state("s", "f32", "s"))
            .node(node("n2").state("s", "f32", "s"))
            .node(node("n3").output("x", "f32"))
            .node(node("n4").reads_state("s", "f32", "s")),
    ]);
    assert_eq!(order_of(&robot), ["n3", "n1", "n2", "n4"]);
}

#[test]
fn of_orders_of_writers_that_contradict_each_other_the_earlier_pair_wins() {
    // n1 before n2 for `s`, n3 before n4 for `t`; inputs put n4 before n1 and n2 before n3.
    let robot = robot(vec![
        real_time("Control")
            .node(node("n1").input("x", "f32", "x").state("s", "f32", "s"))
            .node(node("n2").state("s", "f32", "s").output("y", "f32"))
            .node(node("n3").input("y", "f32", "y").state("t", "f32", "t"))
            .node(node("n4").state("t", "f32", "t").output("x", "f32")),
    ]);
    assert_eq!(order_of(&robot), ["n4", "n1", "n2", "n3"]);
}

/// Numbers that look random, the same ones every time.
struct Numbers(u64);

impl Numbers {
    fn below(&mut self, bound: usize) -> usize {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        usize::try_from((self.0 >> 33) % bound as u64).unwrap_or_default()
    }
}

/// A cycler without rings: nodes read only what stands before them in an order that is not the manifest's.
fn any_robot(numbers: &mut Numbers, states: usize) -> Robot {
    const NODES: usize = 7;
    let mut hidden: Vec<usize> = (0..NODES).collect();
    for last in (1..NODES).rev() {
        hidden.swap(last, numbers.below(last + 1));
    }
    let mut cycler = real_time("Control");
    for one in 0..NODES {
        let mut node = node(&format!("n{one}")).output(&format!("x{one}"), "f32");
        for other in (0..NODES).filter(|other| hidden[*other] < hidden[one]) {
            if numbers.below(5) == 0 {
                node = node.input(&format!("i{other}"), "f32", &format!("x{other}"));
            }
        }
        for state in 0..states {
            if numbers.below(3) == 0 {
                node = node.state(&format!("s{state}"), "f32", &format!("s{state}"));
            }
        }
        cycler = cycler.node(node);
    }
    robot(vec![cycler])
}

#[test]
fn in_any_graph_no_ring_arises_and_writers_stand_in_manifest_order_where_they_can() {
    let mut numbers = Numbers(7);
    let mut moved = 0;
    for round in 0..500 {
        let states = 1 + round % 3;
        let robot = any_robot(&mut numbers, states);
        let cycler = &robot.cyclers[0];
        let schedule = schedule(&robot, &mut Diagnostics::new()).expect("there is no ring");
        let schedule = &schedule.cyclers[0];
        assert_eq!(schedule.order.len(), cycler.nodes.len(), "a ring arose");
        let place = |node: usize| schedule.place(node).expect("every node is placed");
        for edge in &schedule.edges {
            assert!(place(edge.from) < place(edge.to), "{edge:?}");
        }
        let data = graph(cycler, &edges::edges(cycler));
        moved += usize::from(order(cycler, &data) != schedule.order);
        let whole = graph(cycler, &schedule.edges);
        for pair in writers::pairs(cycler) {
            let (earlier, later) = (pair.earlier, pair.later);
            if place(earlier) < place(later) {
                continue;
            }
            // Only a way there, of inputs or of pairs that won, lets the later one run first.
            let way = |graph: &Graph, from: usize, to: usize| {
                let (from, to) = (NodeIndex::new(from), NodeIndex::new(to));
                petgraph::algo::has_path_connecting(graph, from, to, None)
            };
            assert!(way(&whole, later, earlier), "{earlier} {later}");
        }
    }
    assert!(moved > 50, "the graphs ask for nothing: {moved}");
}
