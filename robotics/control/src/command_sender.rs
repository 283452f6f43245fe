//! Sends this cycle's command to the body, and never one that nobody decided on.

use framework::{HardwareInterface, Input, RequiredInput, Result, context};
use hardware::ActuatorInterface;
use serde::{Deserialize, Serialize};
use types::leds::Leds;
use types::motor_commands::MotorCommands;

/// Lights stay as they were while nobody decides on them.
#[derive(Debug, Deserialize, Serialize)]
pub struct CommandSender {
    leds: Leds,
}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    hardware_interface: HardwareInterface,
    motor_commands: RequiredInput<Option<MotorCommands>, "motor_commands?">,
    leds: Input<Option<Leds>, "leds?">,
}

#[context]
pub struct MainOutputs {}

impl CommandSender {
    /// Begins with dark lights.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self {
            leds: Leds::default(),
        })
    }

    /// Called only where there is a command for the motors.
    pub fn cycle(&mut self, context: CycleContext<impl ActuatorInterface>) -> Result<MainOutputs> {
        if let Some(leds) = context.leds {
            self.leds = *leds;
        }
        context
            .hardware_interface
            .write_command(context.motor_commands, &self.leds)?;
        Ok(MainOutputs {})
    }
}

#[cfg(test)]
mod tests {
    use std::sync::{Arc, Mutex};

    use types::joints::Joints;
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

    #[test]
    fn what_was_decided_is_sent_and_lights_stay() {
        let mut node = CommandSender::new(CreationContext {}).unwrap();
        let body = Arc::new(Body::default());
        let motors = MotorCommands {
            positions: Joints::filled(0.1),
            stiffnesses: Joints::filled(0.5),
        };
        let leds = Leds {
            chest: Color::new(1.0, 0.0, 0.0),
            ..Leds::default()
        };
        for leds in [Some(&leds), None] {
            let context = CycleContext {
                hardware_interface: &body,
                motor_commands: &motors,
                leds,
            };
            node.cycle(context).unwrap();
        }
        assert_eq!(
            *body.commands.lock().unwrap(),
            [(motors, leds), (motors, leds)]
        );
    }
}
