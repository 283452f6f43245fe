//! Lets one motion have the body, and changes it only where the robot does not fall over that.
//!
//! A motion that is not begun where the body is comes after a way there: the dispatching. Only limp
//! is never waited for, and limp is where the body starts, and what it is once the hardware has let it down.

use framework::{CyclerState, Input, MainOutput, Result, context};
use serde::{Deserialize, Serialize};
use types::motion::{BodyMotion, MotionCommand, MotionSelection, SafeExits, Script};

/// Which motion has the body.
#[derive(Debug, Deserialize, Serialize)]
pub struct MotionSelector {
    selection: MotionSelection,
}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    motion_command: Input<MotionCommand, "motion_command">,
    is_in_safe_state: Input<bool, "sensor_data.is_in_safe_state">,
    // Written by motions later in the cycle: here stands what they said in the cycle before.
    safe_exits: CyclerState<SafeExits, "safe_exits">,
}

#[context]
pub struct MainOutputs {
    /// Who may command the body in this cycle.
    motion_selection: MainOutput<MotionSelection>,
}

impl MotionSelector {
    /// Starts limp.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self {
            selection: MotionSelection::default(),
        })
    }

    /// Stays with the motion or goes on to the one that is commanded.
    pub fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs> {
        let wanted = context.motion_command.body;
        self.selection = if *context.is_in_safe_state {
            MotionSelection::default()
        } else {
            next(self.selection, wanted, *context.safe_exits)
        };
        Ok(MainOutputs {
            motion_selection: self.selection.into(),
        })
    }
}

fn next(selection: MotionSelection, wanted: BodyMotion, exits: SafeExits) -> MotionSelection {
    let stay = selection;
    let current = selection.current;
    let go = |to| MotionSelection {
        current: to,
        is_dispatching: to != BodyMotion::Unstiff && !begins_anywhere(current, to),
    };
    if let BodyMotion::Scripted(script) = wanted
        && script.protects()
    {
        return match current {
            // Who gets up tilts as one who falls.
            BodyMotion::Scripted(now) if now.stands_up() && !exits.script => arrive(stay, exits),
            BodyMotion::Scripted(now) if now.protects() => stay,
            _ => MotionSelection {
                current: wanted,
                is_dispatching: false,
            },
        };
    }
    match (current, wanted) {
        (_, BodyMotion::Unstiff) => go(BodyMotion::Unstiff),
        // There is nothing to sit down from.
        (BodyMotion::Unstiff, BodyMotion::SitDown) => stay,
        (BodyMotion::Unstiff, _) => go(wanted),
        _ if selection.is_dispatching => match (exits.dispatch, current == wanted) {
            (false, _) => stay,
            // Whom the referee takes out may have somebody's hands on it.
            (true, false) if !is_kick(current) || wanted == BodyMotion::Penalized => go(wanted),
            (true, _) => arrive(stay, exits),
        },
        (BodyMotion::SitDown, _) if !exits.sit_down => stay,
        (BodyMotion::SitDown, BodyMotion::SitDown) => go(BodyMotion::Unstiff),
        (BodyMotion::Scripted(script), _) if !script.protects() => {
            if exits.script {
                go(wanted)
            } else {
                stay
            }
        }
        _ if current == wanted => stay,
        (BodyMotion::Walk, _) if !exits.walk => stay,
        _ => go(wanted),
    }
}

/// The way to a motion ends where that begins.
fn arrive(selection: MotionSelection, exits: SafeExits) -> MotionSelection {
    MotionSelection {
        is_dispatching: selection.is_dispatching && !exits.dispatch,
        ..selection
    }
}

/// A ball waits for nobody who looks elsewhere: a catch begins as the robot stands, with its head as it is.
fn begins_anywhere(from: BodyMotion, to: BodyMotion) -> bool {
    let is_on_both_feet = matches!(from, BodyMotion::Stand | BodyMotion::Walk);
    is_on_both_feet && to == BodyMotion::Scripted(Script::Catch)
}

/// Who has asked for a kick does not ask until it is over.
fn is_kick(motion: BodyMotion) -> bool {
    matches!(motion, BodyMotion::Scripted(script) if !script.protects() && !script.stands_up())
}

#[cfg(test)]
mod tests {
    use super::*;

    const NOWHERE: SafeExits = SafeExits {
        sit_down: false,
        dispatch: false,
        walk: false,
        script: false,
    };
    const EVERYWHERE: SafeExits = SafeExits {
        sit_down: true,
        dispatch: true,
        walk: true,
        script: true,
    };

    fn select(
        node: &mut MotionSelector,
        wanted: BodyMotion,
        exits: SafeExits,
    ) -> (BodyMotion, bool) {
        select_in(node, false, wanted, exits)
    }

    fn select_in(
        node: &mut MotionSelector,
        is_in_safe_state: bool,
        wanted: BodyMotion,
        exits: SafeExits,
    ) -> (BodyMotion, bool) {
        let motion_command = MotionCommand {
            body: wanted,
            ..MotionCommand::default()
        };
        let context = CycleContext {
            motion_command: &motion_command,
            is_in_safe_state: &is_in_safe_state,
            safe_exits: &mut exits.clone(),
        };
        let selection = node.cycle(context).unwrap().motion_selection.value;
        (selection.current, selection.is_dispatching)
    }

    fn node() -> MotionSelector {
        MotionSelector::new(CreationContext {}).unwrap()
    }

    /// Already at work, not on the way to it.
    fn node_in(current: BodyMotion) -> MotionSelector {
        let selection = MotionSelection {
            current,
            is_dispatching: false,
        };
        MotionSelector { selection }
    }

    #[test]
    fn the_first_motion_comes_from_limp_by_dispatching() {
        let mut node = node();
        let stand = BodyMotion::Stand;
        assert_eq!(
            select(&mut node, BodyMotion::Unstiff, NOWHERE),
            (BodyMotion::Unstiff, false)
        );
        assert_eq!(select(&mut node, stand, EVERYWHERE), (stand, true));
        assert_eq!(select(&mut node, stand, NOWHERE), (stand, true));
        assert_eq!(select(&mut node, stand, EVERYWHERE), (stand, false));
    }

    #[test]
    fn a_body_that_the_hardware_lets_down_is_limp_whatever_it_did() {
        for motion in [BodyMotion::Stand, BodyMotion::Walk, KICK, RISE, FALL] {
            for wanted in [motion, BodyMotion::Stand, FALL] {
                let mut node = node_in(motion);
                let limp = (BodyMotion::Unstiff, false);
                assert_eq!(select_in(&mut node, true, wanted, NOWHERE), limp);
                assert_eq!(select(&mut node, RISE, NOWHERE), (RISE, true));
            }
        }
    }

    #[test]
    fn a_limp_body_does_not_rise_to_sit_down() {
        let limp = (BodyMotion::Unstiff, false);
        assert_eq!(select(&mut node(), BodyMotion::SitDown, EVERYWHERE), limp);
    }

    #[test]
    fn dispatching_goes_on_to_its_end_whatever_is_commanded() {
        let mut node = node();
        select(&mut node, BodyMotion::Stand, NOWHERE);
        let penalized = BodyMotion::Penalized;
        assert_eq!(
            select(&mut node, penalized, NOWHERE),
            (BodyMotion::Stand, true)
        );
        assert_eq!(select(&mut node, penalized, EVERYWHERE), (penalized, true));
    }

    #[test]
    fn a_pose_is_left_at_once() {
        let mut node = node_in(BodyMotion::Stand);
        let sit_down = BodyMotion::SitDown;
        assert_eq!(select(&mut node, sit_down, NOWHERE), (sit_down, true));
    }

    #[test]
    fn nobody_stands_up_before_sitting_down_is_done() {
        let mut node = node_in(BodyMotion::SitDown);
        let (sit_down, stand) = (BodyMotion::SitDown, BodyMotion::Stand);
        assert_eq!(select(&mut node, stand, NOWHERE), (sit_down, false));
        assert_eq!(select(&mut node, stand, EVERYWHERE), (stand, true));
    }

    #[test]
    fn a_walk_is_left_only_with_both_feet_side_by_side() {
        let mut node = node_in(BodyMotion::Walk);
        let (walk, stand) = (BodyMotion::Walk, BodyMotion::Stand);
        assert_eq!(select(&mut node, stand, NOWHERE), (walk, false));
        assert_eq!(select(&mut node, walk, EVERYWHERE), (walk, false));
        assert_eq!(select(&mut node, stand, EVERYWHERE), (stand, true));
    }

    const FALL: BodyMotion = BodyMotion::Scripted(Script::FallForward);
    const KICK: BodyMotion = BodyMotion::Scripted(Script::KickLeft);
    const RISE: BodyMotion = BodyMotion::Scripted(Script::StandUpFront);

    #[test]
    fn a_fall_is_not_waited_for_and_left_at_once() {
        for motion in [
            BodyMotion::Stand,
            BodyMotion::Walk,
            BodyMotion::SitDown,
            KICK,
        ] {
            for is_dispatching in [false, true] {
                let mut node = node_in(motion);
                node.selection.is_dispatching = is_dispatching;
                assert_eq!(select(&mut node, FALL, NOWHERE), (FALL, false));
                // The direction in which it began.
                let backward = BodyMotion::Scripted(Script::FallBackward);
                assert_eq!(select(&mut node, backward, NOWHERE), (FALL, false));
                assert_eq!(select(&mut node, RISE, NOWHERE), (RISE, true));
            }
        }
    }

    #[test]
    fn who_gets_up_goes_on_to_the_end_although_it_tilts_as_one_who_falls() {
        let mut node = node_in(FALL);
        assert_eq!(select(&mut node, RISE, NOWHERE), (RISE, true));
        assert_eq!(select(&mut node, FALL, NOWHERE), (RISE, true));
        let there = SafeExits {
            dispatch: true,
            ..NOWHERE
        };
        assert_eq!(select(&mut node, FALL, there), (RISE, false));
        for wanted in [FALL, RISE, BodyMotion::Stand] {
            assert_eq!(select(&mut node, wanted, NOWHERE), (RISE, false));
        }
        let stand = BodyMotion::Stand;
        assert_eq!(select(&mut node, stand, EVERYWHERE), (stand, true));
        // And once more if it still lies.
        let mut node = node_in(RISE);
        assert_eq!(select(&mut node, RISE, EVERYWHERE), (RISE, true));
        assert_eq!(select(&mut node_in(RISE), FALL, EVERYWHERE), (FALL, false));
    }

    #[test]
    fn a_catch_begins_at_once_but_not_in_the_midst_of_a_step() {
        let catch = BodyMotion::Scripted(Script::Catch);
        let stand = BodyMotion::Stand;
        let mut node = node_in(stand);
        assert_eq!(select(&mut node, catch, NOWHERE), (catch, false));
        assert_eq!(select(&mut node, stand, NOWHERE), (catch, false));
        assert_eq!(select(&mut node, stand, EVERYWHERE), (stand, true));
        let mut node = node_in(BodyMotion::Walk);
        assert_eq!(select(&mut node, catch, NOWHERE), (BodyMotion::Walk, false));
        assert_eq!(select(&mut node, catch, EVERYWHERE), (catch, false));
    }

    #[test]
    fn a_kick_that_was_begun_is_carried_out_once() {
        let mut node = node_in(BodyMotion::Stand);
        let stand = BodyMotion::Stand;
        assert_eq!(select(&mut node, KICK, NOWHERE), (KICK, true));
        assert_eq!(select(&mut node, stand, NOWHERE), (KICK, true));
        assert_eq!(select(&mut node, stand, EVERYWHERE), (KICK, false));
        assert_eq!(select(&mut node, stand, NOWHERE), (KICK, false));
        assert_eq!(select(&mut node, stand, EVERYWHERE), (stand, true));
    }

    #[test]
    fn a_kick_that_has_not_begun_is_left_by_who_is_penalized() {
        let mut node = node_in(BodyMotion::Stand);
        let out = BodyMotion::Penalized;
        assert_eq!(select(&mut node, KICK, NOWHERE), (KICK, true));
        assert_eq!(select(&mut node, out, NOWHERE), (KICK, true));
        assert_eq!(select(&mut node, out, EVERYWHERE), (out, true));
        assert_eq!(select(&mut node, out, EVERYWHERE), (out, false));
    }

    #[test]
    fn after_sitting_down_the_body_is_limp_and_stays_so() {
        let mut node = node_in(BodyMotion::SitDown);
        let limp = (BodyMotion::Unstiff, false);
        assert_eq!(select(&mut node, BodyMotion::SitDown, EVERYWHERE), limp);
        assert_eq!(select(&mut node, BodyMotion::SitDown, NOWHERE), limp);
    }

    #[test]
    fn limp_is_not_waited_for() {
        for current in [
            BodyMotion::SitDown,
            BodyMotion::Stand,
            BodyMotion::Penalized,
            BodyMotion::Walk,
            FALL,
            RISE,
            KICK,
        ] {
            for is_dispatching in [false, true] {
                let mut node = node_in(current);
                node.selection.is_dispatching = is_dispatching;
                let limp = (BodyMotion::Unstiff, false);
                assert_eq!(select(&mut node, BodyMotion::Unstiff, NOWHERE), limp);
            }
        }
    }
}
