//! Understands what the referee's computer says, and counts what it cannot have said.

use framework::{AdditionalOutput, Input, MainOutput, Result, context};
use serde::{Deserialize, Serialize};
use spl_messages::control_data;
use types::game::GameControllerPacket;
use types::network::{Channel, Datagram, PacketCounts};

/// Counts packets.
#[derive(Debug, Deserialize, Serialize)]
pub struct GameControllerParser {
    counts: PacketCounts,
}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    datagram: Input<Datagram, "datagram">,

    /// Why this cycle's datagram is no control data; no value where it is or is for another channel.
    refusal: AdditionalOutput<String, "game_controller_parser.refusal">,
}

#[context]
pub struct MainOutputs {
    /// What this cycle's datagram says; absent where it is not for this channel or not understood.
    game_controller_packet: MainOutput<Option<GameControllerPacket>>,
    /// All packets of the channel since the start.
    game_controller_counts: MainOutput<PacketCounts>,
}

impl GameControllerParser {
    /// Begins to count.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self {
            counts: PacketCounts::default(),
        })
    }

    /// Never fails: anybody may send anything.
    pub fn cycle(&mut self, mut context: CycleContext) -> Result<MainOutputs> {
        let packet = match context.datagram.channel {
            Channel::GameController => self.understand(&mut context),
            Channel::Team => None,
        };
        Ok(MainOutputs {
            game_controller_packet: packet.into(),
            game_controller_counts: self.counts.into(),
        })
    }

    fn understand(&mut self, context: &mut CycleContext) -> Option<GameControllerPacket> {
        let datagram = context.datagram;
        match control_data::decode(&datagram.bytes) {
            Ok(message) => {
                self.counts.accepted += 1;
                Some(GameControllerPacket {
                    message,
                    sender: datagram.sender,
                })
            }
            Err(error) => {
                self.counts.rejected += 1;
                context.refusal.fill_if_subscribed(|| error.to_string());
                None
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use framework::testing::AdditionalProbe;
    use types::game::{GameControllerMessage, GameState};
    use types::network::Endpoint;

    use super::*;

    const SENDER: Endpoint = Endpoint {
        address: [10, 0, 0, 5],
        port: 3838,
    };

    fn parser() -> GameControllerParser {
        GameControllerParser::new(CreationContext {}).unwrap()
    }

    fn cycle(node: &mut GameControllerParser, channel: Channel, bytes: &[u8]) -> MainOutputs {
        cycle_heard(node, channel, bytes).0
    }

    /// And the reason of a refusal.
    fn cycle_heard(
        node: &mut GameControllerParser,
        channel: Channel,
        bytes: &[u8],
    ) -> (MainOutputs, Option<String>) {
        let datagram = &Datagram {
            channel,
            sender: SENDER,
            bytes: bytes.to_vec(),
        };
        let mut refusal = AdditionalProbe::default();
        let context = CycleContext {
            datagram,
            refusal: refusal.output(),
        };
        (node.cycle(context).unwrap(), refusal.value().cloned())
    }

    fn message() -> GameControllerMessage {
        GameControllerMessage {
            game_state: GameState::Ready,
            ..GameControllerMessage::default()
        }
    }

    #[test]
    fn control_data_are_understood_and_their_sender_is_known() {
        let mut node = parser();
        let bytes = control_data::encode(&message());
        let outputs = cycle(&mut node, Channel::GameController, &bytes);
        let packet = outputs.game_controller_packet.value.unwrap();
        assert_eq!((packet.message, packet.sender), (message(), SENDER));
        let counts = cycle(&mut node, Channel::GameController, &bytes).game_controller_counts;
        assert_eq!((counts.value.accepted, counts.value.rejected), (2, 0));
    }

    #[test]
    fn hostile_packets_are_counted_and_give_nothing() {
        let mut node = parser();
        let good = control_data::encode(&message());
        let mut old = good;
        old[4] = 17;
        let mut flipped = good;
        flipped[10] = 99;
        let hostile: [&[u8]; 5] = [b"", &good[..117], &[0xff; 129], &old, &flipped];
        for (index, bytes) in hostile.into_iter().enumerate() {
            let outputs = cycle(&mut node, Channel::GameController, bytes);
            assert_eq!(outputs.game_controller_packet.value, None);
            let counts = outputs.game_controller_counts.value;
            assert_eq!((counts.accepted, counts.rejected), (0, index as u64 + 1));
        }
        let outputs = cycle(&mut node, Channel::GameController, &good);
        assert!(outputs.game_controller_packet.value.is_some());
    }

    #[test]
    fn who_listens_hears_why_a_packet_is_refused() {
        let mut node = parser();
        let good = control_data::encode(&message());
        let mut old = good;
        old[4] = 17;
        let refusals = [&good[..117], &old, &good]
            .map(|bytes| cycle_heard(&mut node, Channel::GameController, bytes).1);
        let expected = [
            Some("the message has 117 bytes instead of 118"),
            Some("the version is 17 instead of 18"),
            None,
        ];
        assert_eq!(refusals.each_ref().map(Option::as_deref), expected);
        assert_eq!(cycle_heard(&mut node, Channel::Team, b"HGtm").1, None);
    }

    #[test]
    fn the_team_channel_changes_nothing() {
        let mut node = parser();
        for bytes in [&control_data::encode(&message())[..], b"HGtm"] {
            let outputs = cycle(&mut node, Channel::Team, bytes);
            assert_eq!(outputs.game_controller_packet.value, None);
            assert_eq!(
                outputs.game_controller_counts.value,
                PacketCounts::default()
            );
        }
    }
}
