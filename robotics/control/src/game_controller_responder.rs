//! Tells the referee's computer that this robot is alive, and where it believes itself and the ball.

use framework::{CycleTime, HardwareInterface, Parameter, RequiredInput, Result, context};
use hardware::MessageInterface;
use serde::{Deserialize, Serialize};
use spl_messages::return_data::{self, ReturnData};
use types::game::{GameControllerState, Player};
use types::team::TeamMessage;

use crate::pace::Pace;

/// RoboCup SPL rules 2025 allow two answers per second; in s.
const LEAST_INTERVAL: f32 = 0.5;

/// When it answered last.
#[derive(Debug, Deserialize, Serialize)]
pub struct GameControllerResponder {
    pace: Pace,
}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    hardware_interface: HardwareInterface,
    game_controller_state: RequiredInput<Option<GameControllerState>, "game_controller_state?">,
    report: RequiredInput<Option<TeamMessage>, "self_report?">,
    cycle_time: CycleTime,

    /// Who this robot is in the game.
    player: Parameter<Player, "player">,
    /// How much time passes between two answers.
    #[reflect(unit = "s", range = 0.0..)]
    interval: Parameter<f32, "game_controller_responder.interval">,
}

#[context]
pub struct MainOutputs {}

impl GameControllerResponder {
    /// Has answered nobody.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self {
            pace: Pace::default(),
        })
    }

    /// Called only while a referee's computer is heard.
    pub fn cycle(&mut self, context: CycleContext<impl MessageInterface>) -> Result<MainOutputs> {
        let now = context.cycle_time.start;
        if self.pace.is_due(now, *context.interval, LEAST_INTERVAL) {
            let answer = answer(context.report, *context.player);
            let sender = context.game_controller_state.sender;
            context
                .hardware_interface
                .send_to_game_controller(sender, &return_data::encode(&answer)?)?;
        }
        Ok(MainOutputs {})
    }
}

fn answer(report: &TeamMessage, player: Player) -> ReturnData {
    ReturnData {
        player_number: report.player_number,
        team_number: player.team,
        is_fallen: report.is_fallen,
        // The layout knows no robot that is lost: it stands in the middle of the field.
        ground_to_field: report.ground_to_field.unwrap_or_default(),
        ball: report.ball,
    }
}

#[cfg(test)]
mod tests {
    use std::sync::{Arc, Mutex};

    use framework::testing::cycle_time;
    use nalgebra::Point2;
    use types::network::Endpoint;
    use types::team::TeamBall;

    use super::*;

    #[derive(Default)]
    struct Network {
        answers: Mutex<Vec<(Endpoint, Vec<u8>)>>,
    }

    impl MessageInterface for Network {
        fn send_to_game_controller(&self, to: Endpoint, bytes: &[u8]) -> Result<()> {
            self.answers.lock().unwrap().push((to, bytes.to_vec()));
            Ok(())
        }

        fn send_to_team(&self, _bytes: &[u8]) -> Result<()> {
            Err(framework::Error::new("this is for the referee only"))
        }
    }

    const REFEREE: Endpoint = Endpoint {
        address: [10, 0, 0, 1],
        port: 4321,
    };

    fn node() -> GameControllerResponder {
        GameControllerResponder::new(CreationContext {}).unwrap()
    }

    fn cycle(
        node: &mut GameControllerResponder,
        network: &Arc<Network>,
        now: u64,
        player: Player,
        interval: f32,
    ) -> Result<()> {
        let context = CycleContext {
            hardware_interface: network,
            game_controller_state: &GameControllerState {
                sender: REFEREE,
                ..GameControllerState::default()
            },
            report: &TeamMessage {
                player_number: player.number,
                is_fallen: true,
                plays_ball: false,
                ground_to_field: None,
                ball: Some(TeamBall {
                    position: Point2::new(1.5, -0.5),
                    age: 0.5,
                }),
            },
            cycle_time: cycle_time(now, 12),
            player: &player,
            interval: &interval,
        };
        node.cycle(context).map(|_| ())
    }

    const PLAYER: Player = Player {
        number: 3,
        team: 77,
    };

    /// How many answers there are in 12 s of cycles.
    fn count(interval: f32) -> usize {
        let (mut node, network) = (node(), Arc::new(Network::default()));
        for index in 0..1000 {
            cycle(&mut node, &network, 12 * index, PLAYER, interval).unwrap();
        }
        network.answers.lock().unwrap().len()
    }

    #[test]
    fn the_sender_gets_an_answer_about_this_robot() {
        let (mut node, network) = (node(), Arc::new(Network::default()));
        cycle(&mut node, &network, 500, PLAYER, 1.0).unwrap();
        let answers = network.answers.lock().unwrap();
        let [(to, bytes)] = answers.as_slice() else {
            panic!("{answers:?}");
        };
        assert_eq!(*to, REFEREE);
        let number = |at: usize| f32::from_le_bytes(bytes[at..at + 4].try_into().unwrap());
        assert_eq!(bytes.len(), 32);
        assert_eq!(bytes[..8], *b"RGrt\x04\x03\x4d\x01");
        assert_eq!([8, 12, 16, 20].map(number), [0.0, 0.0, 0.0, 0.5]);
        assert_eq!([24, 28].map(number), [1500.0, -500.0]);
    }

    #[test]
    fn answers_come_at_the_wanted_rate_and_never_more_often_than_the_rules_allow() {
        assert_eq!(count(1.0), 12);
        assert_eq!(count(2.0), 6);
        for interval in [0.0, -1.0, f32::NAN] {
            assert_eq!(count(interval), 24, "every {interval} s");
        }
    }

    #[test]
    fn a_number_that_no_shirt_has_is_refused_no_more_often_than_an_answer_is_given() {
        let (mut node, network) = (node(), Arc::new(Network::default()));
        let nobody = Player {
            number: 0,
            team: 77,
        };
        assert!(cycle(&mut node, &network, 0, nobody, 1.0).is_err());
        assert!(cycle(&mut node, &network, 12, nobody, 1.0).is_ok());
        assert_eq!(*network.answers.lock().unwrap(), []);
    }
}
