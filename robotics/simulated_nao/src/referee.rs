//! A referee who plays a game: what state it is in, who may kick, who is taken off the field, and when the whistle sounds.
//!
//! It sees the world as it is and rules as the RoboCup SPL rules 2025 say, as far as this goes: kick-off, goals, kick-in,
//! goal kick, corner kick, free kick after pushing, removal of robots that lie too long, walk in Set, stand where they must
//! not in Set, push, or leave the field, and two halves, in which the teams keep their sides: before the second one all robots are
//! put to where they began. It sees no holding of the ball.

mod announcement;
mod ball;
mod pushing;
mod removal;

use nalgebra::{Point2, Point3};
use types::game::{GameState, Penalty, SetPlay};

pub use self::announcement::message;
pub(crate) use self::ball::TOUCH;
use self::pushing::Movement;
use self::removal::Record;
use crate::scene::Team;
use crate::settings::PlaySettings;

/// What the referee sees of a robot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Player {
    /// Whose it is.
    pub team: Team,
    /// Number of its shirt.
    pub number: u8,
    /// Its ground frame in the field frame: x and y in m, heading in rad.
    pub pose: [f64; 3],
    /// Of its torso, rad.
    pub tilt: f64,
    /// The middles of its soles in the field frame, m.
    pub feet: [Point2<f64>; 2],
}

/// What the referee does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Ruling {
    /// Whistles.
    Whistle,
    /// Puts the ball there, at rest, m.
    PlaceBall([f64; 2]),
    /// Has a robot carried somewhere: its place among the players; x and y in m, heading in rad.
    Carry(usize, [f64; 3]),
}

/// A referee and the game as it really stands.
#[derive(Clone, Debug)]
pub struct Referee {
    settings: PlaySettings,
    /// What robots may do.
    pub state: GameState,
    /// When it became that, s.
    since: f64,
    /// How the game was resumed.
    pub set_play: SetPlay,
    /// When the ball was given to somebody, s.
    set_play_since: f64,
    /// Who kicks.
    pub kicking: Team,
    /// Goals of blue and red.
    pub score: [u8; 2],
    /// Which half it is, 1 first.
    half: u8,
    /// How long the half has been played, s.
    played: f64,
    /// When it looked last, s.
    looked: f64,
    touched_last: Option<Team>,
    /// What the referee's computer does not say before that time, s.
    secret: Option<(f64, Said)>,
    records: Vec<Record>,
    /// Where each player was first seen: its place before a half.
    starts: Vec<[f64; 3]>,
    /// How many robots of each team were removed.
    removals: [u32; 2],
    /// Who was removed and why, in that order.
    removed: Vec<(usize, Penalty)>,
    movements: Vec<Movement>,
}

/// What the referee's computer goes on saying meanwhile.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Said {
    state: GameState,
    set_play: SetPlay,
    kicking: Team,
    score: [u8; 2],
}

impl Referee {
    /// Before the game; blue kicks off.
    pub fn new(settings: PlaySettings) -> Self {
        Self {
            settings,
            state: GameState::Initial,
            since: 0.0,
            set_play: SetPlay::None,
            set_play_since: 0.0,
            kicking: Team::Own,
            score: [0; 2],
            half: 1,
            played: 0.0,
            looked: 0.0,
            touched_last: None,
            secret: None,
            records: Vec::new(),
            starts: Vec::new(),
            removals: [0; 2],
            removed: Vec::new(),
            movements: Vec::new(),
        }
    }

    /// Looks at the world at a time (s) and rules.
    pub fn look(&mut self, now: f64, ball: Option<Point3<f64>>, players: &[Player]) -> Vec<Ruling> {
        let passed = now - self.looked;
        self.looked = now;
        let mut rulings = Vec::new();
        let unknown = players.iter().skip(self.starts.len());
        self.starts.extend(unknown.map(|player| player.pose));
        if self.secret.is_some_and(|(until, _)| now >= until) {
            self.secret = None;
        }
        if self.state == GameState::Playing {
            self.played += passed;
        }
        self.go_on(now, players, &mut rulings);
        if self.state == GameState::Playing
            && let Some(ball) = ball
        {
            self.watch_ball(now, &ball, players, &mut rulings);
        }
        self.watch_players(now, passed, players, &mut rulings);
        if self.state == GameState::Playing {
            let ball = ball.map(|ball| ball.xy());
            self.watch_pushing(now, passed, ball, players, &mut rulings);
        }
        rulings
    }

    /// Takes a robot out, as somebody says.
    pub fn penalise(&mut self, player: usize, penalty: Penalty, players: &[Player]) -> Vec<Ruling> {
        let mut rulings = Vec::new();
        self.records.resize(players.len(), Record::default());
        self.remove(player, penalty, players, &mut rulings);
        rulings
    }

    /// Why a robot was taken out until now, by its place among the players.
    pub fn removals(&self, player: usize) -> impl Iterator<Item = Penalty> {
        let of = move |(place, penalty): &(usize, Penalty)| (*place == player).then_some(*penalty);
        self.removed.iter().filter_map(of)
    }

    /// Whether a robot is not taken out now, by its place among the players.
    pub fn plays(&self, player: usize) -> bool {
        let record = self.records.get(player);
        record.is_none_or(|record| record.penalty == Penalty::None)
    }

    /// What time alone changes.
    fn go_on(&mut self, now: f64, players: &[Player], rulings: &mut Vec<Ruling>) {
        let since = now - self.since;
        let settings = self.settings;
        match self.state {
            GameState::Initial if since >= settings.initial => self.enter(now, GameState::Ready),
            GameState::Ready if since >= settings.ready => {
                self.enter(now, GameState::Set);
                rulings.push(Ruling::PlaceBall([0.0, 0.0]));
                self.check_places(players, rulings);
            }
            GameState::Set if since >= settings.set => {
                self.keep_secret(now);
                self.enter(now, GameState::Playing);
                self.set_play_since = now;
                self.touched_last = None;
                rulings.push(Ruling::Whistle);
            }
            GameState::Playing if self.played >= settings.half => {
                self.enter(now, GameState::Finished);
                self.secret = None;
                rulings.push(Ruling::Whistle);
            }
            GameState::Finished if self.half < settings.halves && since >= settings.pause => {
                self.half += 1;
                self.played = 0.0;
                // Who did not kick off the game kicks off now.
                self.kicking = Team::Opponent;
                self.enter(now, GameState::Initial);
                self.records.fill(Record::default());
                let starts = self.starts.iter().enumerate();
                rulings.extend(starts.map(|(player, start)| Ruling::Carry(player, *start)));
            }
            GameState::Playing
                if self.set_play != SetPlay::None
                    && now - self.set_play_since >= settings.free_kick =>
            {
                self.set_play = SetPlay::None;
            }
            _ => {}
        }
    }

    fn enter(&mut self, now: f64, state: GameState) {
        self.state = state;
        self.since = now;
        self.set_play = SetPlay::None;
    }

    /// The referee's computer says for a while what it says now.
    fn keep_secret(&mut self, now: f64) {
        let said = self.said();
        self.secret = Some((now + self.settings.delay, said));
    }

    fn said(&self) -> Said {
        self.secret.map_or(
            Said {
                state: self.state,
                set_play: self.set_play,
                kicking: self.kicking,
                score: self.score,
            },
            |(_, said)| said,
        )
    }
}

fn other(team: Team) -> Team {
    match team {
        Team::Own => Team::Opponent,
        Team::Opponent => Team::Own,
    }
}

/// 1 towards the goal that a team attacks, seen along x.
fn direction(team: Team) -> f64 {
    match team {
        Team::Own => 1.0,
        Team::Opponent => -1.0,
    }
}

fn index(team: Team) -> usize {
    usize::from(team == Team::Opponent)
}
