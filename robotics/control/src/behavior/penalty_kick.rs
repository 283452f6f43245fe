//! Owns what is different where a robot alone with the keeper shoots at the goal.

use framework::math;
use nalgebra::Point2;
use types::behavior::{Activity, Role};
use types::game::{GamePhase, KickingTeam, SetPlay};
use types::motion::BodyMotion;

use super::decision::{Decision, View};
use super::places::wrapped;

/// RoboCup SPL rules 2025, penalty shoot-out: who shoots may not play the ball again once it has clearly moved.
///
/// `None` where the robot may play.
pub(super) fn watch_shot(view: &View<'_>) -> Option<Decision> {
    let world = view.world;
    let is_own_shot = world.game_phase == GamePhase::PenaltyShootout
        && world.kicking_team == KickingTeam::Own
        && view.role() == Role::Striker;
    let places = &view.parameters.places;
    let ball = view.ball_on_field().filter(|_| is_own_shot)?;
    let mark = Point2::new(places.goal_line - places.penalty_mark, 0.0);
    let is_shot = nalgebra::distance(&ball, &mark) > places.shot;
    is_shot.then(|| Decision::of_body(Activity::WatchShot, BodyMotion::Stand, view.head()))
}

/// The direction past the keeper from a ball there (field frame, m and rad), where the own team has a penalty kick and
/// somebody is seen in the goal.
///
/// Past the side on which there is more room; who has turned to one by `easy`, the direction that suits it, stays with it.
pub(super) fn past_keeper(view: &View<'_>, ball: Point2<f32>, easy: f32) -> Option<f32> {
    let world = view.world;
    let is_own = world.set_play == SetPlay::PenaltyKick && world.kicking_team == KickingTeam::Own;
    let (places, attack) = (&view.parameters.places, &view.parameters.attack);
    let ground_to_field = world.ground_to_field.filter(|_| is_own)?;
    let near = places.goal_line - places.penalty_mark / 2.0;
    let mut obstacles = world.obstacles.iter();
    let keeper = obstacles.find_map(|obstacle| {
        let place = ground_to_field * obstacle.position;
        (place.x > near && place.y.abs() < places.post).then_some(place)
    })?;
    let to_keeper = math::atan2(keeper.y - ball.y, keeper.x - ball.x);
    let turned = wrapped(easy - to_keeper);
    let side = match turned.abs() > attack.corner_chosen {
        true => turned,
        false => -keeper.y,
    };
    let corner = attack.corner.copysign(side);
    Some(math::atan2(corner - ball.y, places.goal_line - ball.x))
}

#[cfg(test)]
mod tests {
    use nalgebra::{Isometry2, Vector2};
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

    fn with_keeper(mut scene: Scene, x: f32, y: f32) -> Scene {
        let to_ground = scene.world.ground_to_field.unwrap().inverse();
        scene.world.obstacles = vec![Obstacle {
            position: to_ground * Point2::new(x, y),
            radius: 0.2,
            ..Obstacle::default()
        }];
        scene
    }

    fn aim(scene: &Scene) -> f32 {
        scene.view(play).plan.aim.unwrap()
    }

    #[test]
    fn a_shot_goes_past_the_keeper_on_the_side_with_more_room() {
        let corner = math::atan2(0.4_f32, 1.3);
        for (y, expected) in [(0.1, -corner), (-0.1, corner), (0.3, -corner)] {
            let found = aim(&with_keeper(shooting(), 4.5, y));
            assert!((found - expected).abs() < 1e-4, "{y}: {found}");
        }
    }

    #[test]
    fn who_has_turned_to_one_side_stays_with_it_though_the_keeper_moves_a_little() {
        for heading in [0.3_f32, -0.3] {
            let behind = Isometry2::new(Vector2::new(2.87, 0.0), heading);
            for y in [0.05, -0.05] {
                let on_field = aim(&with_keeper(shooting_from(behind), 4.5, y)) + heading;
                assert_eq!(
                    on_field.signum(),
                    heading.signum(),
                    "{heading} {y}: {on_field}"
                );
            }
        }
    }

    fn shooting_from(pose: Isometry2<f32>) -> Scene {
        let mut scene = shooting();
        scene.world.ground_to_field = Some(pose);
        let ball = pose.inverse() * Point2::new(3.2, 0.0);
        scene.with_ball(ball.x, ball.y)
    }

    #[test]
    fn with_nobody_in_the_goal_or_in_the_game_it_goes_straight_on() {
        let beside = with_keeper(shooting(), 4.5, 0.9);
        let before = with_keeper(shooting(), 3.0, 0.6);
        let mut in_the_game = with_keeper(shooting(), 4.5, 0.1);
        in_the_game.world.set_play = SetPlay::None;
        in_the_game.world.game_phase = GamePhase::Normal;
        for scene in [shooting(), beside, before, in_the_game] {
            assert!(aim(&scene).abs() < 1e-4);
        }
    }

    #[test]
    fn a_ball_that_was_shot_is_not_played_again_but_in_the_game_it_is() {
        for (x, activity) in [(3.25, None), (3.9, Some(Activity::WatchShot))] {
            let mut scene = shooting().with_ball(x - 2.85, 0.1);
            assert_eq!(
                scene.view(play).activity == Activity::WatchShot,
                activity.is_some()
            );
            scene.world.game_phase = GamePhase::Normal;
            assert!(scene.view(play).activity.plays_ball(), "{x}");
        }
        let mut theirs = shooting().with_ball(-5.0, 0.1);
        theirs.world.kicking_team = KickingTeam::Opponent;
        theirs.world.role = Some(Role::Keeper);
        assert_ne!(theirs.view(play).activity, Activity::WatchShot);
    }
}
