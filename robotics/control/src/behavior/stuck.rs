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
        if legs == Legs::Down {
            self.free = None;
            self.retreat = None;
            let is_beside_somebody =
                self.lay_beside_somebody_at.is_some() || nearest(obstacles, recovery).is_some();
            self.lay_beside_somebody_at = is_beside_somebody.then_some(now);
            return;
        }
        let waits = (now - self.moved_at).as_secs_f32() > recovery.waits;
        let is_over = self.retreat.is_some_and(|retreat| retreat.is_over(now));
        let Some(&pose) = ground_to_field.filter(|_| !waits && !is_over) else {
            self.free = None;
            self.retreat = None;
            if waits {
                self.lay_beside_somebody_at = None;
            }
            return;
        };
        // Who pushed it over pushes on: getting up is no use before it is elsewhere.
        let lay_at = mem::take(&mut self.lay_beside_somebody_at);
        if lay_at.is_some_and(|lay_at| !is_long_ago(lay_at, recovery.duration, now)) {
            self.free = Some(Free { pose, since: now });
            self.retreat = Some(Retreat {
                since: now,
                longest: recovery.after,
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
                    });
                }
            }
            _ => {
                self.free = Some(Free { pose, since: now });
                self.retreat = None;
            }
        }
    }

    /// Whether it has to go elsewhere before anything else.
    pub(super) fn backs_off(&self) -> bool {
        self.retreat.is_some()
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
