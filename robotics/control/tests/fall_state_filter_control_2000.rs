//! Cycle 2000 of Control as it was recorded: `control::fall_state_filter` computes the same again, bit for bit.
//!
//! Written by `hulkgen capture`, with its values in `captured/fall_state_filter_control_2000.json`.

use control::fall_state_filter::{CycleContext, FallStateFilter};
use framework::testing::{AdditionalProbe, Captured};

#[test]
fn fall_state_filter_computes_cycle_2000_of_control_again() {
    let captured = Captured::new(include_str!("captured/fall_state_filter_control_2000.json"));
    let mut node: FallStateFilter = captured.state();
    let mut center_of_mass_overhang = AdditionalProbe::default();
    let context = CycleContext {
        inertial: &captured.value("inertial"),
        orientation: &captured.value("orientation"),
        positions: &captured.value("positions"),
        robot_kinematics: &captured.value("robot_kinematics"),
        center_of_mass: &captured.value("center_of_mass"),
        has_ground_contact: &captured.value("has_ground_contact"),
        cycle_time: captured.time(),
        tilt: &captured.value("tilt"),
        overhang: &captured.value("overhang"),
        tilting_rotation: &captured.value("tilting_rotation"),
        acceleration_time: &captured.value("acceleration_time"),
        resting_deviation: &captured.value("resting_deviation"),
        sitting: &captured.value("sitting"),
        longest_fall: &captured.value("longest_fall"),
        center_of_mass_overhang: center_of_mass_overhang.output(),
    };
    let outputs = node
        .cycle(context)
        .expect("it did not fail when it was recorded");
    captured.assert_output("fall_state", &outputs.fall_state.value);
    captured.assert_state(&node);
}
