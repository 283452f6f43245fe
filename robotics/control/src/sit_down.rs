//! Lets the robot down: from a crouch onto its heels, then limp, so gently that nothing drops.

use framework::{CycleTime, CyclerState, Input, MainOutput, Parameter, Result, context};
use serde::{Deserialize, Serialize};
use types::joints::Joints;
use types::motion::{BodyMotion, MotionSelection};
use types::motor_commands::MotorCommands;

use crate::transition;

/// How far the robot is down.
#[derive(Debug, Deserialize, Serialize)]
pub struct SitDown {
    /// In s since the crouch; `None` while another motion has the body.
    elapsed: Option<f32>,
}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    motion_selection: Input<MotionSelection, "motion_selection">,
    cycle_time: CycleTime,
    /// Whether the robot is down and limp.
    safe_exit: CyclerState<bool, "safe_exits.sit_down">,

    /// The pose where sitting down begins, in rad.
    crouch: Parameter<Joints<f32>, "sit_down.crouch">,
    /// The pose where it ends, in rad.
    sitting: Parameter<Joints<f32>, "sit_down.sitting">,
    /// Stiffness of every joint until the robot sits, 0 (limp) to 1.
    #[reflect(range = 0.0..=1.0)]
    stiffness: Parameter<f32, "sit_down.stiffness">,
    /// Share of every joint's greatest speed that the motion may take.
    velocity_share: Parameter<f32, "sit_down.velocity_share">,
    /// The way from the crouch to the ground takes at least so long.
    #[reflect(unit = "s", range = 0.0..)]
    minimum_duration: Parameter<f32, "sit_down.minimum_duration">,
    /// How long the stiffness takes to fade.
    #[reflect(unit = "s", range = 0.0..)]
    release_duration: Parameter<f32, "sit_down.release_duration">,
}

#[context]
pub struct MainOutputs {
    /// For all joints; `None` while another motion has the body.
    sit_down_commands: MainOutput<Option<MotorCommands>>,
}

impl SitDown {
    /// Nothing to prepare.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self { elapsed: None })
    }

    /// The next pose on the way down, then less and less stiffness.
    pub fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs> {
        if !context.motion_selection.is_at(BodyMotion::SitDown) {
            self.elapsed = None;
            *context.safe_exit = false;
            return Ok(MainOutputs {
                sit_down_commands: None.into(),
            });
        }
        let since_last = context.cycle_time.since_last.as_secs_f32();
        let elapsed = self.elapsed.map_or(0.0, |elapsed| elapsed + since_last);
        self.elapsed = Some(elapsed);

        let (crouch, sitting) = (context.crouch, context.sitting);
        let duration = transition::duration(crouch, sitting, *context.velocity_share)
            .max(*context.minimum_duration);
        let lowered = transition::progress(elapsed, duration);
        let released = match lowered {
            1.0 => transition::progress(elapsed - duration, *context.release_duration),
            _ => 0.0,
        };
        *context.safe_exit = released == 1.0;
        let commands = MotorCommands::holding(
            transition::pose(crouch, sitting, lowered),
            *context.stiffness * (1.0 - released),
        );
        Ok(MainOutputs {
            sit_down_commands: Some(commands).into(),
        })
    }
}

#[cfg(test)]
mod tests {
    use framework::testing;

    use super::*;

    fn cycle(node: &mut SitDown, is_dispatching: bool) -> (Option<MotorCommands>, bool) {
        let mut safe_exit = false;
        let motion_selection = MotionSelection {
            current: BodyMotion::SitDown,
            is_dispatching,
        };
        let context = CycleContext {
            motion_selection: &motion_selection,
            cycle_time: testing::cycle_time(0, 12),
            safe_exit: &mut safe_exit,
            crouch: &Joints::filled(0.2),
            sitting: &Joints::filled(0.5),
            stiffness: &0.8,
            velocity_share: &0.25,
            minimum_duration: &1.0,
            release_duration: &1.0,
        };
        let commands = node.cycle(context).unwrap().sit_down_commands.value;
        (commands, safe_exit)
    }

    fn node() -> SitDown {
        SitDown::new(CreationContext {}).unwrap()
    }

    #[test]
    fn it_begins_in_the_crouch_each_time() {
        let mut node = node();
        for _ in 0..2 {
            assert_eq!(cycle(&mut node, true), (None, false));
            let (commands, safe_exit) = cycle(&mut node, false);
            assert_eq!(commands.unwrap().positions, Joints::filled(0.2));
            assert!(!safe_exit);
            for _ in 0..30 {
                cycle(&mut node, false);
            }
        }
    }

    #[test]
    fn the_robot_gets_limp_within_a_second_after_it_sits_and_not_before() {
        let mut node = node();
        let mut limp_after = None;
        for step in 0..200 {
            let (commands, safe_exit) = cycle(&mut node, false);
            let MotorCommands {
                positions,
                stiffnesses,
            } = commands.unwrap();
            let sits = positions == Joints::filled(0.5);
            assert!(sits || stiffnesses.left_knee_pitch == 0.8);
            assert_eq!(safe_exit, stiffnesses.left_knee_pitch == 0.0);
            if safe_exit && limp_after.is_none() {
                limp_after = Some(step);
            }
        }
        // Two seconds of 12 ms cycles.
        assert_eq!(limp_after, Some(167));
    }

    #[test]
    fn stiffness_fades_without_steps() {
        let mut node = node();
        let mut last = 0.8;
        for _ in 0..200 {
            let (commands, _) = cycle(&mut node, false);
            let stiffness = commands.unwrap().stiffnesses.left_knee_pitch;
            assert!((0.0..0.0101).contains(&(last - stiffness)), "{stiffness}");
            last = stiffness;
        }
    }
}
