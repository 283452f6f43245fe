//! Cycle 2000 of Control as it was recorded: `control::odometry` computes the same again, bit for bit.
//!
//! Written by `hulkgen capture`, with its values in `captured/odometry_control_2000.json`.

use control::odometry::{CycleContext, OdometryProvider};
use framework::testing::Captured;

#[test]
fn odometry_computes_cycle_2000_of_control_again() {
    let captured = Captured::new(include_str!("captured/odometry_control_2000.json"));
    let mut node: OdometryProvider = captured.state();
    let support_side: Option<_> = captured.value("support_side");
    let context = CycleContext {
        robot_kinematics: &captured.value("robot_kinematics"),
        support_side: support_side.as_ref(),
        orientation: &captured.value("orientation"),
        inertial: &captured.value("inertial"),
        fall_state: &captured.value("fall_state"),
        cycle_time: captured.time(),
        forward_scale: &captured.value("forward_scale"),
        left_scale: &captured.value("left_scale"),
        still_distance: &captured.value("still_distance"),
        still_angle: &captured.value("still_angle"),
        still_rotation: &captured.value("still_rotation"),
        still_time: &captured.value("still_time"),
    };
    let outputs = node
        .cycle(context)
        .expect("it did not fail when it was recorded");
    captured.assert_output("odometry", &outputs.odometry.value);
    captured.assert_state(&node);
}
