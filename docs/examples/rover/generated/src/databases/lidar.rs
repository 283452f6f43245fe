//! What cycler `Lidar` writes, and what its nodes see.
//!
//! Written by `hulkgen generate` from hulk.toml and the nodes it names. Do not edit.

use std::sync::Arc;

use framework::Cycle;
use framework::Injection;
use framework::InjectionCell;
use framework::InjectionTable;
use framework::Reflect;
use framework::Timestamp;
use framework::recorded::Outputs;
use rover_nodes::types::Freeway;
use rover_nodes::types::Scan;
use serde::Deserialize;
use serde::Serialize;

use crate::parameters::Parameters;

/// Main outputs that only nodes of `Lidar` read: they stay with the instance.
#[derive(Clone, Debug, Default, Deserialize, Reflect, Serialize)]
pub struct OwnOutputs {
    /// rover_nodes::lidar::scan_receiver
    pub scan: Scan,
}

/// Main outputs that other instances read, too: written in the slot that those will read.
#[derive(Clone, Debug, Default, Deserialize, Outputs, Reflect, Serialize)]
pub struct SharedOutputs {
    /// rover_nodes::lidar::freeway_detection
    pub freeways: Vec<Freeway>,
}

/// Values of clients in place of main outputs.
#[derive(Clone, Debug, Default, Deserialize, Outputs, Serialize)]
pub struct Injections {
    pub freeways: Injection<Vec<Freeway>>,
    pub scan: Injection<Scan>,
}

impl InjectionTable for Injections {
    fn get_mut(&mut self, output: &str) -> Option<&mut dyn InjectionCell> {
        match output {
            "freeways" => Some(&mut self.freeways),
            "scan" => Some(&mut self.scan),
            _ => None,
        }
    }
}

/// Everything the nodes of one cycle may touch, borrowed.
pub struct Frame<'a, Hardware> {
    pub capture_time: &'a mut Option<Timestamp>,
    pub cycle: Cycle,
    pub hardware_interface: &'a Arc<Hardware>,
    pub injections: Option<&'a Injections>,
    pub own: &'a mut OwnOutputs,
    pub parameters: &'a Parameters,
    pub shared: &'a mut SharedOutputs,
}
