//! Owns what a robot does in the game: what the referee lets it do with the ball, else what its role asks of it.

use framework::math;
use nalgebra::{Isometry2, Point2};
use types::behavior::{Activity, Role};
use types::game::{KickingTeam, SetPlay};
use types::motion::{BodyMotion, HeadMotion};

use super::attack::attack;
use super::decision::{Decision, View};
use super::keeper::{beside_keeper, block, guard, leaves_it_to_keeper, stay_on_line};
use super::penalty_kick::watch_shot;

/// In Ready: to the place of the role.
pub(super) fn get_ready(view: &View<'_>) -> Decision {
    let (places, keeper) = (&view.parameters.places, &view.parameters.keeper);
    let world = view.world;
    let pose = places.before_kick(view.role(), world.kicking_team, world.set_play, keeper);
    view.go_to(&pose, Activity::WalkToPlace, Activity::WaitInReady)
}

/// In Playing.
pub(super) fn play(view: &View<'_>) -> Decision {
    if let Some(restricted) = restricted(view).or_else(|| watch_shot(view)) {
        return restricted;
    }
    let Some(ball) = view.world.ball else {
        return without_ball(view);
    };
    match view.role() {
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
    if is_theirs && view.role() == Role::Keeper {
        let blocks = world.ball.and_then(|ball| block(view, &ball));
        if blocks.is_some() || is_penalty_kick {
            return blocks.or_else(|| Some(stay_on_line(view)));
        }
    }
    let is_kick_off = world.set_play == SetPlay::None
        && view
            .since_kick_off()
            .is_some_and(|since| since < places.kick_off_duration);
    let is_their_kick_off =
        is_kick_off && world.kicking_team == KickingTeam::Opponent && view.role() != Role::Keeper;
    let is_lost = world.ground_to_field.is_none();
    if is_lost && (is_theirs || is_their_kick_off) && world.ball.is_some() {
        return Some(view.look_for_pose(Activity::KeepDistance));
    }
    let on_field = view.ball_on_field()?;
    let stay_away = |activity| {
        let of_role = places.of_role(view.role(), on_field, view.place(), &view.parameters.keeper);
        let pose = match activity {
            Activity::LeavePenaltyArea if world.kicking_team == KickingTeam::Own => {
                places.outside_other_penalty_area(&of_role)
            }
            Activity::LeavePenaltyArea => places.outside_own_penalty_area(&of_role),
            // Between ball and goal; pushed away it would stand where the striker does.
            _ if view.role() == Role::Keeper => of_role,
            _ => places.at_a_distance(&of_role, on_field),
        };
        Some(view.go_to_facing_ball(&pose, activity, activity))
    };
    match (world.kicking_team, view.role()) {
        (KickingTeam::Own, Role::Striker) => None,
        (KickingTeam::Own, Role::Keeper) => None,
        (KickingTeam::Own | KickingTeam::Opponent, _) if is_penalty_kick => {
            stay_away(Activity::LeavePenaltyArea)
        }
        (KickingTeam::Opponent, Role::Keeper) if world.set_play == SetPlay::None => None,
        (KickingTeam::Opponent, _) if world.set_play != SetPlay::None => {
            stay_away(Activity::KeepDistance)
        }
        (KickingTeam::Opponent, _) => {
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
    let search = &view.parameters.search;
    let seconds_since = |since| (view.now - since).as_secs_f32();
    let phase = |since, round| match round > 0.0 {
        true => seconds_since(since) % round,
        false => 0.0,
    };
    if let Some(ball) = view.world.team_ball {
        // Who finds nothing where a mate sees it turns, however long he goes on to say so.
        let round = search.with_head + search.turning;
        let since = view.memory.searches_since.unwrap_or(view.now);
        return match phase(since, round) < search.with_head {
            true => towards(view, ball),
            false => view.search_by_turning(),
        };
    }
    let (places, keeper) = (&view.parameters.places, &view.parameters.keeper);
    let is_keeper = view.role() == Role::Keeper;
    let place = places.of_role(view.role(), Point2::origin(), view.place(), keeper);
    let round = search.with_head + search.turning + search.walking;
    let phase = phase(view.memory.ball_known_at, round);
    let with_body = search.with_head..search.with_head + search.turning;
    if with_body.contains(&phase) {
        return view.search_by_turning();
    }
    if is_keeper {
        return view.go_to(&place, Activity::GuardGoal, Activity::GuardGoal);
    }
    if phase < search.with_head {
        return Decision::of_body(
            Activity::SearchWithHead,
            BodyMotion::Stand,
            HeadMotion::LookAround,
        );
    }
    view.go_to(&place, Activity::HoldPosition, Activity::SearchWithHead)
}

/// Turns to where a team mate sees the ball, or to the place from which the role plays it.
fn towards(view: &View<'_>, ball: Point2<f32>) -> Decision {
    match view.role() {
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
pub(super) fn hold(view: &View<'_>, role: Role) -> Decision {
    let ball = view.ball_on_field().unwrap_or_else(Point2::origin);
    let places = &view.parameters.places;
    let pose = places.of_role(role, ball, view.place(), &view.parameters.keeper);
    match role {
        Role::Keeper | Role::Sweeper => {
            view.go_to_facing_ball(&pose, Activity::GuardGoal, Activity::GuardGoal)
        }
        _ => view.go_to(&pose, Activity::HoldPosition, Activity::HoldPosition),
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector2;

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
            (Role::Sweeper, Activity::GuardGoal),
        ] {
            let mut scene = Scene::at(-1.0, 0.0, 0.0).with_ball(2.0, 0.0);
            scene.world.role = Some(role);
            assert_eq!(scene.view(play).activity, activity, "{role:?}");
        }
    }

    #[test]
    fn who_stands_in_for_the_keeper_goes_between_ball_and_goal_and_stays_before_the_ball() {
        for (ball, expected) in [
            ([0.0, 0.0], [-3.5, 0.0]),
            ([-4.5, 2.5], [-4.5, 1.0]),
            ([-3.5, 0.0], [-3.8, 0.0]),
        ] {
            let mut scene = Scene::at(-2.0, 1.0, 0.0).with_ball(ball[0] + 2.0, ball[1] - 1.0);
            scene.world.role = Some(Role::Sweeper);
            let target = scene.view(play).plan.target.unwrap().translation.vector;
            let place = scene.world.ground_to_field.unwrap() * Point2::from(target);
            assert!((place - Point2::from(expected)).norm() < 1e-3, "{place}");
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
            scene.world.role = Some(role);
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
    fn at_a_penalty_kick_of_the_others_the_keeper_stays_on_its_line_whatever_it_knows() {
        for (sees, is_lost) in [(true, false), (false, false), (true, true), (false, true)] {
            let mut scene = Scene::at(-4.5, 0.0, 0.0).with_ball(1.3, 0.0);
            scene.world.role = Some(Role::Keeper);
            scene.world.set_play = SetPlay::PenaltyKick;
            scene.world.kicking_team = KickingTeam::Opponent;
            scene.lost_for(8.0);
            if !sees {
                scene.world.ball = None;
            }
            if is_lost {
                scene.without_pose_for(8.0);
            }
            let decided = scene.view(play);
            assert_eq!(decided.activity, Activity::GuardGoal, "{sees} {is_lost}");
            assert_eq!(decided.command.body, BodyMotion::Stand, "{sees} {is_lost}");
        }
    }

    #[test]
    fn at_a_free_kick_of_the_others_the_keeper_keeps_its_own_place_and_blocks() {
        let mut scene = Scene::at(-4.0, 0.0, 0.0).with_ball(0.7, 0.3);
        scene.world.role = Some(Role::Keeper);
        scene.world.set_play = SetPlay::PushingFreeKick;
        scene.world.kicking_team = KickingTeam::Opponent;
        let target = |scene: &Scene| {
            let target = scene.view(play).plan.target.unwrap().translation.vector;
            scene.world.ground_to_field.unwrap() * Point2::from(target)
        };
        let own = target(&scene);
        assert!((own - Point2::new(-4.5, 0.0)).norm() < 0.6, "{own}");
        scene.world.role = Some(Role::Striker);
        assert!((target(&scene) - own).norm() > 0.3);
        scene.world.role = Some(Role::Keeper);
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
    fn who_is_lost_leaves_a_kick_off_to_the_others() {
        for (since, is_theirs) in [(1.0, true), (11.0, false)] {
            let mut scene = Scene::at(-1.2, 0.0, 0.0).with_ball(1.2, 0.0);
            scene.world.kicking_team = KickingTeam::Opponent;
            scene.without_pose_for(0.0);
            scene.kicked_off(since);
            let is_away = scene.view(play).activity == Activity::KeepDistance;
            assert_eq!(is_away, is_theirs, "{since} s");
        }
    }

    #[test]
    fn who_gives_the_others_room_does_not_walk_over_their_ball() {
        // The ball lies between the robot and its place.
        for (ahead, left) in [(-0.5, 0.05), (-0.6, -0.1), (-0.4, 0.0)] {
            for sees in [true, false] {
                let mut scene = Scene::at(1.0, 0.0, 0.0).with_ball(ahead, left);
                scene.world.set_play = SetPlay::KickIn;
                scene.world.kicking_team = KickingTeam::Opponent;
                if !sees {
                    scene.world.team_ball = scene.world.ball.take().map(|ball| ball.position);
                }
                let plan = scene.view(play).plan;
                let way_point = plan.way_point.expect("it walks").coords;
                let ball = Point2::new(ahead, left).coords;
                let along = (ball.dot(&way_point) / way_point.norm_squared()).clamp(0.0, 1.0);
                let nearest = (ball - way_point * along).norm();
                assert!(nearest > 0.25, "{nearest} m of ({ahead}, {left})");
            }
        }
    }

    #[test]
    fn who_gives_the_others_room_or_guards_the_goal_goes_back_with_its_face_to_the_ball() {
        // The ball lies between the robot and the other goal; its place is behind it.
        for (role, x, ball) in [(Role::Striker, 0.0, 0.4), (Role::Keeper, -3.1, 2.0)] {
            let mut scene = Scene::at(x, 0.0, 0.0).with_ball(ball, 0.0);
            scene.world.role = Some(role);
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
        scene.world.role = Some(Role::Supporter);
        assert_eq!(scene.view(play).activity, Activity::HoldPosition);
    }

    #[test]
    fn a_keeper_turns_for_a_lost_ball_and_a_striker_for_one_that_only_its_mate_sees() {
        let mut scene = Scene::at(-4.0, 0.0, 0.0);
        let search = scene.parameters.search;
        scene.world.role = Some(Role::Keeper);
        for (lost_for, activity) in [
            (0.5 * search.with_head, Activity::GuardGoal),
            (search.with_head + 1.0, Activity::SearchByTurning),
            (search.with_head + search.turning + 1.0, Activity::GuardGoal),
        ] {
            scene.lost_for(lost_for);
            assert_eq!(scene.view(play).activity, activity, "{lost_for} s");
        }
        scene.world.role = Some(Role::Striker);
        scene.world.team_ball = Some(Point2::new(0.2, 0.0));
        for (since, activity) in [
            (0.5 * search.with_head, Activity::SearchWithHead),
            (search.with_head + 1.0, Activity::SearchByTurning),
            (
                search.with_head + search.turning + 1.0,
                Activity::SearchWithHead,
            ),
        ] {
            scene.searches_for(since);
            assert_eq!(scene.view(play).activity, activity, "{since} s");
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
