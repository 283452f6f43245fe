//! Cycle 283 of Audio as it was recorded: `audio::whistle_detection` computes the same again, bit for bit.
//!
//! Written by `hulkgen capture`, with its values in `captured/whistle_detection_audio_283.json`.

use audio::whistle_detection::{CreationContext, CycleContext, WhistleDetection};
use framework::testing::{AdditionalProbe, Captured};

#[test]
fn whistle_detection_computes_cycle_283_of_audio_again() {
    let captured = Captured::new(include_str!("captured/whistle_detection_audio_283.json"));
    let mut node: WhistleDetection = captured.state();
    let created = CreationContext {};
    node.restore(created)
        .expect("it did not fail in the replay");
    let mut peaks = AdditionalProbe::default();
    let context = CycleContext {
        audio_block: &captured.value("audio_block"),
        parameters: &captured.value("parameters"),
        peaks: peaks.output(),
    };
    let outputs = node
        .cycle(context)
        .expect("it did not fail when it was recorded");
    captured.assert_output("whistle_evidence", &outputs.whistle_evidence.value);
    captured.assert_state(&node);
}
