//! Nodes of several cyclers.

pub mod counter;
