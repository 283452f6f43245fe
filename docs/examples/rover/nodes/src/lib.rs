//! The nodes of a rover with two wheels and a lidar.

pub mod drive;
pub mod interfaces;
pub mod lidar;
pub mod types;
