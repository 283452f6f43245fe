//! What cycler `Keeper` writes, and what its nodes see.
//!
//! Written by `hulkgen generate` from hulk.toml and the nodes it names. Do not edit.

use std::sync::Arc;

use framework::Consumer;
use framework::Cycle;
use framework::Horizon;
use framework::Injection;
use framework::InjectionCell;
use framework::InjectionTable;
use framework::Interleaving;
use framework::Reflect;
use framework::Timestamp;
use framework::View;
use framework::recorded::Outputs;
use outpost_nodes::types::Entry;
use serde::Deserialize;
use serde::Serialize;

use crate::databases::lookout;
use crate::parameters::Parameters;

/// Main outputs that only nodes of `Keeper` read: they stay with the instance.
#[derive(Clone, Debug, Default, Deserialize, Reflect, Serialize)]
pub struct OwnOutputs {
    /// outpost_nodes::keeper::book
    pub entries: Vec<Entry>,
    /// outpost_nodes::keeper::book
    pub newest_in_the_north: Option<Entry>,
    /// outpost_nodes::keeper::book
    pub provisional: Vec<Entry>,
}

/// Values of clients in place of main outputs.
#[derive(Clone, Debug, Default, Deserialize, Outputs, Serialize)]
pub struct Injections {
    pub entries: Injection<Vec<Entry>>,
    pub newest_in_the_north: Injection<Option<Entry>>,
    pub provisional: Injection<Vec<Entry>>,
}

impl InjectionTable for Injections {
    fn get_mut(&mut self, output: &str) -> Option<&mut dyn InjectionCell> {
        match output {
            "entries" => Some(&mut self.entries),
            "newest_in_the_north" => Some(&mut self.newest_in_the_north),
            "provisional" => Some(&mut self.provisional),
            _ => None,
        }
    }
}

/// Perception instances in one order of time.
pub struct Perception {
    pub horizon: Horizon,
    pub lookout: Interleaving,
    pub lookout_north: Consumer<lookout::SharedOutputs>,
    pub lookout_south: Consumer<lookout::SharedOutputs>,
}

/// The newest finished cycle of other instances.
#[derive(Clone, Copy)]
pub struct Latest<'a> {
    pub lookout_north: View<'a, lookout::SharedOutputs>,
}

/// Everything the nodes of one cycle may touch, borrowed.
pub struct Frame<'a, Hardware> {
    pub capture_time: &'a mut Option<Timestamp>,
    pub cycle: Cycle,
    pub hardware_interface: &'a Arc<Hardware>,
    pub injections: Option<&'a Injections>,
    pub latest: Latest<'a>,
    pub own: &'a mut OwnOutputs,
    pub parameters: &'a Parameters,
    pub perception: &'a Perception,
}
