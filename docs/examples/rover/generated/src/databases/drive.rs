//! What cycler `Drive` writes, and what its nodes see.
//!
//! Written by `hulkgen generate` from hulk.toml and the nodes it names. Do not edit.

use std::sync::Arc;

use framework::Consumer;
use framework::Cycle;
use framework::History;
use framework::Horizon;
use framework::Injection;
use framework::InjectionCell;
use framework::InjectionTable;
use framework::Reflect;
use framework::Timestamp;
use framework::recorded::Outputs;
use rover_nodes::types::Pose;
use rover_nodes::types::Rolled;
use rover_nodes::types::Speeds;
use serde::Deserialize;
use serde::Serialize;

use crate::databases::lidar;
use crate::parameters::Parameters;

/// Main outputs that only nodes of `Drive` read: they stay with the instance.
#[derive(Clone, Debug, Default, Deserialize, Reflect, Serialize)]
pub struct OwnOutputs {
    /// rover_nodes::drive::odometry
    pub pose: Pose,
    /// rover_nodes::drive::wheel_receiver
    pub rolled: Rolled,
    /// rover_nodes::drive::steering
    pub speeds: Option<Speeds>,
}

/// Values of clients in place of main outputs.
#[derive(Clone, Debug, Default, Deserialize, Outputs, Serialize)]
pub struct Injections {
    pub pose: Injection<Pose>,
    pub rolled: Injection<Rolled>,
    pub speeds: Injection<Option<Speeds>>,
}

impl InjectionTable for Injections {
    fn get_mut(&mut self, output: &str) -> Option<&mut dyn InjectionCell> {
        match output {
            "pose" => Some(&mut self.pose),
            "rolled" => Some(&mut self.rolled),
            "speeds" => Some(&mut self.speeds),
            _ => None,
        }
    }
}

/// Main outputs that are read by time.
pub struct Historic {
    /// rover_nodes::drive::odometry
    pub pose: History<Pose>,
}

/// Perception instances in one order of time.
pub struct Perception {
    pub horizon: Horizon,
    pub lidar: Consumer<lidar::SharedOutputs>,
}

/// Everything the nodes of one cycle may touch, borrowed.
pub struct Frame<'a, Hardware> {
    pub capture_time: &'a mut Option<Timestamp>,
    pub cycle: Cycle,
    pub hardware_interface: &'a Arc<Hardware>,
    pub historic: &'a Historic,
    pub injections: Option<&'a Injections>,
    pub own: &'a mut OwnOutputs,
    pub parameters: &'a Parameters,
    pub perception: &'a Perception,
}
