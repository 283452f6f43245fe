//! What connects a robot's program with what is outside of it, whether that is real or simulated: the UDP sockets of a
//! game, and cameras and microphones of another process.

pub mod senses;
pub mod sockets;
