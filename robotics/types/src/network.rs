//! Owns what comes over the network, before anybody has understood it.

use framework::{Clear, Reflect};
use serde::{Deserialize, Serialize};

/// What came in one piece.
#[derive(Clear, Clone, Debug, Default, Deserialize, Eq, PartialEq, Reflect, Serialize)]
pub struct Datagram {
    /// To which port it came.
    pub channel: Channel,
    /// Who sent it.
    pub sender: Endpoint,
    /// What it says; may be anything.
    #[serde(with = "framework::bytes")]
    pub bytes: Vec<u8>,
}

/// What a port is for.
#[derive(Clear, Clone, Copy, Debug, Default, Deserialize, Eq, PartialEq, Reflect, Serialize)]
pub enum Channel {
    /// The referee's computer: control data arrive, answers leave.
    #[default]
    GameController,
    /// The robots of the own team.
    Team,
}

/// A computer and its port.
#[derive(Clear, Clone, Copy, Debug, Default, Deserialize, Eq, PartialEq, Reflect, Serialize)]
pub struct Endpoint {
    /// IPv4 address.
    pub address: [u8; 4],
    /// Port of UDP.
    pub port: u16,
}

/// How many packets of a kind were understood.
#[derive(Clear, Clone, Copy, Debug, Default, Deserialize, Eq, PartialEq, Reflect, Serialize)]
pub struct PacketCounts {
    /// Understood.
    pub accepted: u64,
    /// Not understood: wrong length, version, or content.
    pub rejected: u64,
}
