//! The nodes of a Booster K1 that stands, looks around and waves.

pub mod body_receiver;
pub mod interfaces;
pub mod joints;
pub mod look_around;
pub mod motor_sender;
pub mod prepare;
pub mod types;
pub mod wave;

mod swing;
