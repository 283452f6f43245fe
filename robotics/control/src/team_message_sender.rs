//! Tells the own team what this robot knows, as often as the referee lets a team talk.
//!
//! A team has a budget of messages for the game, and loses all its goals where it sends more. Only the
//! referee's computer knows what is left: while none is heard, nothing is sent.

use framework::{CycleTime, HardwareInterface, Parameter, RequiredInput, Result, context};
use hardware::MessageInterface;
use serde::{Deserialize, Serialize};
use spl_messages::team_message;
use types::game::GameControllerState;
use types::team::TeamMessage;

use crate::pace::Pace;

/// Whatever the parameters say, a robot does not talk more often, in s.
const LEAST_INTERVAL: f32 = 1.0;

/// When it sent last.
#[derive(Debug, Deserialize, Serialize)]
pub struct TeamMessageSender {
    pace: Pace,
}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    hardware_interface: HardwareInterface,
    game_controller_state: RequiredInput<Option<GameControllerState>, "game_controller_state?">,
    report: RequiredInput<Option<TeamMessage>, "team_report?">,
    cycle_time: CycleTime,

    /// How much time passes between two messages.
    #[reflect(unit = "s", range = 0.0..)]
    interval: Parameter<f32, "team_message_sender.interval">,
    /// How many messages of the team's budget are never sent.
    reserve: Parameter<u16, "team_message_sender.reserve">,
}

#[context]
pub struct MainOutputs {}

impl TeamMessageSender {
    /// Has sent nothing.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self {
            pace: Pace::default(),
        })
    }

    /// Called only while a referee's computer is heard and this robot is in the game.
    pub fn cycle(&mut self, context: CycleContext<impl MessageInterface>) -> Result<MainOutputs> {
        let now = context.cycle_time.start;
        let budget = context.game_controller_state.message_budget;
        if budget > *context.reserve && self.pace.is_due(now, *context.interval, LEAST_INTERVAL) {
            let mut room = [0; team_message::GREATEST_LENGTH];
            let bytes = team_message::encode(context.report, &mut room)?;
            context.hardware_interface.send_to_team(bytes)?;
        }
        Ok(MainOutputs {})
    }
}

#[cfg(test)]
mod tests {
    use std::sync::{Arc, Mutex};

    use framework::testing::cycle_time;
    use types::network::Endpoint;

    use super::*;

    #[derive(Default)]
    struct Network {
        messages: Mutex<Vec<Vec<u8>>>,
    }

    impl MessageInterface for Network {
        fn send_to_game_controller(&self, _to: Endpoint, _bytes: &[u8]) -> Result<()> {
            Err(framework::Error::new("this is for the team only"))
        }

        fn send_to_team(&self, bytes: &[u8]) -> Result<()> {
            self.messages.lock().unwrap().push(bytes.to_vec());
            Ok(())
        }
    }

    /// What is sent in 60 s of cycles.
    fn messages(message_budget: u16, interval: f32) -> Vec<Vec<u8>> {
        let mut node = TeamMessageSender::new(CreationContext {}).unwrap();
        let network = Arc::new(Network::default());
        for index in 0..5000 {
            let context = CycleContext {
                hardware_interface: &network,
                game_controller_state: &GameControllerState {
                    message_budget,
                    ..GameControllerState::default()
                },
                report: &TeamMessage {
                    player_number: 3,
                    ..TeamMessage::default()
                },
                cycle_time: cycle_time(12 * index, 12),
                interval: &interval,
                reserve: &30,
            };
            node.cycle(context).unwrap();
        }
        network.messages.lock().unwrap().clone()
    }

    #[test]
    fn the_team_hears_a_message_now_and_then() {
        let messages = messages(1200, 7.0);
        assert_eq!(messages.len(), 9);
        for bytes in messages {
            let message = team_message::decode(&bytes).unwrap();
            assert_eq!(message.player_number, 3);
            assert!(bytes.len() <= 128, "{bytes:?}");
        }
    }

    #[test]
    fn the_reserve_of_the_budget_is_not_touched() {
        assert_eq!(messages(31, 7.0).len(), 9);
        assert_eq!(messages(30, 7.0).len(), 0);
        assert_eq!(messages(0, 7.0).len(), 0);
    }

    #[test]
    fn no_parameter_makes_a_robot_chatter() {
        for interval in [0.0, -1.0, f32::NAN] {
            // One a second, at the first of the 12 ms cycles that is late enough.
            assert_eq!(messages(1200, interval).len(), 60, "every {interval} s");
        }
    }
}
