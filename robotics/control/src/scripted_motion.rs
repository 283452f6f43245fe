//! Plays motions that stand in the parameter files, pose by pose: getting up, kicks, and what protects a robot that falls.

use framework::{
    CycleTime, CyclerState, Input, MainOutput, Parameter, PreviousInput, Result, context,
};
use keyframes::Motions;
use serde::{Deserialize, Serialize};
use types::joints::Joints;
use types::motion::{BodyMotion, MotionSelection, Script};
use types::motor_commands::MotorCommands;

use crate::transition;

/// What is played.
#[derive(Debug, Deserialize, Serialize)]
pub struct ScriptedMotion {
    playing: Option<Playing>,
}

/// Which motion, from where, and for how long already.
#[derive(Clone, Copy, Debug, Deserialize, Serialize)]
struct Playing {
    script: Script,
    /// In rad.
    from: Joints<f32>,
    /// In s.
    elapsed: f32,
}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    motion_selection: Input<MotionSelection, "motion_selection">,
    positions: Input<Joints<f32>, "sensor_data.positions">,
    previous: PreviousInput<Option<MotorCommands>, "motor_commands?">,
    cycle_time: CycleTime,
    /// Whether the motion is over.
    safe_exit: CyclerState<bool, "safe_exits.script">,

    /// All of them.
    motions: Parameter<Motions, "motions">,
}

#[context]
pub struct MainOutputs {
    /// For all joints; `None` while another motion has the body.
    script_commands: MainOutput<Option<MotorCommands>>,
}

impl ScriptedMotion {
    /// Nothing is played.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self { playing: None })
    }

    /// The pose of this moment.
    pub fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs> {
        let selection = context.motion_selection;
        let BodyMotion::Scripted(script) = selection.current else {
            return Ok(self.rest(context.safe_exit));
        };
        if selection.is_dispatching {
            return Ok(self.rest(context.safe_exit));
        }
        let playing = match self.playing {
            Some(playing) if playing.script == script => Playing {
                elapsed: playing.elapsed + context.cycle_time.since_last.as_secs_f32(),
                ..playing
            },
            _ => Playing {
                script,
                from: transition::current_pose(context.previous, context.positions),
                elapsed: 0.0,
            },
        };
        self.playing = Some(playing);
        let motion = context.motions.of(script);
        *context.safe_exit = playing.elapsed >= motion.duration();
        Ok(MainOutputs {
            script_commands: Some(motion.at(playing.elapsed, &playing.from)).into(),
        })
    }

    fn rest(&mut self, safe_exit: &mut bool) -> MainOutputs {
        self.playing = None;
        *safe_exit = false;
        MainOutputs {
            script_commands: None.into(),
        }
    }
}

#[cfg(test)]
mod tests {
    use framework::testing::{self, ParameterFile};

    use super::*;

    fn motions() -> Motions {
        ParameterFile::new(include_str!("../../parameters/default.toml")).get("motions")
    }

    fn cycle(
        node: &mut ScriptedMotion,
        motions: &Motions,
        script: Script,
        is_dispatching: bool,
    ) -> (Option<MotorCommands>, bool) {
        let mut safe_exit = true;
        let motion_selection = MotionSelection {
            current: BodyMotion::Scripted(script),
            is_dispatching,
        };
        let context = CycleContext {
            motion_selection: &motion_selection,
            positions: &Joints::filled(0.1),
            previous: None,
            cycle_time: testing::cycle_time(0, 12),
            safe_exit: &mut safe_exit,
            motions,
        };
        let commands = node.cycle(context).unwrap().script_commands.value;
        (commands, safe_exit)
    }

    #[test]
    fn every_motion_is_played_from_where_the_body_is_to_its_end_each_time() {
        let motions = motions();
        for script in Script::ALL {
            let mut node = ScriptedMotion::new(CreationContext {}).unwrap();
            let motion = motions.of(script);
            for _ in 0..2 {
                assert_eq!(cycle(&mut node, &motions, script, true), (None, false));
                let (commands, is_over) = cycle(&mut node, &motions, script, false);
                assert_eq!(commands.unwrap().positions, Joints::filled(0.1));
                assert!(!is_over);
                let cycles = (0..5000)
                    .take_while(|_| !cycle(&mut node, &motions, script, false).1)
                    .count();
                let seconds = 0.012 * cycles as f32;
                assert!(
                    (seconds - motion.duration()).abs() < 0.025,
                    "{script:?} {seconds}"
                );
                let (commands, _) = cycle(&mut node, &motions, script, false);
                assert_eq!(commands, Some(motion.at(100.0, &Joints::filled(0.0))));
            }
        }
    }

    #[test]
    fn another_motion_begins_at_its_beginning() {
        let motions = motions();
        let mut node = ScriptedMotion::new(CreationContext {}).unwrap();
        for _ in 0..5000 {
            cycle(&mut node, &motions, Script::StandUpFront, false);
        }
        let (commands, is_over) = cycle(&mut node, &motions, Script::FallBackward, false);
        assert_eq!(commands.unwrap().positions, Joints::filled(0.1));
        assert!(!is_over);
    }
}
