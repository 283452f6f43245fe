//! What is decided in every state of the game, and scenes for the tests of the parts.

use framework::Timestamp;
use framework::testing::{AdditionalProbe, ParameterFile, cycle_time};
use nalgebra::{Isometry2, Point2, Vector2};
use types::ball::Ball;
use types::fall_state::{Facing, FallDirection, FallState};
use types::motion::{Script, Step};

use self::way::stuck_in;

use super::*;

mod room;
mod way;

pub(super) fn parameters() -> BehaviorParameters {
    ParameterFile::new(include_str!("../../../parameters/default.toml")).get("behavior")
}

/// A robot in the game, 100 s after its start.
pub(super) struct Scene {
    pub(super) world: WorldState,
    pub(super) parameters: BehaviorParameters,
    memory: Memory,
    now: Timestamp,
}

impl Scene {
    /// On the field, m and rad, without a ball.
    pub(super) fn at(x: f32, y: f32, heading: f32) -> Self {
        let world = WorldState {
            primary_state: PrimaryState::Playing,
            goalkeeper: 1,
            ground_to_field: Some(Isometry2::new(Vector2::new(x, y), heading)),
            ..WorldState::default()
        };
        let now = cycle_time(100_000, 12).start;
        let mut memory = Memory::default();
        memory.notice(&world, &parameters(), now);
        Self {
            world,
            parameters: parameters(),
            memory,
            now,
        }
    }

    /// Seen from the robot, m.
    pub(super) fn with_ball(mut self, ahead: f32, aside: f32) -> Self {
        self.world.ball = Some(Ball {
            position: Point2::new(ahead, aside),
            ..Ball::default()
        });
        self
    }

    /// Seen from the robot, m/s.
    pub(super) fn roll(&mut self, velocity: Vector2<f32>) {
        self.world.ball = self.world.ball.map(|ball| Ball { velocity, ..ball });
    }

    /// So many seconds ago Set was over.
    pub(super) fn kicked_off(&mut self, since: f32) {
        let at = self.ago(since);
        let set = WorldState {
            primary_state: PrimaryState::Set,
            ..WorldState::default()
        };
        self.memory.notice(&set, &self.parameters, at);
        self.memory.notice(&self.world, &self.parameters, at);
    }

    /// The ball was known so many seconds ago.
    pub(super) fn lost_for(&mut self, seconds: f32) {
        self.memory.ball_known_at = self.ago(seconds);
    }

    /// The robot knew so many seconds ago where it is.
    pub(super) fn without_pose_for(&mut self, seconds: f32) {
        self.world.ground_to_field = None;
        self.memory.pose_known_at = self.ago(seconds);
    }

    fn ago(&self, seconds: f32) -> Timestamp {
        cycle_time(100_000 - (seconds * 1000.0) as u64, 12).start
    }

    /// What the robot did in the last cycle.
    pub(super) fn did(&mut self, activity: Activity) {
        self.memory.activity = activity;
    }

    /// Time goes on.
    pub(super) fn pass(&mut self, seconds: f32) {
        self.now = self.now + std::time::Duration::from_secs_f32(seconds);
    }

    /// What is so now, before the next decision.
    pub(super) fn notice(&mut self) {
        self.memory.notice(&self.world, &self.parameters, self.now);
    }

    /// It has searched where it is for so many seconds.
    pub(super) fn searches_for(&mut self, seconds: f32) {
        self.memory.searches_since = Some(self.ago(seconds));
    }

    /// Whether it walked in the last cycle.
    pub(super) fn walks(&mut self, walks: bool) {
        self.memory.is_walking = walks;
    }

    /// Where it goes first on its way to a pose, on the field, m.
    pub(super) fn way_point_to(&self, pose: &Isometry2<f32>) -> Point2<f32> {
        let (walk, wait) = (Activity::WalkToPlace, Activity::WaitInReady);
        let decision = self.view(|view| view.go_to(pose, walk, wait));
        self.world.ground_to_field.unwrap() * decision.plan.way_point.unwrap()
    }

    pub(super) fn view(&self, decide: impl Fn(&View<'_>) -> Decision) -> Decision {
        decide(&View {
            world: &self.world,
            parameters: &self.parameters,
            memory: self.memory,
            now: self.now,
        })
    }
}

fn decision_with(
    world_state: &WorldState,
    client_wish: Option<&ClientWish>,
) -> (MotionCommand, Activity) {
    let mut node = Behavior::new(CreationContext {}).unwrap();
    cycle_of(&mut node, world_state, client_wish, 1000, &parameters())
}

/// One cycle, so many ms after the start.
fn cycle_of(
    node: &mut Behavior,
    world_state: &WorldState,
    client_wish: Option<&ClientWish>,
    millis: u64,
    parameters: &BehaviorParameters,
) -> (MotionCommand, Activity) {
    let mut plan = AdditionalProbe::unsubscribed();
    let context = CycleContext {
        world_state,
        client_wish,
        cycle_time: cycle_time(millis, 12),
        parameters,
        plan: plan.output(),
    };
    let outputs = node.cycle(context).unwrap();
    (outputs.motion_command.value, outputs.activity.value)
}

fn upright(primary_state: PrimaryState, ball: Option<Ball>) -> (MotionCommand, Activity) {
    let world_state = WorldState {
        primary_state,
        ball,
        ground_to_field: Some(Isometry2::translation(-2.0, 0.0)),
        ..WorldState::default()
    };
    decision_with(&world_state, None)
}

fn ball(ahead: f32, aside: f32) -> Option<Ball> {
    Some(Ball {
        position: Point2::new(ahead, aside),
        ..Ball::default()
    })
}

#[test]
fn every_state_of_the_game_has_its_body_its_head_and_its_name() {
    use BodyMotion::{Penalized, SitDown, Stand, Walk};
    use PrimaryState as State;
    let ahead = HeadMotion::LookAt(Point2::new(1.5, -0.2));
    let around = HeadMotion::LookAround;
    for (state, knows_ball, body, head, activity) in [
        (
            State::Unstiff,
            true,
            SitDown,
            HeadMotion::WithBody,
            Activity::SitLimp,
        ),
        (
            State::Penalized,
            true,
            Penalized,
            HeadMotion::WithBody,
            Activity::ServePenalty,
        ),
        (State::Initial, true, Stand, around, Activity::WaitForGame),
        (State::Standby, true, Stand, around, Activity::WaitForGame),
        (State::Ready, true, Walk, ahead, Activity::WalkToPlace),
        (State::Ready, false, Walk, around, Activity::WalkToPlace),
        (State::Set, true, Stand, ahead, Activity::WaitForWhistle),
        (State::Set, false, Stand, around, Activity::WaitForWhistle),
        (State::Playing, true, Walk, ahead, Activity::WalkBehindBall),
        (
            State::Playing,
            false,
            Stand,
            around,
            Activity::SearchWithHead,
        ),
        (
            State::Finished,
            true,
            Stand,
            HeadMotion::Ahead,
            Activity::AfterGame,
        ),
    ] {
        let (command, named) = upright(state, ball(1.5, -0.2).filter(|_| knows_ball));
        assert_eq!((command.body, command.head), (body, head), "{state:?}");
        assert_eq!(named, activity, "{state:?}");
        assert_eq!(command.step == Step::ZERO, body != Walk, "{state:?}");
    }
}

#[test]
fn a_client_drives_a_robot_that_stands_walks_or_kicks_and_no_other() {
    let step = Step {
        left: 0.02,
        ..Step::ZERO
    };
    let wish = ClientWish {
        body: BodyMotion::Walk,
        step,
    };
    let lies = FallState::Lying(Facing::Up);
    for (primary_state, fall_state, body) in [
        (PrimaryState::Initial, FallState::Upright, BodyMotion::Walk),
        (PrimaryState::Playing, FallState::Upright, BodyMotion::Walk),
        (
            PrimaryState::Penalized,
            FallState::Upright,
            BodyMotion::Penalized,
        ),
        (
            PrimaryState::Unstiff,
            FallState::Upright,
            BodyMotion::SitDown,
        ),
        (PrimaryState::Initial, lies, BodyMotion::Unstiff),
        (
            PrimaryState::Playing,
            lies,
            BodyMotion::Scripted(Script::StandUpBack),
        ),
    ] {
        let world_state = WorldState {
            primary_state,
            fall_state,
            ball: ball(1.0, 0.0),
            ..WorldState::default()
        };
        let (command, activity) = decision_with(&world_state, Some(&wish));
        assert_eq!(command.body, body, "{primary_state:?}");
        assert_eq!(command.step == step, body == BodyMotion::Walk);
        assert_eq!(activity == Activity::FollowClient, body == BodyMotion::Walk);
    }
}

#[test]
fn a_sitting_robot_rises_for_the_game() {
    let world_state = WorldState {
        primary_state: PrimaryState::Initial,
        fall_state: FallState::Sitting,
        ..WorldState::default()
    };
    assert_eq!(decision_with(&world_state, None).0.body, BodyMotion::Stand);
}

#[test]
fn whoever_falls_protects_itself_and_whoever_lies_gets_up_where_it_plays() {
    use PrimaryState::{Finished, Initial, Penalized, Playing, Ready, Set, Unstiff};
    let falls = FallState::Falling(FallDirection::Left);
    let lies = FallState::Lying(Facing::Up);
    let decided = |primary_state, fall_state| {
        let world_state = WorldState {
            primary_state,
            fall_state,
            ..WorldState::default()
        };
        let (command, activity) = decision_with(&world_state, None);
        (command.body, activity)
    };
    for state in [Initial, Ready, Playing, Penalized, Finished] {
        let protects = BodyMotion::Scripted(Script::FallSideways);
        assert_eq!(
            decided(state, falls),
            (protects, Activity::Protect),
            "{state:?}"
        );
    }
    for state in [Ready, Set, Playing] {
        let rises = BodyMotion::Scripted(Script::StandUpBack);
        assert_eq!(decided(state, lies), (rises, Activity::GetUp), "{state:?}");
    }
    for state in [Initial, Penalized, Finished, Unstiff] {
        let stays = (BodyMotion::Unstiff, Activity::Lie);
        assert_eq!(decided(state, lies), stays, "{state:?}");
    }
    assert_eq!(decided(Unstiff, falls).0, BodyMotion::Unstiff);
}

#[test]
fn a_robot_that_gets_nowhere_backs_off_and_begins_anew() {
    let parameters = parameters();
    let round = parameters.recovery.after + parameters.recovery.duration;
    let world_state = WorldState {
        primary_state: PrimaryState::Playing,
        ball: ball(1.5, -0.2),
        ground_to_field: Some(Isometry2::translation(-2.0, 0.0)),
        ..WorldState::default()
    };
    let done = stuck_in(2.2 * round, |_| world_state.clone());
    let activities: Vec<_> = done.iter().map(|(activity, ..)| *activity).collect();
    let (walks, backs_off) = (Activity::WalkBehindBall, Activity::BackOff);
    assert_eq!(activities, [walks, backs_off, walks, backs_off, walks]);
}
