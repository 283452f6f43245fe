//! Faster than thinking.

pub mod bumper;
pub mod flinch;
