//! The nodes of a robot that rolls along a rail and wants to know where it is.

pub mod image_receiver;
pub mod interfaces;
pub mod message_receiver;
pub mod pace_receiver;
pub mod position_detection;
pub mod position_filter;
pub mod set_printer;
pub mod types;
pub mod wheel_receiver;
