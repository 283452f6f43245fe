//! Every aspect changed once.

use super::Difference;
use crate::graph::{Graph, describe, fixture};

fn graph() -> Graph {
    describe(&fixture::robot(), &fixture::schedule())
}

/// "+ name", "- name", "~ name: before, after".
fn lines(difference: &Difference) -> Vec<String> {
    let mut lines = Vec::new();
    for (_, changes) in difference.aspects() {
        lines.extend(changes.added.iter().map(|one| format!("+ {}", one.name)));
        lines.extend(changes.removed.iter().map(|one| format!("- {}", one.name)));
        lines.extend((changes.changed.iter()).map(|one| {
            let (before, after) = (&one.before, &one.after);
            format!("~ {}: {}, {}", after.name, before.text, after.text)
        }));
    }
    lines
}

#[test]
fn a_graph_does_not_differ_from_itself() {
    assert!(Difference::between(&graph(), &graph()).is_empty());
}

#[test]
fn where_a_field_stands_makes_no_difference() {
    let mut moved = graph();
    moved.cyclers[0].nodes[0].fields[0].line += 3;
    assert!(Difference::between(&graph(), &moved).is_empty());
}

#[test]
fn every_aspect_is_compared() {
    let mut after = graph();
    after.targets.remove(0);
    after.cyclers[0].instances.pop();
    after.cyclers[0].nodes[0].interfaces.clear();
    after.parameters[0].data = "u8".to_owned();
    after.edges.remove(0);
    let field = &mut after.cyclers[1].nodes[1].fields[0];
    field.data = Some("types::Other".to_owned());
    let difference = Difference::between(&graph(), &after);
    assert_eq!(
        lines(&difference),
        [
            "- simulated",
            "~ Vision: perception, VisionTop, VisionBottom, perception, VisionTop",
            "~ vision::image_receiver of Vision: setup node, asks hardware::CameraInterface, setup node",
            "~ control::head.ball of Control: Input<Option<types::Ball>, \"ball\">, Input<types::Other, \"ball\">",
            "~ vision_bottom.camera: types::CameraPosition, u8",
            "- Vision.image of vision::image_receiver → vision::ball_detection.image of Vision",
        ]
    );
    let of_manifests = Difference::of_manifests(&graph(), &after);
    assert_eq!(lines(&of_manifests).len(), 3);
}

#[test]
fn the_fewest_nodes_are_said_to_have_moved() {
    let mut after = graph();
    for node in &mut after.cyclers[1].nodes {
        node.order = [0, 3, 1, 2][node.order];
    }
    let order = Difference::between(&graph(), &after).order;
    let moves: Vec<_> = (order.iter())
        .map(|one| {
            (
                one.node.as_str(),
                one.before,
                one.after,
                one.behind.as_deref(),
            )
        })
        .collect();
    let behind = Some("control::command_sender");
    assert_eq!(moves, [("control::ball_filter", 1, 3, behind)]);
}

#[test]
fn a_new_node_moves_no_other() {
    let mut before = graph();
    before.cyclers[1]
        .nodes
        .retain(|node| node.path != "control::ball_filter");
    let difference = Difference::between(&before, &graph());
    assert!(difference.order.is_empty());
    assert_eq!(
        difference.nodes.added[0].name,
        "control::ball_filter of Control"
    );
    assert!(difference.fields.is_empty());
}

#[test]
fn another_name_and_another_order_of_cyclers_and_targets_are_told() {
    let mut after = graph();
    after.robot = "other".to_owned();
    after.cyclers.reverse();
    for difference in [
        Difference::between(&graph(), &after),
        Difference::of_manifests(&graph(), &after),
    ] {
        assert!(!difference.is_empty());
        let robot = difference.robot.expect("the name is another");
        assert_eq!(
            (robot.before, robot.after),
            (graph().robot, "other".to_owned())
        );
        let order = difference.cycler_order.expect("the order is another");
        assert_eq!(
            (order.before[0].as_str(), order.after[0].as_str()),
            ("Vision", "Control")
        );
        assert_eq!(difference.target_order, None);
        assert!(difference.cyclers.is_empty() && difference.nodes.is_empty());
    }
    let mut fewer = graph();
    fewer.cyclers.remove(0);
    assert_eq!(Difference::between(&graph(), &fewer).cycler_order, None);
    let mut swapped = graph();
    let mut another = swapped.targets[0].clone();
    another.name = "another".to_owned();
    swapped.targets.push(another);
    let before = swapped.clone();
    swapped.targets.reverse();
    let difference = Difference::between(&before, &swapped);
    assert!(difference.target_order.is_some() && difference.targets.is_empty());
}
