//! Cycle 1157 of Control as it was recorded: `control::ball_filter` computes the same again, bit for bit.
//!
//! Written by `hulkgen capture`, with its values in `captured/ball_filter_control_1157.json`.

use control::ball_filter::{BallFilter, CycleContext};
use framework::testing::{AdditionalProbe, Captured};

#[test]
fn ball_filter_computes_cycle_1157_of_control_again() {
    let captured = Captured::new(include_str!("captured/ball_filter_control_1157.json"));
    let mut node: BallFilter = captured.state();
    let balls = captured.series("balls");
    let balls = balls.seen();
    let ball_views = captured.series("ball_views");
    let ball_views = ball_views.seen();
    let borders = captured.series("borders");
    let borders = borders.seen();
    let limb_masks = captured.series("limb_masks");
    let limb_masks = limb_masks.seen();
    let obstacles_seen = captured.series("obstacles_seen");
    let obstacles_seen = obstacles_seen.seen();
    let odometry = captured.history("odometry");
    let odometry = odometry.seen();
    let mut hypotheses = AdditionalProbe::default();
    let mut persistent_ball = AdditionalProbe::default();
    let mut delivered = AdditionalProbe::default();
    let context = CycleContext {
        balls: balls.input(),
        ball_views: ball_views.input(),
        borders: borders.input(),
        limb_masks: limb_masks.input(),
        obstacles_seen: obstacles_seen.input(),
        obstacles: &captured.value("obstacles"),
        odometry: odometry.input(),
        cycle_time: captured.time(),
        parameters: &captured.value("parameters"),
        hypotheses: hypotheses.output(),
        persistent_ball: persistent_ball.output(),
        delivered: delivered.output(),
    };
    let outputs = node
        .cycle(context)
        .expect("it did not fail when it was recorded");
    captured.assert_output("ball", &outputs.ball.value);
    captured.assert_state(&node);
}
