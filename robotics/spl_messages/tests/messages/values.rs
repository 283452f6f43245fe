//! Any message that there can be.

use nalgebra::{Isometry2, Point2, UnitComplex, Vector2};
use proptest::prelude::*;
use spl_messages::ReturnData;
use types::game::*;
use types::team::{TeamBall, TeamMessage};

pub(crate) const PENALTIES: [Penalty; 14] = [
    Penalty::None,
    Penalty::IllegalBallContact,
    Penalty::PlayerPushing,
    Penalty::IllegalMotionInSet,
    Penalty::InactivePlayer,
    Penalty::IllegalPosition,
    Penalty::LeavingTheField,
    Penalty::RequestForPickup,
    Penalty::LocalGameStuck,
    Penalty::IllegalPositionInSet,
    Penalty::PlayerStance,
    Penalty::IllegalMotionInStandby,
    Penalty::Substitute,
    Penalty::Manual,
];

pub(crate) const STATES: [GameState; 6] = [
    GameState::Initial,
    GameState::Ready,
    GameState::Set,
    GameState::Playing,
    GameState::Finished,
    GameState::Standby,
];

pub(crate) const SET_PLAYS: [SetPlay; 6] = [
    SetPlay::None,
    SetPlay::GoalKick,
    SetPlay::PushingFreeKick,
    SetPlay::CornerKick,
    SetPlay::KickIn,
    SetPlay::PenaltyKick,
];

pub(crate) const PHASES: [GamePhase; 4] = [
    GamePhase::Normal,
    GamePhase::PenaltyShootout,
    GamePhase::Overtime,
    GamePhase::Timeout,
];

pub(crate) const COLORS: [TeamColor; 10] = [
    TeamColor::Blue,
    TeamColor::Red,
    TeamColor::Yellow,
    TeamColor::Black,
    TeamColor::White,
    TeamColor::Green,
    TeamColor::Orange,
    TeamColor::Purple,
    TeamColor::Brown,
    TeamColor::Gray,
];

pub(crate) fn any_control_data() -> impl Strategy<Value = GameControllerMessage> {
    let words = (
        prop::sample::select(&[CompetitionPhase::RoundRobin, CompetitionPhase::Playoff]),
        prop::sample::select(&[CompetitionType::Normal, CompetitionType::MostPasses]),
        prop::sample::select(&PHASES),
        prop::sample::select(&STATES),
        prop::sample::select(&SET_PLAYS),
    );
    let numbers = any::<(u8, u8, bool, i16, i16)>();
    let kicking_team = prop::option::of(0..255_u8);
    let teams = [any_team(), any_team()];
    (words, numbers, kicking_team, teams).prop_map(|(words, numbers, kicking_team, teams)| {
        GameControllerMessage {
            packet_number: numbers.0,
            players_per_team: numbers.1,
            competition_phase: words.0,
            competition_type: words.1,
            game_phase: words.2,
            game_state: words.3,
            set_play: words.4,
            is_first_half: numbers.2,
            kicking_team,
            seconds_remaining: numbers.3,
            secondary_seconds: numbers.4,
            teams,
        }
    })
}

fn any_team() -> impl Strategy<Value = TeamState> {
    let colors = (prop::sample::select(&COLORS), prop::sample::select(&COLORS));
    let numbers = any::<(u8, u8, u8, u8, u16, u16)>();
    let player = (prop::sample::select(&PENALTIES), any::<u8>()).prop_map(
        |(penalty, seconds_till_unpenalized)| PlayerState {
            penalty,
            seconds_till_unpenalized,
        },
    );
    let players = prop::collection::vec(player, PLAYER_COUNT);
    (colors, numbers, players).prop_map(|(colors, numbers, players)| TeamState {
        number: numbers.0,
        field_player_color: colors.0,
        goalkeeper_color: colors.1,
        goalkeeper: numbers.1,
        score: numbers.2,
        penalty_shot: numbers.3,
        single_shots: numbers.4,
        message_budget: numbers.5,
        players: players.try_into().unwrap(),
    })
}

fn any_pose() -> impl Strategy<Value = Isometry2<f32>> {
    (-20.0..20.0_f32, -20.0..20.0_f32, -3.1..3.1_f32).prop_map(|(x, y, heading)| {
        Isometry2::from_parts(Vector2::new(x, y).into(), UnitComplex::new(heading))
    })
}

fn any_ball() -> impl Strategy<Value = TeamBall> {
    (-20.0..20.0_f32, -20.0..20.0_f32, 0.0..1000.0_f32).prop_map(|(x, y, age)| TeamBall {
        position: Point2::new(x, y),
        age,
    })
}

pub(crate) fn any_return_data() -> impl Strategy<Value = ReturnData> {
    let numbers = (1..=20_u8, any::<u8>(), any::<bool>());
    (numbers, any_pose(), prop::option::of(any_ball())).prop_map(
        |((player_number, team_number, is_fallen), ground_to_field, ball)| ReturnData {
            player_number,
            team_number,
            is_fallen,
            ground_to_field,
            ball,
        },
    )
}

pub(crate) fn any_team_message() -> impl Strategy<Value = TeamMessage> {
    let pose = prop::option::of(any_pose());
    let says = (any::<bool>(), any::<bool>());
    (1..=20_u8, says, pose, prop::option::of(any_ball())).prop_map(
        |(player_number, (is_fallen, plays_ball), ground_to_field, ball)| TeamMessage {
            player_number,
            is_fallen,
            plays_ball,
            ground_to_field,
            ball,
        },
    )
}
