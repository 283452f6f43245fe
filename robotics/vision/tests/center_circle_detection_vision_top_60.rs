//! Cycle 60 of VisionTop as it was recorded: `vision::center_circle_detection` computes the same again, bit for bit.
//!
//! Written by `hulkgen capture`, with its values in `captured/center_circle_detection_vision_top_60.json`.

use framework::testing::{AdditionalProbe, Captured};
use vision::center_circle_detection::{CenterCircleDetection, CycleContext};

#[test]
fn center_circle_detection_computes_cycle_60_of_vision_top_again() {
    let captured = Captured::new(include_str!(
        "captured/center_circle_detection_vision_top_60.json"
    ));
    let mut node: CenterCircleDetection = captured.state();
    let mut image_circle = AdditionalProbe::default();
    let context = CycleContext {
        lines: &captured.value("lines"),
        camera_matrix: &captured.value("camera_matrix"),
        radius: &captured.value("radius"),
        parameters: &captured.value("parameters"),
        image_circle: image_circle.output(),
    };
    let outputs = node
        .cycle(context)
        .expect("it did not fail when it was recorded");
    captured.assert_output("center_circle", &outputs.center_circle.value);
    captured.assert_state(&node);
}
