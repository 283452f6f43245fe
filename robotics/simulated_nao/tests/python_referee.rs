//! Lets a robot in Python, with the published layouts, talk to the simulated referee's computer.

use std::io::{BufRead, BufReader, ErrorKind, Read};
use std::path::Path;
use std::process::{Command, Stdio};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use control::game_controller_responder::{self, GameControllerResponder};
use control::team_message_sender::{self, TeamMessageSender};
use control::team_rhythm::TeamRhythm;
use framework::testing::{cycle_time, skip};
use framework::{Clock, Result};
use hardware::MessageInterface;
use nalgebra::{Isometry2, Point2, Vector2};
use simulated_nao::Simulator;
use simulated_nao::settings::{Announcement, Settings};
use spl_messages::control_data;
use types::game::{
    CompetitionPhase, CompetitionType, GameControllerMessage, GameControllerState, GamePhase,
    GameState, KickingTeam, Penalty, Player, PlayerState, SetPlay, TeamColor, TeamState,
};
use types::network::Endpoint;
use types::team::{TeamBall, TeamMessage};

const NAME: &str = "a_python_robot_understands_control_data_and_is_understood";

/// A game of three states.
fn settings(control_port: u16) -> Settings {
    let mut settings = Settings::default();
    settings.network.control_port = control_port;
    settings.network.mate = false;
    settings.game.team = 24;
    settings.game.opponent = 200;
    settings.game.player_number = 4;
    settings.game.schedule = vec![
        Announcement::of(0.0, GameState::Initial),
        Announcement {
            set_play: SetPlay::PenaltyKick,
            kicking_team: KickingTeam::Opponent,
            ..Announcement::of(3.0, GameState::Ready)
        },
        Announcement {
            penalty: Penalty::IllegalPositionInSet,
            kicking_team: KickingTeam::Nobody,
            ..Announcement::of(5.0, GameState::Set)
        },
    ];
    settings
}

/// Every field has a value of its own that is not 0.
fn every_field() -> GameControllerMessage {
    let mut own = TeamState {
        number: 24,
        field_player_color: TeamColor::Yellow,
        goalkeeper_color: TeamColor::Purple,
        goalkeeper: 11,
        score: 12,
        penalty_shot: 13,
        single_shots: 0x1234,
        message_budget: 1111,
        ..TeamState::default()
    };
    let mut other = TeamState {
        number: 200,
        field_player_color: TeamColor::Brown,
        goalkeeper_color: TeamColor::Gray,
        goalkeeper: 14,
        score: 15,
        penalty_shot: 16,
        single_shots: 0x5678,
        message_budget: 2222,
        ..TeamState::default()
    };
    for (number, team) in [(1, &mut own), (101, &mut other)] {
        for (player, seconds) in team.players.iter_mut().zip(number..) {
            *player = PlayerState {
                penalty: Penalty::PlayerStance,
                seconds_till_unpenalized: seconds,
            };
        }
    }
    GameControllerMessage {
        packet_number: 77,
        players_per_team: 7,
        competition_phase: CompetitionPhase::Playoff,
        competition_type: CompetitionType::MostPasses,
        game_phase: GamePhase::Overtime,
        game_state: GameState::Finished,
        set_play: SetPlay::KickIn,
        is_first_half: true,
        kicking_team: Some(99),
        seconds_remaining: -258,
        secondary_seconds: 513,
        teams: [own, other],
    }
}

/// Keeps what the robot's own nodes send.
#[derive(Default)]
struct Sent {
    to_game_controller: Mutex<Vec<u8>>,
    to_team: Mutex<Vec<u8>>,
}

impl MessageInterface for Sent {
    fn send_to_game_controller(&self, _to: Endpoint, bytes: &[u8]) -> Result<()> {
        *self.to_game_controller.lock().unwrap() = bytes.to_vec();
        Ok(())
    }

    fn send_to_team(&self, bytes: &[u8]) -> Result<()> {
        *self.to_team.lock().unwrap() = bytes.to_vec();
        Ok(())
    }
}

/// What the robot's own nodes tell the referee's computer and the team.
fn told() -> [Vec<u8>; 2] {
    let report = TeamMessage {
        player_number: 4,
        is_fallen: true,
        plays_ball: false,
        ground_to_field: Some(Isometry2::new(Vector2::new(-1.5, 0.25), 0.5)),
        ball: Some(TeamBall {
            position: Point2::new(2.0, -0.125),
            age: 1.5,
        }),
    };
    let game_controller_state = GameControllerState {
        message_budget: 1200,
        ..GameControllerState::default()
    };
    let sent = Arc::new(Sent::default());
    let mut responder =
        GameControllerResponder::new(game_controller_responder::CreationContext {}).unwrap();
    let context = game_controller_responder::CycleContext {
        hardware_interface: &sent,
        game_controller_state: &game_controller_state,
        report: &report,
        cycle_time: cycle_time(12, 12),
        player: &Player {
            number: 4,
            team: 24,
        },
        interval: &1.0,
    };
    responder.cycle(context).unwrap();
    let mut sender = TeamMessageSender::new(team_message_sender::CreationContext {}).unwrap();
    let context = team_message_sender::CycleContext {
        hardware_interface: &sent,
        game_controller_state: &game_controller_state,
        report: &report,
        cycle_time: cycle_time(12, 12),
        rhythm: &TeamRhythm {
            interval: 7.0,
            reserve: 0,
            half: 600.0,
        },
        least_interval: &1.0,
    };
    sender.cycle(context).unwrap();
    [&sent.to_game_controller, &sent.to_team].map(|bytes| bytes.lock().unwrap().clone())
}

fn in_hex(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

#[test]
fn a_python_robot_understands_control_data_and_is_understood() {
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/python_referee.py");
    let [return_data, team_message] = told();
    let robot = Command::new("python3")
        .arg(script)
        .args(
            [
                return_data,
                team_message,
                control_data::encode(&every_field()).to_vec(),
            ]
            .map(|bytes| in_hex(&bytes)),
        )
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn();
    let mut robot = match robot {
        Err(error) if error.kind() == ErrorKind::NotFound => {
            return skip(NAME, "install python3");
        }
        robot => robot.expect("python3 is installed, so it can be started"),
    };
    let mut lines = BufReader::new(robot.stdout.take().unwrap()).lines();
    let mut number = || {
        let line = lines.next().and_then(Result::ok);
        line.and_then(|line| line.trim().parse::<u16>().ok())
    };
    let port = number();
    let simulator = port.map(|port| Simulator::start(&settings(port), Clock::wall()).unwrap());
    let answers = number();
    let mut complaint = String::new();
    let mut stderr = robot.stderr.take().unwrap();
    stderr.read_to_string(&mut complaint).unwrap();
    assert!(robot.wait().unwrap().success(), "{complaint}");

    let (simulator, answers) = (simulator.unwrap(), u64::from(answers.unwrap()));
    let begun = Instant::now();
    let counts = || simulator.network_truth().return_data_counts;
    while counts().rejected < answers && begun.elapsed() < Duration::from_secs(20) {
        std::thread::sleep(Duration::from_millis(10));
    }
    let truth = simulator.network_truth();
    assert_eq!(counts().accepted, answers);
    assert_eq!(counts().rejected, answers);
    let data = truth.return_data[0].message;
    assert_eq!(
        (data.player_number, data.is_fallen, data.ball),
        (4, false, None)
    );
    let pose = data.ground_to_field;
    assert!((pose.translation.vector - Vector2::new(-3.0, 0.001)).norm() < 1e-6);
    assert!((pose.rotation.angle() + 0.25).abs() < 1e-6);
}
