//! Understands what other robots of the own team say, and counts what they cannot have said.
//!
//! Messages are broadcast, so that the own ones come back: they are no news.

use framework::{Input, MainOutput, Parameter, Result, context};
use serde::{Deserialize, Serialize};
use spl_messages::team_message;
use types::network::{Channel, Datagram, PacketCounts};
use types::team::TeamMessage;

/// Counts packets.
#[derive(Debug, Deserialize, Serialize)]
pub struct TeamMessageParser {
    counts: PacketCounts,
}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    datagram: Input<Datagram, "datagram">,
    player_number: Parameter<u8, "player.number">,
}

#[context]
pub struct MainOutputs {
    /// What this cycle's datagram says; absent where it is not for this channel, not understood, or
    /// from this robot itself.
    team_message: MainOutput<Option<TeamMessage>>,
    /// All packets of other robots since the start.
    team_message_counts: MainOutput<PacketCounts>,
}

impl TeamMessageParser {
    /// Begins to count.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self {
            counts: PacketCounts::default(),
        })
    }

    /// Never fails: anybody may send anything.
    pub fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs> {
        let message = match context.datagram.channel {
            Channel::Team => self.understand(&context.datagram.bytes, *context.player_number),
            Channel::GameController => None,
        };
        Ok(MainOutputs {
            team_message: message.into(),
            team_message_counts: self.counts.into(),
        })
    }

    fn understand(&mut self, bytes: &[u8], player_number: u8) -> Option<TeamMessage> {
        match team_message::decode(bytes) {
            Ok(message) if message.player_number == player_number => None,
            Ok(message) => {
                self.counts.accepted += 1;
                Some(message)
            }
            Err(_) => {
                self.counts.rejected += 1;
                None
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parser() -> TeamMessageParser {
        TeamMessageParser::new(CreationContext {}).unwrap()
    }

    fn cycle(node: &mut TeamMessageParser, channel: Channel, bytes: &[u8]) -> MainOutputs {
        let datagram = Datagram {
            channel,
            bytes: bytes.to_vec(),
            ..Datagram::default()
        };
        let context = CycleContext {
            datagram: &datagram,
            player_number: &4,
        };
        node.cycle(context).unwrap()
    }

    fn message(player_number: u8) -> (TeamMessage, Vec<u8>) {
        let message = TeamMessage {
            player_number,
            is_fallen: true,
            ..TeamMessage::default()
        };
        let mut room = [0; team_message::GREATEST_LENGTH];
        let bytes = team_message::encode(&message, &mut room).unwrap().to_vec();
        (message, bytes)
    }

    #[test]
    fn a_team_mate_is_understood() {
        let mut node = parser();
        let (message, bytes) = message(2);
        let outputs = cycle(&mut node, Channel::Team, &bytes);
        assert_eq!(outputs.team_message.value, Some(message));
        assert_eq!(outputs.team_message_counts.value.accepted, 1);
    }

    #[test]
    fn own_messages_that_come_back_are_no_news_and_no_mistake() {
        let mut node = parser();
        let outputs = cycle(&mut node, Channel::Team, &message(4).1);
        assert_eq!(outputs.team_message.value, None);
        assert_eq!(outputs.team_message_counts.value, PacketCounts::default());
    }

    #[test]
    fn hostile_packets_are_counted_and_give_nothing() {
        let mut node = parser();
        let (_, good) = message(2);
        let mut nobody = good.clone();
        nobody[5] = 0;
        let long = [&good[..], &[0]].concat();
        let hostile: [&[u8]; 5] = [b"", &good[..6], &[0xff; 129], &nobody, &long];
        for (index, bytes) in hostile.into_iter().enumerate() {
            let outputs = cycle(&mut node, Channel::Team, bytes);
            assert_eq!(outputs.team_message.value, None);
            let counts = outputs.team_message_counts.value;
            assert_eq!((counts.accepted, counts.rejected), (0, index as u64 + 1));
        }
        let outputs = cycle(&mut node, Channel::Team, &good);
        assert!(outputs.team_message.value.is_some());
    }

    #[test]
    fn the_channel_of_the_referee_changes_nothing() {
        let mut node = parser();
        for bytes in [&message(2).1[..], b"RGme"] {
            let outputs = cycle(&mut node, Channel::GameController, bytes);
            assert_eq!(outputs.team_message.value, None);
            assert_eq!(outputs.team_message_counts.value, PacketCounts::default());
        }
    }
}
