//! What the cyclers write and what their nodes see.
//!
//! Written by `hulkgen generate` from hulk.toml and the nodes it names. Do not edit.

pub mod keeper;
pub mod lookout;
