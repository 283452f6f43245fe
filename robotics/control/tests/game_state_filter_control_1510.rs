//! Cycle 1510 of Control as it was recorded: `control::game_state_filter` computes the same again, bit for bit.
//!
//! Written by `hulkgen capture`, with its values in `captured/game_state_filter_control_1510.json`.

use control::game_state_filter::{CycleContext, GameStateFilter};
use framework::testing::Captured;

#[test]
fn game_state_filter_computes_cycle_1510_of_control_again() {
    let captured = Captured::new(include_str!("captured/game_state_filter_control_1510.json"));
    let mut node: GameStateFilter = captured.state();
    let context = CycleContext {
        game_controller_state: &captured.value("game_controller_state"),
        buttons: &captured.value("buttons"),
        whistle: &captured.value("whistle"),
        cycle_time: captured.time(),
        playing_delay: &captured.value("playing_delay"),
        playing_margin: &captured.value("playing_margin"),
    };
    let outputs = node
        .cycle(context)
        .expect("it did not fail when it was recorded");
    captured.assert_output("primary_state", &outputs.primary_state.value);
    captured.assert_state(&node);
}
