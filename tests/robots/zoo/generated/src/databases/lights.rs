//! What cycler `Lights` writes, and what its nodes see.
//!
//! Written by `hulkgen generate` from hulk.toml and the nodes it names. Do not edit.

use std::sync::Arc;

use framework::Cycle;
use framework::InjectionCell;
use framework::InjectionTable;
use framework::Reflect;
use framework::View;
use framework::recorded::Outputs;
use serde::Deserialize;
use serde::Serialize;

use crate::databases::control;

/// Values of clients in place of main outputs.
#[derive(Clone, Debug, Default, Deserialize, Outputs, Serialize)]
pub struct Injections {}

impl InjectionTable for Injections {
    fn get_mut(&mut self, _output: &str) -> Option<&mut dyn InjectionCell> {
        None
    }
}

/// Shared by the nodes of one instance, kept between cycles.
#[derive(Clone, Debug, Default, Deserialize, Reflect, Serialize)]
pub struct CyclerState {
    /// zoo_nodes::lights::lamp (reads), zoo_nodes::lights::setup
    pub beat: u64,
}

/// The newest finished cycle of other instances.
#[derive(Clone, Copy)]
pub struct Latest<'a> {
    pub control: View<'a, control::SharedOutputs>,
}

/// Everything the nodes of one cycle may touch, borrowed.
pub struct Frame<'a, Hardware> {
    pub cycle: Cycle,
    pub cycler_state: &'a mut CyclerState,
    pub hardware_interface: &'a Arc<Hardware>,
    pub latest: Latest<'a>,
}
