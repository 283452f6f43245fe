//! The nodes of every cycler in order.
//!
//! Written by `hulkgen generate` from hulk.toml and the nodes it names. Do not edit.

pub mod keeper;
