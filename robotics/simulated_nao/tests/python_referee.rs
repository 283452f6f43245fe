//! Lets a robot in Python, with the published layouts, talk to the simulated referee's computer.

use std::io::{BufRead, BufReader, Read};
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use framework::Clock;
use framework::testing::skip;
use nalgebra::{Isometry2, Point2, Vector2};
use simulated_nao::Simulator;
use simulated_nao::settings::{Announcement, Settings};
use spl_messages::{ReturnData, return_data};
use types::game::{GameState, KickingTeam, Penalty, SetPlay};
use types::team::TeamBall;

const NAME: &str = "a_python_robot_understands_control_data_and_is_understood";

/// Every kind of field has a value of its own.
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
            ..Announcement::of(1.0, GameState::Ready)
        },
        Announcement {
            penalty: Penalty::IllegalPositionInSet,
            kicking_team: KickingTeam::Nobody,
            ..Announcement::of(2.0, GameState::Set)
        },
    ];
    settings
}

fn return_data_in_hex() -> String {
    let data = ReturnData {
        player_number: 4,
        team_number: 24,
        is_fallen: true,
        ground_to_field: Isometry2::new(Vector2::new(-1.5, 0.25), 0.5),
        ball: Some(TeamBall {
            position: Point2::new(2.0, -0.125),
            age: 1.5,
        }),
    };
    let bytes = return_data::encode(&data).unwrap();
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

#[test]
fn a_python_robot_understands_control_data_and_is_understood() {
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/python_referee.py");
    let robot = Command::new("python3")
        .arg(script)
        .arg(return_data_in_hex())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn();
    let Ok(mut robot) = robot else {
        return skip(NAME, "install python3");
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
    while counts().rejected < answers && begun.elapsed() < Duration::from_secs(5) {
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
