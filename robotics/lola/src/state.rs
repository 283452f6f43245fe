//! Owns LoLA's state message: all sensors of the body, every 12 ms.
//!
//! Decoding goes by key, never by offset: keys may stand in any order, unknown ones are skipped, and
//! what is not exactly one message is an error. Signs become those of REP-103: LoLA sends the
//! negative of the proper acceleration.

use types::identifier::Identifier;
use types::sensor_data::SensorData;

use crate::error::{DecodeError, WrongIdentifier};
use crate::messagepack::Writer;

mod arrays;
mod decoder;

use self::decoder::Decoder;

/// The size of every state message.
pub const STATE_BYTES: usize = 896;

/// What one state message says. Does not allocate.
///
/// # Errors
/// Where the bytes are anything but one whole state with finite values.
pub fn decode(bytes: &[u8]) -> Result<SensorData, DecodeError> {
    Decoder::new(bytes).decode()
}

/// Writes a state as LoLA does, for simulators: always [`STATE_BYTES`] bytes in LoLA's order of keys.
///
/// # Errors
/// Where an identifier has another length than LoLA's: 20 characters, versions 5.
pub fn encode(state: &SensorData, bytes: &mut Vec<u8>) -> Result<(), WrongIdentifier> {
    let configuration = &state.configuration;
    let identifiers = [
        identifier("the body's id", &configuration.body_id, 20)?,
        identifier("the body's version", &configuration.body_version, 5)?,
        identifier("the head's id", &configuration.head_id, 20)?,
        identifier("the head's version", &configuration.head_version, 5)?,
    ];
    let mut writer = Writer::map(bytes, 13);
    writer.array("RobotConfig", 4);
    for text in identifiers {
        writer.text(text);
    }
    let inertial = &state.inertial;
    writer.floats("Accelerometer", (-inertial.accelerometer).into());
    writer.floats("Angles", [inertial.roll, inertial.pitch]);
    writer.floats("Battery", arrays::from_battery(&state.battery));
    writer.floats("Current", state.currents.to_array());
    let [a, b, c, d] = state.force_sensitive_resistors.left;
    let [e, f, g, h] = state.force_sensitive_resistors.right;
    writer.floats("FSR", [a, b, c, d, e, f, g, h]);
    writer.floats("Gyroscope", inertial.gyroscope.into());
    writer.floats("Position", state.positions.to_array());
    writer.floats("Sonar", [state.sonar.left, state.sonar.right]);
    writer.floats("Stiffness", state.stiffnesses.to_array());
    writer.floats("Temperature", state.temperatures.to_array());
    writer.floats("Touch", arrays::from_touch(&state.touch));
    writer.array("Status", 25);
    for status in state.status.to_array() {
        // LoLA knows 0 to 3; more than 127 would change the size of the message.
        writer.byte(status.min(0x7f));
    }
    Ok(())
}

fn identifier<'a>(
    name: &'static str,
    identifier: &'a Identifier,
    expected: usize,
) -> Result<&'a str, WrongIdentifier> {
    let text = identifier.as_str();
    if text.len() == expected {
        Ok(text)
    } else {
        Err(WrongIdentifier {
            name,
            expected,
            found: text.len(),
        })
    }
}
