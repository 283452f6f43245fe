//! Tells the own team what this robot knows, as often as the referee lets a team talk.
//!
//! A team has a budget of messages for the game, and loses all its goals where it sends more. Only the
//! referee's computer knows what is left: while none is heard, nothing is sent, and where less is left than
//! the usual pace needs until the end of the game, the pace is slower.

use framework::{CycleTime, HardwareInterface, Parameter, RequiredInput, Result, context};
use hardware::MessageInterface;
use serde::{Deserialize, Serialize};
use spl_messages::team_message;
use types::game::GameControllerState;
use types::team::TeamMessage;

use crate::pace::Pace;
use crate::team_rhythm::TeamRhythm;

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

    rhythm: Parameter<TeamRhythm, "team_rhythm">,
    /// Whatever the rhythm of the team, this robot does not talk more often.
    #[reflect(unit = "s", range = 1.0..)]
    least_interval: Parameter<f32, "team_message_sender.least_interval">,
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
        let referee = context.game_controller_state;
        let rhythm = context.rhythm;
        let is_left = rhythm.left(referee) > 0;
        if is_left
            && self
                .pace
                .is_due(now, rhythm.interval(referee), *context.least_interval)
        {
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
    use types::game::Penalty;
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
        let referee = GameControllerState {
            message_budget,
            ..GameControllerState::default()
        };
        messages_in(&referee, interval)
    }

    fn messages_in(referee: &GameControllerState, interval: f32) -> Vec<Vec<u8>> {
        let mut node = TeamMessageSender::new(CreationContext {}).unwrap();
        let network = Arc::new(Network::default());
        for index in 0..5000 {
            let context = CycleContext {
                hardware_interface: &network,
                game_controller_state: referee,
                report: &TeamMessage {
                    player_number: 3,
                    ..TeamMessage::default()
                },
                cycle_time: cycle_time(12 * index, 12),
                rhythm: &TeamRhythm {
                    interval,
                    reserve: 30,
                    half: 600.0,
                },
                least_interval: &1.0,
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
    fn what_is_left_lasts_until_the_end_of_the_game() {
        for (is_first_half, seconds_remaining, message_budget, count) in [
            // Seven robots in 1200 s: one each 7.2 s.
            (true, 600, 1200, 9),
            // 60 s of the game for each robot's message, then 20 s, then 600 s.
            (true, 0, 100, 1),
            (false, 200, 100, 3),
            (true, 600, 44, 1),
            // More than enough, and the time is up.
            (false, 60, 1200, 9),
            (false, -20, 31, 9),
        ] {
            let mut referee = GameControllerState {
                message_budget,
                is_first_half,
                seconds_remaining,
                ..GameControllerState::default()
            };
            referee.own_penalties[7..].fill(Penalty::Substitute);
            referee.own_penalties[3] = Penalty::PlayerPushing;
            let sent = messages_in(&referee, 7.0).len();
            assert_eq!(
                sent, count,
                "{is_first_half} {seconds_remaining} {message_budget}"
            );
        }
    }

    #[test]
    fn no_parameter_makes_a_robot_chatter() {
        for interval in [0.0, -1.0, f32::NAN] {
            // One a second, at the first of the 12 ms cycles that is late enough.
            assert_eq!(messages(1200, interval).len(), 60, "every {interval} s");
        }
    }
}
