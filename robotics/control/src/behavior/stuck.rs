//! Owns when a robot that walks or kicks gets nowhere, and where it goes then: away from what holds it, or from whom it holds.
//!
//! Judged by where localisation says that it is: odometry believes every step that slips.

use std::mem;

use framework::Timestamp;
use nalgebra::{Isometry2, Vector2};
use serde::{Deserialize, Serialize};
use types::motion::Step;
use types::obstacles::Obstacle;
use types::world_state::WorldState;

use super::parameters::{RecoveryParameters, WalkParameters};
use super::places::wrapped;

/// Where the robot last got anywhere.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Serialize)]
pub(super) struct Progress {
    free: Option<Free>,
    moved_at: Timestamp,
    /// When it lay where somebody had come near.
    lay_beside_somebody_at: Option<Timestamp>,
    retreat: Option<Retreat>,
    /// When somebody was near last.
    beside_somebody_at: Option<Timestamp>,
    /// When it had got away from somebody, or had given up to.
    got_away_at: Option<Timestamp>,
}

/// A pose of the field frame that was not yet left.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
struct Free {
    pose: Isometry2<f32>,
    since: Timestamp,
}

/// It goes elsewhere before anything else.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
struct Retreat {
    since: Timestamp,
    /// In s.
    longest: f32,
    /// From somebody, who may want the same ball.
    is_from_somebody: bool,
}

/// What the robot does with its legs.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub(super) enum Legs {
    /// It falls, lies or gets up.
    Down,
    /// It wants to get anywhere.
    Move,
    /// It wants to stay.
    Wait,
}

impl Progress {
    /// Where the robot is, and what is around it, nearest first.
    pub(super) fn notice(
        &mut self,
        legs: Legs,
        ground_to_field: Option<&Isometry2<f32>>,
        obstacles: &[Obstacle],
        recovery: &RecoveryParameters,
        now: Timestamp,
    ) {
        if legs != Legs::Wait {
            self.moved_at = now;
        }
        let is_beside_somebody = nearest(obstacles, recovery).is_some();
        if is_beside_somebody {
            self.beside_somebody_at = Some(now);
        }
        if legs == Legs::Down {
            self.free = None;
            self.retreat = None;
            self.got_away_at = None;
            let lay_beside_somebody = self.lay_beside_somebody_at.is_some() || is_beside_somebody;
            self.lay_beside_somebody_at = lay_beside_somebody.then_some(now);
            return;
        }
        let waits = (now - self.moved_at).as_secs_f32() > recovery.waits;
        let is_over = self.retreat.is_some_and(|retreat| retreat.is_over(now));
        let Some(&pose) = ground_to_field.filter(|_| !waits && !is_over) else {
            self.free = None;
            self.end_retreat(now);
            if waits {
                self.lay_beside_somebody_at = None;
            }
            return;
        };
        // Who pushed it over pushes on: getting up is no use before it is elsewhere.
        let lay_at = mem::take(&mut self.lay_beside_somebody_at);
        if is_recent(lay_at, recovery.duration, now) {
            self.free = Some(Free { pose, since: now });
            self.retreat = Some(Retreat {
                since: now,
                longest: recovery.after,
                is_from_somebody: true,
            });
        }
        // Who is turned by whoever holds it has not got away.
        let is_free_to_turn = self.retreat.is_none();
        let has_left = |free: Free| {
            free.is_far(&pose, recovery) || (is_free_to_turn && free.is_turned(&pose, recovery))
        };
        match self.free {
            Some(free) if !has_left(free) => {
                if self.retreat.is_none() && is_long_ago(free.since, recovery.after, now) {
                    self.retreat = Some(Retreat {
                        since: now,
                        longest: recovery.duration,
                        is_from_somebody: is_recent(self.beside_somebody_at, recovery.after, now),
                    });
                }
            }
            _ => {
                self.free = Some(Free { pose, since: now });
                self.end_retreat(now);
            }
        }
    }

    fn end_retreat(&mut self, now: Timestamp) {
        let ended = self.retreat.take();
        if ended.is_some_and(|retreat| retreat.is_from_somebody) {
            self.got_away_at = Some(now);
        }
    }

    /// The game goes on from another place, or the ball is one team's.
    pub(super) fn forget_others(&mut self) {
        self.got_away_at = None;
    }

    /// Whether it has to go elsewhere before anything else.
    pub(super) fn backs_off(&self) -> bool {
        self.retreat.is_some()
    }

    /// Whether it was stuck beside somebody, or pushed over, and has got away a short while ago.
    pub(super) fn has_just_got_away(&self, recovery: &RecoveryParameters, now: Timestamp) -> bool {
        is_recent(self.got_away_at, recovery.gives_way, now)
    }
}

impl Free {
    fn is_far(&self, pose: &Isometry2<f32>, recovery: &RecoveryParameters) -> bool {
        let way = pose.translation.vector - self.pose.translation.vector;
        way.norm() > recovery.distance
    }

    fn is_turned(&self, pose: &Isometry2<f32>, recovery: &RecoveryParameters) -> bool {
        let turned = wrapped(pose.rotation.angle() - self.pose.rotation.angle());
        turned.abs() > recovery.turned
    }
}

impl Retreat {
    fn is_over(&self, now: Timestamp) -> bool {
        is_long_ago(self.since, self.longest, now)
    }
}

fn is_long_ago(since: Timestamp, seconds: f32, now: Timestamp) -> bool {
    (now - since).as_secs_f32() >= seconds
}

fn is_recent(at: Option<Timestamp>, seconds: f32, now: Timestamp) -> bool {
    at.is_some_and(|at| !is_long_ago(at, seconds, now))
}

/// Whoever is so near that both may touch.
fn nearest<'a>(obstacles: &'a [Obstacle], recovery: &RecoveryParameters) -> Option<&'a Obstacle> {
    obstacles
        .first()
        .filter(|obstacle| obstacle.position.coords.norm() < recovery.near)
}

/// How near somebody is who may be a mate that says it lies, m: who stands there keeps it from getting up.
///
/// Who does not know its place may be anywhere.
pub(super) fn fallen_mate(world: &WorldState, recovery: &RecoveryParameters) -> Option<f32> {
    let mut mates = world.teammates.iter().map(|mate| &mate.message);
    let may_be_here = mates.any(|mate| {
        let places = world.ground_to_field.zip(mate.ground_to_field);
        let is_near = |(own, other): (Isometry2<f32>, Isometry2<f32>)| {
            (other.translation.vector - own.translation.vector).norm() < recovery.mate
        };
        mate.is_fallen && places.is_none_or(is_near)
    });
    let nearest = world.obstacles.first().filter(|_| may_be_here);
    nearest.map(|obstacle| obstacle.position.coords.norm())
}

/// Away from what is near, else back.
pub(super) fn step_away(
    obstacles: &[Obstacle],
    recovery: &RecoveryParameters,
    walk: &WalkParameters,
) -> Step {
    let away = nearest(obstacles, recovery)
        .and_then(|obstacle| (-obstacle.position.coords).try_normalize(f32::EPSILON))
        .unwrap_or_else(|| -Vector2::x());
    Step {
        forward: away.x * walk.forward,
        left: away.y * walk.left,
        turn: 0.0,
    }
}

#[cfg(test)]
mod tests {
    use framework::testing::at_millis;
    use nalgebra::Point2;

    use super::*;
    use crate::behavior::tests::parameters;

    /// For how many seconds of two rounds it backs off, at that speed (m/s), turning (rad/s), with legs that move so often.
    fn backs_off(speed: f32, turn: f32, moves: impl Fn(u64) -> bool, knows: bool) -> f32 {
        let recovery = parameters().recovery;
        let mut progress = Progress::default();
        let mut cycles = 0.0;
        for cycle in 0..(200.0 * (recovery.after + recovery.duration)) as u64 {
            let seconds = 0.01 * cycle as f32;
            let pose = Isometry2::new(Vector2::new(speed * seconds, 0.0), turn * seconds);
            let now = at_millis(10_000 + 10 * cycle);
            let legs = if moves(cycle) { Legs::Move } else { Legs::Wait };
            progress.notice(legs, Some(&pose).filter(|_| knows), &[], &recovery, now);
            cycles += f32::from(u8::from(progress.backs_off()));
        }
        0.01 * cycles
    }

    #[test]
    fn who_walks_and_gets_nowhere_backs_off_for_a_while() {
        let recovery = parameters().recovery;
        let stuck = backs_off(0.0, 0.0, |_| true, true);
        assert!((stuck - 2.0 * recovery.duration).abs() < 0.1, "{stuck} s");
        // Who dithers between two decisions is no better off.
        assert_eq!(backs_off(0.0, 0.0, |cycle| cycle % 50 < 5, true), stuck);
    }

    #[test]
    fn who_is_turned_while_it_backs_off_goes_on_to() {
        let recovery = parameters().recovery;
        let mut progress = Progress::default();
        let (mut turned, mut cycles) = (0.0, 0.0);
        for cycle in 0..(100.0 * (2.0 * recovery.after + recovery.duration)) as u64 {
            if progress.backs_off() {
                turned += 0.005;
                cycles += 1.0;
            }
            let pose = Isometry2::rotation(turned);
            let now = at_millis(10_000 + 10 * cycle);
            progress.notice(Legs::Move, Some(&pose), &[], &recovery, now);
        }
        let backs_off = 0.01 * cycles;
        assert!((backs_off - recovery.duration).abs() < 0.1, "{backs_off} s");
    }

    #[test]
    fn who_was_stuck_beside_somebody_has_just_got_away_for_a_while() {
        let recovery = parameters().recovery;
        let ahead = |distance: f32| Obstacle {
            position: Point2::new(distance, 0.0),
            ..Obstacle::default()
        };
        // Somebody, as long before it backs off, ms, who is seen in one cycle alone; and whether it falls once it has got away.
        let in_time = (1000.0 * recovery.after) as u64 - 100;
        for (obstacle, seen_before, falls, expected) in [
            (ahead(0.9 * recovery.near), 100, false, recovery.gives_way),
            (
                ahead(0.9 * recovery.near),
                in_time,
                false,
                recovery.gives_way,
            ),
            (ahead(0.9 * recovery.near), 100, true, 0.0),
            (ahead(1.1 * recovery.near), 100, false, 0.0),
        ] {
            let mut progress = Progress::default();
            let (mut backed_off, mut cycles) = (0, 0.0);
            let until = recovery.after + recovery.duration + recovery.gives_way + 5.0;
            for cycle in 0..(100.0 * until) as u64 {
                let now = at_millis(10_000 + 10 * cycle);
                let legs = match (progress.backs_off() || backed_off == 0, falls) {
                    (true, _) => Legs::Move,
                    (false, false) => Legs::Wait,
                    (false, true) => Legs::Down,
                };
                let is_seen = 10 * cycle + seen_before == (1000.0 * recovery.after) as u64;
                let obstacles = if is_seen { vec![obstacle] } else { Vec::new() };
                progress.notice(
                    legs,
                    Some(&Isometry2::identity()),
                    &obstacles,
                    &recovery,
                    now,
                );
                backed_off += u64::from(progress.backs_off());
                cycles += f32::from(u8::from(progress.has_just_got_away(&recovery, now)));
            }
            assert!(backed_off > 0);
            let got_away = 0.01 * cycles;
            assert!(
                (got_away - expected).abs() < 0.1,
                "{seen_before} {falls}: {got_away} s"
            );
        }
    }

    #[test]
    fn who_gets_on_turns_waits_or_is_lost_does_not() {
        for (speed, turn, walks, knows) in [
            (0.1, 0.0, true, true),
            (0.0, 0.2, true, true),
            (0.0, 0.0, false, true),
            (0.0, 0.0, true, false),
        ] {
            let stuck = backs_off(speed, turn, |_| walks, knows);
            assert_eq!(stuck, 0.0, "{speed} {turn} {walks} {knows}");
        }
    }

    /// For how many of 15 s it backs off after 5 s on the ground, at that speed (m/s), turned at that (rad/s); somebody is so far
    /// ahead while it lies, m, and it knows its place from so many ms on after it is up.
    fn backs_off_risen(speed: f32, turn: f32, ahead: f32, knows_after: u64) -> f32 {
        let recovery = parameters().recovery;
        let mut progress = Progress::default();
        let somebody = [Obstacle {
            position: Point2::new(ahead, 0.0),
            ..Obstacle::default()
        }];
        for cycle in 0..500 {
            let now = at_millis(5_000 + 10 * cycle);
            progress.notice(Legs::Down, None, &somebody, &recovery, now);
            assert!(!progress.backs_off());
        }
        let mut cycles = 0.0;
        for cycle in 0..1500 {
            let seconds = 0.01 * cycle as f32;
            let pose = Isometry2::new(Vector2::new(-seconds * speed, 0.0), seconds * turn);
            let now = at_millis(10_000 + 10 * cycle);
            let pose = Some(&pose).filter(|_| 10 * cycle >= knows_after);
            progress.notice(Legs::Move, pose, &[], &recovery, now);
            cycles += f32::from(u8::from(progress.backs_off()));
        }
        0.01 * cycles
    }

    #[test]
    fn who_was_pushed_over_gets_away_before_it_plays_on() {
        let RecoveryParameters {
            after,
            duration,
            distance,
            near,
            ..
        } = parameters().recovery;
        let (in_time, late) = (duration - 0.5, duration + 0.5);
        let [in_time, late] = [in_time, late].map(|seconds| (1000.0 * seconds) as u64);
        for (knows_after, turn) in [(0, 0.0), (in_time, 0.0), (0, 0.3)] {
            let away = backs_off_risen(0.1, turn, 0.9 * near, knows_after);
            assert!((away - distance / 0.1).abs() < 0.1, "{away} s");
        }
        // Held, it gives up in the end.
        let held = backs_off_risen(0.0, 0.0, 0.9 * near, 0);
        assert!((held - after).abs() < 0.1, "{held} s");
        assert_eq!(backs_off_risen(0.1, 0.0, 1.1 * near, 0), 0.0);
        // Whoever was there has gone by then.
        assert_eq!(backs_off_risen(0.1, 0.0, 0.9 * near, late), 0.0);
    }

    #[test]
    fn who_was_pushed_over_has_just_got_away_once_it_has_left() {
        let recovery = parameters().recovery;
        let somebody = [Obstacle {
            position: Point2::new(0.5 * recovery.near, 0.0),
            ..Obstacle::default()
        }];
        for (obstacles, expected) in [(somebody.as_slice(), true), (&[], false)] {
            let mut progress = Progress::default();
            let here = Isometry2::identity();
            let there = Isometry2::translation(-1.1 * recovery.distance, 0.0);
            progress.notice(Legs::Down, None, obstacles, &recovery, at_millis(10_000));
            progress.notice(Legs::Move, Some(&here), &[], &recovery, at_millis(10_010));
            assert!(!progress.has_just_got_away(&recovery, at_millis(10_010)));
            progress.notice(Legs::Move, Some(&there), &[], &recovery, at_millis(12_000));
            assert_eq!(
                progress.has_just_got_away(&recovery, at_millis(12_000)),
                expected
            );
            progress.forget_others();
            assert!(!progress.has_just_got_away(&recovery, at_millis(12_000)));
        }
    }

    #[test]
    fn it_goes_away_from_what_is_near_else_back() {
        let (recovery, walk) = (parameters().recovery, parameters().walk);
        for (obstacle, forward, left) in [
            (None, -1.0, 0.0),
            (Some([0.3, 0.0]), -1.0, 0.0),
            (Some([0.0, 0.3]), 0.0, -1.0),
            (Some([-0.3, 0.0]), 1.0, 0.0),
            (Some([0.0, 2.0]), -1.0, 0.0),
        ] {
            let obstacles = obstacle.map(|place| Obstacle {
                position: Point2::from(place),
                ..Obstacle::default()
            });
            let step = step_away(obstacles.as_slice(), &recovery, &walk);
            assert_eq!(step.forward, forward * walk.forward, "{obstacle:?}");
            assert_eq!(step.left, left * walk.left, "{obstacle:?}");
        }
    }
}
