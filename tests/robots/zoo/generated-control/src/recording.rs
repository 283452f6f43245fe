//! Recordings of the robot, and their replay.
//!
//! Written by `hulkgen generate` from hulk.toml and the nodes it names. Do not edit.

use framework::Result;
use framework::Timestamp;
use framework::commanded;
use framework::recorded::describe;
use framework::replay::Replayable;
use framework::replay::no_hardware;
use zoo_nodes::interfaces::BodyInterface;
use zoo_nodes::interfaces::LegInterface;

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
    fn read_joints(&self) -> Result<(Timestamp, [f32; 3])> {
        no_hardware()
    }

    fn leg_length(&self) -> f32 {
        no_hardware()
    }
}

impl LegInterface for Sink {
    fn write_angles(&self, angles: &[f32]) -> Result<()> {
        commanded!("LegInterface::write_angles", angles);
        Ok(())
    }
}
