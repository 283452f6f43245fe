//! Recordings of the robot, and their replay.
//!
//! Written by `hulkgen generate` from hulk.toml and the nodes it names. Do not edit.

use framework::Leased;
use framework::Result;
use framework::Timestamp;
use framework::commanded;
use framework::recorded::describe;
use framework::replay::Replayable;
use framework::replay::no_hardware;
use hardware::ActuatorInterface;
use hardware::CameraInterface;
use hardware::MessageInterface;
use hardware::MicrophoneInterface;
use hardware::NetworkInterface;
use hardware::SensorInterface;
use hardware::SpeakerInterface;
use types::audio::AudioBlock;
use types::audio::Tone;
use types::camera::CameraPosition;
use types::image::YuyvImage;
use types::leds::Leds;
use types::motor_commands::MotorCommands;
use types::network::Datagram;
use types::network::Endpoint;
use types::sensor_data::SensorData;

use crate::runtime::audio::Audio;
use crate::runtime::control::Control;
use crate::runtime::spl_network::SplNetwork;
use crate::runtime::vision::Vision;

pub mod audio;
pub mod control;
pub mod spl_network;
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
        instance: "SplNetwork",
        create: spl_network::replay_spl_network,
        types: describe::<SplNetwork<Sink>>,
    },
    Replayable {
        instance: "Audio",
        create: audio::replay_audio,
        types: describe::<Audio<Sink>>,
    },
    Replayable {
        instance: "Control",
        create: control::replay_control,
        types: describe::<Control<Sink>>,
    },
];

/// The hardware of a replay: what it is told to do goes nowhere, and it cannot be asked.
#[derive(Clone, Copy, Debug)]
pub struct Sink;

impl ActuatorInterface for Sink {
    fn write_command(&self, motors: &MotorCommands, leds: &Leds) -> Result<()> {
        commanded!("ActuatorInterface::write_command", motors, leds);
        Ok(())
    }
}

impl CameraInterface for Sink {
    fn read_image(&self, _: CameraPosition) -> Result<(Timestamp, Leased<YuyvImage>)> {
        no_hardware()
    }
}

impl MessageInterface for Sink {
    fn send_to_game_controller(&self, to: Endpoint, bytes: &[u8]) -> Result<()> {
        commanded!("MessageInterface::send_to_game_controller", to, bytes);
        Ok(())
    }

    fn send_to_team(&self, bytes: &[u8]) -> Result<()> {
        commanded!("MessageInterface::send_to_team", bytes);
        Ok(())
    }
}

impl MicrophoneInterface for Sink {
    fn read_audio(&self) -> Result<(Timestamp, Leased<AudioBlock>)> {
        no_hardware()
    }
}

impl NetworkInterface for Sink {
    fn join_team(&self, team: u8) -> Result<()> {
        commanded!("NetworkInterface::join_team", team);
        Ok(())
    }

    fn read_datagram(&self, _: &mut Datagram) -> Result<Timestamp> {
        no_hardware()
    }
}

impl SensorInterface for Sink {
    fn read_sensors(&self) -> Result<(Timestamp, SensorData)> {
        no_hardware()
    }
}

impl SpeakerInterface for Sink {
    fn play_tone(&self, tone: &Tone) -> Result<()> {
        commanded!("SpeakerInterface::play_tone", tone);
        Ok(())
    }
}
