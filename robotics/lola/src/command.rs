//! Owns LoLA's command message: what motors, lights, and sonars shall do next.

use types::joints::Joints;
use types::leds::{Color, Leds};
use types::motor_commands::MotorCommands;

use crate::error::DecodeError;
use crate::messagepack::{Reader, Writer};

/// The size of a command with all keys.
pub const COMMAND_BYTES: usize = 786;

/// Everything a command can say.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Command {
    /// Angles and stiffnesses.
    pub motors: MotorCommands,
    /// Colours of the lights.
    pub leds: Leds,
    /// Whether the left and the right sonar send.
    pub sonars: [bool; 2],
}

/// All keys in the order in which they are written.
const KEYS: [&str; 11] = [
    "Position",
    "Stiffness",
    "Chest",
    "LEar",
    "REar",
    "LEye",
    "REye",
    "LFoot",
    "RFoot",
    "Skull",
    "Sonar",
];

/// Writes a command with all keys in place of what `bytes` held: always [`COMMAND_BYTES`] bytes.
///
/// Does not allocate once `bytes` has had its size.
pub fn encode(command: &Command, bytes: &mut Vec<u8>) {
    let Command {
        motors,
        leds,
        sonars,
    } = command;
    let mut writer = Writer::map(bytes, 11);
    writer.floats("Position", motors.positions.to_array());
    writer.floats("Stiffness", motors.stiffnesses.to_array());
    writer.floats("Chest", from_color(leds.chest));
    writer.floats("LEar", leds.left_ear);
    writer.floats("REar", leds.right_ear);
    writer.floats("LEye", from_eye(&leds.left_eye));
    writer.floats("REye", from_eye(&leds.right_eye));
    writer.floats("LFoot", from_color(leds.left_foot));
    writer.floats("RFoot", from_color(leds.right_foot));
    writer.floats("Skull", leds.skull);
    writer.array("Sonar", 2);
    for sonar in sonars {
        writer.boolean(*sonar);
    }
}

/// Takes one command from the front of `bytes` and says how many bytes it had. Does not allocate.
///
/// Commands have no length on the wire: a server calls this with all that it has received and waits
/// for more while the answer is [`DecodeError::Truncated`]. Keys that the message lacks keep their
/// values, as they do in LoLA; on an error `command` keeps all of them.
///
/// # Errors
/// Where the bytes do not begin with one whole command with finite values.
pub fn decode(bytes: &[u8], command: &mut Command) -> Result<usize, DecodeError> {
    let mut reader = Reader::new(bytes);
    let mut next = *command;
    let mut seen = [false; KEYS.len()];
    for _ in 0..reader.map()? {
        let key = reader.text()?;
        let Some(place) = KEYS.iter().position(|known| *known == key) else {
            reader.skip()?;
            continue;
        };
        let key = KEYS[place];
        if std::mem::replace(&mut seen[place], true) {
            return Err(DecodeError::Duplicate { key });
        }
        decode_entry(&mut reader, key, &mut next)?;
    }
    *command = next;
    Ok(reader.position())
}

fn decode_entry(
    reader: &mut Reader<'_>,
    key: &'static str,
    command: &mut Command,
) -> Result<(), DecodeError> {
    let leds = &mut command.leds;
    match key {
        "Position" => command.motors.positions = Joints::from_array(floats(reader, key)?),
        "Stiffness" => command.motors.stiffnesses = Joints::from_array(floats(reader, key)?),
        "Chest" => leds.chest = to_color(floats(reader, key)?),
        "LEar" => leds.left_ear = floats(reader, key)?,
        "REar" => leds.right_ear = floats(reader, key)?,
        "LEye" => leds.left_eye = to_eye(floats(reader, key)?),
        "REye" => leds.right_eye = to_eye(floats(reader, key)?),
        "LFoot" => leds.left_foot = to_color(floats(reader, key)?),
        "RFoot" => leds.right_foot = to_color(floats(reader, key)?),
        "Skull" => leds.skull = floats(reader, key)?,
        _ => {
            reader.array(key, 2)?;
            command.sonars = [reader.boolean()?, reader.boolean()?];
        }
    }
    Ok(())
}

fn floats<const VALUES: usize>(
    reader: &mut Reader<'_>,
    key: &'static str,
) -> Result<[f32; VALUES], DecodeError> {
    reader.array(key, VALUES)?;
    let mut values = [0.0; VALUES];
    for value in &mut values {
        *value = reader.float(key)?;
    }
    Ok(values)
}

fn from_color(color: Color) -> [f32; 3] {
    [color.red, color.green, color.blue]
}

fn to_color([red, green, blue]: [f32; 3]) -> Color {
    Color { red, green, blue }
}

/// Eyes go channel by channel: eight times red, then green, then blue.
fn from_eye(eye: &[Color; 8]) -> [f32; 24] {
    let segments = eye.map(from_color);
    std::array::from_fn(|place| segments[place % 8][place / 8])
}

fn to_eye(channels: [f32; 24]) -> [Color; 8] {
    std::array::from_fn(|segment| {
        to_color([
            channels[segment],
            channels[segment + 8],
            channels[segment + 16],
        ])
    })
}
