//! Each policy, and how far a failure spreads.

use super::{explain, text};
use crate::graph::fixture;
use crate::pipeline::Understood;
use crate::resolve::parameter_files::Unchecked;
use crate::resolve::robot::{OnFailure, Robot};

fn failing(mut robot: Robot, node: &str, policy: OnFailure) -> String {
    let nodes = robot
        .cyclers
        .iter_mut()
        .flat_map(|cycler| &mut cycler.nodes);
    for found in nodes.filter(|found| found.path == node) {
        found.on_failure = policy;
    }
    let schedule = fixture::schedule();
    let understood = Understood {
        robot,
        schedule,
        unchecked: Unchecked::default(),
    };
    text(&explain(&understood, node).expect("the node is there"))
}

#[test]
fn skipped_outputs_are_defaults_and_a_required_input_skips_on() {
    assert_eq!(
        failing(fixture::robot(), "control::ball_filter", OnFailure::Skip),
        "\
control::ball_filter: node of Control, on failure skip
  the cycle goes on
  its outputs are defaults: ball, matrix
  Vision vision::ball_detection: matrix (RequiredInput of Control.matrix?) is absent: the node is skipped, its outputs are defaults
  Control control::head: ball (Input of Control.ball) is the default
  Control control::ball_filter: balls (PerceptionInput of Vision.balls) has entries with the default
  Control control::head: calibration (CyclerState of Control.calibration) stays what it was
"
    );
}

#[test]
fn a_restart_keeps_the_latest_values_and_abandons_the_entry() {
    let text = failing(
        fixture::robot(),
        "vision::ball_detection",
        OnFailure::Restart,
    );
    assert!(text.contains("created anew"), "{text}");
    assert!(!text.contains("safe state"), "{text}");
    assert!(
        text.contains(
            "control::ball_filter: balls (PerceptionInput of VisionBottom.balls) never gets this cycle's entry"
        ),
        "{text}"
    );
    assert!(
        text.contains(
            "control::command_sender: image (LatestInput of VisionTop.image) stays what it was"
        ),
        "{text}"
    );
}

#[test]
fn a_setup_node_that_fails_under_hold_starts_over() {
    let text = failing(fixture::robot(), "vision::image_receiver", OnFailure::Hold);
    assert!(
        text.contains("no cycle begins; setup starts over"),
        "{text}"
    );
    assert!(
        text.contains("(PerceptionInput of VisionTop.balls) has no entry"),
        "{text}"
    );
}

#[test]
fn under_stop_the_robot_stops() {
    let text = failing(fixture::robot(), "control::head", OnFailure::Stop);
    assert!(text.contains("a call of walk is refused"), "{text}");
    assert!(text.contains("the robot stops, in order"), "{text}");
    assert!(text.contains("gets nothing new: the robot stops"), "{text}");
}
