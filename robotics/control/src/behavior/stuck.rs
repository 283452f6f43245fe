//! Owns when a robot that walks or kicks gets nowhere, and where it goes then: away from what holds it.
//!
//! Judged by where localisation says that it is: odometry believes every step that slips.

use std::time::Duration;

use framework::Timestamp;
use nalgebra::{Isometry2, Vector2};
use serde::{Deserialize, Serialize};
use types::motion::Step;
use types::obstacles::Obstacle;

use super::parameters::{RecoveryParameters, WalkParameters};
use super::places::wrapped;

/// Who has not walked for longer waits; who dithers between both does not.
const WAITS: Duration = Duration::from_secs(1);

/// Where the robot last got anywhere.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Serialize)]
pub(super) struct Progress {
    free: Option<Free>,
    moved_at: Timestamp,
    backs_off_since: Option<Timestamp>,
}

/// A pose of the field frame that was not yet left.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
struct Free {
    pose: Isometry2<f32>,
    since: Timestamp,
}

impl Progress {
    /// Where the robot is, and whether it wants to get anywhere.
    pub(super) fn notice(
        &mut self,
        ground_to_field: Option<&Isometry2<f32>>,
        moves: bool,
        recovery: &RecoveryParameters,
        now: Timestamp,
    ) {
        if moves {
            self.moved_at = now;
        }
        let is_long_ago = |since: Timestamp, seconds: f32| (now - since).as_secs_f32() >= seconds;
        let has_backed_off = self
            .backs_off_since
            .is_some_and(|since| is_long_ago(since, recovery.duration));
        let waits = now - self.moved_at > WAITS;
        let Some(&pose) = ground_to_field.filter(|_| !waits && !has_backed_off) else {
            self.free = None;
            self.backs_off_since = None;
            return;
        };
        match self.free {
            Some(free) if !free.has_been_left(&pose, recovery) => {
                if self.backs_off_since.is_none() && is_long_ago(free.since, recovery.after) {
                    self.backs_off_since = Some(now);
                }
            }
            _ => self.free = Some(Free { pose, since: now }),
        }
    }

    /// Whether it has to go elsewhere before anything else.
    pub(super) fn backs_off(&self) -> bool {
        self.backs_off_since.is_some()
    }
}

impl Free {
    fn has_been_left(&self, pose: &Isometry2<f32>, recovery: &RecoveryParameters) -> bool {
        let way = pose.translation.vector - self.pose.translation.vector;
        let turned = wrapped(pose.rotation.angle() - self.pose.rotation.angle());
        way.norm() > recovery.distance || turned.abs() > recovery.turned
    }
}

/// Away from what is near, else back.
pub(super) fn step_away(
    obstacles: &[Obstacle],
    recovery: &RecoveryParameters,
    walk: &WalkParameters,
) -> Step {
    let away = obstacles
        .first()
        .map(|obstacle| -obstacle.position.coords)
        .filter(|away| away.norm() < recovery.near)
        .and_then(|away| away.try_normalize(f32::EPSILON))
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

    /// For how many of 20 s it backs off, at that speed (m/s), turning (rad/s), with legs that move so often.
    fn backs_off(speed: f32, turn: f32, moves: impl Fn(u64) -> bool, knows: bool) -> f32 {
        let recovery = parameters().recovery;
        let mut progress = Progress::default();
        let mut cycles = 0.0;
        for cycle in 0..2000 {
            let seconds = 0.01 * cycle as f32;
            let pose = Isometry2::new(Vector2::new(speed * seconds, 0.0), turn * seconds);
            let now = at_millis(10_000 + 10 * cycle);
            progress.notice(Some(&pose).filter(|_| knows), moves(cycle), &recovery, now);
            cycles += f32::from(u8::from(progress.backs_off()));
        }
        0.01 * cycles
    }

    #[test]
    fn who_walks_and_gets_nowhere_backs_off_for_a_while() {
        let recovery = parameters().recovery;
        let stuck = backs_off(0.0, 0.0, |_| true, true);
        let rounds = 20.0 / (recovery.after + recovery.duration);
        assert!(
            stuck > 0.9 * recovery.duration * rounds.floor(),
            "{stuck} s"
        );
        assert!(stuck < 1.1 * recovery.duration * rounds.ceil(), "{stuck} s");
        // Who dithers between two decisions is no better off.
        assert_eq!(backs_off(0.0, 0.0, |cycle| cycle % 50 < 5, true), stuck);
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
