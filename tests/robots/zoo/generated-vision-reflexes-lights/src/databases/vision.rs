//! What cycler `Vision` writes, and what its nodes see.
//!
//! Written by `hulkgen generate` from hulk.toml and the nodes it names. Do not edit.

use std::sync::Arc;

use framework::AdditionalSlot;
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
use zoo_nodes::types::Image;
use zoo_nodes::types::Spot;

use crate::databases::control;
use crate::parameters::Parameters;
use crate::parameters::VisionInstance;

/// Main outputs that only nodes of `Vision` read: they stay with the instance.
#[derive(Clone, Debug, Default, Deserialize, Reflect, Serialize)]
pub struct OwnOutputs {
    /// zoo_nodes::vision::other_eye
    pub agreement: f32,
    /// zoo_nodes::shared::counter
    pub cycles: u64,
    /// zoo_nodes::vision::exposure
    pub exposure: f32,
    /// zoo_nodes::vision::horizon_finder
    pub horizon: Option<f32>,
    /// zoo_nodes::vision::eye
    pub image: Image,
}

/// Main outputs that other instances read, too: written in the slot that those will read.
#[derive(Clone, Debug, Default, Deserialize, Outputs, Reflect, Serialize)]
pub struct SharedOutputs {
    /// zoo_nodes::vision::spot_finder
    pub best: Option<Spot>,
    /// zoo_nodes::vision::spot_finder
    pub spots: Vec<Spot>,
}

/// Computed only while somebody listens.
#[derive(Debug, Default)]
pub struct AdditionalOutputs {
    /// zoo_nodes::vision::spot_finder
    pub candidates: AdditionalSlot<Vec<Spot>>,
    pub cycler_instance: AdditionalOutputsCyclerInstance,
}

#[derive(Debug, Default)]
pub struct AdditionalOutputsCyclerInstance {
    /// zoo_nodes::vision::eye
    pub width: AdditionalSlot<usize>,
}

/// Who listens to which additional output, decided once per cycle.
#[derive(Clone, Copy, Debug, Default, Deserialize, Serialize)]
pub struct Subscribed {
    pub candidates: bool,
    pub cycler_instance_width: bool,
}

/// Values of clients in place of main outputs.
#[derive(Clone, Debug, Default, Deserialize, Outputs, Serialize)]
pub struct Injections {
    pub agreement: Injection<f32>,
    pub best: Injection<Option<Spot>>,
    pub cycles: Injection<u64>,
    pub exposure: Injection<f32>,
    pub horizon: Injection<Option<f32>>,
    pub image: Injection<Image>,
    pub spots: Injection<Vec<Spot>>,
}

impl InjectionTable for Injections {
    fn get_mut(&mut self, output: &str) -> Option<&mut dyn InjectionCell> {
        match output {
            "agreement" => Some(&mut self.agreement),
            "best" => Some(&mut self.best),
            "cycles" => Some(&mut self.cycles),
            "exposure" => Some(&mut self.exposure),
            "horizon" => Some(&mut self.horizon),
            "image" => Some(&mut self.image),
            "spots" => Some(&mut self.spots),
            _ => None,
        }
    }
}

/// Shared by the nodes of one instance, kept between cycles.
#[derive(Clone, Debug, Default, Deserialize, Reflect, Serialize)]
pub struct CyclerState {
    /// zoo_nodes::shared::counter
    pub count: u64,
    /// zoo_nodes::vision::exposure, zoo_nodes::vision::spot_finder (reads)
    pub exposure: f32,
}

/// The newest finished cycle of other instances.
#[derive(Clone, Copy)]
pub struct Latest<'a> {
    pub vision_top: View<'a, crate::databases::vision::SharedOutputs>,
    pub vision_bottom: View<'a, crate::databases::vision::SharedOutputs>,
    pub control: View<'a, control::SharedOutputs>,
}

/// What the last finished cycle wrote.
#[derive(Clone, Copy)]
pub struct Previous<'a> {
    pub own: &'a OwnOutputs,
    pub shared: &'a SharedOutputs,
}

/// Everything a node may ask for when it is created.
pub struct Creation<'a> {
    pub cycler_state: &'a mut CyclerState,
    pub instance_parameters: &'a VisionInstance,
    pub parameters: &'a Parameters,
}

/// Everything the nodes of one cycle may touch, borrowed.
pub struct Frame<'a, Hardware> {
    pub additional_outputs: &'a mut AdditionalOutputs,
    pub capture_time: &'a mut Option<Timestamp>,
    pub cycle: Cycle,
    pub cycler_state: &'a mut CyclerState,
    pub hardware_interface: &'a Arc<Hardware>,
    pub injections: Option<&'a Injections>,
    pub instance_exposure: &'a f32,
    pub instance_parameters: &'a VisionInstance,
    pub latest: Latest<'a>,
    pub own: &'a mut OwnOutputs,
    pub parameters: &'a Parameters,
    pub previous: Previous<'a>,
    pub shared: &'a mut SharedOutputs,
    pub subscribed: Subscribed,
}

impl<Hardware> Frame<'_, Hardware> {
    /// What a node needs that is created anew after a panic.
    pub fn creation(&mut self) -> Creation<'_> {
        Creation {
            cycler_state: self.cycler_state,
            instance_parameters: self.instance_parameters,
            parameters: self.parameters,
        }
    }
}
