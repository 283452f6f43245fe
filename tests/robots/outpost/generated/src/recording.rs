//! Recordings of the robot, and their replay.
//!
//! Written by `hulkgen generate` from hulk.toml and the nodes it names. Do not edit.

use framework::Result;
use framework::Timestamp;
use framework::recorded::describe;
use framework::replay::Replayable;
use framework::replay::no_hardware;
use outpost_nodes::interfaces::ClockInterface;

use crate::runtime::keeper::Keeper;

pub mod keeper;

/// All instances that a recording can be replayed with, in manifest order.
pub const INSTANCES: &[Replayable] = &[
    Replayable {
        instance: "Keeper",
        create: keeper::replay_keeper,
        types: describe::<Keeper<Sink>>,
    },
];

/// The hardware of a replay: what it is told to do goes nowhere, and it cannot be asked.
#[derive(Clone, Copy, Debug)]
pub struct Sink;

impl ClockInterface for Sink {
    fn read_stroke(&self) -> Result<Timestamp> {
        no_hardware()
    }
}
