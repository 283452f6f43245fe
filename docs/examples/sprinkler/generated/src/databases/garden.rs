//! What cycler `Garden` writes, and what its nodes see.
//!
//! Written by `hulkgen generate` from hulk.toml and the nodes it names. Do not edit.

use std::sync::Arc;

use framework::Cycle;
use framework::Injection;
use framework::InjectionCell;
use framework::InjectionTable;
use framework::Reflect;
use framework::Timestamp;
use framework::View;
use framework::recorded::Outputs;
use serde::Deserialize;
use serde::Serialize;

use crate::databases::weather;
use crate::parameters::Parameters;

/// Main outputs that only nodes of `Garden` read: they stay with the instance.
#[derive(Clone, Debug, Default, Deserialize, Reflect, Serialize)]
pub struct OwnOutputs {
    /// sprinkler_nodes::soil_receiver
    pub moisture: f32,
    /// sprinkler_nodes::thirst
    pub thirst: f32,
    /// sprinkler_nodes::valve_choice
    pub valve: Option<bool>,
}

/// Values of clients in place of main outputs.
#[derive(Clone, Debug, Default, Deserialize, Outputs, Serialize)]
pub struct Injections {
    pub moisture: Injection<f32>,
    pub thirst: Injection<f32>,
    pub valve: Injection<Option<bool>>,
}

impl InjectionTable for Injections {
    fn get_mut(&mut self, output: &str) -> Option<&mut dyn InjectionCell> {
        match output {
            "moisture" => Some(&mut self.moisture),
            "thirst" => Some(&mut self.thirst),
            "valve" => Some(&mut self.valve),
            _ => None,
        }
    }
}

/// The newest finished cycle of other instances.
#[derive(Clone, Copy)]
pub struct Latest<'a> {
    pub weather: View<'a, weather::SharedOutputs>,
}

/// What the last finished cycle wrote.
#[derive(Clone, Copy)]
pub struct Previous<'a> {
    pub own: &'a OwnOutputs,
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
    pub previous: Previous<'a>,
}
