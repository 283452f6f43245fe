//! Cycle 932 of Control as it was recorded: `control::team_ball_filter` computes the same again, bit for bit.
//!
//! Written by `hulkgen capture`, with its values in `captured/team_ball_filter_control_932.json`.

use control::team_ball_filter::{CycleContext, TeamBallFilter};
use framework::testing::Captured;

#[test]
fn team_ball_filter_computes_cycle_932_of_control_again() {
    let captured = Captured::new(include_str!("captured/team_ball_filter_control_932.json"));
    let mut node: TeamBallFilter = captured.state();
    let context = CycleContext {
        ground_to_field: &captured.value("ground_to_field"),
        ball: &captured.value("ball"),
        teammates: &captured.value("teammates"),
        cycle_time: captured.time(),
        player: &captured.value("player"),
        parameters: &captured.value("parameters"),
    };
    let outputs = node
        .cycle(context)
        .expect("it did not fail when it was recorded");
    captured.assert_output("team_ball", &outputs.team_ball.value);
    captured.assert_state(&node);
}
