//! The fixture robot in every form.

use super::{EdgeKind, Graph, describe, dot, fixture, html, json, mermaid, svg};

fn graph() -> Graph {
    describe(&fixture::robot(), &fixture::schedule())
}

fn edges(graph: &Graph) -> Vec<String> {
    let edges = graph.edges.iter().map(|edge| {
        let instance = edge.from.instance.as_deref().unwrap_or("-");
        let (from, to) = (&edge.from, &edge.to);
        let (word, checked) = (edge.kind.word(), if edge.checked { "" } else { " (rustc)" });
        let kind = format!("{word}{checked}");
        format!(
            "{kind}: {instance} {}.{} -> {}.{}",
            from.node, from.output, to.node, to.field
        )
    });
    edges.collect()
}

#[test]
fn edges_stand_by_reader_and_perception_has_one_for_each_instance() {
    assert_eq!(
        edges(&graph()),
        [
            "input: - vision::image_receiver.image -> vision::ball_detection.image",
            "latest: Control control::ball_filter.matrix -> vision::ball_detection.matrix",
            "input: - control::ball_filter.ball -> control::head.ball",
            "previous: - control::head.command -> control::head.last_command",
            "state: - control::ball_filter.calibration -> control::head.calibration",
            "historic: - control::sensor_receiver.sensors -> control::ball_filter.sensors",
            "perception: VisionTop vision::ball_detection.balls -> control::ball_filter.balls",
            "perception: VisionBottom vision::ball_detection.balls -> control::ball_filter.balls",
            "input: - control::head.command -> control::command_sender.command",
            "latest (rustc): VisionTop vision::image_receiver.image -> control::command_sender.image",
        ]
    );
}

#[test]
fn json_has_the_documented_keys() {
    let graph = graph();
    let value: serde_json::Value =
        serde_json::from_str(&json::render(&graph)).expect("it is valid JSON");
    assert_eq!(value["version"], 1);
    assert_eq!(value["robot"], "walker");
    assert_eq!(value["hash"], graph.hash);
    assert_eq!(
        value["parameters"][1],
        serde_json::json!({
            "path": "vision_top.camera",
            "type": "types::CameraPosition",
            "readers": ["vision::image_receiver"],
        })
    );
    let filter = &value["cyclers"][1]["nodes"][2];
    assert_eq!(value["cyclers"][0]["kind"], "perception");
    assert_eq!(value["cyclers"][1]["kind"], "real-time");
    assert_eq!(
        (&filter["path"], &filter["order"]),
        (&"control::ball_filter".into(), &1.into())
    );
    assert_eq!(
        filter["fields"][1],
        serde_json::json!({
            "context": "cycle",
            "name": "balls",
            "kind": "PerceptionInput",
            "type": "Vec<types::Ball>",
            "instance": "Vision",
            "path": "balls",
            "line": 7,
        })
    );
    assert_eq!(filter["fields"][3]["type"], serde_json::Value::Null);
    assert_eq!(
        value["edges"][1],
        serde_json::json!({
            "from": {
                "cycler": "Control",
                "instance": "Control",
                "node": "control::ball_filter",
                "output": "matrix",
            },
            "to": { "cycler": "Vision", "node": "vision::ball_detection", "field": "matrix" },
            "kind": "latest",
            "checked": true,
        })
    );
}

#[test]
fn the_hash_knows_meanings_and_not_lines() {
    let before = graph().hash;
    assert_eq!(before.len(), 16);
    let mut robot = fixture::robot();
    robot.cyclers[0].nodes[1].cycle[0].line = 99;
    assert_eq!(describe(&robot, &fixture::schedule()).hash, before);
    robot.cyclers[0].nodes[1].cycle[0].name = "picture".to_owned();
    assert_ne!(describe(&robot, &fixture::schedule()).hash, before);
}

#[test]
fn one_cycler_is_shown_with_what_it_exchanges() {
    let vision = graph().of_cycler("Vision").expect("it is a cycler");
    let nodes: Vec<&str> = (vision.cyclers.iter())
        .flat_map(|cycler| cycler.nodes.iter().map(|node| node.path.as_str()))
        .collect();
    assert_eq!(
        nodes,
        [
            "vision::image_receiver",
            "vision::ball_detection",
            "control::ball_filter",
            "control::command_sender",
        ]
    );
    assert!(vision.edges.iter().all(|edge| edge.kind != EdgeKind::State));
    assert_eq!(vision.hash, graph().hash);
    assert!(graph().of_cycler("Audio").is_none());
}

#[test]
fn mermaid_bundles_edges_of_one_kind() {
    insta::assert_snapshot!(mermaid::render(&graph()), @r#"
    flowchart TB
        subgraph Vision["Vision (perception): VisionTop, VisionBottom"]
            Vision__vision__image_receiver["vision::image_receiver"]:::setup
            Vision__vision__ball_detection["vision::ball_detection"]
        end
        subgraph Control["Control (real-time)"]
            Control__control__sensor_receiver["control::sensor_receiver"]:::setup
            Control__control__ball_filter["control::ball_filter"]
            Control__control__head["control::head"]
            Control__control__command_sender["control::command_sender"]
        end
        Vision__vision__image_receiver -->|"image"| Vision__vision__ball_detection
        Control__control__ball_filter ==>|"matrix"| Vision__vision__ball_detection
        Control__control__ball_filter -->|"ball"| Control__control__head
        Control__control__head -.->|"command"| Control__control__head
        Control__control__ball_filter -.->|"calibration"| Control__control__head
        Control__control__sensor_receiver -->|"sensors"| Control__control__ball_filter
        Vision__vision__ball_detection ==>|"VisionTop.balls, VisionBottom.balls"| Control__control__ball_filter
        Control__control__head -->|"command"| Control__control__command_sender
        Vision__vision__image_receiver ==>|"VisionTop.image"| Control__control__command_sender
        classDef setup stroke-width:3px
    "#);
}

#[test]
fn dot_draws_a_cluster_for_each_cycler() {
    insta::assert_snapshot!(dot::render(&graph()), @r#"
    digraph "walker" {
        rankdir=TB;
        node [shape=box, style=rounded, fontname="monospace"];
        edge [fontname="monospace", fontsize=10];
        subgraph "cluster_Vision" {
            label="Vision (perception)\nVisionTop, VisionBottom";
            "Vision/vision::image_receiver" [label="0 vision::image_receiver", style="rounded,bold"];
            "Vision/vision::ball_detection" [label="1 vision::ball_detection"];
        }
        subgraph "cluster_Control" {
            label="Control (real-time)\nControl";
            "Control/control::sensor_receiver" [label="0 control::sensor_receiver", style="rounded,bold"];
            "Control/control::ball_filter" [label="1 control::ball_filter"];
            "Control/control::head" [label="2 control::head"];
            "Control/control::command_sender" [label="3 control::command_sender"];
        }
        "Vision/vision::image_receiver" -> "Vision/vision::ball_detection" [label="image", style=solid];
        "Control/control::ball_filter" -> "Vision/vision::ball_detection" [label="matrix", style=bold, color=darkorange];
        "Control/control::ball_filter" -> "Control/control::head" [label="ball", style=solid];
        "Control/control::head" -> "Control/control::head" [label="command", style=dashed, constraint=false];
        "Control/control::ball_filter" -> "Control/control::head" [label="calibration", style=dotted, color=purple];
        "Control/control::sensor_receiver" -> "Control/control::ball_filter" [label="sensors", style=solid, color=teal];
        "Vision/vision::ball_detection" -> "Control/control::ball_filter" [label="VisionTop.balls\nVisionBottom.balls", style=bold, color=forestgreen];
        "Control/control::head" -> "Control/control::command_sender" [label="command", style=solid];
        "Vision/vision::image_receiver" -> "Control/control::command_sender" [label="VisionTop.image", style=bold, color=darkorange];
    }
    "#);
}

#[test]
fn the_picture_names_every_node_and_draws_every_kind_of_edge() {
    let picture = svg::render(&graph());
    for name in [
        "vision::ball_detection",
        "control::command_sender",
        "VisionTop, VisionBottom",
    ] {
        assert!(picture.contains(name), "{name} is missing");
    }
    for kind in [
        "input",
        "previous",
        "historic",
        "latest",
        "perception",
        "state",
    ] {
        assert!(
            picture.contains(&format!("class=\"wire {kind}\" data-from")),
            "{kind} is missing"
        );
    }
    assert!(picture.contains("Vec&lt;types::Ball&gt;"));
    assert!(!picture.contains("Vec<"), "types are escaped");
    assert_eq!(picture, svg::render(&graph()));
}

#[test]
fn every_selection_can_be_drawn() {
    for cycler in ["Vision", "Control"] {
        let graph = graph().of_cycler(cycler).expect("it is a cycler");
        assert!(svg::render(&graph).ends_with("</svg>\n"));
        assert!(mermaid::render(&graph).contains(cycler));
        assert!(dot::render(&graph).contains(cycler));
    }
}

#[test]
fn a_robot_without_cyclers_can_be_drawn() {
    let graph = Graph {
        cyclers: Vec::new(),
        edges: Vec::new(),
        ..graph()
    };
    assert!(svg::render(&graph).contains("0 cyclers, 0 nodes, 0 edges"));
}

#[test]
fn the_page_needs_no_other_file() {
    let page = html::render(&graph());
    assert!(!page.contains("{{"));
    assert!(page.contains("<title>Robot walker</title>"));
    let outside = page.replace("http://www.w3.org/2000/svg", "");
    assert!(!outside.contains("http:") && !outside.contains("https:"));
    assert!(page.contains("data-node=\"Control/control::head\""));
}
