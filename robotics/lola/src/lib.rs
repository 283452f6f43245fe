//! Speaks with LoLA, the process on the NAO V6 that serves sensors and takes commands.
//!
//! LoLA listens on a UNIX stream socket, sends one MessagePack map of 896 bytes every 12 ms, and takes
//! one map in reply to each (Aldebaran documentation, RoboCup SPL LoLA notes). [`state`] and
//! [`command`] read and write these maps without allocating; [`Client`] is the robot's end of the
//! socket. Simulators use the same codec from the other side.

pub mod client;

pub mod command;
pub mod state;

pub mod error;

mod safety;

mod messagepack;

pub use client::{Client, Counts};
pub use command::{COMMAND_BYTES, Command};
pub use error::DecodeError;
pub use safety::Safety;
pub use state::STATE_BYTES;

/// Where LoLA listens on the robot.
pub const SOCKET: &str = "/tmp/robocup";
