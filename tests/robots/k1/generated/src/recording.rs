//! Recordings of the robot, and their replay.
//!
//! Written by `hulkgen generate` from hulk.toml and the nodes it names. Do not edit.

use framework::Result;
use framework::Timestamp;
use framework::commanded;
use framework::recorded::describe;
use framework::replay::Replayable;
use framework::replay::no_hardware;
use k1_nodes::interfaces::BodyInterface;
use k1_nodes::interfaces::MotorInterface;
use k1_nodes::types::Body;
use k1_nodes::types::MotorCommands;

use crate::runtime::control::Control;

pub mod control;

/// All instances that a recording can be replayed with, in manifest order.
pub const INSTANCES: &[Replayable] = &[
    Replayable {
        instance: "Control",
        create: control::replay_control,
        types: describe::<Control<Sink>>,
    },
];

/// The hardware of a replay: what it is told to do goes nowhere, and it cannot be asked.
#[derive(Clone, Copy, Debug)]
pub struct Sink;

impl BodyInterface for Sink {
    fn read_body(&self) -> Result<(Timestamp, Body)> {
        no_hardware()
    }
}

impl MotorInterface for Sink {
    fn write_motors(&self, commands: &MotorCommands) -> Result<()> {
        commanded!("MotorInterface::write_motors", commands);
        Ok(())
    }
}
