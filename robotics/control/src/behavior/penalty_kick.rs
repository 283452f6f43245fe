//! Owns what is different where a robot alone with the keeper shoots at the goal.

use framework::{Timestamp, math};
use nalgebra::Point2;
use serde::{Deserialize, Serialize};
use types::behavior::{Activity, Role};
use types::game::{GamePhase, KickingTeam, PrimaryState, SetPlay};
use types::motion::BodyMotion;
use types::world_state::WorldState;

use super::decision::{Decision, View};
use super::parameters::{AttackParameters, BehaviorParameters};

/// What has become of the own team's penalty kick.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Serialize)]
pub(super) struct PenaltyKick {
    /// Whether it goes to the left of the keeper; `None` before one was seen.
    goes_left: Option<bool>,
    /// Where the ball lay when this robot began to play it, in the field frame, m.
    played_from: Option<Point2<f32>>,
    /// Since when it has lain elsewhere.
    moved_since: Option<Timestamp>,
    /// Since when the robot has kicked, without a break.
    kicks_since: Option<Timestamp>,
    has_kicked: bool,
    /// Whether this was the shot of a shoot-out, after which it may not play the ball again.
    pub(super) is_shot: bool,
}

impl PenaltyKick {
    /// Before anything is decided; `before` is what the robot did last.
    pub(super) fn notice(
        &mut self,
        world: &WorldState,
        before: Activity,
        parameters: &BehaviorParameters,
        now: Timestamp,
    ) {
        if world.primary_state != PrimaryState::Playing {
            *self = Self::default();
            return;
        }
        if world.set_play != SetPlay::PenaltyKick || world.kicking_team != KickingTeam::Own {
            return;
        }
        if world.game_phase == GamePhase::PenaltyShootout {
            self.is_shot |= self.is_gone(world, before, &parameters.attack, now);
        }
        if let Some(keeper) = keeper(world, parameters) {
            let goes_left = self.goes_left.unwrap_or(keeper.y < 0.0);
            let on_that_side = if goes_left { keeper.y } else { -keeper.y };
            let is_taken = on_that_side > parameters.attack.corner_taken;
            self.goes_left = Some(goes_left != is_taken);
        }
    }

    /// Whether the ball that this robot plays has moved, or nobody sees it where it has kicked: behind the keeper or
    /// beside the goal.
    fn is_gone(
        &mut self,
        world: &WorldState,
        before: Activity,
        attack: &AttackParameters,
        now: Timestamp,
    ) -> bool {
        let lasts = |since: &mut Option<Timestamp>, is_so: bool, long: f32| {
            *since = is_so.then(|| since.unwrap_or(now));
            since.is_some_and(|since| (now - since).as_secs_f32() >= long)
        };
        let is_kicking = before == Activity::Kick;
        self.has_kicked |= lasts(&mut self.kicks_since, is_kicking, attack.kick_duration);
        let Some(ball) = world.ball else {
            return self.has_kicked;
        };
        let Some(ground_to_field) = world.ground_to_field else {
            return false;
        };
        let place = ground_to_field * ball.position;
        if is_kicking || matches!(before, Activity::Align | Activity::Dribble) {
            self.played_from.get_or_insert(place);
        }
        let has_moved = self
            .played_from
            .is_some_and(|from| nalgebra::distance(&from, &place) > attack.shot);
        lasts(&mut self.moved_since, has_moved, attack.shot_for)
    }
}

/// Who stands in the opponents' goal, nearest to its middle, in the field frame, m.
fn keeper(world: &WorldState, parameters: &BehaviorParameters) -> Option<Point2<f32>> {
    let BehaviorParameters { places, attack, .. } = parameters;
    let near = places.goal_line - places.penalty_mark / 2.0;
    let reach = near..=places.goal_line + attack.keeper_behind_line;
    let ground_to_field = world.ground_to_field?;
    let obstacles = world.obstacles.iter();
    let in_goal = obstacles
        .map(|obstacle| ground_to_field * obstacle.position)
        .filter(|place| {
            reach.contains(&place.x) && place.y.abs() < places.post - attack.post_margin
        });
    in_goal.min_by(|one, other| one.y.abs().total_cmp(&other.y.abs()))
}

/// RoboCup SPL rules 2025, penalty shoot-out: who shoots may not play the ball again once it has clearly moved.
///
/// `None` where the robot may play.
pub(super) fn watch_shot(view: &View<'_>) -> Option<Decision> {
    let has_shot = view.memory.penalty_kick.is_shot && view.role() == Role::Striker;
    has_shot.then(|| Decision::of_body(Activity::WatchShot, BodyMotion::Stand, view.head()))
}

/// The direction past the keeper from a ball there (field frame, m and rad), where the own team has a penalty kick and
/// somebody was seen in the goal.
pub(super) fn past_keeper(view: &View<'_>, ball: Point2<f32>) -> Option<f32> {
    let (places, attack) = (&view.parameters.places, &view.parameters.attack);
    let is_penalty_kick = view.world.set_play == SetPlay::PenaltyKick;
    let goes_left = view
        .memory
        .penalty_kick
        .goes_left
        .filter(|_| is_penalty_kick)?;
    let corner = if goes_left {
        attack.corner
    } else {
        -attack.corner
    };
    Some(math::atan2(corner - ball.y, places.goal_line - ball.x))
}

#[cfg(test)]
mod tests {
    use types::ball::Ball;
    use types::obstacles::Obstacle;

    use super::*;
    use crate::behavior::play::play;
    use crate::behavior::tests::Scene;

    /// On the edge of the penalty area, the ball on its mark.
    fn shooting() -> Scene {
        let mut scene = Scene::at(2.85, 0.0, 0.0).with_ball(0.35, 0.0);
        scene.world.set_play = SetPlay::PenaltyKick;
        scene.world.game_phase = GamePhase::PenaltyShootout;
        scene.world.kicking_team = KickingTeam::Own;
        scene.world.role = Some(Role::Striker);
        scene
    }

    fn put_keeper(scene: &mut Scene, x: f32, y: f32) {
        let to_ground = scene.world.ground_to_field.unwrap().inverse();
        scene.world.obstacles = vec![Obstacle {
            position: to_ground * Point2::new(x, y),
            radius: 0.2,
            ..Obstacle::default()
        }];
    }

    /// After so long, s, in which the robot did this, with the ball there on the field.
    fn after(seconds: f32, scene: &mut Scene, did: Activity, ball: Option<[f32; 2]>) -> Activity {
        let to_ground = scene.world.ground_to_field.map(|pose| pose.inverse());
        scene.world.ball = ball.zip(to_ground).map(|(ball, to_ground)| Ball {
            position: to_ground * Point2::from(ball),
            ..Ball::default()
        });
        scene.did(did);
        scene.notice();
        scene.pass(seconds);
        scene.notice();
        scene.view(play).activity
    }

    fn aim(scene: &mut Scene) -> f32 {
        scene.notice();
        scene.view(play).plan.aim.unwrap()
    }

    #[test]
    fn a_shot_goes_past_the_keeper_on_the_side_with_more_room() {
        let corner = math::atan2(0.4_f32, 1.3);
        for (y, expected) in [(0.05, -corner), (-0.05, corner), (0.3, -corner)] {
            let mut scene = shooting();
            put_keeper(&mut scene, 4.5, y);
            let found = aim(&mut scene);
            assert!((found - expected).abs() < 1e-4, "{y}: {found}");
        }
    }

    #[test]
    fn a_side_that_was_chosen_is_kept_until_the_keeper_stands_there() {
        let mut scene = shooting();
        for (y, goes_left) in [
            (-0.02, true),
            (0.05, true),
            (-0.3, true),
            (0.09, true),
            (0.2, false),
            (-0.05, false),
            (-0.2, true),
        ] {
            put_keeper(&mut scene, 4.5, y);
            assert_eq!(aim(&mut scene) > 0.0, goes_left, "{y}");
        }
        scene.world.obstacles.clear();
        assert!(aim(&mut scene) > 0.0, "a keeper that is not seen for once");
    }

    #[test]
    fn with_nobody_in_the_goal_or_in_the_game_it_goes_straight_on() {
        for (x, y) in [(4.5, 0.7), (4.5, -0.9), (3.0, 0.3), (5.0, 0.0)] {
            let mut scene = shooting();
            put_keeper(&mut scene, x, y);
            assert!(aim(&mut scene).abs() < 1e-4, "{x} {y}");
        }
        let mut in_the_game = shooting();
        in_the_game.world.set_play = SetPlay::None;
        put_keeper(&mut in_the_game, 4.5, 0.1);
        assert!(aim(&mut in_the_game).abs() < 1e-4);
    }

    #[test]
    fn a_ball_that_was_shot_is_not_played_again_wherever_it_lies() {
        let (mark, away) = (Some([3.2, 0.0]), Some([3.9, 0.2]));
        let mut scene = shooting();
        assert!(after(1.0, &mut scene, Activity::WaitForWhistle, mark).plays_ball());
        assert!(after(1.0, &mut scene, Activity::Align, Some([3.3, 0.1])).plays_ball());
        assert!(
            after(0.1, &mut scene, Activity::Align, away).plays_ball(),
            "for once"
        );
        assert!(
            after(1.0, &mut scene, Activity::Kick, Some([3.25, 0.0])).plays_ball(),
            "missed"
        );
        for ball in [away, mark, None] {
            let activity = after(0.5, &mut scene, Activity::WalkBehindBall, ball);
            assert_eq!(activity, Activity::WatchShot, "{ball:?}");
        }
        scene.world.ground_to_field = None;
        let lost = after(0.1, &mut scene, Activity::WatchShot, None);
        assert_eq!(lost, Activity::WatchShot);
        // The referee's computer is not heard for a while.
        scene.world.game_phase = GamePhase::Normal;
        scene.world.set_play = SetPlay::None;
        let silent = after(0.1, &mut scene, Activity::WatchShot, None);
        assert_eq!(silent, Activity::WatchShot);
        scene.world.primary_state = PrimaryState::Set;
        scene.notice();
        std::mem::swap(&mut scene.world, &mut shooting().world);
        assert!(after(1.0, &mut scene, Activity::WaitForWhistle, mark).plays_ball());
    }

    #[test]
    fn a_ball_that_nobody_sees_after_a_whole_kick_was_shot() {
        for (did, seconds, activity) in [
            (Activity::Kick, 1.5, Activity::WatchShot),
            (Activity::Kick, 0.1, Activity::SearchWithHead),
            (Activity::Align, 1.5, Activity::SearchWithHead),
        ] {
            let mut scene = shooting();
            after(seconds, &mut scene, did, Some([3.2, 0.0]));
            scene.lost_for(1.0);
            let found = after(0.0, &mut scene, Activity::SearchWithHead, None);
            assert_eq!(found, activity, "{did:?} {seconds}");
        }
    }

    #[test]
    fn who_has_not_played_the_ball_and_who_plays_in_the_game_watches_no_shot() {
        let elsewhere = Some([3.9, 0.2]);
        for did in [Activity::WaitForWhistle, Activity::WalkBehindBall] {
            let mut wrong = shooting();
            for _ in 0..3 {
                assert!(after(1.0, &mut wrong, did, elsewhere).plays_ball());
            }
        }
        for (phase, team, role) in [
            (GamePhase::Normal, KickingTeam::Own, Role::Striker),
            (
                GamePhase::PenaltyShootout,
                KickingTeam::Opponent,
                Role::Keeper,
            ),
        ] {
            let mut scene = shooting();
            scene.world.game_phase = phase;
            scene.world.kicking_team = team;
            scene.world.role = Some(role);
            after(1.5, &mut scene, Activity::Kick, Some([3.2, 0.0]));
            let found = after(1.5, &mut scene, Activity::Kick, elsewhere);
            assert_ne!(found, Activity::WatchShot, "{phase:?} {team:?}");
        }
    }
}
