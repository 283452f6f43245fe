//! Recordings of the robot, and their replay.
//!
//! Written by `hulkgen generate` from hulk.toml and the nodes it names. Do not edit.

use framework::Result;
use framework::Timestamp;
use framework::commanded;
use framework::recorded::describe;
use framework::replay::Replayable;
use framework::replay::no_hardware;
use timing_nodes::interfaces::Camera;
use timing_nodes::interfaces::Console;
use timing_nodes::interfaces::Effort;
use timing_nodes::interfaces::Odometer;
use timing_nodes::interfaces::Pace;

use crate::runtime::localization::Localization;
use crate::runtime::odometry::Odometry;
use crate::runtime::radio::Radio;
use crate::runtime::vision::Vision;

pub mod localization;
pub mod odometry;
pub mod radio;
pub mod vision;

/// All instances that a recording can be replayed with, in manifest order.
pub const INSTANCES: &[Replayable] = &[
    Replayable {
        instance: "Vision",
        create: vision::replay_vision,
        types: describe::<Vision<Sink>>,
    },
    Replayable {
        instance: "Odometry",
        create: odometry::replay_odometry,
        types: describe::<Odometry<Sink>>,
    },
    Replayable {
        instance: "Radio",
        create: radio::replay_radio,
        types: describe::<Radio<Sink>>,
    },
    Replayable {
        instance: "Localization",
        create: localization::replay_localization,
        types: describe::<Localization<Sink>>,
    },
];

/// The hardware of a replay: what it is told to do goes nowhere, and it cannot be asked.
#[derive(Clone, Copy, Debug)]
pub struct Sink;

impl Camera for Sink {
    fn read_image(&self) -> Result<(Timestamp, f32)> {
        no_hardware()
    }
}

impl Console for Sink {
    fn print(&self, line: &str) -> Result<()> {
        commanded!("Console::print", line);
        Ok(())
    }
}

impl Effort for Sink {
    fn take(&self, seconds: f32) -> Result<()> {
        commanded!("Effort::take", seconds);
        Ok(())
    }
}

impl Odometer for Sink {
    fn read_wheels(&self) -> Result<(Timestamp, f32)> {
        no_hardware()
    }
}

impl Pace for Sink {
    fn read_pace(&self) -> Result<Timestamp> {
        no_hardware()
    }
}

impl timing_nodes::interfaces::Radio for Sink {
    fn read_message(&self) -> Result<(Timestamp, f32)> {
        no_hardware()
    }
}
