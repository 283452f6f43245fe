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
}
