//! Listens for whistles.

pub mod ear;
pub mod whistle;
