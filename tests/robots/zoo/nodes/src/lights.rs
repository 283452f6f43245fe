//! Shows what the robot does.

pub mod cycle;
pub mod lamp;
pub mod setup;
