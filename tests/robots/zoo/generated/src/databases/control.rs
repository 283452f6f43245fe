//! What cycler `Control` writes, and what its nodes see.
//!
//! Written by `hulkgen generate` from hulk.toml and the nodes it names. Do not edit.

use std::sync::Arc;

use framework::AdditionalSlot;
use framework::Answerer;
use framework::Consumer;
use framework::Cycle;
use framework::History;
use framework::Horizon;
use framework::Injection;
use framework::InjectionCell;
use framework::InjectionTable;
use framework::Interleaving;
use framework::Reflect;
use framework::Timestamp;
use framework::recorded::Outputs;
use serde::Deserialize;
use serde::Serialize;
use zoo_nodes::types::Point;
use zoo_nodes::types::Pose;
use zoo_nodes::types::Report;
use zoo_nodes::types::Spot;
use zoo_nodes::types::Walk;

use crate::databases::hearing;
use crate::databases::vision;
use crate::parameters::Parameters;

/// Main outputs that only nodes of `Control` read: they stay with the instance.
#[derive(Clone, Debug, Default, Deserialize, Reflect, Serialize)]
pub struct OwnOutputs {
    /// zoo_nodes::shared::counter
    pub cycles: u64,
    /// zoo_nodes::control::body
    pub joints: [f32; 3],
    /// zoo_nodes::control::gait
    pub plan: Vec<f32>,
    /// zoo_nodes::control::spot_filter
    pub report: Report,
    /// zoo_nodes::control::watcher
    pub seen: u32,
    /// zoo_nodes::control::gait
    pub speed: f32,
}

/// Main outputs that other instances read, too: written in the slot that those will read.
#[derive(Clone, Debug, Default, Deserialize, Outputs, Reflect, Serialize)]
pub struct SharedOutputs {
    /// zoo_nodes::control::pose_filter
    pub pose: Pose,
    /// zoo_nodes::control::spot_filter
    pub target: Option<Spot>,
}

/// Computed only while somebody listens.
#[derive(Debug, Default)]
pub struct AdditionalOutputs {
    pub debug: AdditionalOutputsDebug,
}

#[derive(Debug, Default)]
pub struct AdditionalOutputsDebug {
    /// zoo_nodes::control::watcher
    pub certainty: AdditionalSlot<f32>,
    pub watcher: AdditionalOutputsDebugWatcher,
}

#[derive(Debug, Default)]
pub struct AdditionalOutputsDebugWatcher {
    /// zoo_nodes::control::watcher
    pub seen: AdditionalSlot<Vec<f32>>,
}

/// Who listens to which additional output, decided once per cycle.
#[derive(Clone, Copy, Debug, Default, Deserialize, Serialize)]
pub struct Subscribed {
    pub debug_certainty: bool,
    pub debug_watcher_seen: bool,
}

/// Values of clients in place of main outputs.
#[derive(Clone, Debug, Default, Deserialize, Outputs, Serialize)]
pub struct Injections {
    pub cycles: Injection<u64>,
    pub joints: Injection<[f32; 3]>,
    pub plan: Injection<Vec<f32>>,
    pub pose: Injection<Pose>,
    pub report: Injection<Report>,
    pub seen: Injection<u32>,
    pub speed: Injection<f32>,
    pub target: Injection<Option<Spot>>,
}

impl InjectionTable for Injections {
    fn get_mut(&mut self, output: &str) -> Option<&mut dyn InjectionCell> {
        match output {
            "cycles" => Some(&mut self.cycles),
            "joints" => Some(&mut self.joints),
            "plan" => Some(&mut self.plan),
            "pose" => Some(&mut self.pose),
            "report" => Some(&mut self.report),
            "seen" => Some(&mut self.seen),
            "speed" => Some(&mut self.speed),
            "target" => Some(&mut self.target),
            _ => None,
        }
    }
}

/// Shared by the nodes of one instance, kept between cycles.
#[derive(Clone, Debug, Default, Deserialize, Reflect, Serialize)]
pub struct CyclerState {
    /// zoo_nodes::shared::counter
    pub count: u64,
    pub filter: CyclerStateFilter,
    pub gait: CyclerStateGait,
}

#[derive(Clone, Debug, Default, Deserialize, Reflect, Serialize)]
pub struct CyclerStateFilter {
    /// zoo_nodes::control::pose_filter, zoo_nodes::control::watcher (reads)
    pub drift: Point,
    /// zoo_nodes::control::pose_filter, zoo_nodes::control::watcher (reads)
    pub gain: f32,
}

#[derive(Clone, Debug, Default, Deserialize, Reflect, Serialize)]
pub struct CyclerStateGait {
    /// zoo_nodes::control::gait
    pub phase: f32,
}

/// Calls that nodes answer, at most one of each in a cycle.
pub struct Procedures {
    /// zoo_nodes::control::gait
    pub stop: Answerer<(), bool>,
    /// zoo_nodes::control::gait
    pub walk: Answerer<Walk, f32>,
}

/// Main outputs that are read by time.
pub struct Historic {
    /// zoo_nodes::control::pose_filter
    pub pose: History<Pose>,
}

/// Perception instances in one order of time.
pub struct Perception {
    pub horizon: Horizon,
    pub vision: Interleaving,
    pub vision_top: Consumer<vision::SharedOutputs>,
    pub vision_bottom: Consumer<vision::SharedOutputs>,
    pub hearing: Consumer<hearing::SharedOutputs>,
}

/// What the last finished cycle wrote.
#[derive(Clone, Copy)]
pub struct Previous<'a> {
    pub own: &'a OwnOutputs,
    pub shared: &'a SharedOutputs,
}

/// Everything a node may ask for when it is created.
pub struct Creation<'a, Hardware> {
    pub cycler_state: &'a mut CyclerState,
    pub hardware_interface: &'a Arc<Hardware>,
    pub parameters: &'a Parameters,
}

/// Everything the nodes of one cycle may touch, borrowed.
pub struct Frame<'a, Hardware> {
    pub additional_outputs: &'a mut AdditionalOutputs,
    pub capture_time: &'a mut Option<Timestamp>,
    pub cycle: Cycle,
    pub cycler_state: &'a mut CyclerState,
    pub hardware_interface: &'a Arc<Hardware>,
    pub historic: &'a Historic,
    pub injections: Option<&'a Injections>,
    pub own: &'a mut OwnOutputs,
    pub parameters: &'a Parameters,
    pub perception: &'a Perception,
    pub previous: Previous<'a>,
    pub procedures: &'a mut Procedures,
    pub shared: &'a mut SharedOutputs,
    pub subscribed: Subscribed,
}

impl<Hardware> Frame<'_, Hardware> {
    /// What a node needs that is created anew after a panic.
    pub fn creation(&mut self) -> Creation<'_, Hardware> {
        Creation {
            cycler_state: self.cycler_state,
            hardware_interface: self.hardware_interface,
            parameters: self.parameters,
        }
    }
}
