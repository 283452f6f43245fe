//! The bridge as a neighbour of ROS 2 that speaks Zenoh (rmw_zenoh): which messages carry its values, by which hash of their
//! type others know them, and what shows a node with its topics and services to the graph of ROS 2.

pub(crate) mod announce;
pub(crate) mod export;
mod hash;
pub(crate) mod interface;
mod key;
mod messages;
mod names;
mod packages;
mod service;

#[cfg(test)]
mod tests;
