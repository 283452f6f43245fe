//! Cycle 1331 of Control as it was recorded: `control::obstacle_filter` computes the same again, bit for bit.
//!
//! Written by `hulkgen capture`, with its values in `captured/obstacle_filter_control_1331.json`.

use control::obstacle_filter::{CycleContext, ObstacleFilter};
use framework::testing::Captured;

#[test]
fn obstacle_filter_computes_cycle_1331_of_control_again() {
    let captured = Captured::new(include_str!("captured/obstacle_filter_control_1331.json"));
    let mut node: ObstacleFilter = captured.state();
    let candidates = captured.series("candidates");
    let candidates = candidates.seen();
    let odometry = captured.history("odometry");
    let odometry = odometry.seen();
    let mut obstacles = Default::default();
    let context = CycleContext {
        candidates: candidates.input(),
        odometry: odometry.input(),
        sonar_distances: &captured.value("sonar_distances"),
        bumpers: &captured.value("bumpers"),
        fall_state: &captured.value("fall_state"),
        cycle_time: captured.time(),
        parameters: &captured.value("parameters"),
        obstacles: &mut obstacles,
    };
    node.cycle(context)
        .expect("it did not fail when it was recorded");
    captured.assert_output("obstacles", &obstacles);
    captured.assert_state(&node);
}
