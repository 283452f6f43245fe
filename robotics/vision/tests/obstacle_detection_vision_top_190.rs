//! Cycle 190 of VisionTop as it was recorded: `vision::obstacle_detection` computes the same again, bit for bit.
//!
//! Written by `hulkgen capture`, with its values in `captured/obstacle_detection_vision_top_190.json`.

use framework::testing::{AdditionalProbe, Captured};
use vision::obstacle_detection::{CycleContext, ObstacleDetection};

#[test]
fn obstacle_detection_computes_cycle_190_of_vision_top_again() {
    let captured = Captured::new(include_str!(
        "captured/obstacle_detection_vision_top_190.json"
    ));
    let mut node: ObstacleDetection = captured.state();
    let mut obstacle_feet = AdditionalProbe::default();
    let mut obstacles = Default::default();
    let context = CycleContext {
        image_segments: &captured.value("image_segments"),
        field_border: &captured.value("field_border"),
        lines: &captured.value("lines"),
        camera_matrix: &captured.value("camera_matrix"),
        line_width: &captured.value("line_width"),
        ball_radius: &captured.value("ball_radius"),
        parameters: &captured.value("parameters"),
        projection_noise: &captured.value("projection_noise"),
        obstacle_feet: obstacle_feet.output(),
        obstacles: &mut obstacles,
    };
    node.cycle(context)
        .expect("it did not fail when it was recorded");
    captured.assert_output("obstacles", &obstacles);
    captured.assert_state(&node);
}
