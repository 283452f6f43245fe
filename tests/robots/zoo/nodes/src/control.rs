//! Moves the body.

pub mod body;
pub mod gait;
pub mod legs;
pub mod pose_filter;
pub mod spot_filter;
pub mod watcher;
