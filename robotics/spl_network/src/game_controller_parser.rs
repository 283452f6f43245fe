//! Understands what the referee's computer says, and counts what it cannot have said.

use framework::{Input, MainOutput, Result, context};
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
    pub fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs> {
        let packet = match context.datagram.channel {
            Channel::GameController => self.understand(context.datagram),
            Channel::Team => None,
        };
        Ok(MainOutputs {
            game_controller_packet: packet.into(),
            game_controller_counts: self.counts.into(),
        })
    }

    fn understand(&mut self, datagram: &Datagram) -> Option<GameControllerPacket> {
        let message = control_data::decode(&datagram.bytes).ok();
        match message {
            Some(_) => self.counts.accepted += 1,
            None => self.counts.rejected += 1,
        }
        Some(GameControllerPacket {
            message: message?,
            sender: datagram.sender,
        })
    }
}

#[cfg(test)]
mod tests {
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
        let datagram = &Datagram {
            channel,
            sender: SENDER,
            bytes: bytes.to_vec(),
        };
        node.cycle(CycleContext { datagram }).unwrap()
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
