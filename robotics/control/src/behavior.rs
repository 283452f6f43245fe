//! Decides what body and head do, from what the robot knows about the game and the world.
//!
//! Protects itself where the robot falls, gets up where it plays, still where the rules want it still, walks to its place
//! before a kick-off, and plays as its role asks while the game is on. Every decision has a name, the activity, and the plan
//! behind it can be watched. A client may drive the body instead.

mod attack;
mod decision;
mod keeper;
mod on_the_ground;
mod parameters;
mod penalty_kick;
mod places;
mod play;
mod stuck;
mod walk_to;
mod way;

use framework::{AdditionalOutput, CycleTime, Input, MainOutput, Parameter, Result, context};
use serde::{Deserialize, Serialize};
use types::behavior::{Activity, Plan, Role};
use types::game::{PrimaryState, SetPlay};
use types::motion::{BodyMotion, ClientWish, HeadMotion, MotionCommand};
use types::world_state::WorldState;

use self::decision::{Decision, Memory, View};
use self::on_the_ground::on_the_ground;
pub use self::parameters::{
    AttackParameters, BehaviorParameters, KeeperParameters, PlaceParameters, RecoveryParameters,
    SearchParameters, WalkParameters,
};
use self::play::{get_ready, play};
use self::stuck::{fallen_mate, step_away};

/// What was decided before.
#[derive(Debug, Deserialize, Serialize)]
pub struct Behavior {
    memory: Memory,
}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    world_state: Input<WorldState, "world_state">,
    client_wish: Input<Option<ClientWish>, "client_wish?">,
    cycle_time: CycleTime,

    parameters: Parameter<BehaviorParameters, "behavior">,

    /// Where the robot wants to get.
    plan: AdditionalOutput<Plan, "plan">,
}

#[context]
pub struct MainOutputs {
    /// What the robot shall do with itself.
    motion_command: MainOutput<MotionCommand>,
    /// What that is called.
    activity: MainOutput<Activity>,
}

impl Behavior {
    /// Nothing has happened yet.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self {
            memory: Memory::default(),
        })
    }

    /// What the state of the game allows, unless the robot falls or lies.
    pub fn cycle(&mut self, mut context: CycleContext) -> Result<MainOutputs> {
        let now = context.cycle_time.start;
        self.memory
            .notice(context.world_state, context.parameters, now);
        let view = View {
            world: context.world_state,
            parameters: context.parameters,
            memory: self.memory,
            now,
        };
        let decision = obey(context.client_wish, decide(&view));
        self.memory.keep(&decision, now);
        context.plan.fill_if_subscribed(|| decision.plan);
        Ok(MainOutputs {
            motion_command: decision.command.into(),
            activity: decision.activity.into(),
        })
    }
}

/// What robots may do in each state is as in the RoboCup SPL rules 2025.
fn decide(view: &View<'_>) -> Decision {
    if let Some(decision) = on_the_ground(view.world) {
        return decision;
    }
    let still = Decision::of_body;
    match view.world.primary_state {
        PrimaryState::Unstiff => {
            still(Activity::SitLimp, BodyMotion::SitDown, HeadMotion::WithBody)
        }
        PrimaryState::Penalized => still(
            Activity::ServePenalty,
            BodyMotion::Penalized,
            HeadMotion::WithBody,
        ),
        PrimaryState::Initial | PrimaryState::Standby => still(
            Activity::WaitForGame,
            BodyMotion::Stand,
            HeadMotion::LookAround,
        ),
        PrimaryState::Ready | PrimaryState::Playing if view.memory.progress.backs_off() => {
            back_off(view)
        }
        PrimaryState::Ready => make_room(view, get_ready(view)),
        PrimaryState::Set => still(Activity::WaitForWhistle, BodyMotion::Stand, view.head()),
        PrimaryState::Playing => make_room(view, give_way(view, play(view))),
        PrimaryState::Finished => still(Activity::AfterGame, BodyMotion::Stand, HeadMotion::Ahead),
    }
}

/// Who would stand beside a mate that gets up stands farther away, and does not come back before it is up.
fn make_room(view: &View<'_>, decision: Decision) -> Decision {
    let recovery = &view.parameters.recovery;
    let stands = decision.command.body == BodyMotion::Stand;
    let has_made_room =
        view.memory.activity == Activity::BackOff && !decision.activity.plays_ball();
    // A keeper that stands for a shot stands where it has to.
    let keeps = matches!(decision.activity, Activity::Block | Activity::WatchShot)
        || (view.world.set_play == SetPlay::PenaltyKick && view.role() == Role::Keeper);
    let distance = match (stands || has_made_room) && !keeps {
        true => fallen_mate(view.world, recovery),
        false => None,
    };
    match distance {
        Some(distance) if distance < recovery.near => back_off(view),
        Some(distance) if has_made_room && distance < recovery.near + recovery.room => {
            Decision::of_body(Activity::BackOff, BodyMotion::Stand, view.head())
        }
        _ => decision,
    }
}

/// Two that held each other at the ball, or fell over each other, would meet there again: the defender plays it first, and who has
/// got away from somebody stands for a while where he would play it in the others' half.
fn give_way(view: &View<'_>, decision: Decision) -> Decision {
    let recovery = &view.parameters.recovery;
    let would_play = decision.activity.plays_ball()
        || matches!(
            decision.activity,
            Activity::WalkToBall | Activity::LookWhereTeamSees
        );
    let is_theirs = would_play
        && view.memory.progress.has_just_got_away(recovery, view.now)
        && view.ball_on_field().is_some_and(|ball| ball.x > 0.0);
    match is_theirs {
        true => Decision::of_body(Activity::BackOff, BodyMotion::Stand, view.head()),
        false => decision,
    }
}

/// Whatever holds the robot, from elsewhere it finds another way.
fn back_off(view: &View<'_>) -> Decision {
    let BehaviorParameters { recovery, walk, .. } = view.parameters;
    let step = step_away(&view.world.obstacles, recovery, walk);
    Decision::walk(Activity::BackOff, step, view.head())
}

/// A client drives a robot that stands, walks or kicks by its own decision, and no other.
fn obey(wish: Option<&ClientWish>, decision: Decision) -> Decision {
    let is_on_its_feet = match decision.command.body {
        BodyMotion::Stand | BodyMotion::Walk => true,
        BodyMotion::Scripted(_) => decision.activity == Activity::Kick,
        BodyMotion::Unstiff | BodyMotion::SitDown | BodyMotion::Penalized => false,
    };
    match wish.filter(|_| is_on_its_feet) {
        Some(wish) => Decision {
            activity: Activity::FollowClient,
            command: MotionCommand {
                body: wish.body,
                step: wish.step,
                ..decision.command
            },
            plan: Plan::default(),
        },
        None => decision,
    }
}

#[cfg(test)]
mod tests;
