//! Cycle 1111 of Control as it was recorded: `control::whistle_filter` computes the same again, bit for bit.
//!
//! Written by `hulkgen capture`, with its values in `captured/whistle_filter_control_1111.json`.

use control::whistle_filter::{CycleContext, WhistleFilter};
use framework::testing::{AdditionalProbe, Captured};

#[test]
fn whistle_filter_computes_cycle_1111_of_control_again() {
    let captured = Captured::new(include_str!("captured/whistle_filter_control_1111.json"));
    let mut node: WhistleFilter = captured.state();
    let whistle_evidence = captured.series("whistle_evidence");
    let whistle_evidence = whistle_evidence.seen();
    let mut votes = AdditionalProbe::default();
    let context = CycleContext {
        whistle_evidence: whistle_evidence.input(),
        cycle_time: captured.time(),
        least_microphones: &captured.value("least_microphones"),
        least_blocks: &captured.value("least_blocks"),
        window: &captured.value("window"),
        votes: votes.output(),
    };
    let outputs = node
        .cycle(context)
        .expect("it did not fail when it was recorded");
    captured.assert_output("whistle", &outputs.whistle.value);
    captured.assert_state(&node);
}
