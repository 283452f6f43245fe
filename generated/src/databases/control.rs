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
use nalgebra::UnitQuaternion;
use serde::Deserialize;
use serde::Serialize;
use types::ball::Ball;
use types::camera::CameraMatrices;
use types::feet::Feet;
use types::feet::Side;
use types::head::HeadAngles;
use types::head::HeadCommand;
use types::head::HeadRequest;
use types::leds::Leds;
use types::motor_commands::MotionPhase;
use types::motor_commands::MotorCommands;
use types::robot_kinematics::RobotKinematics;
use types::sensor_data::SensorData;

use crate::databases::vision;
use crate::parameters::Parameters;

/// Main outputs that only nodes of `Control` read: they stay with the instance.
#[derive(Clone, Debug, Default, Deserialize, Reflect, Serialize)]
pub struct OwnOutputs {
    /// control::ball_memory
    pub ball: Option<Ball>,
    /// control::ready_pose
    pub body_commands: Option<MotorCommands>,
    /// control::foot_pressure
    pub ground_contact: bool,
    /// control::head_scan
    pub head_command: Option<HeadCommand>,
    /// control::led_status
    pub leds: Option<Leds>,
    /// control::motor_commands_collector
    pub motor_commands: Option<MotorCommands>,
    /// control::orientation_filter
    pub orientation: UnitQuaternion<f32>,
    /// control::forward_kinematics
    pub robot_kinematics: RobotKinematics,
    /// control::sensor_data_receiver
    pub sensor_data: SensorData,
    /// control::foot_pressure
    pub support_side: Option<Side>,
}

/// Main outputs that other instances read, too: written in the slot that those will read.
#[derive(Clone, Debug, Default, Deserialize, Reflect, Serialize)]
pub struct SharedOutputs {
    /// control::camera_matrices
    pub camera_matrices: Option<CameraMatrices>,
}

/// Computed only while somebody listens.
#[derive(Debug, Default)]
pub struct AdditionalOutputs {
    pub ball_memory: AdditionalOutputsBallMemory,
    pub foot_pressure: AdditionalOutputsFootPressure,
    pub orientation_filter: AdditionalOutputsOrientationFilter,
}

#[derive(Debug, Default)]
pub struct AdditionalOutputsBallMemory {
    /// control::ball_memory
    pub persistent_ball: AdditionalSlot<Option<Ball>>,
}

#[derive(Debug, Default)]
pub struct AdditionalOutputsFootPressure {
    /// control::foot_pressure
    pub sole_pressures: AdditionalSlot<Feet<f32>>,
}

#[derive(Debug, Default)]
pub struct AdditionalOutputsOrientationFilter {
    /// control::orientation_filter
    pub innovation: AdditionalSlot<f32>,
}

/// Who listens to which additional output, decided once per cycle.
#[derive(Clone, Copy, Debug, Default)]
pub struct Subscribed {
    pub ball_memory_persistent_ball: bool,
    pub foot_pressure_sole_pressures: bool,
    pub orientation_filter_innovation: bool,
}

/// Values of clients in place of main outputs.
#[derive(Clone, Debug, Default)]
pub struct Injections {
    pub ball: Injection<Option<Ball>>,
    pub body_commands: Injection<Option<MotorCommands>>,
    pub camera_matrices: Injection<Option<CameraMatrices>>,
    pub ground_contact: Injection<bool>,
    pub head_command: Injection<Option<HeadCommand>>,
    pub leds: Injection<Option<Leds>>,
    pub motor_commands: Injection<Option<MotorCommands>>,
    pub orientation: Injection<UnitQuaternion<f32>>,
    pub robot_kinematics: Injection<RobotKinematics>,
    pub sensor_data: Injection<SensorData>,
    pub support_side: Injection<Option<Side>>,
}

impl InjectionTable for Injections {
    fn get_mut(&mut self, output: &str) -> Option<&mut dyn InjectionCell> {
        match output {
            "ball" => Some(&mut self.ball),
            "body_commands" => Some(&mut self.body_commands),
            "camera_matrices" => Some(&mut self.camera_matrices),
            "ground_contact" => Some(&mut self.ground_contact),
            "head_command" => Some(&mut self.head_command),
            "leds" => Some(&mut self.leds),
            "motor_commands" => Some(&mut self.motor_commands),
            "orientation" => Some(&mut self.orientation),
            "robot_kinematics" => Some(&mut self.robot_kinematics),
            "sensor_data" => Some(&mut self.sensor_data),
            "support_side" => Some(&mut self.support_side),
            _ => None,
        }
    }
}

/// Shared by the nodes of one instance, kept between cycles.
#[derive(Clone, Debug, Default, Deserialize, Reflect, Serialize)]
pub struct CyclerState {
    /// control::head_scan (reads), control::ready_pose
    pub motion_phase: MotionPhase,
}

/// Calls that nodes answer, at most one of each in a cycle.
pub struct Procedures {
    /// control::head_scan
    pub look_at: Answerer<HeadRequest, HeadAngles>,
}

/// Main outputs that are read by time.
pub struct Historic {
    /// control::orientation_filter
    pub orientation: History<UnitQuaternion<f32>>,
}

/// Perception instances in one order of time.
pub struct Perception {
    pub horizon: Horizon,
    pub vision: Interleaving,
    pub vision_top: Consumer<vision::SharedOutputs>,
    pub vision_bottom: Consumer<vision::SharedOutputs>,
}

/// What the last finished cycle wrote.
#[derive(Clone, Copy)]
pub struct Previous<'a> {
    pub own: &'a OwnOutputs,
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
