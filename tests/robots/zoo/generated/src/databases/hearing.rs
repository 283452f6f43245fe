//! What cycler `Hearing` writes, and what its nodes see.
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
use zoo_nodes::types::Whistle;

/// Main outputs that other instances read, too: written in the slot that those will read.
#[derive(Clone, Debug, Default, Deserialize, Outputs, Reflect, Serialize)]
pub struct SharedOutputs {
    /// zoo_nodes::hearing::ear
    pub loudness: f32,
    /// zoo_nodes::hearing::whistle
    pub whistle: Option<Whistle>,
}

/// Values of clients in place of main outputs.
#[derive(Clone, Debug, Default, Deserialize, Outputs, Serialize)]
pub struct Injections {
    pub loudness: Injection<f32>,
    pub whistle: Injection<Option<Whistle>>,
}

impl InjectionTable for Injections {
    fn get_mut(&mut self, output: &str) -> Option<&mut dyn InjectionCell> {
        match output {
            "loudness" => Some(&mut self.loudness),
            "whistle" => Some(&mut self.whistle),
            _ => None,
        }
    }
}

/// What the last finished cycle wrote.
#[derive(Clone, Copy)]
pub struct Previous<'a> {
    pub shared: &'a SharedOutputs,
}

/// Everything the nodes of one cycle may touch, borrowed.
pub struct Frame<'a, Hardware> {
    pub capture_time: &'a mut Option<Timestamp>,
    pub cycle: Cycle,
    pub hardware_interface: &'a Arc<Hardware>,
    pub injections: Option<&'a Injections>,
    pub previous: Previous<'a>,
    pub shared: &'a mut SharedOutputs,
}
