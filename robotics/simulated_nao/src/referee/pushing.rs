//! Who pushes whom: a robot that gets on towards one of the other team it touches, while that one does not come as well.

use nalgebra::{Point2, Vector2};
use types::game::{Penalty, SetPlay};

use super::{Player, Referee, Ruling, other};

/// Robots whose middles are nearer than this, m, touch: a NAO's shoulders are 0.28 m apart, its arms hang beside them.
const TOUCH: f64 = 0.32;
/// Who gets on faster than this towards another one, m/s, pushes it.
const SPEED: f64 = 0.05;
/// For so long, s, a touch is no foul.
const PATIENCE: f64 = 1.0;
/// Robots sway while they walk: speeds are means over so long, s.
const MEAN: f64 = 0.5;
/// Who is farther away after one look, m, was carried.
const CARRIED: f64 = 0.2;
/// A torso that leans more, rad, falls and cannot help it.
const FALLING: f64 = 0.5;
/// Pushing that near to the ball, m, is a free kick for the others (RoboCup SPL rules 2025).
const AT_THE_BALL: f64 = 0.5;

/// How a robot moves, and for how long it has been pushing.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Movement {
    place: Option<Point2<f64>>,
    /// m/s.
    velocity: Vector2<f64>,
    /// s.
    pushes: f64,
}

impl Movement {
    fn go_on(&mut self, place: Point2<f64>, passed: f64) {
        let way = self.place.map_or_else(Vector2::zeros, |last| place - last);
        if way.norm() > CARRIED {
            *self = Self::default();
        } else if passed > 0.0 {
            self.velocity += (way / passed - self.velocity) * (passed / MEAN).min(1.0);
        }
        self.place = Some(place);
    }
}

impl Referee {
    pub(super) fn watch_pushing(
        &mut self,
        now: f64,
        passed: f64,
        ball: Option<Point2<f64>>,
        players: &[Player],
        rulings: &mut Vec<Ruling>,
    ) {
        self.movements.resize(players.len(), Movement::default());
        for (movement, player) in self.movements.iter_mut().zip(players) {
            movement.go_on(place(player), passed);
        }
        for pusher in 0..players.len() {
            let pushed = self.pushed_by(pusher, players);
            let movement = &mut self.movements[pusher];
            movement.pushes = match pushed {
                Some(_) => movement.pushes + passed,
                None => 0.0,
            };
            if movement.pushes <= PATIENCE || !self.settings.penalties {
                continue;
            }
            movement.pushes = 0.0;
            let near = place(&players[pusher]);
            match ball.filter(|ball| (ball - near).norm() <= AT_THE_BALL) {
                Some(ball) => {
                    let team = other(players[pusher].team);
                    self.restart(now, SetPlay::PushingFreeKick, team, ball.into(), rulings);
                }
                None => self.remove(pusher, Penalty::PlayerPushing, players, rulings),
            }
        }
    }

    /// Whom a robot pushes now.
    fn pushed_by(&self, pusher: usize, players: &[Player]) -> Option<usize> {
        let plays = |place: usize, player: &Player| self.plays(place) && player.tilt < FALLING;
        let own = players.get(pusher).filter(|own| plays(pusher, own))?;
        let mut others = players.iter().enumerate();
        others
            .find(|(index, victim)| {
                let between = place(victim) - place(own);
                let towards = between.try_normalize(f64::EPSILON).unwrap_or_default();
                let comes = |player: usize, towards: Vector2<f64>| {
                    self.movements[player].velocity.dot(&towards) > SPEED
                };
                victim.team != own.team
                    && plays(*index, victim)
                    && between.norm() < TOUCH
                    && comes(pusher, towards)
                    && !comes(*index, -towards)
            })
            .map(|(index, _)| index)
    }
}

fn place(player: &Player) -> Point2<f64> {
    Point2::new(player.pose[0], player.pose[1])
}
