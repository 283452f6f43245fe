//! Cycle 27 of SplNetwork as it was recorded: `spl_network::team_message_parser` computes the same again, bit for bit.
//!
//! Written by `hulkgen capture`, with its values in `captured/team_message_parser_spl_network_27.json`.

use framework::testing::{AdditionalProbe, Captured};
use spl_network::team_message_parser::{CycleContext, TeamMessageParser};

#[test]
fn team_message_parser_computes_cycle_27_of_spl_network_again() {
    let captured = Captured::new(include_str!(
        "captured/team_message_parser_spl_network_27.json"
    ));
    let mut node: TeamMessageParser = captured.state();
    let mut refusal = AdditionalProbe::default();
    let context = CycleContext {
        datagram: &captured.value("datagram"),
        player_number: &captured.value("player_number"),
        refusal: refusal.output(),
    };
    let outputs = node
        .cycle(context)
        .expect("it did not fail when it was recorded");
    captured.assert_output("team_message", &outputs.team_message.value);
    captured.assert_output("team_message_counts", &outputs.team_message_counts.value);
    captured.assert_state(&node);
}
