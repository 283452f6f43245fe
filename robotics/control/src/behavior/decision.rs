//! Owns what a decision is made from and what it consists of.

use framework::Timestamp;
use nalgebra::{Isometry2, Point2};
use serde::{Deserialize, Serialize};
use types::behavior::{Activity, Plan, Role};
use types::fall_state::FallState;
use types::game::{PrimaryState, SetPlay};
use types::motion::{BodyMotion, HeadMotion, MotionCommand, Step};
use types::obstacles::{Obstacle, ObstacleKind};
use types::world_state::WorldState;

use super::parameters::{BehaviorParameters, WalkParameters};
use super::penalty_kick::PenaltyKick;
use super::stuck::{Legs, Progress};
use super::walk_to::step_to;
use super::way::{Circle, first_way_point};

/// What the robot does, and why.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Decision {
    pub(super) activity: Activity,
    pub(super) command: MotionCommand,
    pub(super) plan: Plan,
}

/// What was decided and seen before.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Serialize)]
pub(super) struct Memory {
    /// What the robot did in the game in the last cycle.
    state: PrimaryState,
    /// When it began to play after Set; `None` where it plays for another reason.
    kick_off_at: Option<Timestamp>,
    /// When the ball was known last, or the robot began to do without it.
    pub(super) ball_known_at: Timestamp,
    /// When it knew last where it is, or had no need to.
    pub(super) pose_known_at: Timestamp,
    pub(super) is_walking: bool,
    pub(super) activity: Activity,
    pub(super) progress: Progress,
    /// When it began to search where it is; `None` while it does anything else.
    pub(super) searches_since: Option<Timestamp>,
    pub(super) penalty_kick: PenaltyKick,
}

/// Everything that is decided on.
#[derive(Clone, Copy)]
pub(super) struct View<'a> {
    pub(super) world: &'a WorldState,
    pub(super) parameters: &'a BehaviorParameters,
    pub(super) memory: Memory,
    pub(super) now: Timestamp,
}

impl Decision {
    pub(super) fn of_body(activity: Activity, body: BodyMotion, head: HeadMotion) -> Self {
        Self {
            activity,
            command: MotionCommand {
                body,
                head,
                step: Step::ZERO,
            },
            plan: Plan::default(),
        }
    }

    pub(super) fn walk(activity: Activity, step: Step, head: HeadMotion) -> Self {
        let mut decision = Self::of_body(activity, BodyMotion::Walk, head);
        decision.command.step = step;
        decision
    }
}

impl Memory {
    /// Before anything is decided.
    pub(super) fn notice(
        &mut self,
        world: &WorldState,
        parameters: &BehaviorParameters,
        now: Timestamp,
    ) {
        let is_playing = world.primary_state == PrimaryState::Playing;
        if world.primary_state != self.state {
            self.kick_off_at = (is_playing && self.state == PrimaryState::Set).then_some(now);
            self.state = world.primary_state;
        }
        if world.ball.is_some() || !is_playing {
            self.ball_known_at = now;
        }
        let is_in_game = is_playing || world.primary_state == PrimaryState::Ready;
        if world.ground_to_field.is_some() || !is_in_game {
            self.pose_known_at = now;
        }
        self.penalty_kick
            .notice(world, self.activity, parameters, now);
        self.progress.notice(
            self.legs(world.fall_state),
            world.ground_to_field.as_ref(),
            &world.obstacles,
            &parameters.recovery,
            now,
        );
        if !is_playing || world.set_play != SetPlay::None {
            self.progress.forget_others();
        }
    }

    /// What they did by the robot's own decision: they move, too, where it waits until a place becomes free.
    fn legs(&self, fall_state: FallState) -> Legs {
        let is_up = matches!(fall_state, FallState::Upright | FallState::Sitting);
        let moves = match self.activity {
            Activity::FollowClient => false,
            activity => activity.plays_ball() || self.is_walking,
        };
        match (is_up, moves) {
            (false, _) => Legs::Down,
            (true, true) => Legs::Move,
            (true, false) => Legs::Wait,
        }
    }

    /// Once it is decided.
    pub(super) fn keep(&mut self, decision: &Decision, now: Timestamp) {
        let searches = matches!(
            decision.activity,
            Activity::SearchWithHead | Activity::SearchByTurning
        );
        // Who gets out of somebody's way meanwhile goes on to search.
        if decision.activity != Activity::BackOff {
            self.searches_since = searches.then(|| self.searches_since.unwrap_or(now));
        }
        self.activity = decision.activity;
        self.is_walking = decision.command.body == BodyMotion::Walk;
    }
}

impl View<'_> {
    /// What the robot is for its team; one without a role does not get as far as to play it.
    pub(super) fn role(&self) -> Role {
        self.world.role.unwrap_or_default()
    }

    /// Where the robot is, in the field frame; the centre mark where it does not know.
    pub(super) fn place(&self) -> Point2<f32> {
        let pose = self.world.ground_to_field;
        pose.map_or_else(Point2::origin, |pose| pose.translation.vector.into())
    }

    /// Since the kick-off, s; `None` where the game goes on for another reason.
    pub(super) fn since_kick_off(&self) -> Option<f32> {
        let kick_off_at = self.memory.kick_off_at?;
        Some((self.now - kick_off_at).as_secs_f32())
    }

    /// On the ball, where one is known.
    pub(super) fn head(&self) -> HeadMotion {
        self.world.ball.map_or(HeadMotion::LookAround, |ball| {
            HeadMotion::LookAt(ball.position)
        })
    }

    /// The ball in the field frame, m.
    pub(super) fn ball_on_field(&self) -> Option<Point2<f32>> {
        let ball = self.world.ball.map(|ball| ball.position);
        Some(self.world.ground_to_field? * ball.or(self.world.team_ball)?)
    }

    /// Walks to a pose of the field frame around what stands in the way, and stands there as something else.
    ///
    /// Where the robot does not know where it is it looks for that.
    pub(super) fn go_to(
        &self,
        pose: &Isometry2<f32>,
        on_the_way: Activity,
        there: Activity,
    ) -> Decision {
        let near = self.parameters.walk.near;
        self.go_to_from(near, pose, on_the_way, there)
    }

    /// Likewise, but sideways and backwards rather than turn away from a ball that it sees.
    pub(super) fn go_to_facing_ball(
        &self,
        pose: &Isometry2<f32>,
        on_the_way: Activity,
        there: Activity,
    ) -> Decision {
        let walk = &self.parameters.walk;
        let near = self.world.ball.map_or(walk.near, |_| walk.near_with_ball);
        self.go_to_from(near, pose, on_the_way, there)
    }

    /// From `near` on in all directions.
    fn go_to_from(
        &self,
        near: f32,
        pose: &Isometry2<f32>,
        on_the_way: Activity,
        there: Activity,
    ) -> Decision {
        match self.world.ground_to_field {
            Some(ground_to_field) => {
                let field_to_ground = ground_to_field.inverse();
                let target = field_to_ground * pose;
                let ball = self.ball_on_field().map(|ball| field_to_ground * ball);
                let ball = ball.filter(|_| gives_room(on_the_way));
                let around = ball.map(|middle| Circle {
                    middle,
                    radius: self.parameters.attack.clearance,
                });
                self.walk(near, &target, (around, false), (on_the_way, there))
            }
            None => self.look_for_pose(there),
        }
    }

    /// Where the robot does not know where it is: who sees only lines of one direction learns no more before it turns.
    pub(super) fn look_for_pose(&self, standing: Activity) -> Decision {
        let search = &self.parameters.search;
        let lost_for = (self.now - self.memory.pose_known_at).as_secs_f32();
        let round = search.with_head + search.turning;
        match round > 0.0 && lost_for % round >= search.with_head {
            true => self.search_by_turning(),
            false => Decision::of_body(standing, BodyMotion::Stand, HeadMotion::LookAround),
        }
    }

    pub(super) fn search_by_turning(&self) -> Decision {
        let step = Step {
            turn: self.parameters.search.turn,
            ..Step::ZERO
        };
        Decision::walk(Activity::SearchByTurning, step, HeadMotion::LookAround)
    }

    /// Likewise in the ground frame, and around one more circle.
    pub(super) fn walk_to(
        &self,
        target: &Isometry2<f32>,
        more: Option<Circle>,
        on_the_way: Activity,
        there: Activity,
    ) -> Decision {
        let near = self.parameters.walk.near;
        let is_at_ball = more.is_some();
        self.walk(near, target, (more, is_at_ball), (on_the_way, there))
    }

    fn walk(
        &self,
        near: f32,
        target: &Isometry2<f32>,
        (more, is_at_ball): (Option<Circle>, bool),
        (on_the_way, there): (Activity, Activity),
    ) -> Decision {
        let walk = WalkParameters {
            near,
            ..self.parameters.walk
        };
        let target = &self.out_of_goals(target);
        let place = Point2::from(target.translation.vector);
        if self.is_occupied(place, is_at_ball) {
            let mut decision = Decision::of_body(there, BodyMotion::Stand, self.head());
            decision.plan.target = Some(*target);
            return decision;
        }
        let way_point = self.way_point(place, more);
        let step = step_to(target, way_point, self.memory.is_walking, &walk);
        let mut decision = match step {
            Some(step) => Decision::walk(on_the_way, step, self.head()),
            None => Decision::of_body(there, BodyMotion::Stand, self.head()),
        };
        decision.plan.target = Some(*target);
        decision.plan.way_point = step.map(|_| way_point);
        decision
    }

    /// Whether somebody stands in a place, or so near that both would touch, and the robot beside him: going on would push.
    ///
    /// At the ball only robots count: what else is seen there may be the ball.
    pub(super) fn is_occupied(&self, place: Point2<f32>, is_at_ball: bool) -> bool {
        let walk = &self.parameters.walk;
        self.world.obstacles.iter().any(|obstacle| {
            let radius = obstacle.radius + walk.clearance;
            (obstacle.kind == ObstacleKind::Robot || !is_at_ball)
                && (place - obstacle.position).norm() < radius
                && obstacle.position.coords.norm() < radius + walk.beside_occupied
        })
    }

    /// Where it goes first on its way to a place, around what stands there and never through a goal.
    fn way_point(&self, place: Point2<f32>, more: Option<Circle>) -> Point2<f32> {
        let (walk, places) = (&self.parameters.walk, &self.parameters.places);
        let obstacles = self.world.obstacles.iter();
        let circles = obstacles
            .map(|obstacle| self.around(obstacle, place))
            .chain(more);
        let Some(ground_to_field) = self.world.ground_to_field else {
            return first_way_point(place, circles, walk, |_| false);
        };
        let field_to_ground = ground_to_field.inverse();
        if let Some(out) = places.way_out_of_goal(ground_to_field.translation.vector.into()) {
            return field_to_ground * out;
        }
        let posts = places.posts(walk.clearance).map(|post| Circle {
            middle: field_to_ground * post.middle,
            ..post
        });
        let is_closed = |point| places.is_closed(ground_to_field * point);
        first_way_point(place, circles.chain(posts), walk, is_closed)
    }

    /// What the middle of the robot stays out of on its way to a place because of somebody.
    ///
    /// Nobody is in a hurry in Ready, but whose place is beside somebody goes there.
    fn around(&self, obstacle: &Obstacle, place: Point2<f32>) -> Circle {
        let walk = &self.parameters.walk;
        let circle = |clearance: f32| Circle {
            middle: obstacle.position,
            radius: obstacle.radius + clearance,
        };
        let wide = circle(walk.clearance_in_ready);
        let has_room = (place - wide.middle).norm() >= wide.radius;
        match self.world.primary_state == PrimaryState::Ready && has_room {
            true => wide,
            false => circle(walk.clearance),
        }
    }

    /// The same pose of the ground frame, or before the goal line where it lies in a goal.
    pub(super) fn out_of_goals(&self, target: &Isometry2<f32>) -> Isometry2<f32> {
        let Some(ground_to_field) = self.world.ground_to_field else {
            return *target;
        };
        let place = ground_to_field * Point2::from(target.translation.vector);
        let place = ground_to_field.inverse() * self.parameters.places.out_of_goals(place);
        Isometry2::from_parts(place.into(), target.rotation)
    }
}

/// Whoever does this must not touch the ball.
fn gives_room(activity: Activity) -> bool {
    matches!(
        activity,
        Activity::KeepDistance | Activity::LeavePenaltyArea
    )
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector2;

    use super::*;
    use crate::behavior::tests::Scene;

    #[test]
    fn nobody_is_sent_into_a_goal() {
        let scene = Scene::at(-3.5, 0.5, 0.0);
        for (place, expected) in [([-4.8, 0.2], [-4.5, 0.2]), ([-4.0, 1.0], [-4.0, 1.0])] {
            let pose = Isometry2::translation(place[0], place[1]);
            let decision =
                scene.view(|view| view.go_to(&pose, Activity::WalkToPlace, Activity::WaitInReady));
            let ground_to_field = scene.world.ground_to_field.unwrap();
            let target = decision.plan.target.unwrap().translation.vector;
            let target = ground_to_field * Point2::from(target);
            assert!((target - Point2::from(expected)).norm() < 1e-5, "{target}");
        }
    }

    #[test]
    fn ways_lead_around_goals_and_not_off_the_carpet() {
        let pose = Isometry2::translation(-4.4, 1.2);
        // From before the goal to beside it.
        let scene = Scene::at(-4.45, 0.4, 1.5);
        let way_point = scene.way_point_to(&pose);
        assert!(way_point.x > -4.35, "{way_point}");
        // Out of it through its mouth.
        let scene = Scene::at(-4.8, 0.6, 1.5);
        let way_point = scene.way_point_to(&pose);
        assert!(way_point.x > -4.3 && way_point.y < 0.5, "{way_point}");
        // Past somebody near the touch line on the inner side, though that is longer.
        let mut scene = Scene::at(-1.0, 3.4, 0.0);
        scene.world.obstacles.push(Obstacle {
            position: Point2::new(1.0, -0.05),
            radius: 0.2,
            ..Obstacle::default()
        });
        let way_point = scene.way_point_to(&Isometry2::translation(1.0, 3.4));
        assert!(way_point.y < 3.1, "{way_point}");
    }

    #[test]
    fn in_ready_there_is_time_to_go_wide_around_somebody() {
        use PrimaryState::{Playing, Ready};
        let mut scene = Scene::at(-2.0, 0.0, 0.0);
        let middle = Point2::new(-1.0, 0.05);
        scene.world.obstacles = vec![Obstacle {
            position: middle + Vector2::new(2.0, 0.0),
            radius: 0.2,
            ..Obstacle::default()
        }];
        // How far the robot stays away from his middle; `None` where it goes straight.
        for (state, place, distance) in [
            (Ready, [0.0, 0.0], Some(0.5..0.55)),
            (Playing, [0.0, 0.0], Some(0.4..0.45)),
            // The straight way leads past him at 0.44 m.
            (Ready, [0.0, 1.1], Some(0.5..0.55)),
            (Playing, [0.0, 1.1], None),
            // Its place is 0.45 m behind him.
            (Ready, [-0.55, 0.05], Some(0.4..0.45)),
        ] {
            scene.world.primary_state = state;
            let place = Point2::from(place);
            let pose = Isometry2::translation(place.x, place.y);
            let way_point = scene.way_point_to(&pose);
            match distance {
                Some(distance) => {
                    let away = (way_point - middle).norm();
                    assert!(distance.contains(&away), "{state:?} {place}: {away}");
                }
                None => assert!((way_point - place).norm() < 1e-5, "{way_point}"),
            }
        }
    }

    #[test]
    fn a_place_in_which_somebody_stands_is_not_walked_into() {
        let mut scene = Scene::at(-2.0, 0.0, 0.0);
        for (ahead, beside_place, stops) in [
            (0.45, 0.0, true),
            (0.45, 0.2, true),
            (0.45, 0.6, false),
            // From further away it comes nearer.
            (1.0, 0.0, false),
        ] {
            let obstacle = Obstacle {
                position: Point2::new(ahead, 0.0),
                radius: 0.2,
                ..Obstacle::default()
            };
            scene.world.obstacles = vec![obstacle];
            let pose = Isometry2::translation(-2.0 + ahead, beside_place);
            let decision =
                scene.view(|view| view.go_to(&pose, Activity::WalkToPlace, Activity::WaitInReady));
            let has_stopped = decision.activity == Activity::WaitInReady;
            assert_eq!(has_stopped, stops, "{ahead} {beside_place}");
        }
    }
}
