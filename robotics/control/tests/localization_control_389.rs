//! Cycle 389 of Control as it was recorded: `control::localization` computes the same again, bit for bit.
//!
//! Written by `hulkgen capture`, with its values in `captured/localization_control_389.json`.

use control::localization::{CycleContext, Localization};
use framework::testing::{AdditionalProbe, Captured};

#[test]
fn localization_computes_cycle_389_of_control_again() {
    let captured = Captured::new(include_str!("captured/localization_control_389.json"));
    let mut node: Localization = captured.state();
    let lines = captured.series("lines");
    let lines = lines.seen();
    let penalty_mark = captured.series("penalty_mark");
    let penalty_mark = penalty_mark.seen();
    let center_circle = captured.series("center_circle");
    let center_circle = center_circle.seen();
    let corners = captured.series("corners");
    let corners = corners.seen();
    let odometry = captured.history("odometry");
    let odometry = odometry.seen();
    let mut hypotheses = AdditionalProbe::default();
    let context = CycleContext {
        lines: lines.input(),
        penalty_mark: penalty_mark.input(),
        center_circle: center_circle.input(),
        corners: corners.input(),
        odometry: odometry.input(),
        fall_state: &captured.value("fall_state"),
        has_ground_contact: &captured.value("has_ground_contact"),
        primary_state: &captured.value("primary_state"),
        game_controller_state: &captured.value("game_controller_state"),
        cycle_time: captured.time(),
        player: &captured.value("player"),
        markings: &captured.value("markings"),
        parameters: &captured.value("parameters"),
        hypotheses: hypotheses.output(),
    };
    let outputs = node
        .cycle(context)
        .expect("it did not fail when it was recorded");
    captured.assert_output("ground_to_field", &outputs.ground_to_field.value);
    captured.assert_state(&node);
}
