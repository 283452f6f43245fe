//! Cycle 2601 of Control as it was recorded: `control::behavior` computes the same again, bit for bit.
//!
//! Written by `hulkgen capture`, with its values in `captured/behavior_control_2601.json`.

use control::behavior::{Behavior, CycleContext};
use framework::testing::{AdditionalProbe, Captured};

#[test]
fn behavior_computes_cycle_2601_of_control_again() {
    let captured = Captured::new(include_str!("captured/behavior_control_2601.json"));
    let mut node: Behavior = captured.state();
    let client_wish: Option<_> = captured.value("client_wish");
    let mut plan = AdditionalProbe::default();
    let context = CycleContext {
        world_state: &captured.value("world_state"),
        client_wish: client_wish.as_ref(),
        cycle_time: captured.time(),
        parameters: &captured.value("parameters"),
        plan: plan.output(),
    };
    let outputs = node
        .cycle(context)
        .expect("it did not fail when it was recorded");
    captured.assert_output("motion_command", &outputs.motion_command.value);
    captured.assert_output("activity", &outputs.activity.value);
    captured.assert_state(&node);
}
