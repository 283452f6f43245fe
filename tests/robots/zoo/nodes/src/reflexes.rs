//! Faster than thinking.

pub mod bumper;
pub mod create;
pub mod flinch;
pub mod node;
