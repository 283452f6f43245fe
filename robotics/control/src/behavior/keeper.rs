//! Owns what the goalkeeper does, and what the striker leaves to it.

use nalgebra::Point2;
use types::ball::Ball;
use types::behavior::{Activity, Role};
use types::motion::{BodyMotion, Script, Step};

use super::attack::attack;
use super::decision::{Decision, View};
use super::play::hold;
use super::walk_to::within;

/// The goalkeeper: into the way of a ball that comes, at one that lies near the goal, else between the two.
pub(super) fn guard(view: &View<'_>, ball: &Ball) -> Decision {
    if let Some(block) = block(view, ball) {
        return block;
    }
    let keeper = &view.parameters.keeper;
    // Farther off it goes on where it has begun to.
    let has_begun = view.memory.activity.plays_ball();
    let patience = if has_begun { keeper.patience } else { 1.0 };
    match is_near_goal(view, patience * keeper.clears) {
        true => attack(view, ball.position),
        false => hold(view, Role::Keeper),
    }
}

/// Whether the ball lies nearer to the middle of the own goal than so many m.
fn is_near_goal(view: &View<'_>, reach: f32) -> bool {
    let goal = view.parameters.places.own_goal();
    view.ball_on_field()
        .is_some_and(|ball| (ball - goal).norm() < reach)
}

/// Whether a keeper plays the ball: one that stands there, and that said that it knows the ball.
///
/// Only where it does so whatever it did before, and also where it believes the ball to be a little farther off: a ball that
/// both play is better than one that each leaves to the other.
pub(super) fn leaves_it_to_keeper(view: &View<'_>) -> bool {
    let (places, keeper) = (&view.parameters.places, &view.parameters.keeper);
    let mut teammates = view.world.teammates.iter();
    is_near_goal(view, keeper.clears / keeper.patience)
        && teammates.any(|teammate| {
            let message = &teammate.message;
            let is_at_goal = message.ground_to_field.is_some_and(|pose| {
                let place = Point2::from(pose.translation.vector);
                (place - places.own_goal()).norm() < keeper.patience * keeper.clears
            });
            let can_play = !message.is_fallen && message.ball.is_some();
            message.player_number == view.world.goalkeeper && is_at_goal && can_play
        })
}

/// Out of the way of a keeper that plays the ball away: where the others' striker is met.
pub(super) fn beside_keeper(view: &View<'_>) -> Decision {
    let (places, keeper) = (&view.parameters.places, &view.parameters.keeper);
    let ball = view.ball_on_field().unwrap_or_else(Point2::origin);
    let pose = places.beside_clearing(ball, keeper);
    let activity = Activity::KeepDistance;
    view.go_to_facing_ball(&pose, activity, activity)
}

/// On the goal line until the ball is played, only sideways: a ball that comes has been blocked before.
pub(super) fn stay_on_line(view: &View<'_>) -> Decision {
    Decision::of_body(Activity::GuardGoal, BodyMotion::Stand, view.head())
}

/// What stops a ball that comes fast: a catch, or the step into its way; `None` where none comes, or it hits the robot anyway.
pub(super) fn block(view: &View<'_>, ball: &Ball) -> Option<Decision> {
    let keeper = &view.parameters.keeper;
    let (place, velocity) = (ball.position, ball.velocity);
    if velocity.x > -keeper.fast || place.x <= 0.0 {
        return None;
    }
    let time = place.x / -velocity.x;
    let aside = place.y + time * velocity.y;
    let arrives = velocity.x < -keeper.catch_fast && keeper.catch_after < time;
    if arrives && aside.abs() < keeper.catch_aside {
        let catch = BodyMotion::Scripted(Script::Catch);
        if time < keeper.catch_before {
            return Some(Decision::of_body(Activity::Catch, catch, view.head()));
        }
        // Whoever is in the midst of a step when the time has come is too late.
        if time < keeper.catch_before + keeper.halt {
            return Some(Decision::of_body(
                Activity::Block,
                BodyMotion::Stand,
                view.head(),
            ));
        }
    }
    let is_needed = time <= keeper.soon && aside.abs() > keeper.covered;
    let step = Step {
        left: within(aside, view.parameters.walk.left),
        ..Step::ZERO
    };
    is_needed.then(|| Decision::walk(Activity::Block, step, view.head()))
}

#[cfg(test)]
mod tests {
    use nalgebra::{Isometry2, Vector2};
    use types::team::{TeamBall, TeamMessage, Teammate};

    use super::*;
    use crate::behavior::play::play;
    use crate::behavior::tests::Scene;

    #[test]
    fn the_keeper_steps_into_the_way_of_a_ball_that_comes() {
        for (aside, speed, left) in [
            (0.4, 1.5, Some(true)),
            (-0.4, 1.5, Some(false)),
            (0.02, 1.5, None),
            (0.4, 0.05, None),
        ] {
            let mut scene = Scene::at(-4.2, 0.0, 0.0).with_ball(2.5, aside);
            scene.world.role = Some(Role::Keeper);
            scene.roll(Vector2::new(-speed, 0.0));
            let decided = scene.view(play);
            let blocks = decided.activity == Activity::Block;
            assert_eq!(
                blocks.then_some(decided.command.step.left > 0.0),
                left,
                "{aside}"
            );
        }
    }

    #[test]
    fn the_keeper_catches_what_comes_near_its_feet_and_soon_and_stands_before() {
        for (distance, aside, walks, activity) in [
            (0.9, 0.15, false, Activity::Catch),
            (0.9, 0.0, false, Activity::Catch),
            (0.9, 0.15, true, Activity::Catch),
            (0.9, 0.3, false, Activity::Block),
            (1.8, 0.15, true, Activity::Block),
            (1.8, 0.3, true, Activity::Block),
            (3.0, 0.15, false, Activity::Block),
            (0.4, 0.15, false, Activity::Block),
        ] {
            let mut scene = Scene::at(-4.2, 0.0, 0.0).with_ball(distance, aside);
            scene.world.role = Some(Role::Keeper);
            scene.roll(Vector2::new(-1.5, 0.0));
            scene.walks(walks);
            let decided = scene.view(play);
            assert_eq!(decided.activity, activity, "{distance} {aside} {walks}");
            let stands = decided.command.body == BodyMotion::Stand;
            assert_eq!(
                stands,
                distance == 1.8 && aside == 0.15,
                "{distance} {aside}"
            );
        }
    }

    #[test]
    fn a_keeper_that_plays_a_ball_is_not_stopped_by_one_that_hardly_rolls() {
        let mut scene = Scene::at(-4.2, 0.0, 0.0).with_ball(0.3, 0.05);
        scene.world.role = Some(Role::Keeper);
        for (speed, activity) in [(0.4, Activity::Dribble), (0.8, Activity::Catch)] {
            scene.roll(Vector2::new(-speed, 0.0));
            assert_eq!(scene.view(play).activity, activity, "{speed}");
        }
    }

    #[test]
    fn the_keeper_plays_away_what_lies_before_its_goal() {
        let mut scene = Scene::at(-4.2, 0.0, 0.0).with_ball(0.6, 0.1);
        scene.world.role = Some(Role::Keeper);
        assert_eq!(scene.view(play).activity, Activity::WalkBehindBall);
    }

    #[test]
    fn the_keeper_goes_on_a_little_further_and_the_striker_leaves_it_what_is_surely_the_keepers() {
        use Activity::{GuardGoal, KeepDistance, WalkBehindBall};
        for (role, from_goal, before, activity) in [
            (Role::Keeper, 1.1, GuardGoal, WalkBehindBall),
            (Role::Keeper, 1.3, GuardGoal, GuardGoal),
            (Role::Keeper, 1.3, Activity::Dribble, WalkBehindBall),
            (Role::Keeper, 1.6, Activity::Dribble, GuardGoal),
            (Role::Striker, 0.9, WalkBehindBall, KeepDistance),
            (Role::Striker, 1.1, WalkBehindBall, WalkBehindBall),
            (Role::Striker, 1.1, KeepDistance, WalkBehindBall),
        ] {
            let decided = near_goal(&mut with_keeper(role), from_goal, before);
            assert_eq!(decided, activity, "{role:?} {from_goal} after {before:?}");
        }
    }

    #[test]
    fn no_ball_is_left_by_keeper_and_striker_to_each_other() {
        use Activity::{BackOff, Block, Catch, Dribble, GuardGoal, KeepDistance, WalkBehindBall};
        let (mut keeper, mut striker) = (with_keeper(Role::Keeper), with_keeper(Role::Striker));
        // They believe it up to 0.2 m apart, and have done anything before.
        let did = [GuardGoal, Block, Catch, BackOff, Dribble]
            .into_iter()
            .flat_map(|keeper| [WalkBehindBall, KeepDistance].map(|striker| (keeper, striker)));
        for (keeper_did, striker_did) in did {
            for centimetres in 50..=200 {
                let from_goal = 0.01 * centimetres as f32;
                let striker_does = near_goal(&mut striker, from_goal, striker_did);
                for apart in [0.0, 0.2] {
                    let keeper_does = near_goal(&mut keeper, from_goal + apart, keeper_did);
                    assert!(
                        keeper_does.plays_ball() || striker_does.plays_ball(),
                        "{from_goal} m: {keeper_does:?} after {keeper_did:?}, {striker_does:?} after {striker_did:?}"
                    );
                }
            }
        }
    }

    /// With a mate in the goal.
    fn with_keeper(role: Role) -> Scene {
        let mut scene = Scene::at(-2.5, 0.0, 0.0);
        scene.world.role = Some(role);
        scene.world.teammates = vec![keeper(true)];
        scene
    }

    /// What is done about a ball that lies so far before the goal, m.
    fn near_goal(scene: &mut Scene, from_goal: f32, before: Activity) -> Activity {
        scene.world.ball = Some(Ball {
            position: Point2::new(from_goal - 2.0, 0.0),
            ..Ball::default()
        });
        scene.did(before);
        scene.view(play).activity
    }

    #[test]
    fn a_striker_plays_the_ball_where_the_keeper_lies_or_does_not_know_it() {
        let mut lies = keeper(true);
        lies.message.is_fallen = true;
        let mut elsewhere = keeper(true);
        elsewhere.message.ground_to_field = Some(Isometry2::translation(0.0, 0.0));
        let mut another = keeper(true);
        another.message.player_number = 2;
        for teammate in [lies, elsewhere, another, keeper(false)] {
            let mut scene = Scene::at(-2.5, 0.0, 0.0).with_ball(-0.9, 0.0);
            scene.world.teammates = vec![teammate];
            let decided = scene.view(play).activity;
            assert_eq!(decided, Activity::WalkBehindBall, "{teammate:?}");
        }
    }

    /// In its goal.
    fn keeper(knows_ball: bool) -> Teammate {
        Teammate {
            message: TeamMessage {
                player_number: 1,
                ground_to_field: Some(Isometry2::translation(-4.2, 0.0)),
                ball: knows_ball.then(TeamBall::default),
                ..TeamMessage::default()
            },
            ..Teammate::default()
        }
    }
}
