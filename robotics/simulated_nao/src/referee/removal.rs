//! Who is taken off the field, for how long, and where to.

use framework::math;
use types::game::{GameState, Penalty};

use super::{Player, Referee, Ruling, direction, index};
use crate::field::{CARPET, CIRCLE_RADIUS, LENGTH, PENALTY_MARK_DISTANCE, WIDTH};

/// A torso that leans more than this, rad, lies.
const LYING: f64 = 1.0;
/// Who moves farther than this in Set, m, has walked.
const WALKED: f64 = 0.15;
/// Penalties of Set, s.
const IN_SET: f64 = 15.0;
/// Every earlier removal of the team adds so much, s.
const MORE: f64 = 10.0;
/// How far from the touch line removed robots stand, m.
const OUTSIDE: f64 = 0.5;

/// What the referee knows of a robot.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Record {
    pub(super) penalty: Penalty,
    /// How long it has to stay away, s.
    pub(super) left: f64,
    /// How long it has lain, s.
    lies: f64,
    /// Where it stood when Set began, m.
    stood: Option<[f64; 2]>,
}

impl Referee {
    pub(super) fn watch_players(
        &mut self,
        now: f64,
        passed: f64,
        players: &[Player],
        rulings: &mut Vec<Ruling>,
    ) {
        self.records.resize(players.len(), Record::default());
        let runs = matches!(self.state, GameState::Ready | GameState::Playing);
        for (place, player) in players.iter().enumerate() {
            let state = self.state;
            let fallen = self.settings.fallen;
            let record = &mut self.records[place];
            if record.penalty != Penalty::None {
                record.left -= if runs { passed } else { 0.0 };
                if record.left <= 0.0 && record.penalty != Penalty::Manual {
                    *record = Record::default();
                }
                continue;
            }
            record.lies = match player.tilt > LYING && runs {
                true => record.lies + passed,
                false => 0.0,
            };
            let [x, y, _] = player.pose;
            let stood = match state {
                GameState::Set => *record.stood.get_or_insert([x, y]),
                _ => {
                    record.stood = None;
                    [x, y]
                }
            };
            let walked = math::hypot(x - stood[0], y - stood[1]);
            let penalty = if record.lies > fallen {
                Penalty::InactivePlayer
            } else if runs && is_off_the_carpet(x, y) {
                Penalty::LeavingTheField
            } else if state == GameState::Set && walked > WALKED && now > self.since {
                Penalty::IllegalMotionInSet
            } else {
                continue;
            };
            if self.settings.penalties {
                self.remove(place, penalty, players, rulings);
            }
        }
    }

    /// When Set begins everybody has to be in the own half, and but for who kicks off outside of the circle.
    pub(super) fn check_places(&mut self, players: &[Player], rulings: &mut Vec<Ruling>) {
        self.records.resize(players.len(), Record::default());
        for (place, player) in players.iter().enumerate() {
            let [x, y, _] = player.pose;
            let radius = f64::from(CIRCLE_RADIUS);
            let in_circle = math::hypot(x, y) < radius;
            let in_own_half = x * direction(player.team) < 0.0;
            let is_legal = match player.team == self.kicking {
                true => in_own_half || in_circle,
                false => in_own_half && !in_circle,
            };
            let is_free = self.records[place].penalty == Penalty::None;
            if !is_legal && is_free && self.settings.penalties {
                self.remove(place, Penalty::IllegalPositionInSet, players, rulings);
            }
        }
    }

    /// Takes a robot off the field.
    pub(super) fn remove(
        &mut self,
        place: usize,
        penalty: Penalty,
        players: &[Player],
        rulings: &mut Vec<Ruling>,
    ) {
        let Some(player) = players.get(place) else {
            return;
        };
        let in_set = matches!(
            penalty,
            Penalty::IllegalMotionInSet | Penalty::IllegalPositionInSet
        );
        let earlier = &mut self.removals[index(player.team)];
        let left = match in_set {
            true => IN_SET,
            false => self.settings.removal + MORE * f64::from(*earlier),
        };
        *earlier += u32::from(!in_set);
        self.removed.push((place, penalty));
        self.records[place] = Record {
            penalty,
            left,
            ..Record::default()
        };
        // Who walks in Set stays where it is.
        if penalty != Penalty::IllegalMotionInSet {
            rulings.push(Ruling::Carry(place, beside_the_field(player)));
        }
    }
}

/// Outside of the touch line that is nearer, at the height of the own penalty mark, towards the field.
fn beside_the_field(player: &Player) -> [f64; 3] {
    let side = if player.pose[1] < 0.0 { -1.0 } else { 1.0 };
    let mark = f64::from(LENGTH) / 2.0 - f64::from(PENALTY_MARK_DISTANCE);
    // Neighbouring numbers have places of their own, so that hardly anybody is put onto somebody.
    let aside = 0.5 * f64::from(player.number % 7);
    [
        -direction(player.team) * (mark - aside),
        side * (f64::from(WIDTH) / 2.0 + OUTSIDE),
        -side * std::f64::consts::FRAC_PI_2,
    ]
}

fn is_off_the_carpet(x: f64, y: f64) -> bool {
    x.abs() > f64::from(CARPET.x) || y.abs() > f64::from(CARPET.y)
}
