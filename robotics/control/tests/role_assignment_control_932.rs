//! Cycle 932 of Control as it was recorded: `control::role_assignment` computes the same again, bit for bit.
//!
//! Written by `hulkgen capture`, with its values in `captured/role_assignment_control_932.json`.

use control::role_assignment::{CycleContext, RoleAssignment};
use framework::testing::Captured;

#[test]
fn role_assignment_computes_cycle_932_of_control_again() {
    let captured = Captured::new(include_str!("captured/role_assignment_control_932.json"));
    let mut node: RoleAssignment = captured.state();
    let context = CycleContext {
        primary_state: &captured.value("primary_state"),
        game_controller_state: &captured.value("game_controller_state"),
        whose_ball: &captured.value("whose_ball"),
        ball: &captured.value("ball"),
        team_ball: &captured.value("team_ball"),
        teammates: &captured.value("teammates"),
        player: &captured.value("player"),
        parameters: &captured.value("parameters"),
        markings: &captured.value("markings"),
    };
    let outputs = node
        .cycle(context)
        .expect("it did not fail when it was recorded");
    captured.assert_output("role", &outputs.role.value);
    captured.assert_output("goalkeeper", &outputs.goalkeeper.value);
    captured.assert_state(&node);
}
