//! A NAO V6 without a NAO: its body, cameras, microphones and low level interface, on a simulated
//! field with a referee's computer and a team mate.
//!
//! In reading order: what can be chosen ([`settings`], [`scene`]), the world ([`field`], [`physics`], the
//! cameras, sound), LoLA's server, the network, the thread that turns them in real time
//! ([`Simulator`]), and the framework's hardware on top ([`Hardware`]). [`ground_truth`] and
//! [`NetworkTruth`] tell tests what is really the case.
//!
//! The field frame has its origin at the centre mark, x towards one goal, y to the left, z up.

pub mod camera;
pub mod field;
pub mod ground_truth;
pub mod physics;
pub mod referee;
pub mod scene;
pub mod settings;

mod hardware;
mod network;
mod noise;
mod pacing;
mod per_camera;
mod photograph;
pub mod posture;
mod senses;
mod server;
mod silence;
mod simulation;
mod simulator;
mod sound;
mod stage;
mod world;

pub use ground_truth::{
    BallTruth, BodyTruth, GameTruth, GoalPostTruth, GroundTruth, ImageTruth, RobotTruth,
};
pub use hardware::Hardware;
pub use network::{NetworkTruth, Received};
pub use server::Exchange;
pub use simulator::Simulator;
pub use sound::WhistleTruth;
