//! What another machine runs.

pub mod ear;
pub mod range_finder;
