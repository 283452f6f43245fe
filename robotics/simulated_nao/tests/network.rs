//! The simulated network with the wall clock: everything travels through real UDP sockets.

use std::net::UdpSocket;
use std::time::{Duration, Instant};

use framework::{Clock, Hardware as _, HardwareContext, Stop};
use hardware::{MessageInterface, NetworkInterface};
use simulated_nao::Hardware;
use spl_messages::{ReturnData, control_data, return_data, team_message};
use types::game::GameState;
use types::network::{Channel, Datagram};
use types::team::TeamMessage;

const PATIENCE: Duration = Duration::from_secs(20);

fn create(options: &[&str]) -> Hardware {
    create_with(options, "")
}

/// With these settings of `[hardware.simulated]`.
fn create_with(options: &[&str], table: &str) -> Hardware {
    Hardware::new(HardwareContext {
        // These tests are about what the hardware says when; the bodies have tests of their own.
        options: ["--physics", "kinematic"]
            .iter()
            .chain(options)
            .map(|&option| option.to_owned())
            .collect(),
        table: table.parse().unwrap(),
        run_folder: std::env::temp_dir(),
        clock: Clock::wall(),
        stop: Stop::new(),
    })
    .unwrap()
}

/// The next datagram that is wanted.
fn read(hardware: &Hardware, is_wanted: impl Fn(&Datagram) -> bool) -> Datagram {
    let begun = Instant::now();
    let mut datagram = Datagram::default();
    while begun.elapsed() < PATIENCE {
        match hardware.read_datagram(&mut datagram) {
            Ok(_) if is_wanted(&datagram) => return datagram,
            Ok(_) => {}
            Err(error) => assert!(error.is_no_event(), "{error}"),
        }
    }
    panic!("nothing that is wanted comes");
}

#[test]
fn the_referee_is_heard_and_hears_the_answer() {
    let hardware = create(&["--game", "Playing"]);
    let datagram = read(&hardware, |datagram| {
        datagram.channel == Channel::GameController
    });
    let message = control_data::decode(&datagram.bytes).unwrap();
    assert_eq!(message.game_state, GameState::Playing);
    assert_eq!(datagram.sender.port, hardware.ports().unwrap()[2]);
    let data = ReturnData {
        player_number: 3,
        team_number: 5,
        is_fallen: true,
        ..ReturnData::default()
    };
    let bytes = return_data::encode(&data).unwrap();
    hardware
        .send_to_game_controller(datagram.sender, &bytes)
        .unwrap();
    let begun = Instant::now();
    while hardware.network_truth().return_data.is_empty() && begun.elapsed() < PATIENCE {
        std::thread::sleep(Duration::from_millis(5));
    }
    let received = hardware.network_truth().return_data;
    assert_eq!(received[0].message, data);
    assert!(hardware.network_truth().game_message.is_some());
}

#[test]
fn the_mate_is_heard_and_hears_and_the_own_broadcast_comes_back() {
    let mate = "robots = [{ position = [1.0, 0.5], team = 'own', number = 2 }]";
    let hardware = create_with(&["--ball", "2,1", "--no-referee"], mate);
    let datagram = read(&hardware, |_| true);
    let message = team_message::decode(&datagram.bytes).unwrap();
    let ball = message.ball.unwrap().position;
    assert!((ball.x - 1.0).abs() < 1e-5 && (ball.y - 0.5).abs() < 1e-5);
    assert_eq!(message.player_number, 2);

    let own = TeamMessage {
        player_number: 3,
        ..TeamMessage::default()
    };
    let mut room = [0; team_message::GREATEST_LENGTH];
    let bytes = team_message::encode(&own, &mut room).unwrap();
    hardware.send_to_team(bytes).unwrap();
    let returned = read(&hardware, |datagram| datagram.bytes == bytes);
    assert_eq!(returned.sender.port, hardware.ports().unwrap()[1]);
    let begun = Instant::now();
    while hardware.network_truth().team_messages.is_empty() && begun.elapsed() < PATIENCE {
        std::thread::sleep(Duration::from_millis(5));
    }
    assert_eq!(hardware.network_truth().team_messages[0].message, own);
}

#[test]
fn anybody_can_send_anything_and_it_is_cut_a_byte_above_what_is_allowed() {
    let hardware = create(&["--no-referee", "--no-mate"]);
    let stranger = UdpSocket::bind("127.0.0.1:0").unwrap();
    let [control_port, team_port, _] = hardware.ports().unwrap();
    for (port, channel) in [
        (control_port, Channel::GameController),
        (team_port, Channel::Team),
    ] {
        stranger.send_to(&[9; 1000], ("127.0.0.1", port)).unwrap();
        let datagram = read(&hardware, |_| true);
        assert_eq!((datagram.channel, datagram.bytes), (channel, vec![9; 129]));
        let port = stranger.local_addr().unwrap().port();
        assert_eq!(datagram.sender.port, port);
        assert_eq!(datagram.sender.address, [127, 0, 0, 1]);
    }
}

#[test]
fn other_addresses_are_heard_only_where_that_was_chosen() {
    let stranger = UdpSocket::bind("127.0.0.1:0").unwrap();
    for (table, is_heard) in [
        ("network.address = '127.0.0.1'", false),
        ("network.address = '0.0.0.0'", true),
    ] {
        let hardware = create_with(&["--no-referee", "--no-mate"], table);
        let [control_port, ..] = hardware.ports().unwrap();
        // Nobody there may be told to later senders.
        let _ = stranger.send_to(b"elsewhere", ("127.0.0.2", control_port));
        let _ = stranger.send_to(b"here", ("127.0.0.1", control_port));
        let first = read(&hardware, |_| true);
        assert_eq!(first.bytes == b"elsewhere", is_heard, "{table}");
    }
}

#[test]
fn one_flooded_port_does_not_silence_the_other() {
    let hardware = create(&["--no-referee", "--no-mate"]);
    for _ in 0..50 {
        hardware.send_to_control_port(b"flood").unwrap();
    }
    hardware.send_to_team_port(b"team").unwrap();
    let mut datagram = Datagram::default();
    let heard = (0..3).any(|_| {
        hardware.read_datagram(&mut datagram).unwrap();
        datagram.bytes == b"team"
    });
    assert!(heard);
}
