//! Holds the pose from which a robot can do everything else: knees bent, arms out of the way.

use framework::{Input, MainOutput, Parameter, Result, context};
use serde::{Deserialize, Serialize};
use types::joints::Joints;
use types::motion::{BodyMotion, MotionSelection};
use types::motor_commands::MotorCommands;

/// Keeps nothing between cycles.
#[derive(Debug, Deserialize, Serialize)]
pub struct Stand {}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    motion_selection: Input<MotionSelection, "motion_selection">,

    /// The pose to hold, in rad.
    positions: Parameter<Joints<f32>, "stand.positions">,
    /// Stiffness of every joint, 0 (limp) to 1.
    #[reflect(range = 0.0..=1.0)]
    stiffness: Parameter<f32, "stand.stiffness">,
}

#[context]
pub struct MainOutputs {
    /// For all joints; `None` while another motion has the body.
    stand_commands: MainOutput<Option<MotorCommands>>,
}

impl Stand {
    /// Nothing to prepare.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self {})
    }

    /// The pose, while it is selected and reached.
    pub fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs> {
        let has_body = context.motion_selection.is_at(BodyMotion::Stand);
        Ok(MainOutputs {
            stand_commands: has_body
                .then(|| MotorCommands::holding(*context.positions, *context.stiffness))
                .into(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn commands(current: BodyMotion, is_dispatching: bool) -> Option<MotorCommands> {
        let mut node = Stand::new(CreationContext {}).unwrap();
        let motion_selection = MotionSelection {
            current,
            is_dispatching,
        };
        let context = CycleContext {
            motion_selection: &motion_selection,
            positions: &Joints::filled(0.2),
            stiffness: &0.8,
        };
        node.cycle(context).unwrap().stand_commands.value
    }

    #[test]
    fn the_pose_is_held_while_it_is_selected() {
        let held = MotorCommands {
            positions: Joints::filled(0.2),
            stiffnesses: Joints::filled(0.8),
        };
        assert_eq!(commands(BodyMotion::Stand, false), Some(held));
    }

    #[test]
    fn nothing_is_commanded_before_the_pose_is_reached_or_while_another_motion_has_the_body() {
        assert_eq!(commands(BodyMotion::Stand, true), None);
        assert_eq!(commands(BodyMotion::Penalized, false), None);
    }
}
