//! Cycle 2700 of Control as it was recorded: `control::scripted_motion` computes the same again, bit for bit.
//!
//! Written by `hulkgen capture`, with its values in `captured/scripted_motion_control_2700.json`.

use control::scripted_motion::{CycleContext, ScriptedMotion};
use framework::testing::Captured;

#[test]
fn scripted_motion_computes_cycle_2700_of_control_again() {
    let captured = Captured::new(include_str!("captured/scripted_motion_control_2700.json"));
    let mut node: ScriptedMotion = captured.state();
    let previous: Option<_> = captured.value("previous");
    let mut safe_exit = captured.value("safe_exit");
    let context = CycleContext {
        motion_selection: &captured.value("motion_selection"),
        positions: &captured.value("positions"),
        previous: previous.as_ref(),
        cycle_time: captured.time(),
        safe_exit: &mut safe_exit,
        motions: &captured.value("motions"),
    };
    let outputs = node
        .cycle(context)
        .expect("it did not fail when it was recorded");
    captured.assert_output("script_commands", &outputs.script_commands.value);
    captured.assert_state(&node);
}
