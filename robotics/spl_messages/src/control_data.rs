//! What the referee's computer tells all robots twice a second: control data, version 18.
//!
//! Layout as GameController publishes it for the SPL of 2024 and 2025: 118 bytes, little endian,
//! without padding. Decoding takes what this version defines and nothing else.

mod numbers;

use types::game::{GameControllerMessage, PlayerState, TeamState};

use self::numbers::Numbered;
use crate::bytes::{Reader, Writer};
use crate::error::DecodeError;

/// The size of a message.
pub const LENGTH: usize = 118;
/// What stands in front of it.
pub const HEADER: [u8; 4] = *b"RGme";
/// The version of its layout.
pub const VERSION: u8 = 18;

/// The kicking team where there is none, or it is hidden.
const NOBODY: u8 = 255;

/// The bytes of a message. A kicking team of number 255 is sent as none: no team has it.
pub fn encode(message: &GameControllerMessage) -> [u8; LENGTH] {
    let mut bytes = [0; LENGTH];
    let mut writer = Writer::new(&mut bytes);
    writer.bytes(&HEADER);
    writer.u8(VERSION);
    writer.u8(message.packet_number);
    writer.u8(message.players_per_team);
    writer.u8(message.competition_phase.number());
    writer.u8(message.competition_type.number());
    writer.u8(message.game_phase.number());
    writer.u8(message.game_state.number());
    writer.u8(message.set_play.number());
    writer.u8(message.is_first_half.into());
    writer.u8(message.kicking_team.unwrap_or(NOBODY));
    writer.i16(message.seconds_remaining);
    writer.i16(message.secondary_seconds);
    for team in &message.teams {
        encode_team(team, &mut writer);
    }
    bytes
}

/// The message that these bytes are.
///
/// # Errors
/// Where they are not exactly one message of this version.
pub fn decode(bytes: &[u8]) -> Result<GameControllerMessage, DecodeError> {
    let mut reader = Reader::exactly(LENGTH, bytes)?;
    reader.header(HEADER)?;
    reader.version(VERSION)?;
    Ok(GameControllerMessage {
        packet_number: reader.u8(),
        players_per_team: reader.u8(),
        competition_phase: numbered(&mut reader)?,
        competition_type: numbered(&mut reader)?,
        game_phase: numbered(&mut reader)?,
        game_state: numbered(&mut reader)?,
        set_play: numbered(&mut reader)?,
        is_first_half: reader.boolean("firstHalf")?,
        kicking_team: Some(reader.u8()).filter(|team| *team != NOBODY),
        seconds_remaining: reader.i16(),
        secondary_seconds: reader.i16(),
        teams: [decode_team(&mut reader)?, decode_team(&mut reader)?],
    })
}

fn encode_team(team: &TeamState, writer: &mut Writer<'_>) {
    writer.u8(team.number);
    writer.u8(team.field_player_color.number());
    writer.u8(team.goalkeeper_color.number());
    writer.u8(team.goalkeeper);
    writer.u8(team.score);
    writer.u8(team.penalty_shot);
    writer.u16(team.single_shots);
    writer.u16(team.message_budget);
    for player in &team.players {
        writer.u8(player.penalty.number());
        writer.u8(player.seconds_till_unpenalized);
    }
}

fn decode_team(reader: &mut Reader<'_>) -> Result<TeamState, DecodeError> {
    let mut team = TeamState {
        number: reader.u8(),
        field_player_color: numbered(reader)?,
        goalkeeper_color: numbered(reader)?,
        goalkeeper: reader.u8(),
        score: reader.u8(),
        penalty_shot: reader.u8(),
        single_shots: reader.u16(),
        message_budget: reader.u16(),
        ..TeamState::default()
    };
    for player in &mut team.players {
        *player = PlayerState {
            penalty: numbered(reader)?,
            seconds_till_unpenalized: reader.u8(),
        };
    }
    Ok(team)
}

fn numbered<T: Numbered>(reader: &mut Reader<'_>) -> Result<T, DecodeError> {
    let found = reader.u8();
    T::from_number(found).ok_or(DecodeError::UnknownValue {
        field: T::FIELD,
        expected: T::EXPECTED,
        found,
    })
}
