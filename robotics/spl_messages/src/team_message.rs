//! What the robots of this team tell each other, in a format of its own.
//!
//! | bytes | content |
//! |---|---|
//! | 4 | `HGtm` |
//! | 1 | version, 1 |
//! | 1 | number of the sender's shirt, 1 to 20 |
//! | 1 | bit 0: lies on the ground, bit 1: knows its pose, bit 2: knows the ball, bit 3: plays it; all others 0 |
//! | 16 | with bit 1: x and y of the sender in the field frame in m, cosine and sine of its heading |
//! | 12 | with bit 2: x and y of the ball in the sender's ground frame in m, its age in s |
//!
//! Numbers are little endian `f32`. At most 35 bytes; the rules of 2025 allow 128.

use nalgebra::{Complex, ComplexField, Isometry2, Point2, UnitComplex, Vector2};
use types::team::{TeamBall, TeamMessage};

use crate::bytes::{Reader, Writer};
use crate::error::{DecodeError, EncodeError};

/// The size of a message that says everything.
pub const GREATEST_LENGTH: usize = HEAD_LENGTH + POSE_LENGTH + BALL_LENGTH;
/// The greatest size that the rules of 2025 allow.
pub const PERMITTED_LENGTH: usize = 128;
/// What stands in front of it.
pub const HEADER: [u8; 4] = *b"HGtm";
/// The version of its layout.
pub const VERSION: u8 = 1;

const HEAD_LENGTH: usize = 7;
const POSE_LENGTH: usize = 16;
const BALL_LENGTH: usize = 12;

const IS_FALLEN: u8 = 1;
const KNOWS_POSE: u8 = 2;
const KNOWS_BALL: u8 = 4;
const PLAYS_BALL: u8 = 8;

/// How far the length of a cosine and its sine may be from 1: more than rounding, less than matters.
const TURN_TOLERANCE: f32 = 1e-4;
const TURN: &str = "the cosine or sine of an angle";

const _: () = assert!(GREATEST_LENGTH <= PERMITTED_LENGTH);

/// Writes a message into `room`; its bytes.
///
/// # Errors
/// Names what nobody may send: a shirt that there is not, what is infinite or no number, an age from
/// the future.
pub fn encode<'room>(
    message: &TeamMessage,
    room: &'room mut [u8; GREATEST_LENGTH],
) -> Result<&'room [u8], EncodeError> {
    let mut writer = Writer::new(room);
    writer.bytes(&HEADER);
    writer.u8(VERSION);
    writer.shirt("player number", message.player_number)?;
    writer.u8(flags(message));
    if let Some(pose) = &message.ground_to_field {
        encode_pose(pose, &mut writer)?;
    }
    if let Some(ball) = &message.ball {
        encode_ball(ball, &mut writer)?;
    }
    let length = writer.written();
    Ok(&room[..length])
}

/// The message that these bytes are.
///
/// # Errors
/// Where they are not exactly one message of this version, or say what no robot can say.
pub fn decode(bytes: &[u8]) -> Result<TeamMessage, DecodeError> {
    let head = bytes.first_chunk::<HEAD_LENGTH>();
    let flags = head.map_or(0, |head| head[HEAD_LENGTH - 1]);
    let mut reader = Reader::exactly(length(flags), bytes)?;
    reader.header(HEADER)?;
    reader.version(VERSION)?;
    let player_number = reader.shirt("player number")?;
    let found = reader.u8();
    if found & !(IS_FALLEN | KNOWS_POSE | KNOWS_BALL | PLAYS_BALL) != 0 {
        return Err(DecodeError::UnknownValue {
            field: "flags",
            expected: "0 to 15",
            found,
        });
    }
    let ground_to_field = is_set(flags, KNOWS_POSE).then(|| decode_pose(&mut reader));
    let ball = is_set(flags, KNOWS_BALL).then(|| decode_ball(&mut reader));
    Ok(TeamMessage {
        player_number,
        is_fallen: is_set(flags, IS_FALLEN),
        plays_ball: is_set(flags, PLAYS_BALL),
        ground_to_field: ground_to_field.transpose()?,
        ball: ball.transpose()?,
    })
}

fn flags(message: &TeamMessage) -> u8 {
    let flag = |is_set: bool, flag: u8| if is_set { flag } else { 0 };
    flag(message.is_fallen, IS_FALLEN)
        | flag(message.ground_to_field.is_some(), KNOWS_POSE)
        | flag(message.ball.is_some(), KNOWS_BALL)
        | flag(message.plays_ball, PLAYS_BALL)
}

fn is_set(flags: u8, flag: u8) -> bool {
    flags & flag != 0
}

fn length(flags: u8) -> usize {
    let part = |flag, length| if is_set(flags, flag) { length } else { 0 };
    HEAD_LENGTH + part(KNOWS_POSE, POSE_LENGTH) + part(KNOWS_BALL, BALL_LENGTH)
}

fn encode_pose(pose: &Isometry2<f32>, writer: &mut Writer<'_>) -> Result<(), EncodeError> {
    for length in pose.translation.vector.iter() {
        writer.f32("position", *length)?;
    }
    writer.f32("heading", pose.rotation.re)?;
    writer.f32("heading", pose.rotation.im)?;
    if let Some(found) = not_a_turn(pose.rotation.into_inner()) {
        return Err(EncodeError {
            field: "heading",
            expected: TURN,
            found,
        });
    }
    Ok(())
}

fn decode_pose(reader: &mut Reader<'_>) -> Result<Isometry2<f32>, DecodeError> {
    let position = Vector2::new(reader.f32("position")?, reader.f32("position")?);
    let turn = Complex::new(reader.f32("heading")?, reader.f32("heading")?);
    if let Some(found) = not_a_turn(turn) {
        return Err(DecodeError::OutOfRange {
            field: "heading",
            expected: TURN,
            found,
        });
    }
    // Taken as it is, so that it stays the same bits on every robot.
    let rotation = UnitComplex::new_unchecked(turn);
    Ok(Isometry2::from_parts(position.into(), rotation))
}

/// The part that is to blame where these are no cosine and sine.
fn not_a_turn(turn: Complex<f32>) -> Option<f32> {
    let length = turn.modulus();
    let is_turn = (length - 1.0).abs() <= TURN_TOLERANCE;
    (!is_turn).then_some(if turn.re.abs() > 1.0 {
        turn.re
    } else {
        turn.im
    })
}

fn encode_ball(ball: &TeamBall, writer: &mut Writer<'_>) -> Result<(), EncodeError> {
    for length in ball.position.iter() {
        writer.f32("ball", *length)?;
    }
    writer.age("age", ball.age)
}

fn decode_ball(reader: &mut Reader<'_>) -> Result<TeamBall, DecodeError> {
    let position = Point2::new(reader.f32("ball")?, reader.f32("ball")?);
    let age = reader.age("age")?;
    Ok(TeamBall { position, age })
}
