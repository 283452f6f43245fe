//! Owns how a robot plays the ball into the opponents' goal: around it, behind it, then dribbling or kicking.
//!
//! All of it in the ground frame. The aim is the direction in which the ball shall go; seen along it the robot has to be
//! behind the ball, on the line, and face the same way.

use framework::math;
use nalgebra::{Isometry2, Point2, Vector2};
use types::behavior::Activity;
use types::motion::{BodyMotion, Script, Step};

use super::decision::{Decision, View};
use super::parameters::AttackParameters;
use super::penalty_kick::past_keeper;
use super::places::wrapped;
use super::walk_to::{straight, within};
use super::way::Circle;

/// Nearer to the ball than this share of its place behind it the robot would never be free of the ball.
const FREE_SHARE: f32 = 0.95;

/// Where the robot is, seen from the ball along the aim.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Stance {
    /// Behind the ball, m.
    behind: f32,
    /// To the left of the line, m.
    aside: f32,
    /// Of the aim from where the robot faces, rad.
    aim: f32,
}

/// How to play a ball (ground frame, m).
pub(super) fn attack(view: &View<'_>, ball: Point2<f32>) -> Decision {
    let attack = &view.parameters.attack;
    let Some(ground_to_field) = view.world.ground_to_field else {
        let away = ball.coords.cap_magnitude(attack.behind);
        let heading = math::atan2(ball.y, ball.x);
        let target = Isometry2::new(ball.coords - away, heading);
        let decision = view.walk_to(&target, None, Activity::WalkToBall, Activity::WalkToBall);
        return match decision.command.body {
            BodyMotion::Stand => view.look_for_pose(Activity::WalkToBall),
            _ => decision,
        };
    };
    let heading = ground_to_field.rotation.angle();
    let on_field = ground_to_field * ball;
    // From afar the ball goes on as the robot comes, at its feet as the robot faces.
    let easy = match ball.coords.norm() > attack.reach {
        true => heading + math::atan2(ball.y, ball.x),
        false => heading,
    };
    let easy = past_keeper(view, on_field).unwrap_or(easy);
    let places = &view.parameters.places;
    let aim = wrapped(places.aim(on_field, easy, attack) - heading);
    let stance = Stance::new(ball, aim);
    let may_kick = places.distance_to_goal(on_field) <= attack.kick_range;
    let mut decision = match choose(&stance, ball, may_kick, view.memory.activity, attack) {
        Activity::Kick => kick(view, ball),
        Activity::Align => align(view, ball, aim),
        Activity::Dribble => Decision::walk(Activity::Dribble, push(&stance, view), view.head()),
        activity => walk_behind(view, ball, aim, activity),
    };
    decision.plan.aim = Some(aim);
    decision
}

/// What to do with a ball, by where the robot is and what it was doing.
fn choose(
    stance: &Stance,
    ball: Point2<f32>,
    may_kick: bool,
    before: Activity,
    attack: &AttackParameters,
) -> Activity {
    let goes_on = matches!(before, Activity::Dribble | Activity::Align | Activity::Kick);
    let patience = if goes_on { attack.patience } else { 1.0 };
    let is_behind = stance.behind > 0.0
        && stance.behind <= patience * attack.reach
        && stance.aside.abs() <= patience * attack.aside
        && stance.aim.abs() <= patience * attack.off_aim;
    if !is_behind {
        return Activity::WalkBehindBall;
    }
    if !may_kick {
        return Activity::Dribble;
    }
    // Who has decided to kick stops its walk first, over which it moves a little.
    let patience = if before == Activity::Kick {
        attack.patience
    } else {
        1.0
    };
    let off = ball - at_foot(ball, attack);
    let lies_right = off.x.abs() <= patience * attack.kick_ahead_tolerance
        && off.y.abs() <= patience * attack.kick_aside_tolerance
        && stance.aim.abs() <= patience * attack.kick_tolerance;
    if lies_right {
        Activity::Kick
    } else {
        Activity::Align
    }
}

/// With the foot that is nearer.
fn kick(view: &View<'_>, ball: Point2<f32>) -> Decision {
    let script = match ball.y >= 0.0 {
        true => Script::KickLeft,
        false => Script::KickRight,
    };
    Decision::of_body(Activity::Kick, BodyMotion::Scripted(script), view.head())
}

/// In short steps to where the ball lies before the nearer foot.
fn align(view: &View<'_>, ball: Point2<f32>, aim: f32) -> Decision {
    let attack = &view.parameters.attack;
    let off = ball - at_foot(ball, attack);
    let walk = &view.parameters.walk;
    let step = Step {
        forward: within(off.x, attack.push),
        left: within(off.y, walk.left),
        turn: within(aim, walk.turn),
    };
    Decision::walk(Activity::Align, step, view.head())
}

/// Where a ball has to lie for the foot that is nearer.
fn at_foot(ball: Point2<f32>, attack: &AttackParameters) -> Point2<f32> {
    let side = if ball.y >= 0.0 { 1.0 } else { -1.0 };
    Point2::new(attack.kick_ahead, side * attack.kick_aside)
}

/// Through the ball, the slower the further off the line.
fn push(stance: &Stance, view: &View<'_>) -> Step {
    let (attack, walk) = (&view.parameters.attack, &view.parameters.walk);
    let off = stance.aside.abs() / (attack.patience * attack.aside).max(f32::EPSILON);
    let is_far = stance.behind > attack.behind;
    Step {
        forward: match is_far {
            true => attack.push,
            false => attack.push * (1.0 - off).clamp(0.0, 1.0),
        },
        left: within(-stance.aside, walk.left),
        turn: within(stance.aim, walk.turn),
    }
}

/// To the place from which it can be dribbled, not through the ball.
fn walk_behind(view: &View<'_>, ball: Point2<f32>, aim: f32, activity: Activity) -> Decision {
    let attack = &view.parameters.attack;
    let back = Isometry2::rotation(aim) * Vector2::new(attack.behind, 0.0);
    let target = Isometry2::new(ball.coords - back, aim);
    let around = Circle {
        middle: ball,
        radius: attack.clearance.min(FREE_SHARE * attack.behind),
    };
    let mut decision = view.walk_to(&target, Some(around), activity, activity);
    // Near enough for a place, but the ball cannot be played from there yet: who stood here would stand for ever.
    let target = view.out_of_goals(&target);
    let is_free = !view.is_occupied(target.translation.vector.into(), true);
    if decision.command.body == BodyMotion::Stand && is_free {
        let step = straight(&target, &view.parameters.walk);
        decision.command = Decision::walk(activity, step, view.head()).command;
    }
    decision
}

impl Stance {
    fn new(ball: Point2<f32>, aim: f32) -> Self {
        let from_ball = Isometry2::rotation(-aim) * -ball.coords;
        Self {
            behind: -from_ball.x,
            aside: from_ball.y,
            aim,
        }
    }
}

#[cfg(test)]
mod tests {
    use types::motion::HeadMotion;
    use types::obstacles::{Obstacle, ObstacleKind};

    use super::*;
    use crate::behavior::tests::{Scene, parameters};

    fn choice(ball: [f32; 2], aim: f32, may_kick: bool, before: Activity) -> Activity {
        let ball = Point2::from(ball);
        let stance = Stance::new(ball, aim);
        choose(&stance, ball, may_kick, before, &parameters().attack)
    }

    #[test]
    fn what_to_do_with_a_ball_by_where_it_lies() {
        use Activity::{Align, Dribble, Kick, WalkBehindBall};
        for (ball, aim, may_kick, before, expected) in [
            ([1.5, 0.0], 0.0, false, WalkBehindBall, WalkBehindBall),
            ([0.25, 0.0], 0.0, false, WalkBehindBall, Dribble),
            // Beside the line, behind the ball's back, or with the face elsewhere.
            ([0.25, 0.2], 0.0, false, WalkBehindBall, WalkBehindBall),
            ([-0.25, 0.0], 0.0, false, WalkBehindBall, WalkBehindBall),
            ([0.25, 0.0], 1.0, false, WalkBehindBall, WalkBehindBall),
            // Who is at it does not give up so soon.
            ([0.25, 0.1], 0.0, false, WalkBehindBall, WalkBehindBall),
            ([0.25, 0.1], 0.0, false, Dribble, Dribble),
            // Near the goal it kicks, once the ball lies before a foot.
            ([0.25, 0.0], 0.0, true, Dribble, Align),
            ([0.18, 0.05], 0.0, true, Align, Kick),
            ([0.18, -0.05], 0.0, true, Align, Kick),
            ([0.18, 0.08], 0.0, true, Align, Align),
            ([0.18, 0.08], 0.0, true, Kick, Kick),
            ([0.18, 0.05], 0.0, false, Align, Dribble),
        ] {
            let chosen = choice(ball, aim, may_kick, before);
            assert_eq!(chosen, expected, "{ball:?} {aim} after {before:?}");
        }
    }

    #[test]
    fn the_foot_is_that_on_the_side_of_the_ball() {
        for (aside, script) in [(0.05, Script::KickLeft), (-0.05, Script::KickRight)] {
            let scene = Scene::at(3.3, 0.0, 0.0).with_ball(0.18, aside);
            let decision = scene.view(|view| attack(view, Point2::new(0.18, aside)));
            assert_eq!(decision.command.body, BodyMotion::Scripted(script));
        }
    }

    #[test]
    fn a_ball_between_robot_and_own_goal_is_walked_around() {
        // The robot faces its own goal.
        let scene = Scene::at(0.0, 0.0, std::f32::consts::PI).with_ball(1.0, 0.02);
        let decision = scene.view(|view| attack(view, Point2::new(1.0, 0.02)));
        assert_eq!(decision.activity, Activity::WalkBehindBall);
        let target = decision.plan.target.unwrap().translation.vector;
        assert!(target.x > 1.1, "{target}");
        let way_point = decision.plan.way_point.unwrap();
        assert!(way_point.x < 1.1 && way_point.y.abs() > 0.1, "{way_point}");
    }

    #[test]
    fn a_robot_that_stands_nearly_behind_the_ball_goes_on_until_it_can_play_it() {
        let scene = Scene::at(-0.35, 0.0, 0.0).with_ball(0.33, 0.07);
        let decision = scene.view(|view| attack(view, Point2::new(0.33, 0.07)));
        assert_eq!(decision.activity, Activity::WalkBehindBall);
        assert_eq!(decision.command.body, BodyMotion::Walk);
        assert!(decision.command.step.left > 0.0, "{decision:?}");
    }

    #[test]
    fn a_robot_behind_the_ball_is_not_pushed_away() {
        let mut scene = Scene::at(-2.0, 0.0, std::f32::consts::PI).with_ball(0.3, 0.0);
        for (kind, stands) in [(ObstacleKind::Robot, true), (ObstacleKind::Unknown, false)] {
            scene.world.obstacles = vec![Obstacle {
                position: Point2::new(0.48, 0.1),
                radius: 0.2,
                kind,
                ..Obstacle::default()
            }];
            let decision = scene.view(|view| attack(view, Point2::new(0.3, 0.0)));
            assert_eq!(decision.activity, Activity::WalkBehindBall);
            assert_eq!(decision.command.body == BodyMotion::Stand, stands);
        }
    }

    #[test]
    fn a_ball_on_the_own_goal_line_is_played_along_it() {
        // From a metre before the own goal, the ball between its posts.
        let scene = Scene::at(-3.5, 0.3, std::f32::consts::PI).with_ball(0.95, 0.0);
        let decision = scene.view(|view| attack(view, Point2::new(0.95, 0.0)));
        assert_eq!(decision.activity, Activity::WalkBehindBall);
        let ground_to_field = scene.world.ground_to_field.unwrap();
        let target = decision.plan.target.unwrap().translation.vector;
        let target = ground_to_field * Point2::from(target);
        // Beside it towards the middle, not behind it in the net.
        assert!(target.x > -4.51 && target.y < 0.2, "{target}");
    }

    #[test]
    fn without_a_pose_it_walks_to_the_ball_and_stops_there() {
        let mut scene = Scene::at(0.0, 0.0, 0.0).with_ball(1.0, 0.3);
        scene.world.ground_to_field = None;
        let far = scene.view(|view| attack(view, Point2::new(1.0, 0.3)));
        assert_eq!(far.command.body, BodyMotion::Walk);
        let near = scene.view(|view| attack(view, Point2::new(0.2, 0.0)));
        assert_eq!(near.command.body, BodyMotion::Stand);
        assert_eq!(near.command.head, HeadMotion::LookAround);
        // And turns where it has seen nothing new for a while.
        scene.without_pose_for(scene.parameters.search.with_head + 1.0);
        let turns = scene.view(|view| attack(view, Point2::new(0.2, 0.0)));
        assert_eq!(turns.activity, Activity::SearchByTurning);
    }
}
