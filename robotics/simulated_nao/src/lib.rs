//! A NAO V6 without a NAO: its body, cameras and low level interface, on a simulated field.
//!
//! In reading order: what can be chosen ([`settings`]), the world ([`field`], [`physics`], the
//! cameras), LoLA's server, the thread that turns them in real time ([`Simulator`]), and the
//! framework's hardware on top ([`Hardware`]). [`ground_truth`] tells tests what is really the case.
//!
//! The field frame has its origin at the centre mark, x towards one goal, y to the left, z up.

pub mod camera;
pub mod field;
pub mod ground_truth;
pub mod physics;
pub mod settings;

mod hardware;
pub mod posture;
mod safety;
mod server;
mod simulation;
mod simulator;
mod world;

pub use ground_truth::{BallTruth, BodyTruth, GroundTruth, ImageTruth};
pub use hardware::Hardware;
pub use simulator::Simulator;
