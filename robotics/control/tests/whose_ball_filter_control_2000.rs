//! Cycle 2000 of Control as it was recorded: `control::whose_ball_filter` computes the same again, bit for bit.
//!
//! Written by `hulkgen capture`, with its values in `captured/whose_ball_filter_control_2000.json`.

use control::whose_ball_filter::{CycleContext, WhoseBallFilter};
use framework::testing::Captured;

#[test]
fn whose_ball_filter_computes_cycle_2000_of_control_again() {
    let captured = Captured::new(include_str!("captured/whose_ball_filter_control_2000.json"));
    let mut node: WhoseBallFilter = captured.state();
    let context = CycleContext {
        primary_state: &captured.value("primary_state"),
        game_controller_state: &captured.value("game_controller_state"),
        cycle_time: captured.time(),
        set_play_lasts: &captured.value("set_play_lasts"),
    };
    let outputs = node
        .cycle(context)
        .expect("it did not fail when it was recorded");
    captured.assert_output("whose_ball", &outputs.whose_ball.value);
    captured.assert_state(&node);
}
