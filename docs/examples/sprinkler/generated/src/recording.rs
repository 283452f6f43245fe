//! Recordings of the robot, and their replay.
//!
//! Written by `hulkgen generate` from hulk.toml and the nodes it names. Do not edit.

use framework::Result;
use framework::Timestamp;
use framework::commanded;
use framework::recorded::describe;
use framework::replay::Replayable;
use framework::replay::no_hardware;
use sprinkler_nodes::RainGauge;
use sprinkler_nodes::SoilProbe;
use sprinkler_nodes::Valve;

use crate::runtime::garden::Garden;
use crate::runtime::weather::Weather;

pub mod garden;
pub mod weather;

/// All instances that a recording can be replayed with, in manifest order.
pub const INSTANCES: &[Replayable] = &[
    Replayable {
        instance: "Weather",
        create: weather::replay_weather,
        types: describe::<Weather<Sink>>,
    },
    Replayable {
        instance: "Garden",
        create: garden::replay_garden,
        types: describe::<Garden<Sink>>,
    },
];

/// The hardware of a replay: what it is told to do goes nowhere, and it cannot be asked.
#[derive(Clone, Copy, Debug)]
pub struct Sink;

impl RainGauge for Sink {
    fn read_rain(&self) -> Result<(Timestamp, f32)> {
        no_hardware()
    }
}

impl SoilProbe for Sink {
    fn read_moisture(&self) -> Result<(Timestamp, f32)> {
        no_hardware()
    }
}

impl Valve for Sink {
    fn write_valve(&self, is_open: bool) -> Result<()> {
        commanded!("Valve::write_valve", is_open);
        Ok(())
    }
}
