//! The robot `outpost`: its parameters, databases, cyclers and runtime.
//!
//! Written by `hulkgen generate` from hulk.toml and the nodes it names. Do not edit.

#[rustfmt::skip]
pub mod parameters;
#[rustfmt::skip]
pub mod databases;
#[rustfmt::skip]
pub mod cyclers;
#[rustfmt::skip]
pub mod runtime;
#[rustfmt::skip]
pub mod recording;
