//! Understands what other robots of the own team say, and counts what they cannot have said.
//!
//! Messages are broadcast, so that the own ones come back: they are no news.

use framework::{AdditionalOutput, Input, MainOutput, Parameter, Result, context};
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

    /// Why this cycle's datagram is no team message; no value where it is or is for another channel.
    refusal: AdditionalOutput<String, "team_message_parser.refusal">,
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
    pub fn cycle(&mut self, mut context: CycleContext) -> Result<MainOutputs> {
        let message = match context.datagram.channel {
            Channel::Team => self.understand(&mut context),
            Channel::GameController => None,
        };
        Ok(MainOutputs {
            team_message: message.into(),
            team_message_counts: self.counts.into(),
        })
    }

    fn understand(&mut self, context: &mut CycleContext) -> Option<TeamMessage> {
        match team_message::decode(&context.datagram.bytes) {
            Ok(message) if message.player_number == *context.player_number => None,
            Ok(message) => {
                self.counts.accepted += 1;
                Some(message)
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

    use super::*;

    fn parser() -> TeamMessageParser {
        TeamMessageParser::new(CreationContext {}).unwrap()
    }

    fn cycle(node: &mut TeamMessageParser, channel: Channel, bytes: &[u8]) -> MainOutputs {
        cycle_heard(node, channel, bytes).0
    }

    /// And the reason of a refusal.
    fn cycle_heard(
        node: &mut TeamMessageParser,
        channel: Channel,
        bytes: &[u8],
    ) -> (MainOutputs, Option<String>) {
        let datagram = Datagram {
            channel,
            bytes: bytes.to_vec(),
            ..Datagram::default()
        };
        let mut refusal = AdditionalProbe::default();
        let context = CycleContext {
            datagram: &datagram,
            player_number: &4,
            refusal: refusal.output(),
        };
        (node.cycle(context).unwrap(), refusal.value().cloned())
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
    fn who_listens_hears_why_a_message_is_refused() {
        let mut node = parser();
        let (_, good) = message(2);
        let mut nobody = good.clone();
        nobody[5] = 0;
        let refusals = [&good[..6], &nobody[..], &good, &message(4).1]
            .map(|bytes| cycle_heard(&mut node, Channel::Team, bytes).1);
        let expected = [
            Some("the message has 6 bytes instead of 7"),
            Some("`player number` is 0 instead of a shirt's number from 1 to 20"),
            None,
            None,
        ];
        assert_eq!(refusals.each_ref().map(Option::as_deref), expected);
        let other = cycle_heard(&mut node, Channel::GameController, b"RGme");
        assert_eq!(other.1, None);
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
