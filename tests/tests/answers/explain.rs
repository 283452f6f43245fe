//! `explain` about the NAO.

use crate::{answer, json};

#[test]
fn the_examples_of_the_help_work_on_this_robot() {
    let help = answer("explain --help");
    let examples = help
        .lines()
        .filter_map(|line| line.trim().strip_prefix("hulkgen explain "))
        .map(|line| line.split('#').next().unwrap_or_default());
    let mut tried = 0;
    for example in examples.filter(|example| !example.contains(['<', '['])) {
        assert!(!answer(&format!("explain {example}")).is_empty());
        json(&answer(&format!("explain {example} --format json")));
        tried += 1;
    }
    assert_eq!(tried, 6, "{help}");
}

#[test]
fn a_parameter_names_its_readers_and_its_files() {
    let text = answer("explain player.number");
    assert!(text.contains("read by control::self_report"), "{text}");
    assert!(text.contains("Number of the shirt"), "{text}");
    assert!(text.contains("robotics/parameters/default.toml:"), "{text}");
}

#[test]
fn a_parameter_has_its_unit_and_its_range() {
    let text = answer("explain odometry.still_rotation");
    assert!(
        text.starts_with("odometry.still_rotation: f32 in rad/s, within 0..\n"),
        "{text}"
    );
    assert!(
        text.contains("A torso that turns more slowly is still"),
        "{text}"
    );
    let field = answer("explain ball_filter.rolling_time");
    assert!(
        field.contains("  ball_filter.rolling_time: f32 in s, within 0..\n"),
        "{field}"
    );
}

#[test]
fn a_field_of_a_parameter_has_its_own_type_docs_and_value() {
    let text = answer("explain parameters.ball_filter.gate");
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(
        lines[0],
        "ball_filter: control::ball_filter::BallFilterParameters"
    );
    assert!(lines[1].starts_with("  read by control::ball_filter of Control (robotics/control/"));
    assert!(lines.contains(&"  ball_filter.gate: f32"), "{text}");
    assert!(
        lines
            .iter()
            .any(|line| line.trim_start().starts_with("In standard deviations"))
    );
    assert!(!text.contains("ball_filter.rolling_time"), "{text}");

    let whole = json(&answer("explain ball_filter.gate --format json"));
    let value = &whole["parameters"][0]["values"][0];
    assert_eq!(value["path"], "ball_filter.gate", "{whole:#}");
    assert_eq!(value["type"], "f32");
    let given = &value["given"][0];
    assert_eq!(given["file"], "robotics/parameters/default.toml");
    let line = given["line"].as_u64().expect("a line") as usize;
    let file = std::fs::read_to_string(support::root().join("robotics/parameters/default.toml"));
    let file = file.expect("the robot has it");
    let written = file.lines().nth(line - 1).expect("the line is there");
    let value = given["value"].as_str().expect("as it is written");
    assert!(
        written.starts_with("gate = ") && written.contains(value),
        "{written}"
    );
}

#[test]
fn an_order_is_explained_by_the_field_that_asks_for_it() {
    // In whichever order they are named.
    for pair in ["ball_filter odometry", "odometry ball_filter"] {
        let text = answer(&format!("explain order {pair}"));
        let first = "control::odometry runs before control::ball_filter in Control, as ";
        assert!(text.starts_with(first), "{text}");
        let why = "  control::ball_filter reads odometry of control::odometry: odometry (HistoricInput, robotics/control/src/ball_filter.rs:";
        assert!(text.contains(why), "{text}");
    }
    let order = json(&answer("explain order ball_filter odometry --format json"));
    let order = &order["orders"][0];
    assert_eq!(order["first"]["node"], "control::odometry");
    assert_eq!(order["second"]["node"], "control::ball_filter");
    let (first, second) = (&order["first"]["order"], &order["second"]["order"]);
    assert!(first.as_u64() < second.as_u64(), "{order:#}");
    let step = &order["steps"][0];
    assert_eq!(step["why"], "field");
    let node = std::fs::read_to_string(support::root().join("robotics/control/src/ball_filter.rs"));
    let line = step["line"].as_u64().expect("a line") as usize;
    let node = node.expect("the robot has it");
    let field = node.lines().nth(line - 1).expect("the line is there");
    assert!(field.contains("odometry: HistoricInput<"), "{field}");
}

#[test]
fn an_order_along_several_nodes_names_every_step() {
    let order = json(&answer(
        "explain order sensor_data_receiver command_sender --format json",
    ));
    let order = &order["orders"][0];
    let steps = order["steps"].as_array().expect("a list");
    assert_eq!(steps[0]["before"], "control::sensor_data_receiver");
    for pair in steps.windows(2) {
        assert_eq!(pair[0]["after"], pair[1]["before"], "{order:#}");
    }
    assert_eq!(
        steps.last().map(|step| &step["after"]),
        Some(&order["second"]["node"])
    );
    let text = answer("explain order sensor_data_receiver command_sender");
    assert_eq!(text.lines().count(), 1 + steps.len(), "{text}");
}

#[test]
fn nodes_of_different_cyclers_have_no_order_but_edges() {
    let text = answer("explain order ball_detection ball_filter");
    for part in [
        "vision::ball_detection",
        "control::ball_filter",
        "Vision",
        "Control",
        "balls",
    ] {
        assert!(text.contains(part), "`{part}` is missing in: {text}");
    }
    assert!(!text.contains("runs before"), "{text}");
}

#[test]
fn a_failure_says_what_happens_and_who_sees_it() {
    let text = answer("explain --if-fails camera_matrices");
    assert!(
        text.starts_with("control::camera_matrices: node of Control, on failure stop\n"),
        "{text}"
    );
    for part in [
        "  the cycle is abandoned\n",
        "  the robot stops, in order, and the hardware goes into its safe state\n",
        "control::command_sender",
        "  Vision vision::camera_matrix_extractor: camera_matrices (LatestInput of Control.camera_matrices) gets nothing new: the robot stops\n",
    ] {
        assert!(text.contains(part), "`{part}` is missing in: {text}");
    }
    let failure = json(&answer("explain --if-fails camera_matrices --format json"));
    let failure = &failure["failures"][0];
    assert_eq!(failure["on_failure"], "stop", "{failure:#}");
    assert_eq!(failure["node"], "control::camera_matrices");
    let not_run = failure["not_run"].as_array().expect("a list");
    assert!(not_run.contains(&"control::command_sender".into()));
    // What runs before it has run.
    assert!(!not_run.contains(&"control::orientation_filter".into()));
}
