//! Recordings of the robot, and their replay.
//!
//! Written by `hulkgen generate` from hulk.toml and the nodes it names. Do not edit.

use framework::Result;
use framework::Timestamp;
use framework::commanded;
use framework::recorded::describe;
use framework::replay::Replayable;
use framework::replay::no_hardware;
use rover_nodes::interfaces::Encoders;
use rover_nodes::interfaces::Motors;
use rover_nodes::types::Rolled;
use rover_nodes::types::Scan;
use rover_nodes::types::Speeds;

use crate::runtime::drive::Drive;
use crate::runtime::lidar::Lidar;

pub mod drive;
pub mod lidar;

/// All instances that a recording can be replayed with, in manifest order.
pub const INSTANCES: &[Replayable] = &[
    Replayable {
        instance: "Lidar",
        create: lidar::replay_lidar,
        types: describe::<Lidar<Sink>>,
    },
    Replayable {
        instance: "Drive",
        create: drive::replay_drive,
        types: describe::<Drive<Sink>>,
    },
];

/// The hardware of a replay: what it is told to do goes nowhere, and it cannot be asked.
#[derive(Clone, Copy, Debug)]
pub struct Sink;

impl Encoders for Sink {
    fn read_wheels(&self) -> Result<(Timestamp, Rolled)> {
        no_hardware()
    }
}

impl rover_nodes::interfaces::Lidar for Sink {
    fn read_scan(&self, _: &mut Scan) -> Result<Timestamp> {
        no_hardware()
    }
}

impl Motors for Sink {
    fn write_speeds(&self, speeds: Speeds) -> Result<()> {
        commanded!("Motors::write_speeds", speeds);
        Ok(())
    }
}
