//! What cycler `Localization` writes, and what its nodes see.
//!
//! Written by `hulkgen generate` from hulk.toml and the nodes it names. Do not edit.

use std::sync::Arc;

use framework::Consumer;
use framework::Cycle;
use framework::Horizon;
use framework::Injection;
use framework::InjectionCell;
use framework::InjectionTable;
use framework::Reflect;
use framework::Timestamp;
use framework::recorded::Outputs;
use serde::Deserialize;
use serde::Serialize;
use timing_nodes::types::Sets;

use crate::databases::odometry;
use crate::databases::radio;
use crate::databases::vision;
use crate::parameters::Parameters;

/// Main outputs that only nodes of `Localization` read: they stay with the instance.
#[derive(Clone, Debug, Default, Deserialize, Reflect, Serialize)]
pub struct OwnOutputs {
    /// timing_nodes::position_filter
    pub sets: Option<Sets>,
}

/// Values of clients in place of main outputs.
#[derive(Clone, Debug, Default, Deserialize, Outputs, Serialize)]
pub struct Injections {
    pub sets: Injection<Option<Sets>>,
}

impl InjectionTable for Injections {
    fn get_mut(&mut self, output: &str) -> Option<&mut dyn InjectionCell> {
        match output {
            "sets" => Some(&mut self.sets),
            _ => None,
        }
    }
}

/// Perception instances in one order of time.
pub struct Perception {
    pub horizon: Horizon,
    pub vision: Consumer<vision::SharedOutputs>,
    pub odometry: Consumer<odometry::SharedOutputs>,
    pub radio: Consumer<radio::SharedOutputs>,
}

/// Everything the nodes of one cycle may touch, borrowed.
pub struct Frame<'a, Hardware> {
    pub capture_time: &'a mut Option<Timestamp>,
    pub cycle: Cycle,
    pub hardware_interface: &'a Arc<Hardware>,
    pub injections: Option<&'a Injections>,
    pub own: &'a mut OwnOutputs,
    pub parameters: &'a Parameters,
    pub perception: &'a Perception,
}
