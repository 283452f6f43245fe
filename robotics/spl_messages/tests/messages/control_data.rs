//! Control data: the published offsets, every number, every refusal.

use proptest::prelude::*;
use spl_messages::control_data::{LENGTH, decode, encode};
use types::game::*;

use crate::values::{COLORS, PENALTIES, PHASES, SET_PLAYS, STATES, any_control_data};

fn bytes() -> [u8; LENGTH] {
    encode(&GameControllerMessage::default())
}

/// The message whose byte at this place is another.
fn with(place: usize, value: u8) -> Result<GameControllerMessage, String> {
    let mut bytes = bytes();
    bytes[place] = value;
    decode(&bytes).map_err(|error| error.to_string())
}

#[test]
fn every_field_stands_where_the_published_layout_has_it() {
    let team = |number, score| TeamState {
        number,
        field_player_color: TeamColor::Red,
        goalkeeper_color: TeamColor::Gray,
        goalkeeper: 12,
        score,
        penalty_shot: 1,
        single_shots: 0x0506,
        message_budget: 1200,
        ..TeamState::default()
    };
    let mut message = GameControllerMessage {
        packet_number: 200,
        players_per_team: 7,
        competition_phase: CompetitionPhase::Playoff,
        competition_type: CompetitionType::MostPasses,
        game_phase: GamePhase::Overtime,
        game_state: GameState::Playing,
        set_play: SetPlay::KickIn,
        is_first_half: true,
        kicking_team: Some(24),
        seconds_remaining: -2,
        secondary_seconds: 0x0102,
        teams: [team(24, 3), team(5, 9)],
    };
    message.teams[0].players[0].penalty = Penalty::Manual;
    message.teams[1].players[19] = PlayerState {
        penalty: Penalty::Substitute,
        seconds_till_unpenalized: 45,
    };
    let bytes = encode(&message);
    assert_eq!(bytes[..10], *b"RGme\x12\xc8\x07\x01\x01\x02");
    assert_eq!(bytes[10..18], [3, 4, 1, 24, 0xfe, 0xff, 0x02, 0x01]);
    let of_team = [24, 1, 9, 12, 3, 1, 0x06, 0x05, 0xb0, 0x04, 15, 0];
    assert_eq!(bytes[18..30], of_team);
    assert_eq!(bytes[68..73], [5, 1, 9, 12, 9]);
    assert_eq!(bytes[116..], [14, 45]);
    assert_eq!(decode(&bytes), Ok(message));
}

#[test]
fn nobody_kicks_where_the_team_is_255() {
    assert_eq!(bytes()[13], 255);
    assert_eq!(with(13, 255).unwrap().kicking_team, None);
    assert_eq!(with(13, 0).unwrap().kicking_team, Some(0));
}

#[test]
fn each_word_has_its_number() {
    for number in 0..=255_u8 {
        let place = usize::from(number);
        let state = with(10, number).ok().map(|message| message.game_state);
        assert_eq!(state, STATES.get(place).copied());
        let set_play = with(11, number).ok().map(|message| message.set_play);
        assert_eq!(set_play, SET_PLAYS.get(place).copied());
        let phase = with(9, number).ok().map(|message| message.game_phase);
        assert_eq!(phase, PHASES.get(place).copied());
        let color = with(19, number).ok();
        let color = color.map(|message| message.teams[0].field_player_color);
        assert_eq!(color, COLORS.get(place).copied());
        // 12 and 13 are no penalties.
        let penalty = match place {
            0..=11 => Some(PENALTIES[place]),
            14 | 15 => Some(PENALTIES[place - 2]),
            _ => None,
        };
        let found = with(28, number).ok();
        assert_eq!(
            found.map(|message| message.teams[0].players[0].penalty),
            penalty
        );
    }
}

#[test]
fn a_refusal_says_what_was_expected_and_what_came() {
    for (place, value, expected) in [
        (0, b'X', "the header is \"XGme\" instead of \"RGme\""),
        (3, 0, "the header is \"RGm\\x00\" instead of \"RGme\""),
        (4, 17, "the version is 17 instead of 18"),
        (7, 2, "`competitionPhase` is 2 instead of 0 or 1"),
        (8, 9, "`competitionType` is 9 instead of 0 or 1"),
        (9, 4, "`gamePhase` is 4 instead of 0 to 3"),
        (10, 6, "`state` is 6 instead of 0 to 5"),
        (11, 255, "`setPlay` is 255 instead of 0 to 5"),
        (12, 2, "`firstHalf` is 2 instead of 0 or 1"),
        (20, 10, "`a team's colour` is 10 instead of 0 to 9"),
        (116, 13, "`penalty` is 13 instead of 0 to 11, 14 or 15"),
    ] {
        assert_eq!(with(place, value).unwrap_err(), expected);
    }
    let long = [&bytes()[..], &[0]].concat();
    assert_eq!(
        decode(&long).unwrap_err().to_string(),
        "the message has 119 bytes instead of 118"
    );
}

proptest! {
    #[test]
    fn what_is_encoded_is_decoded_again(message in any_control_data()) {
        prop_assert_eq!(decode(&encode(&message)), Ok(message));
    }
}
