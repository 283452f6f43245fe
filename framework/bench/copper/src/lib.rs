//! The work of the robot `trivial` as a graph of copper, with and without its log.

mod logging;
mod quiet;
mod tasks;

pub use logging::Logging;
pub use quiet::Quiet;
