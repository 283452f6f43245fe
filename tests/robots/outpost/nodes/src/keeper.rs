//! What runs on the robot.

pub mod book;
pub mod clock;
