//! What cycler `SplNetwork` writes, and what its nodes see.
//!
//! Written by `hulkgen generate` from hulk.toml and the nodes it names. Do not edit.

use std::sync::Arc;

use framework::AdditionalSlot;
use framework::Cycle;
use framework::Injection;
use framework::InjectionCell;
use framework::InjectionTable;
use framework::Reflect;
use framework::Timestamp;
use framework::recorded::Outputs;
use serde::Deserialize;
use serde::Serialize;
use types::game::GameControllerPacket;
use types::network::Datagram;
use types::network::PacketCounts;
use types::team::TeamMessage;

use crate::parameters::Parameters;

/// Main outputs that only nodes of `SplNetwork` read: they stay with the instance.
#[derive(Clone, Debug, Default, Deserialize, Reflect, Serialize)]
pub struct OwnOutputs {
    /// spl_network::message_receiver
    pub datagram: Datagram,
    /// spl_network::game_controller_parser
    pub game_controller_counts: PacketCounts,
    /// spl_network::team_message_parser
    pub team_message_counts: PacketCounts,
}

/// Main outputs that other instances read, too: written in the slot that those will read.
#[derive(Clone, Debug, Default, Deserialize, Outputs, Reflect, Serialize)]
pub struct SharedOutputs {
    /// spl_network::game_controller_parser
    pub game_controller_packet: Option<GameControllerPacket>,
    /// spl_network::team_message_parser
    pub team_message: Option<TeamMessage>,
}

/// Computed only while somebody listens.
#[derive(Debug, Default)]
pub struct AdditionalOutputs {
    pub game_controller_parser: AdditionalOutputsGameControllerParser,
    pub team_message_parser: AdditionalOutputsTeamMessageParser,
}

#[derive(Debug, Default)]
pub struct AdditionalOutputsGameControllerParser {
    /// spl_network::game_controller_parser
    pub refusal: AdditionalSlot<String>,
}

#[derive(Debug, Default)]
pub struct AdditionalOutputsTeamMessageParser {
    /// spl_network::team_message_parser
    pub refusal: AdditionalSlot<String>,
}

/// Who listens to which additional output, decided once per cycle.
#[derive(Clone, Copy, Debug, Default, Deserialize, Serialize)]
pub struct Subscribed {
    pub game_controller_parser_refusal: bool,
    pub team_message_parser_refusal: bool,
}

/// Values of clients in place of main outputs.
#[derive(Clone, Debug, Default, Deserialize, Outputs, Serialize)]
pub struct Injections {
    pub datagram: Injection<Datagram>,
    pub game_controller_counts: Injection<PacketCounts>,
    pub game_controller_packet: Injection<Option<GameControllerPacket>>,
    pub team_message: Injection<Option<TeamMessage>>,
    pub team_message_counts: Injection<PacketCounts>,
}

impl InjectionTable for Injections {
    fn get_mut(&mut self, output: &str) -> Option<&mut dyn InjectionCell> {
        match output {
            "datagram" => Some(&mut self.datagram),
            "game_controller_counts" => Some(&mut self.game_controller_counts),
            "game_controller_packet" => Some(&mut self.game_controller_packet),
            "team_message" => Some(&mut self.team_message),
            "team_message_counts" => Some(&mut self.team_message_counts),
            _ => None,
        }
    }
}

/// Everything a node may ask for when it is created.
pub struct Creation<'a, Hardware> {
    pub hardware_interface: &'a Arc<Hardware>,
    pub parameters: &'a Parameters,
}

/// Everything the nodes of one cycle may touch, borrowed.
pub struct Frame<'a, Hardware> {
    pub additional_outputs: &'a mut AdditionalOutputs,
    pub capture_time: &'a mut Option<Timestamp>,
    pub cycle: Cycle,
    pub hardware_interface: &'a Arc<Hardware>,
    pub injections: Option<&'a Injections>,
    pub own: &'a mut OwnOutputs,
    pub parameters: &'a Parameters,
    pub shared: &'a mut SharedOutputs,
    pub subscribed: Subscribed,
}
