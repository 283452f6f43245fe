//! How the game stands at a time, as the referee's computer sees it.
//!
//! Durations are those of the RoboCup SPL rules 2025.

use types::game::{
    CompetitionPhase, GameControllerMessage, GamePhase, GameState, KickingTeam, PLAYER_COUNT,
    Penalty, PlayerState, SetPlay, TeamColor, TeamState,
};

use crate::settings::{Announcement, GameSettings, PLAYERS_PER_TEAM};

/// A half, s.
const HALF: f64 = 600.0;
/// To walk to the own places before a kick-off and before a penalty kick, s.
const READY: f64 = 45.0;
const READY_FOR_PENALTY_KICK: f64 = 30.0;
/// Until the ball is free after a kick-off, and after everything else, s.
const KICK_OFF: f64 = 10.0;
const FREE_KICK: f64 = 30.0;
/// A shot of a penalty shoot-out, s.
const SHOT: f64 = 30.0;
/// A standard removal, s.
const REMOVAL: f64 = 45.0;

/// The message for so many seconds after the start, without its number.
pub(super) fn message_at(game: &GameSettings, seconds: f64) -> GameControllerMessage {
    let said = game
        .schedule
        .iter()
        .take_while(|announcement| announcement.at <= seconds)
        .count();
    let before = Announcement::of(0.0, GameState::Initial);
    let current = said
        .checked_sub(1)
        .map_or(&before, |last| &game.schedule[last]);
    let since = seconds - current.at;
    GameControllerMessage {
        packet_number: 0,
        players_per_team: PLAYERS_PER_TEAM,
        competition_phase: CompetitionPhase::RoundRobin,
        game_phase: current.phase,
        game_state: current.state,
        set_play: current.set_play,
        is_first_half: true,
        kicking_team: match current.kicking_team {
            KickingTeam::Own => Some(game.team),
            KickingTeam::Opponent => Some(game.opponent),
            KickingTeam::Nobody => None,
        },
        seconds_remaining: match (current.phase, current.state) {
            (GamePhase::PenaltyShootout, GameState::Playing) => count_down(SHOT, since),
            (GamePhase::PenaltyShootout, _) => count_down(SHOT, 0.0),
            _ => count_down(HALF, playing_seconds(&game.schedule, seconds)),
        },
        secondary_seconds: secondary(current, since),
        teams: teams(game, current, since),
        ..GameControllerMessage::default()
    }
}

fn teams(game: &GameSettings, current: &Announcement, since: f64) -> [TeamState; 2] {
    let mut teams = [own_team(game, current), other_team(game, current)];
    let team = &mut teams[usize::from(game.is_opponent)];
    team.players[usize::from(game.player_number) - 1] = PlayerState {
        penalty: current.penalty,
        seconds_till_unpenalized: match current.penalty {
            Penalty::None | Penalty::Substitute | Penalty::Manual => 0,
            _ => count_down(REMOVAL, since).max(0) as u8,
        },
    };
    teams
}

/// How long the half has been played.
fn playing_seconds(schedule: &[Announcement], seconds: f64) -> f64 {
    let ends = schedule.iter().skip(1).map(|next| next.at);
    schedule
        .iter()
        .zip(ends.chain([f64::INFINITY]))
        .filter(|(announcement, _)| announcement.state == GameState::Playing)
        .map(|(announcement, end)| (seconds.min(end) - announcement.at).max(0.0))
        .sum()
}

fn secondary(current: &Announcement, since: f64) -> i16 {
    let duration = match (current.state, current.set_play) {
        _ if current.phase == GamePhase::PenaltyShootout => return 0,
        (GameState::Ready, SetPlay::PenaltyKick) => READY_FOR_PENALTY_KICK,
        (GameState::Ready, _) => READY,
        (GameState::Playing, SetPlay::None) => KICK_OFF,
        (GameState::Playing, _) => FREE_KICK,
        _ => return 0,
    };
    count_down(duration, since).max(0)
}

/// Whole seconds that are left, rounded up as the real GameController does.
fn count_down(duration: f64, passed: f64) -> i16 {
    (duration - passed).ceil() as i16
}

fn own_team(game: &GameSettings, current: &Announcement) -> TeamState {
    TeamState {
        number: game.team,
        field_player_color: TeamColor::Blue,
        goalkeeper_color: TeamColor::Black,
        goalkeeper: game.goalkeepers[0],
        score: current.score[0],
        ..team_state(game)
    }
}

fn other_team(game: &GameSettings, current: &Announcement) -> TeamState {
    TeamState {
        number: game.opponent,
        field_player_color: TeamColor::Red,
        goalkeeper_color: TeamColor::Green,
        goalkeeper: game.goalkeepers[1],
        score: current.score[1],
        ..team_state(game)
    }
}

/// A team at the start: whoever is not on the field is a substitute.
fn team_state(game: &GameSettings) -> TeamState {
    let mut players = [PlayerState::default(); PLAYER_COUNT];
    for substitute in &mut players[PLAYERS_PER_TEAM.into()..] {
        substitute.penalty = Penalty::Substitute;
    }
    TeamState {
        message_budget: game.message_budget,
        players,
        ..TeamState::default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_usual_game_leads_to_playing_and_its_clocks_run() {
        let game = GameSettings::default();
        for (seconds, state, secondary, remaining) in [
            (0.1, GameState::Initial, 0, 600),
            (2.9, GameState::Initial, 0, 600),
            (3.1, GameState::Ready, 45, 600),
            (7.6, GameState::Ready, 41, 600),
            (8.1, GameState::Set, 0, 600),
            (26.6, GameState::Set, 0, 600),
            (27.1, GameState::Playing, 10, 600),
            (40.0, GameState::Playing, 0, 587),
            (700.0, GameState::Playing, 0, -73),
        ] {
            let message = message_at(&game, seconds);
            assert_eq!(message.game_state, state, "{seconds}");
            assert_eq!(message.secondary_seconds, secondary, "{seconds}");
            assert_eq!(message.seconds_remaining, remaining, "{seconds}");
            assert_eq!(message.kicking_team, Some(game.team));
        }
    }

    #[test]
    fn a_shot_of_a_shoot_out_has_thirty_seconds() {
        let mut game = GameSettings::default();
        for announcement in &mut game.schedule {
            announcement.phase = GamePhase::PenaltyShootout;
        }
        for (seconds, remaining) in [(20.0, 30), (27.1, 30), (40.0, 17)] {
            let message = message_at(&game, seconds);
            assert_eq!(message.game_phase, GamePhase::PenaltyShootout);
            assert_eq!(message.seconds_remaining, remaining, "{seconds}");
            assert_eq!(message.secondary_seconds, 0, "{seconds}");
        }
    }

    #[test]
    fn a_penalty_is_the_robots_own_and_counts_down() {
        let mut game = GameSettings::default();
        game.schedule[3].penalty = Penalty::PlayerPushing;
        game.schedule[3].kicking_team = KickingTeam::Nobody;
        let message = message_at(&game, 30.0);
        assert_eq!(message.kicking_team, None);
        let [own, other] = message.teams;
        assert_eq!(own.players[2].penalty, Penalty::PlayerPushing);
        assert_eq!(own.players[2].seconds_till_unpenalized, 42);
        let penalized = |team: &TeamState| {
            let players = team.players[..7].iter();
            players
                .filter(|player| player.penalty != Penalty::None)
                .count()
        };
        assert_eq!((penalized(&own), penalized(&other)), (1, 0));
        assert_eq!(own.players[7].penalty, Penalty::Substitute);
    }

    #[test]
    fn each_team_has_a_goalkeeper_of_its_own() {
        let goalkeepers =
            |game: &GameSettings| message_at(game, 0.0).teams.map(|team| team.goalkeeper);
        assert_eq!(goalkeepers(&GameSettings::default()), [1, 1]);
        let game = GameSettings {
            goalkeepers: [4, 0],
            ..GameSettings::default()
        };
        assert_eq!(goalkeepers(&game), [4, 0]);
    }

    #[test]
    fn goals_are_those_of_the_team_that_shot_them() {
        let mut game = GameSettings::default();
        game.schedule[3].score = [2, 1];
        let goals = |seconds| message_at(&game, seconds).teams.map(|team| team.score);
        assert_eq!((goals(20.0), goals(30.0)), ([0, 0], [2, 1]));
    }

    #[test]
    fn without_any_announcement_the_game_has_not_begun() {
        let game = GameSettings {
            schedule: Vec::new(),
            ..GameSettings::default()
        };
        assert_eq!(message_at(&game, 5.0).game_state, GameState::Initial);
    }
}
