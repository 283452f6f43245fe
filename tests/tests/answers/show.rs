//! `show`: every stage of the NAO, of a vehicle and of the zoo, for people and for programs.

use std::path::Path;

use support::root;

use crate::robot::Robot;
use crate::{Ended, hulkgen, json};

const STAGES: [&str; 5] = ["manifest", "nodes", "robot", "schedule", "model"];

/// Every stage names every node, in both forms.
#[track_caller]
fn every_stage_names_every_node(folder: &Path) {
    let run = |arguments: &str| Ended::of(&mut hulkgen(folder, arguments)).expect(0).stdout;
    let graph = json(&run("graph --format json"));
    let cyclers = graph["cyclers"].as_array().expect("a list");
    let nodes: Vec<&str> = cyclers
        .iter()
        .flat_map(|cycler| cycler["nodes"].as_array().expect("a list"))
        .map(|node| node["path"].as_str().expect("a path"))
        .collect();
    assert!(nodes.len() > 1, "{graph:#}");
    for stage in STAGES {
        let text = run(&format!("show {stage}"));
        let value = json(&run(&format!("show {stage} --format json")));
        assert!(value.is_object(), "{stage}: {value:#}");
        let mut strings = Vec::new();
        collect(&value, &mut strings);
        for node in &nodes {
            // The text of the model has the names that generated code uses.
            assert!(
                stage == "model" || text.contains(node),
                "{stage}: {node} is missing in\n{text}"
            );
            assert!(
                strings.iter().any(|string| string.contains(node)),
                "{stage}: {node} is missing in\n{value:#}"
            );
        }
    }
}

/// Every text in it, keys too.
fn collect<'a>(value: &'a serde_json::Value, strings: &mut Vec<&'a str>) {
    match value {
        serde_json::Value::String(text) => strings.push(text),
        serde_json::Value::Array(items) => items.iter().for_each(|item| collect(item, strings)),
        serde_json::Value::Object(entries) => {
            for (key, value) in entries {
                strings.push(key);
                collect(value, strings);
            }
        }
        _ => {}
    }
}

#[test]
fn every_stage_of_the_nao_names_its_nodes() {
    every_stage_names_every_node(&root());
}

#[test]
fn every_stage_of_the_zoo_names_its_nodes() {
    every_stage_names_every_node(&root().join("tests/robots/zoo"));
}

#[test]
fn a_stage_is_shown_up_to_the_first_mistake() {
    let robot = Robot::new("perception_and_real_time");
    robot.edit(
        "nodes/src/detector.rs",
        "Input<u8, \"brightness\">",
        "Input<u8, \"light\">",
    );
    for stage in ["manifest", "nodes"] {
        json(
            &robot
                .run(&format!("show {stage} --format json"))
                .expect(0)
                .stdout,
        );
    }
    for stage in ["robot", "schedule", "model"] {
        let ended = robot.run(&format!("show {stage} --format json")).expect(1);
        assert_eq!(ended.stdout, "");
        assert!(
            ended.stderr.contains("error[unknown-output]"),
            "{}",
            ended.stderr
        );
    }
}
