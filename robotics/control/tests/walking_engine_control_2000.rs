//! Cycle 2000 of Control as it was recorded: `control::walking_engine` computes the same again, bit for bit.
//!
//! Written by `hulkgen capture`, with its values in `captured/walking_engine_control_2000.json`.
//! The least weight stood in code that day: written in by hand.

use control::walking_engine::{CycleContext, WalkingEngine};
use framework::testing::Captured;

#[test]
fn walking_engine_computes_cycle_2000_of_control_again() {
    let captured = Captured::new(include_str!("captured/walking_engine_control_2000.json"));
    let mut node: WalkingEngine = captured.state();
    let mut safe_exit = captured.value("safe_exit");
    let context = CycleContext {
        motion_command: &captured.value("motion_command"),
        motion_selection: &captured.value("motion_selection"),
        gyroscope: &captured.value("gyroscope"),
        orientation: &captured.value("orientation"),
        resistors: &captured.value("resistors"),
        temperatures: &captured.value("temperatures"),
        cycle_time: captured.time(),
        safe_exit: &mut safe_exit,
        parameters: &captured.value("parameters"),
        heat: &captured.value("heat"),
        least_weight: &captured.value("least_weight"),
    };
    let outputs = node
        .cycle(context)
        .expect("it did not fail when it was recorded");
    captured.assert_output("walk_commands", &outputs.walk_commands.value);
    captured.assert_state(&node);
}
