//! Owns what a robot does in the game: what the referee lets it do with the ball, else what its role asks of it.

use framework::math;
use nalgebra::{Isometry2, Point2};
use types::ball::Ball;
use types::behavior::{Activity, Role};
use types::game::{KickingTeam, SetPlay};
use types::motion::{BodyMotion, HeadMotion, Step};

use super::attack::attack;
use super::decision::{Decision, View};
use super::walk_to::within;

/// In Ready: to the place of the role.
pub(super) fn get_ready(view: &View<'_>) -> Decision {
    let (places, keeper) = (&view.parameters.places, &view.parameters.keeper);
    let world = view.world;
    let pose = places.before_kick(world.role, world.kicking_team, world.set_play, keeper);
    view.go_to(&pose, Activity::WalkToPlace, Activity::WaitInReady)
}

/// In Playing.
pub(super) fn play(view: &View<'_>) -> Decision {
    if let Some(restricted) = restricted(view) {
        return restricted;
    }
    let Some(ball) = view.world.ball else {
        return without_ball(view);
    };
    match view.world.role {
        Role::Striker if leaves_it_to_keeper(view) => beside_keeper(view),
        Role::Striker => attack(view, ball.position),
        Role::Keeper => guard(view, &ball),
        role => hold(view, role),
    }
}

/// What the rules ask of this robot while one of the teams has the ball for itself; `None` where it may play.
///
/// A ball that only a team mate sees is as much the others'. Nobody keeps away from one that nobody sees.
fn restricted(view: &View<'_>) -> Option<Decision> {
    let world = view.world;
    let places = &view.parameters.places;
    let is_penalty_kick = world.set_play == SetPlay::PenaltyKick;
    let is_theirs = world.kicking_team == KickingTeam::Opponent && world.set_play != SetPlay::None;
    if is_theirs && world.role == Role::Keeper {
        let blocks = world.ball.and_then(|ball| block(view, &ball));
        if blocks.is_some() {
            return blocks;
        }
    }
    if world.ground_to_field.is_none() && is_theirs && world.ball.is_some() {
        let (stand, activity) = (BodyMotion::Stand, Activity::KeepDistance);
        return Some(Decision::of_body(activity, stand, view.head()));
    }
    let on_field = view.ball_on_field()?;
    let stay_away = |activity| {
        let of_role = places.of_role(world.role, on_field, &view.parameters.keeper);
        let pose = match activity {
            Activity::LeavePenaltyArea if world.kicking_team == KickingTeam::Own => {
                places.outside_other_penalty_area(&of_role)
            }
            Activity::LeavePenaltyArea => places.outside_own_penalty_area(&of_role),
            // Between ball and goal; pushed away it would stand where the striker does.
            _ if world.role == Role::Keeper => of_role,
            _ => places.at_a_distance(&of_role, on_field),
        };
        Some(view.go_to_facing_ball(&pose, activity, activity))
    };
    match (world.kicking_team, world.role) {
        (KickingTeam::Own, Role::Striker) => None,
        (KickingTeam::Opponent, Role::Keeper) if is_penalty_kick => Some(stay_on_line(view)),
        (KickingTeam::Own, Role::Keeper) => None,
        (KickingTeam::Own | KickingTeam::Opponent, _) if is_penalty_kick => {
            stay_away(Activity::LeavePenaltyArea)
        }
        (KickingTeam::Opponent, Role::Keeper) if world.set_play == SetPlay::None => None,
        (KickingTeam::Opponent, _) if world.set_play != SetPlay::None => {
            stay_away(Activity::KeepDistance)
        }
        (KickingTeam::Opponent, _) => {
            let is_kick_off = view
                .since_kick_off()
                .is_some_and(|since| since < places.kick_off_duration);
            let lies_there = on_field.coords.norm() < places.kicked_off;
            match is_kick_off && lies_there {
                true => stay_away(Activity::KeepDistance),
                false => None,
            }
        }
        (KickingTeam::Own | KickingTeam::Nobody, _) => None,
    }
}

/// With the head first, then with the body, then from somewhere else.
fn without_ball(view: &View<'_>) -> Decision {
    if let Some(ball) = view.world.team_ball {
        return towards(view, ball);
    }
    let search = &view.parameters.search;
    let (places, keeper) = (&view.parameters.places, &view.parameters.keeper);
    let lost_for = (view.now - view.memory.ball_known_at).as_secs_f32();
    let place = places.of_role(view.world.role, Point2::origin(), keeper);
    let round = search.with_head + search.turning + search.walking;
    let phase = if round > 0.0 { lost_for % round } else { 0.0 };
    if view.world.role == Role::Keeper {
        return view.go_to(&place, Activity::GuardGoal, Activity::GuardGoal);
    }
    if phase < search.with_head {
        return Decision::of_body(
            Activity::SearchWithHead,
            BodyMotion::Stand,
            HeadMotion::LookAround,
        );
    }
    if phase < search.with_head + search.turning {
        return view.search_by_turning();
    }
    view.go_to(&place, Activity::HoldPosition, Activity::SearchWithHead)
}

/// Turns to where a team mate sees the ball, or to the place from which the role plays it.
fn towards(view: &View<'_>, ball: Point2<f32>) -> Decision {
    match view.world.role {
        Role::Striker => {
            let away = ball.coords.cap_magnitude(view.parameters.attack.reach);
            let heading = math::atan2(ball.y, ball.x);
            let target = Isometry2::new(ball.coords - away, heading);
            let look = Activity::LookWhereTeamSees;
            view.walk_to(&target, None, look, Activity::SearchWithHead)
        }
        role => hold(view, role),
    }
}

/// At the place of the role, which goes with the ball.
fn hold(view: &View<'_>, role: Role) -> Decision {
    let ball = view.ball_on_field().unwrap_or_else(Point2::origin);
    let places = &view.parameters.places;
    let pose = places.of_role(role, ball, &view.parameters.keeper);
    match role {
        Role::Keeper => view.go_to_facing_ball(&pose, Activity::GuardGoal, Activity::GuardGoal),
        _ => view.go_to(&pose, Activity::HoldPosition, Activity::HoldPosition),
    }
}

/// The goalkeeper: into the way of a ball that comes, at one that lies near the goal, else between the two.
fn guard(view: &View<'_>, ball: &Ball) -> Decision {
    if let Some(block) = block(view, ball) {
        return block;
    }
    match is_near_goal(view, view.memory.activity.plays_ball()) {
        true => attack(view, ball.position),
        false => hold(view, Role::Keeper),
    }
}

/// Whether the ball lies so near to the goal that the keeper plays it away; farther off it goes on where it has begun to.
fn is_near_goal(view: &View<'_>, has_begun: bool) -> bool {
    let (places, keeper) = (&view.parameters.places, &view.parameters.keeper);
    let patience = if has_begun { keeper.patience } else { 1.0 };
    view.ball_on_field()
        .is_some_and(|ball| (ball - places.own_goal()).norm() < patience * keeper.clears)
}

/// Whether a keeper plays the ball: one that stands there, and that said that it knows the ball.
fn leaves_it_to_keeper(view: &View<'_>) -> bool {
    let (places, keeper) = (&view.parameters.places, &view.parameters.keeper);
    let stays_away = view.memory.activity == Activity::KeepDistance;
    let mut teammates = view.world.teammates.iter();
    is_near_goal(view, stays_away)
        && teammates.any(|teammate| {
            let message = &teammate.message;
            let is_at_goal = message.ground_to_field.is_some_and(|pose| {
                let place = Point2::from(pose.translation.vector);
                (place - places.own_goal()).norm() < keeper.patience * keeper.clears
            });
            let can_play = !message.is_fallen && message.ball.is_some();
            message.player_number == view.keeper && is_at_goal && can_play
        })
}

/// Out of the way of a keeper that plays the ball away: where the others' striker is met.
fn beside_keeper(view: &View<'_>) -> Decision {
    let (places, keeper) = (&view.parameters.places, &view.parameters.keeper);
    let ball = view.ball_on_field().unwrap_or_else(Point2::origin);
    let pose = places.beside_clearing(ball, keeper);
    let activity = Activity::KeepDistance;
    view.go_to_facing_ball(&pose, activity, activity)
}

/// On the goal line until the ball is played, only sideways: a ball that comes has been blocked before.
fn stay_on_line(view: &View<'_>) -> Decision {
    Decision::of_body(Activity::GuardGoal, BodyMotion::Stand, view.head())
}

/// The step into the way of a ball that comes fast; `None` where none does, or it hits the robot anyway.
fn block(view: &View<'_>, ball: &Ball) -> Option<Decision> {
    let keeper = &view.parameters.keeper;
    let (place, velocity) = (ball.position, ball.velocity);
    if velocity.x > -keeper.fast || place.x <= 0.0 {
        return None;
    }
    let time = place.x / -velocity.x;
    let aside = place.y + time * velocity.y;
    let is_needed = time <= keeper.soon && aside.abs() > keeper.covered;
    let step = Step {
        left: within(aside, view.parameters.walk.left),
        ..Step::ZERO
    };
    is_needed.then(|| Decision::walk(Activity::Block, step, view.head()))
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector2;
    use types::team::{TeamBall, TeamMessage, Teammate};

    use super::*;
    use crate::behavior::tests::Scene;

    #[test]
    fn what_each_role_does_with_a_ball_two_metres_ahead() {
        for (role, activity) in [
            (Role::Striker, Activity::WalkBehindBall),
            (Role::Keeper, Activity::GuardGoal),
            (Role::Supporter, Activity::HoldPosition),
            (Role::DefenderLeft, Activity::HoldPosition),
            (Role::DefenderRight, Activity::HoldPosition),
        ] {
            let mut scene = Scene::at(-1.0, 0.0, 0.0).with_ball(2.0, 0.0);
            scene.world.role = role;
            assert_eq!(scene.view(play).activity, activity, "{role:?}");
        }
    }

    #[test]
    fn what_the_referee_gives_to_one_team_the_other_stays_away_from() {
        use Activity::{GuardGoal, HoldPosition, KeepDistance, LeavePenaltyArea, WalkBehindBall};
        use KickingTeam::{Nobody, Opponent, Own};
        for (set_play, kicking_team, role, activity) in [
            (SetPlay::None, Nobody, Role::Striker, WalkBehindBall),
            (SetPlay::KickIn, Own, Role::Striker, WalkBehindBall),
            (SetPlay::KickIn, Own, Role::Supporter, HoldPosition),
            (SetPlay::KickIn, Opponent, Role::Striker, KeepDistance),
            (SetPlay::CornerKick, Opponent, Role::Supporter, KeepDistance),
            (SetPlay::GoalKick, Opponent, Role::Striker, KeepDistance),
            (
                SetPlay::PushingFreeKick,
                Opponent,
                Role::Striker,
                KeepDistance,
            ),
            (SetPlay::PenaltyKick, Own, Role::Striker, WalkBehindBall),
            (SetPlay::PenaltyKick, Own, Role::Supporter, LeavePenaltyArea),
            (
                SetPlay::PenaltyKick,
                Opponent,
                Role::DefenderLeft,
                LeavePenaltyArea,
            ),
            (SetPlay::PenaltyKick, Opponent, Role::Keeper, GuardGoal),
            // Long after the kick-off the ball is everybody's.
            (SetPlay::None, Opponent, Role::Striker, WalkBehindBall),
        ] {
            let mut scene = Scene::at(0.0, 0.0, 0.0).with_ball(0.6, 0.1);
            scene.world.set_play = set_play;
            scene.world.kicking_team = kicking_team;
            scene.world.role = role;
            let decided = scene.view(play);
            assert_eq!(
                decided.activity, activity,
                "{set_play:?} {kicking_team:?} {role:?}"
            );
            if activity == KeepDistance {
                let target = decided.plan.target.unwrap().translation.vector;
                assert!((target - Vector2::new(0.6, 0.1)).norm() > 0.75, "{target}");
            }
        }
    }

    #[test]
    fn who_does_not_see_a_ball_of_the_others_or_is_lost_does_not_play_it_either() {
        for (sees, is_lost) in [(false, false), (true, true)] {
            let mut scene = Scene::at(0.0, 0.0, 0.0).with_ball(0.6, 0.1);
            scene.world.set_play = SetPlay::KickIn;
            scene.world.kicking_team = KickingTeam::Opponent;
            if !sees {
                scene.world.team_ball = scene.world.ball.take().map(|ball| ball.position);
            }
            if is_lost {
                scene.without_pose_for(0.0);
            }
            let decided = scene.view(play);
            assert_eq!(decided.activity, Activity::KeepDistance, "{sees} {is_lost}");
        }
    }

    #[test]
    fn at_a_free_kick_of_the_others_the_keeper_keeps_its_own_place_and_blocks() {
        let mut scene = Scene::at(-4.0, 0.0, 0.0).with_ball(0.7, 0.3);
        scene.world.role = Role::Keeper;
        scene.world.set_play = SetPlay::PushingFreeKick;
        scene.world.kicking_team = KickingTeam::Opponent;
        let target = |scene: &Scene| {
            let target = scene.view(play).plan.target.unwrap().translation.vector;
            scene.world.ground_to_field.unwrap() * Point2::from(target)
        };
        let own = target(&scene);
        assert!((own - Point2::new(-4.5, 0.0)).norm() < 0.6, "{own}");
        scene.world.role = Role::Striker;
        assert!((target(&scene) - own).norm() > 0.3);
        scene.world.role = Role::Keeper;
        scene.roll(Vector2::new(-1.0, 0.2));
        assert_eq!(scene.view(play).activity, Activity::Block);
    }

    #[test]
    fn after_a_kick_off_of_the_others_the_ball_is_theirs_for_ten_seconds_or_until_it_moves() {
        for (since, ball_ahead, is_free) in [(1.0, 1.2, false), (11.0, 1.2, true), (1.0, 1.8, true)]
        {
            let mut scene = Scene::at(-1.2, 0.0, 0.0).with_ball(ball_ahead, 0.0);
            scene.world.kicking_team = KickingTeam::Opponent;
            scene.kicked_off(since);
            let is_away = scene.view(play).activity == Activity::KeepDistance;
            assert_eq!(is_away, !is_free, "{since} s, {ball_ahead} m");
        }
    }

    #[test]
    fn who_gives_the_others_room_or_guards_the_goal_goes_back_with_its_face_to_the_ball() {
        // The ball lies between the robot and the other goal; its place is behind it.
        for (role, x, ball) in [(Role::Striker, 0.0, 0.4), (Role::Keeper, -3.1, 2.0)] {
            let mut scene = Scene::at(x, 0.0, 0.0).with_ball(ball, 0.0);
            scene.world.role = role;
            scene.world.set_play = SetPlay::KickIn;
            scene.world.kicking_team = KickingTeam::Opponent;
            let step = scene.view(play).command.step;
            assert!(step.forward < 0.0 && step.turn.abs() < 0.1, "{step:?}");
            // Who does not see it turns round.
            scene.world.ball = None;
            scene.world.team_ball = Some(Point2::new(ball, 0.0));
            let step = scene.view(play).command.step;
            assert!(step.forward >= 0.0, "{step:?}");
        }
    }

    #[test]
    fn a_lost_ball_is_looked_for_with_the_head_then_with_the_body_then_elsewhere() {
        let mut scene = Scene::at(-2.0, 1.0, 0.0);
        let search = scene.parameters.search;
        for (lost_for, activity) in [
            (0.5 * search.with_head, Activity::SearchWithHead),
            (search.with_head + 1.0, Activity::SearchByTurning),
            (
                search.with_head + search.turning + 1.0,
                Activity::HoldPosition,
            ),
        ] {
            scene.lost_for(lost_for);
            assert_eq!(scene.view(play).activity, activity, "{lost_for} s");
        }
        scene.world.team_ball = Some(Point2::new(2.0, 1.0));
        assert_eq!(scene.view(play).activity, Activity::LookWhereTeamSees);
        scene.world.role = Role::Supporter;
        assert_eq!(scene.view(play).activity, Activity::HoldPosition);
    }

    #[test]
    fn the_keeper_steps_into_the_way_of_a_ball_that_comes() {
        for (aside, speed, left) in [
            (0.4, 1.5, Some(true)),
            (-0.4, 1.5, Some(false)),
            (0.02, 1.5, None),
            (0.4, 0.05, None),
        ] {
            let mut scene = Scene::at(-4.2, 0.0, 0.0).with_ball(2.0, aside);
            scene.world.role = Role::Keeper;
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
    fn the_keeper_plays_away_what_lies_before_its_goal() {
        let mut scene = Scene::at(-4.2, 0.0, 0.0).with_ball(0.6, 0.1);
        scene.world.role = Role::Keeper;
        assert_eq!(scene.view(play).activity, Activity::WalkBehindBall);
    }

    #[test]
    fn of_keeper_and_striker_one_plays_the_ball_and_goes_on_a_little_further() {
        use Activity::{GuardGoal, KeepDistance, WalkBehindBall};
        for (role, from_goal, before, activity) in [
            (Role::Keeper, 1.1, GuardGoal, WalkBehindBall),
            (Role::Keeper, 1.3, GuardGoal, GuardGoal),
            (Role::Keeper, 1.3, Activity::Dribble, WalkBehindBall),
            (Role::Keeper, 1.6, Activity::Dribble, GuardGoal),
            (Role::Striker, 1.1, WalkBehindBall, KeepDistance),
            (Role::Striker, 1.3, WalkBehindBall, WalkBehindBall),
            (Role::Striker, 1.3, KeepDistance, KeepDistance),
        ] {
            let mut scene = Scene::at(-2.5, 0.0, 0.0).with_ball(from_goal - 2.0, 0.0);
            scene.world.role = role;
            scene.world.teammates = vec![keeper(true)];
            scene.did(before);
            let decided = scene.view(play).activity;
            assert_eq!(decided, activity, "{role:?} {from_goal} after {before:?}");
        }
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

    #[test]
    fn in_ready_everybody_walks_to_a_place_and_waits_there() {
        let mut scene = Scene::at(-3.0, 3.0, -1.5);
        scene.world.kicking_team = KickingTeam::Own;
        assert_eq!(scene.view(get_ready).activity, Activity::WalkToPlace);
        let mut scene = Scene::at(-0.35, 0.0, 0.0);
        scene.world.kicking_team = KickingTeam::Own;
        assert_eq!(scene.view(get_ready).activity, Activity::WaitInReady);
        scene.world.ground_to_field = None;
        assert_eq!(scene.view(get_ready).activity, Activity::WaitInReady);
        scene.without_pose_for(scene.parameters.search.with_head + 1.0);
        assert_eq!(scene.view(get_ready).activity, Activity::SearchByTurning);
    }
}
