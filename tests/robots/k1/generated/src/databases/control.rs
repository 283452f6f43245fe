//! What cycler `Control` writes, and what its nodes see.
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
use k1_nodes::joints::COUNT;
use k1_nodes::types::Body;
use k1_nodes::types::MotorCommands;
use serde::Deserialize;
use serde::Serialize;

use crate::parameters::Parameters;

/// Main outputs that only nodes of `Control` read: they stay with the instance.
#[derive(Clone, Debug, Default, Deserialize, Reflect, Serialize)]
pub struct OwnOutputs {
    /// k1_nodes::wave
    pub arm_pitch: Option<f32>,
    /// k1_nodes::body_receiver
    pub body: Body,
    /// k1_nodes::look_around
    pub head_yaw: Option<f32>,
    /// k1_nodes::motor_sender
    pub motor_commands: MotorCommands,
    /// k1_nodes::prepare
    pub standing: Option<[f32; COUNT]>,
}

/// Values of clients in place of main outputs.
#[derive(Clone, Debug, Default, Deserialize, Outputs, Serialize)]
pub struct Injections {
    pub arm_pitch: Injection<Option<f32>>,
    pub body: Injection<Body>,
    pub head_yaw: Injection<Option<f32>>,
    pub motor_commands: Injection<MotorCommands>,
    pub standing: Injection<Option<[f32; COUNT]>>,
}

impl InjectionTable for Injections {
    fn get_mut(&mut self, output: &str) -> Option<&mut dyn InjectionCell> {
        match output {
            "arm_pitch" => Some(&mut self.arm_pitch),
            "body" => Some(&mut self.body),
            "head_yaw" => Some(&mut self.head_yaw),
            "motor_commands" => Some(&mut self.motor_commands),
            "standing" => Some(&mut self.standing),
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
}
