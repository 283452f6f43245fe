//! The server with a robot that runs, over real sockets.

mod arriving;
mod files;
mod fuzz;
mod hostile;
mod limits;
mod remote;
mod requests;
mod subscriptions;
mod timings;
mod zoo;
