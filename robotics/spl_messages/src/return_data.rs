//! What each robot tells the referee's computer about itself: return data, version 4.
//!
//! Layout as GameController publishes it: 32 bytes, little endian, without padding; lengths in mm
//! there, in m here. The rules of 2024 and 2025 allow two messages a second.

use std::f32::consts::PI;

use nalgebra::{Isometry2, Point2, UnitComplex, Vector2};
use types::team::TeamBall;

use crate::bytes::{Reader, Writer};
use crate::error::{DecodeError, EncodeError};

/// The size of a message.
pub const LENGTH: usize = 32;
/// What stands in front of it.
pub const HEADER: [u8; 4] = *b"RGrt";
/// The version of its layout.
pub const VERSION: u8 = 4;

const MILLIMETERS_PER_METER: f32 = 1000.0;
/// The age of a ball that was never seen.
const NEVER: f32 = -1.0;

/// What a robot tells about itself.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ReturnData {
    /// Number of the robot's shirt, from 1 to 20.
    pub player_number: u8,
    /// Number of its team.
    pub team_number: u8,
    /// Whether it lies on the ground and cannot play.
    pub is_fallen: bool,
    /// From its ground frame to the field frame (x towards the goal of the other team), m and rad.
    pub ground_to_field: Isometry2<f32>,
    /// The ball in its ground frame, m, and the seconds since it was seen; `None` where it never was.
    pub ball: Option<TeamBall>,
}

/// The bytes of a message.
///
/// # Errors
/// Names what nobody may send: a shirt that there is not, a length that is infinite or no number.
pub fn encode(data: &ReturnData) -> Result<[u8; LENGTH], EncodeError> {
    let mut bytes = [0; LENGTH];
    let mut writer = Writer::new(&mut bytes);
    writer.bytes(&HEADER);
    writer.u8(VERSION);
    writer.shirt("playerNum", data.player_number)?;
    writer.u8(data.team_number);
    writer.u8(data.is_fallen.into());
    let Isometry2 {
        rotation,
        translation,
    } = data.ground_to_field;
    for length in translation.vector.iter() {
        writer.f32("pose", length * MILLIMETERS_PER_METER)?;
    }
    writer.f32("pose", rotation.angle())?;
    match data.ball {
        Some(ball) => writer.age("ballAge", ball.age)?,
        None => writer.f32("ballAge", NEVER)?,
    }
    let position = data.ball.map_or(Point2::origin(), |ball| ball.position);
    for length in position.iter() {
        writer.f32("ball", length * MILLIMETERS_PER_METER)?;
    }
    Ok(bytes)
}

/// The message that these bytes are.
///
/// # Errors
/// Where they are not exactly one message of this version, or say what no robot can say.
pub fn decode(bytes: &[u8]) -> Result<ReturnData, DecodeError> {
    let mut reader = Reader::exactly(LENGTH, bytes)?;
    reader.header(HEADER)?;
    reader.version(VERSION)?;
    Ok(ReturnData {
        player_number: reader.shirt("playerNum")?,
        team_number: reader.u8(),
        is_fallen: reader.boolean("fallen")?,
        ground_to_field: decode_pose(&mut reader)?,
        ball: decode_ball(&mut reader)?,
    })
}

const AGES: &str = "a number of seconds, or -1 for never";

fn decode_pose(reader: &mut Reader<'_>) -> Result<Isometry2<f32>, DecodeError> {
    let [x, y] = decode_lengths("pose", reader)?;
    let heading = reader.f32("pose")?;
    if heading.abs() > PI {
        return Err(DecodeError::OutOfRange {
            field: "pose",
            expected: "an angle from -pi to pi",
            found: heading,
        });
    }
    Ok(Isometry2::from_parts(
        Vector2::new(x, y).into(),
        UnitComplex::new(heading),
    ))
}

fn decode_ball(reader: &mut Reader<'_>) -> Result<Option<TeamBall>, DecodeError> {
    let age = reader.f32("ballAge")?;
    let [x, y] = decode_lengths("ball", reader)?;
    if age >= 0.0 {
        let position = Point2::new(x, y);
        return Ok(Some(TeamBall { position, age }));
    }
    let misplaced = [x, y].into_iter().find(|length| length.to_bits() != 0);
    let (field, expected, found) = match misplaced {
        _ if age != NEVER => ("ballAge", AGES, age),
        Some(length) => ("ball", "0, since the ball was never seen", length),
        None => return Ok(None),
    };
    Err(DecodeError::OutOfRange {
        field,
        expected,
        found,
    })
}

fn decode_lengths(field: &'static str, reader: &mut Reader<'_>) -> Result<[f32; 2], DecodeError> {
    let x = reader.f32(field)? / MILLIMETERS_PER_METER;
    let y = reader.f32(field)? / MILLIMETERS_PER_METER;
    Ok([x, y])
}
