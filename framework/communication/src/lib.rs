//! The server between a running robot and its clients: a WebSocket that says what docs/protocol.md describes, and the page.
//!
//! ```text
//! instances --copies--> Source --text or bytes, once--> Outbox of each client --> Connection --> socket
//!           <-- injections, calls, parameters -- requests <---------------------- Connection <-- socket
//! ```
//! | Module | Owns |
//! |---|---|
//! | [`server`] | the one thread, and where it listens |
//! | `doorman`, `origin` | who may come in |
//! | `guest` | how much of a message is held before it is whole |
//! | `connection`, `outbox` | one client: what it says, and what waits for it |
//! | `hub`, `requests`, `run` | all clients and the robot |
//! | `sources`, `catalogue`, `parameters`, `timings`, `trace`, `logs` | outputs, paths, parameters, durations, log messages |
//! | `press`, `jpeg` | images as files, and how much time they may take |
//! | [`limits`] | how much a client may ask |
//!
//! Invariant: instances never wait for it; it fetches what they leave, and they take what it leaves.

#![warn(missing_docs)]

pub mod limits;
pub mod server;

mod bundle;
mod catalogue;
mod closely;
mod connection;
mod doorman;
mod frames;
mod guest;
mod hub;
mod jpeg;
mod logs;
mod nesting;
mod origin;
mod outbox;
mod page;
mod parameters;
mod press;
mod requests;
mod run;
mod sources;
mod timings;
mod trace;

use framework::Result;
use framework::launch::{Listening, Served};
use framework::link::Link;

pub use limits::Limits;
pub use server::Server;

/// Serves the clients of a robot until the server is dropped: what `main` of a robot's program hands to the launcher.
pub fn serve(link: Link, listening: Listening) -> Result<Option<Box<dyn Served>>> {
    let server = Server::start(link, listening, Limits::default())?;
    Ok(Some(Box::new(server)))
}
