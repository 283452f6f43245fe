//! What cycler `Vision` writes, and what its nodes see.
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
use serde::Deserialize;
use serde::Serialize;
use timing_nodes::types::Measurement;

use crate::parameters::Parameters;

/// Main outputs that only nodes of `Vision` read: they stay with the instance.
#[derive(Clone, Debug, Default, Deserialize, Reflect, Serialize)]
pub struct OwnOutputs {
    /// timing_nodes::image_receiver
    pub image: f32,
}

/// Main outputs that other instances read, too: written in the slot that those will read.
#[derive(Clone, Debug, Default, Deserialize, Outputs, Reflect, Serialize)]
pub struct SharedOutputs {
    /// timing_nodes::position_detection
    pub measurement: Measurement,
}

/// Values of clients in place of main outputs.
#[derive(Clone, Debug, Default, Deserialize, Outputs, Serialize)]
pub struct Injections {
    pub image: Injection<f32>,
    pub measurement: Injection<Measurement>,
}

impl InjectionTable for Injections {
    fn get_mut(&mut self, output: &str) -> Option<&mut dyn InjectionCell> {
        match output {
            "image" => Some(&mut self.image),
            "measurement" => Some(&mut self.measurement),
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
