//! Recordings of the robot, and their replay.
//!
//! Written by `hulkgen generate` from hulk.toml and the nodes it names. Do not edit.

use framework::Result;
use framework::Timestamp;
use framework::replay::Replayable;
use framework::replay::no_hardware;
use zoo_nodes::interfaces::BodyInterface;
use zoo_nodes::interfaces::BumperInterface;
use zoo_nodes::interfaces::EarInterface;
use zoo_nodes::interfaces::EyeInterface;
use zoo_nodes::interfaces::LampInterface;
use zoo_nodes::interfaces::LegInterface;
use zoo_nodes::interfaces::MetronomeInterface;
use zoo_nodes::types::Camera;
use zoo_nodes::types::Image;

pub mod control;
pub mod hearing;
pub mod lights;
pub mod reflexes;
pub mod vision;

/// All instances that a recording can be replayed with, in manifest order.
pub const INSTANCES: &[Replayable] = &[
    Replayable {
        instance: "VisionTop",
        create: vision::replay_vision_top,
    },
    Replayable {
        instance: "VisionBottom",
        create: vision::replay_vision_bottom,
    },
    Replayable {
        instance: "Hearing",
        create: hearing::replay_hearing,
    },
    Replayable {
        instance: "Control",
        create: control::replay_control,
    },
    Replayable {
        instance: "Reflexes",
        create: reflexes::replay_reflexes,
    },
    Replayable {
        instance: "Lights",
        create: lights::replay_lights,
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

impl BumperInterface for Sink {
    fn read_bumper(&self) -> Result<bool> {
        no_hardware()
    }
}

impl EarInterface for Sink {
    fn read_sound(&self) -> Result<(Timestamp, f32)> {
        no_hardware()
    }
}

impl EyeInterface for Sink {
    fn read_image(&self, _: Camera, _: &mut Image) -> Result<Timestamp> {
        no_hardware()
    }
}

impl LampInterface for Sink {
    fn write_brightness(&self, _: f32) {}
}

impl LegInterface for Sink {
    fn write_angles(&self, _: &[f32]) -> Result<()> {
        Ok(())
    }
}

impl MetronomeInterface for Sink {
    fn read_beat(&self) -> Result<u64> {
        no_hardware()
    }
}
