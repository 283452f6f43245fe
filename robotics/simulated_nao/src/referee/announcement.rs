//! What the referee's computer says of a game that is played.

use types::game::{
    CompetitionPhase, GameControllerMessage, GameState, PLAYER_COUNT, Penalty, PlayerState,
    SetPlay, TeamColor, TeamState,
};

use super::{Player, Referee, index};
use crate::scene::Team;
use crate::settings::GameSettings;

/// The message at a time (s), without its number, as long as no team has told anything.
pub fn message(
    referee: &Referee,
    game: &GameSettings,
    now: f64,
    players: &[Player],
) -> GameControllerMessage {
    let said = referee.said();
    let of = |team: Team| players.iter().filter(move |player| player.team == team);
    let most = of(Team::Own).count().max(of(Team::Opponent).count());
    let team = |team: Team, field_player_color, goalkeeper_color| TeamState {
        number: game.team_of(team),
        field_player_color,
        goalkeeper_color,
        goalkeeper: game.goalkeepers[index(team)],
        score: said.score[index(team)],
        message_budget: game.message_budget,
        players: states(referee, game, team, players),
        ..TeamState::default()
    };
    GameControllerMessage {
        packet_number: 0,
        players_per_team: most as u8,
        competition_phase: CompetitionPhase::RoundRobin,
        game_state: said.state,
        set_play: said.set_play,
        is_first_half: referee.half == 1,
        kicking_team: Some(game.team_of(said.kicking)),
        seconds_remaining: rounded_up(referee.settings.half - referee.played),
        secondary_seconds: secondary(referee, now),
        teams: [
            team(Team::Own, TeamColor::Blue, TeamColor::Black),
            team(Team::Opponent, TeamColor::Red, TeamColor::Green),
        ],
        ..GameControllerMessage::default()
    }
}

/// Of those that play, a team mate that only speaks among them; everybody else is a substitute.
fn states(
    referee: &Referee,
    game: &GameSettings,
    team: Team,
    players: &[Player],
) -> [PlayerState; PLAYER_COUNT] {
    let mut states = [PlayerState {
        penalty: Penalty::Substitute,
        seconds_till_unpenalized: 0,
    }; PLAYER_COUNT];
    if team == Team::Own
        && let Some(mate) = game.mate
    {
        states[usize::from(mate) - 1] = PlayerState::default();
    }
    for (place, player) in players.iter().enumerate() {
        let state = states.get_mut(usize::from(player.number).wrapping_sub(1));
        let (true, Some(state)) = (player.team == team, state) else {
            continue;
        };
        let record = referee.records.get(place).copied().unwrap_or_default();
        *state = PlayerState {
            penalty: record.penalty,
            seconds_till_unpenalized: rounded_up(record.left).clamp(0, 255) as u8,
        };
    }
    states
}

fn secondary(referee: &Referee, now: f64) -> i16 {
    let said = referee.said();
    let until_free = |time: f64| rounded_up(time - (now - referee.set_play_since)).max(0);
    match (said.state, said.set_play) {
        (GameState::Ready, _) => rounded_up(referee.settings.ready - (now - referee.since)).max(0),
        (GameState::Playing, SetPlay::None) if referee.played < referee.settings.kick_off => {
            until_free(referee.settings.kick_off)
        }
        (GameState::Playing, SetPlay::None) => 0,
        (GameState::Playing, _) => until_free(referee.settings.free_kick),
        _ => 0,
    }
}

/// Whole seconds, as the real GameController counts.
fn rounded_up(seconds: f64) -> i16 {
    seconds.ceil() as i16
}
