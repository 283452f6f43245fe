//! Cycler `SplNetwork` (perception), one instance.
//!
//! Written by `hulkgen generate` from hulk.toml and the nodes it names. Do not edit.

use framework::AdditionalOutput;
use framework::Clear;
use framework::Guarded;
use framework::InNode;
use framework::OnFailure;
use framework::Result;
use hardware::NetworkInterface;
use spl_network::game_controller_parser;
use spl_network::message_receiver;
use spl_network::team_message_parser;

use crate::databases::spl_network::Creation;
use crate::databases::spl_network::Frame;

/// The nodes of one instance; they keep their state between cycles.
pub struct Nodes {
    pub game_controller_parser: Guarded<game_controller_parser::GameControllerParser>,
    pub message_receiver: Guarded<message_receiver::MessageReceiver>,
    pub team_message_parser: Guarded<team_message_parser::TeamMessageParser>,
}

impl Nodes {
    pub fn new(creation: &mut Creation<'_, impl NetworkInterface>) -> Result<Self> {
        Ok(Self {
            message_receiver: Guarded::new(
                "spl_network::message_receiver",
                OnFailure::Restart,
                Self::create_message_receiver(creation)?,
            ),
            game_controller_parser: Guarded::new(
                "spl_network::game_controller_parser",
                OnFailure::Restart,
                Self::create_game_controller_parser()?,
            ),
            team_message_parser: Guarded::new(
                "spl_network::team_message_parser",
                OnFailure::Restart,
                Self::create_team_message_parser()?,
            ),
        })
    }

    /// Setup nodes: wait for the data this cycle is about.
    #[inline(always)]
    pub fn setup(&mut self, frame: &mut Frame<'_, impl NetworkInterface>) -> Result<()> {
        self.message_receiver(frame)?;
        Ok(())
    }

    /// Clients' values in place of what setup nodes wrote.
    pub fn inject<Hardware>(frame: &mut Frame<'_, Hardware>) {
        if let Some(injections) = frame.injections {
            injections.datagram.replace(&mut frame.own.datagram);
        }
    }

    /// Nodes: each call reads only what a call above it, or another cycler, wrote.
    #[inline(always)]
    pub fn cycle<Hardware>(&mut self, frame: &mut Frame<'_, Hardware>) -> Result<()> {
        self.game_controller_parser(frame)?;
        self.team_message_parser(frame)?;
        Ok(())
    }

    /// As `cycle`, when it is timed or clients replace outputs.
    #[cold]
    #[inline(never)]
    pub fn cycle_closely<Hardware>(
        &mut self,
        frame: &mut Frame<'_, Hardware>,
    ) -> Result<()> {
        self.cycle(frame)
    }

    /// datagram -> game_controller_packet, game_controller_counts; when subscribed:
    /// game_controller_parser.refusal
    #[inline(always)]
    fn game_controller_parser<Hardware>(
        &mut self,
        frame: &mut Frame<'_, Hardware>,
    ) -> Result<()> {
        let context = game_controller_parser::CycleContext {
            datagram: &frame.own.datagram,
            refusal: AdditionalOutput::new(
                frame.subscribed.game_controller_parser_refusal,
                frame.cycle.number,
                &mut frame.additional_outputs.game_controller_parser.refusal,
            ),
        };
        let outputs = self
            .game_controller_parser
            .call(&frame.cycle, |node| node.cycle(context))?;
        frame.shared.game_controller_packet = outputs.game_controller_packet.value;
        frame.own.game_controller_counts = outputs.game_controller_counts.value;
        if let Some(injections) = frame.injections {
            injections
                .game_controller_packet
                .replace(&mut frame.shared.game_controller_packet);
            injections
                .game_controller_counts
                .replace(&mut frame.own.game_controller_counts);
        }
        Ok(())
    }

    /// hardware -> datagram
    #[inline(always)]
    fn message_receiver(
        &mut self,
        frame: &mut Frame<'_, impl NetworkInterface>,
    ) -> Result<()> {
        Clear::clear(&mut frame.own.datagram);
        let context = message_receiver::CycleContext {
            hardware_interface: frame.hardware_interface,
            datagram: &mut frame.own.datagram,
        };
        let outputs = self
            .message_receiver
            .call(&frame.cycle, |node| node.cycle(context))?;
        *frame.capture_time = Some(outputs.captured_at.0);
        Ok(())
    }

    /// datagram -> team_message, team_message_counts; when subscribed:
    /// team_message_parser.refusal
    #[inline(always)]
    fn team_message_parser<Hardware>(
        &mut self,
        frame: &mut Frame<'_, Hardware>,
    ) -> Result<()> {
        let context = team_message_parser::CycleContext {
            datagram: &frame.own.datagram,
            player_number: &frame.parameters.player.number,
            refusal: AdditionalOutput::new(
                frame.subscribed.team_message_parser_refusal,
                frame.cycle.number,
                &mut frame.additional_outputs.team_message_parser.refusal,
            ),
        };
        let outputs = self
            .team_message_parser
            .call(&frame.cycle, |node| node.cycle(context))?;
        frame.shared.team_message = outputs.team_message.value;
        frame.own.team_message_counts = outputs.team_message_counts.value;
        if let Some(injections) = frame.injections {
            injections.team_message.replace(&mut frame.shared.team_message);
            injections.team_message_counts.replace(&mut frame.own.team_message_counts);
        }
        Ok(())
    }

    fn create_game_controller_parser() -> Result<
        game_controller_parser::GameControllerParser,
    > {
        let context = game_controller_parser::CreationContext {};
        game_controller_parser::GameControllerParser::new(context)
            .in_node("spl_network::game_controller_parser")
    }

    fn create_message_receiver(
        creation: &mut Creation<'_, impl NetworkInterface>,
    ) -> Result<message_receiver::MessageReceiver> {
        let context = message_receiver::CreationContext {
            hardware_interface: creation.hardware_interface,
            team: &creation.parameters.player.team,
        };
        message_receiver::MessageReceiver::new(context)
            .in_node("spl_network::message_receiver")
    }

    fn create_team_message_parser() -> Result<team_message_parser::TeamMessageParser> {
        let context = team_message_parser::CreationContext {};
        team_message_parser::TeamMessageParser::new(context)
            .in_node("spl_network::team_message_parser")
    }
}
