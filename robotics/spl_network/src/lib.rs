//! What comes over the network: the nodes of cycler `SplNetwork`.
//!
//! In the order of a cycle: [`message_receiver`] waits for a datagram on any channel, then
//! [`game_controller_parser`] and [`team_message_parser`] each understand those of their channel.

pub mod game_controller_parser;
pub mod message_receiver;
pub mod team_message_parser;
