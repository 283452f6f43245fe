//! What the nodes ask of the robot's body: one trait for each thing that hardware can do.
//!
//! A hardware crate implements those that its platform has; the generated code asks for the ones
//! that the nodes name. `read_…` belongs to setup nodes, since a recording keeps what they returned.

use framework::{Leased, Result, Timestamp};
use types::audio::{AudioBlock, Tone};
use types::camera::CameraPosition;
use types::image::YuyvImage;
use types::leds::Leds;
use types::motor_commands::MotorCommands;
use types::network::{Datagram, Endpoint};
use types::sensor_data::SensorData;

/// So many images of a camera may be held at once, 39 MB of 640 by 480 pixels: nodes have one, the framework keeps two dozen of them for
/// clients that watch. Those that a recording holds are beside them.
pub const MOST_IMAGES: usize = 64;

/// So many blocks of sound may be held at once, 2 MB of 2048 samples of each microphone.
pub const MOST_BLOCKS: usize = 64;

/// Reads the sensors of the body.
pub trait SensorInterface {
    /// Waits for the next sample of all sensors and says when it was taken.
    ///
    /// # Errors
    /// `Stopped` within 100 ms of a stop; `NoEvent` where the body was silent or sent garbled data:
    /// ask again.
    fn read_sensors(&self) -> Result<(Timestamp, SensorData)>;
}

/// Commands motors and lights.
pub trait ActuatorInterface {
    /// Sends one command to all motors and lights; the body takes about 36 ms to follow.
    ///
    /// A body that went away meanwhile is no error: the next read notices it. In safe state the
    /// hardware drops the command, and says so with the next sample ([`SensorData::is_in_safe_state`]).
    ///
    /// # Errors
    /// Where the command cannot be sent at all.
    fn write_command(&self, motors: &MotorCommands, leds: &Leds) -> Result<()>;
}

/// Reads the cameras of the head.
pub trait CameraInterface {
    /// Waits for the next image of one camera and says when it was taken.
    ///
    /// Leased from a pool of the camera, which has [`MOST_IMAGES`] at most, and those that a recording holds: in the steady state nothing is allocated.
    ///
    /// # Errors
    /// `Stopped` within 100 ms of a stop; `NoEvent` where no image came, it was garbled, or readers hold all of them: ask again.
    fn read_image(&self, position: CameraPosition) -> Result<(Timestamp, Leased<YuyvImage>)>;
}

/// Reads the microphones of the head.
pub trait MicrophoneInterface {
    /// Waits for the next block of sound and says when its last sample was taken.
    ///
    /// Leased from a pool of the microphones, which has [`MOST_BLOCKS`] at most, and those that a recording holds: in the steady state nothing is allocated.
    ///
    /// # Errors
    /// `Stopped` within 100 ms of a stop; `NoEvent` where no sound came, or readers hold all blocks: ask again.
    fn read_audio(&self) -> Result<(Timestamp, Leased<AudioBlock>)>;
}

/// Plays sound.
pub trait SpeakerInterface {
    /// Begins a tone, in place of the one that sounds, and does not wait for its end.
    ///
    /// # Errors
    /// Where it cannot be played at all.
    fn play_tone(&self, tone: &Tone) -> Result<()>;
}

/// Reads what comes over the network.
pub trait NetworkInterface {
    /// Listens where the team of that number talks, unless the hardware's parameters say where.
    ///
    /// Before the first read; once it listens it goes on to listen there.
    ///
    /// # Errors
    /// Names the port that is in use.
    fn join_team(&self, team: u8) -> Result<()>;

    /// Waits for the next datagram on any channel, writes it into `datagram`, and says when it came.
    ///
    /// `datagram` keeps its heap. What is longer than any message of the game is cut, and a byte longer
    /// than allowed remains, so that a strict parser refuses it.
    ///
    /// # Errors
    /// `Stopped` within 100 ms of a stop; `NoEvent` where nothing came for a while: ask again.
    fn read_datagram(&self, datagram: &mut Datagram) -> Result<Timestamp>;
}

/// Sends over the network.
pub trait MessageInterface {
    /// Answers the referee's computer that sent `to` its packet; the hardware knows its port for answers.
    ///
    /// # Errors
    /// Where nothing can be sent at all; a computer that went away is no error.
    fn send_to_game_controller(&self, to: Endpoint, bytes: &[u8]) -> Result<()>;

    /// Tells the whole own team.
    ///
    /// # Errors
    /// Where nothing can be sent at all.
    fn send_to_team(&self, bytes: &[u8]) -> Result<()>;
}
