//! Owns what a robot does that falls or lies: it protects itself, and gets up where it plays.

use types::behavior::Activity;
use types::fall_state::{Facing, FallDirection, FallState};
use types::game::PrimaryState;
use types::motion::{BodyMotion, HeadMotion, Script};
use types::world_state::WorldState;

use super::decision::Decision;

/// `None` for one that stands or sits. One that is limp stays so, and nobody has his hands on a robot that moves.
pub(super) fn on_the_ground(world: &WorldState) -> Option<Decision> {
    let (script, activity) = match world.fall_state {
        FallState::Upright | FallState::Sitting => return None,
        FallState::Falling(FallDirection::Forward) => (Script::FallForward, Activity::Protect),
        FallState::Falling(FallDirection::Backward) => (Script::FallBackward, Activity::Protect),
        FallState::Falling(FallDirection::Left | FallDirection::Right) => {
            (Script::FallSideways, Activity::Protect)
        }
        FallState::Lying(Facing::Down) => (Script::StandUpFront, Activity::GetUp),
        FallState::Lying(Facing::Up) => (Script::StandUpBack, Activity::GetUp),
    };
    let may_move = match world.primary_state {
        PrimaryState::Unstiff => false,
        PrimaryState::Ready | PrimaryState::Set | PrimaryState::Playing => true,
        PrimaryState::Initial
        | PrimaryState::Standby
        | PrimaryState::Penalized
        | PrimaryState::Finished => script.protects(),
    };
    let (activity, body) = match may_move {
        true => (activity, BodyMotion::Scripted(script)),
        false => (Activity::Lie, BodyMotion::Unstiff),
    };
    Some(Decision::of_body(activity, body, HeadMotion::WithBody))
}
