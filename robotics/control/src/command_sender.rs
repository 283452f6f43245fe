//! Sends this cycle's command to the body, and never one that nobody decided on or that harms a joint.
//!
//! The collector limits what motions want; but a client may put anything in place of its command, and what is sent here is
//! what moves the robot.

use framework::{CycleTime, HardwareInterface, Input, RequiredInput, Result, context};
use hardware::ActuatorInterface;
use serde::{Deserialize, Serialize};
use types::joints::Joints;
use types::leds::Leds;
use types::motor_commands::MotorCommands;

use crate::motor_limits::harmless;

/// Lights stay as they were while nobody decides on them.
#[derive(Debug, Deserialize, Serialize)]
pub struct CommandSender {
    leds: Leds,
    sent: Option<MotorCommands>,
}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    hardware_interface: HardwareInterface,
    motor_commands: RequiredInput<Option<MotorCommands>, "motor_commands?">,
    leds: Input<Option<Leds>, "leds?">,
    positions: Input<Joints<f32>, "sensor_data.positions">,
    is_in_safe_state: Input<bool, "sensor_data.is_in_safe_state">,
    cycle_time: CycleTime,
}

#[context]
pub struct MainOutputs {}

impl CommandSender {
    /// Begins with dark lights.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self {
            leds: Leds::default(),
            sent: None,
        })
    }

    /// Called only where there is a command for the motors.
    pub fn cycle(&mut self, context: CycleContext<impl ActuatorInterface>) -> Result<MainOutputs> {
        if let Some(leds) = context.leds {
            self.leds = *leds;
        }
        if *context.is_in_safe_state {
            // The hardware has dropped it.
            self.sent = None;
        }
        let commands = harmless(
            context.motor_commands,
            self.sent.as_ref(),
            context.positions,
            context.cycle_time.since_last.as_secs_f32(),
            1.0,
        );
        context
            .hardware_interface
            .write_command(&commands, &self.leds)?;
        self.sent = Some(commands);
        Ok(MainOutputs {})
    }
}

#[cfg(test)]
mod tests {
    use std::sync::{Arc, Mutex};

    use framework::testing;
    use kinematics::limits;
    use types::joints::JointName;
    use types::leds::Color;

    use super::*;

    #[derive(Default)]
    struct Body {
        commands: Mutex<Vec<(MotorCommands, Leds)>>,
    }

    impl ActuatorInterface for Body {
        fn write_command(&self, motors: &MotorCommands, leds: &Leds) -> Result<()> {
            self.commands.lock().unwrap().push((*motors, *leds));
            Ok(())
        }
    }

    /// What a body at 0.1 rad gets of these commands, one per cycle.
    fn send(commands: &[(MotorCommands, Option<Leds>)]) -> Vec<(MotorCommands, Leds)> {
        let mut node = CommandSender::new(CreationContext {}).unwrap();
        let body = Arc::new(Body::default());
        for (motors, leds) in commands {
            let context = CycleContext {
                hardware_interface: &body,
                motor_commands: motors,
                leds: leds.as_ref(),
                positions: &start(),
                is_in_safe_state: &false,
                cycle_time: testing::cycle_time(0, 12),
            };
            node.cycle(context).unwrap();
        }
        body.commands.lock().unwrap().clone()
    }

    fn start() -> Joints<f32> {
        Joints::from_fn(|joint| limits::clamp(joint, 0.1))
    }

    #[test]
    fn what_was_decided_is_sent_and_lights_stay() {
        let motors = MotorCommands::holding(start(), 0.5);
        let leds = Leds {
            chest: Color::new(1.0, 0.0, 0.0),
            ..Leds::default()
        };
        let sent = send(&[(motors, Some(leds)), (motors, None)]);
        assert_eq!(sent, [(motors, leds), (motors, leds)]);
    }

    #[test]
    fn whatever_is_put_in_place_of_the_command_no_joint_is_harmed() {
        for absurd in [1e30, -1e30, f32::INFINITY, f32::NAN] {
            let commands = [(MotorCommands::holding(Joints::filled(absurd), 1.0), None); 100];
            let mut last = start();
            for (sent, _) in send(&commands) {
                for (joint, angle) in sent.positions.iter() {
                    let most = limits::of(joint).velocity as f32 * 0.012;
                    let way = (angle - last[joint]).abs();
                    // The head's pitch gives way to its shell.
                    assert!(
                        way <= most * 1.001 || joint == JointName::HeadPitch,
                        "{joint:?}"
                    );
                    assert_eq!(*angle, limits::clamp(joint, *angle), "{joint:?}");
                }
                last = sent.positions;
            }
            assert_eq!(last == start(), absurd.is_nan());
        }
    }

    #[test]
    fn what_the_hardware_has_dropped_was_not_sent() {
        let mut node = CommandSender::new(CreationContext {}).unwrap();
        let body = Arc::new(Body::default());
        let motors = MotorCommands::holding(start(), 0.8);
        let mut collapsed = start();
        collapsed.left_knee_pitch = 2.1;
        for (positions, is_in_safe_state) in
            [(start(), false), (collapsed, true), (collapsed, false)]
        {
            let context = CycleContext {
                hardware_interface: &body,
                motor_commands: &motors,
                leds: None,
                positions: &positions,
                is_in_safe_state: &is_in_safe_state,
                cycle_time: testing::cycle_time(0, 12),
            };
            node.cycle(context).unwrap();
        }
        let (last, _) = body.commands.lock().unwrap()[2];
        let most = limits::of(JointName::LeftKneePitch).velocity as f32 * 0.012;
        let way = collapsed.left_knee_pitch - last.positions.left_knee_pitch;
        assert!((0.0..=most * 2.001).contains(&way), "{way}");
    }
}
