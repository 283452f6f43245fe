//! Cycle 28 of SplNetwork as it was recorded: `spl_network::game_controller_parser` computes the same again, bit for bit.
//!
//! Written by `hulkgen capture`, with its values in `captured/game_controller_parser_spl_network_28.json`.

use framework::testing::{AdditionalProbe, Captured};
use spl_network::game_controller_parser::{CycleContext, GameControllerParser};

#[test]
fn game_controller_parser_computes_cycle_28_of_spl_network_again() {
    let captured = Captured::new(include_str!(
        "captured/game_controller_parser_spl_network_28.json"
    ));
    let mut node: GameControllerParser = captured.state();
    let mut refusal = AdditionalProbe::default();
    let context = CycleContext {
        datagram: &captured.value("datagram"),
        refusal: refusal.output(),
    };
    let outputs = node
        .cycle(context)
        .expect("it did not fail when it was recorded");
    captured.assert_output(
        "game_controller_packet",
        &outputs.game_controller_packet.value,
    );
    captured.assert_output(
        "game_controller_counts",
        &outputs.game_controller_counts.value,
    );
    captured.assert_state(&node);
}
