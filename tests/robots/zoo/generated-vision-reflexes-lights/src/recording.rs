//! Recordings of the robot, and their replay.
//!
//! Written by `hulkgen generate` from hulk.toml and the nodes it names. Do not edit.

use framework::Result;
use framework::Timestamp;
use framework::commanded;
use framework::recorded::describe;
use framework::replay::Replayable;
use framework::replay::no_hardware;
use zoo_nodes::interfaces::BumperInterface;
use zoo_nodes::interfaces::EyeInterface;
use zoo_nodes::interfaces::LampInterface;
use zoo_nodes::interfaces::LegInterface;
use zoo_nodes::interfaces::MetronomeInterface;
use zoo_nodes::types::Camera;
use zoo_nodes::types::Image;

use crate::runtime::lights::Lights;
use crate::runtime::reflexes::Reflexes;
use crate::runtime::vision::Vision;

pub mod lights;
pub mod reflexes;
pub mod vision;

/// All instances that a recording can be replayed with, in manifest order.
pub const INSTANCES: &[Replayable] = &[
    Replayable {
        instance: "VisionTop",
        create: vision::replay_vision_top,
        types: describe::<Vision<Sink>>,
    },
    Replayable {
        instance: "VisionBottom",
        create: vision::replay_vision_bottom,
        types: describe::<Vision<Sink>>,
    },
    Replayable {
        instance: "Reflexes",
        create: reflexes::replay_reflexes,
        types: describe::<Reflexes<Sink>>,
    },
    Replayable {
        instance: "Lights",
        create: lights::replay_lights,
        types: describe::<Lights<Sink>>,
    },
];

/// The hardware of a replay: what it is told to do goes nowhere, and it cannot be asked.
#[derive(Clone, Copy, Debug)]
pub struct Sink;

impl BumperInterface for Sink {
    fn read_bumper(&self) -> Result<bool> {
        no_hardware()
    }
}

impl EyeInterface for Sink {
    fn read_image(&self, _: Camera, _: &mut Image) -> Result<Timestamp> {
        no_hardware()
    }
}

impl LampInterface for Sink {
    fn write_brightness(&self, brightness: f32) {
        commanded!("LampInterface::write_brightness", brightness);
    }
}

impl LegInterface for Sink {
    fn write_angles(&self, angles: &[f32]) -> Result<()> {
        commanded!("LegInterface::write_angles", angles);
        Ok(())
    }
}

impl MetronomeInterface for Sink {
    fn read_beat(&self) -> Result<u64> {
        no_hardware()
    }
}
