//! The simulated NAO turned by `next_event`, as the lockstep driver does.

use std::collections::BTreeSet;
use std::net::UdpSocket;
use std::time::Duration;

use framework::{Clock, Hardware as _, HardwareContext, Stop, Timestamp};
use hardware::{
    ActuatorInterface, CameraInterface, MessageInterface, MicrophoneInterface, NetworkInterface,
    SensorInterface, SpeakerInterface,
};
use simulated_nao::{Hardware, Received};
use spl_messages::{ReturnData, return_data, team_message};
use types::audio::Tone;
use types::camera::CameraPosition;
use types::joints::Joints;
use types::leds::{Color, Leds};
use types::motor_commands::MotorCommands;
use types::network::{Channel, Datagram, Endpoint};
use types::team::TeamMessage;

fn create(options: &[&str], table: &str) -> framework::Result<Hardware> {
    Hardware::new(HardwareContext {
        // These tests are about what the hardware says when; the bodies have tests of their own.
        options: ["--physics", "kinematic"]
            .iter()
            .chain(options)
            .map(|&option| option.to_owned())
            .collect(),
        table: toml::from_str(table).unwrap(),
        run_folder: std::env::temp_dir(),
        clock: Clock::stepped(),
        stop: Stop::new(),
    })
}

#[test]
fn events_come_at_the_rates_of_lola_the_cameras_the_network_and_the_microphones() {
    let hardware = create(&[], "").unwrap();
    let mut counts = [0; 5];
    let mut last = None;
    loop {
        let event = hardware.next_event().unwrap().unwrap();
        assert!(last <= Some(event.at));
        last = Some(event.at);
        if event.at.as_nanos() > Duration::from_secs(3).as_nanos() as u64 {
            break;
        }
        let names = [
            "Control",
            "VisionTop",
            "VisionBottom",
            "SplNetwork",
            "Audio",
        ];
        counts[names
            .iter()
            .position(|name| *name == event.instance)
            .unwrap()] += 1;
    }
    // The referee's computer speaks twice a second, the team mate once.
    assert_eq!(counts, [250, 90, 89, 6 + 3, 64]);
}

#[test]
fn what_is_taken_away_has_no_events() {
    let away = ["--no-cameras", "--no-sound", "--no-referee", "--no-mate"];
    let hardware = create(&away, "").unwrap();
    for _ in 0..250 {
        assert_eq!(hardware.next_event().unwrap().unwrap().instance, "Control");
    }
    let hardware = create(&["--no-cameras", "--no-mate"], "").unwrap();
    let instances = std::iter::repeat_with(|| hardware.next_event().unwrap().unwrap().instance);
    let instances: BTreeSet<_> = instances.take(250).collect();
    assert_eq!(
        instances,
        BTreeSet::from(["Audio", "Control", "SplNetwork"])
    );
}

#[test]
fn runs_are_no_matter_to_each_other_whatever_ports_are_chosen() {
    let taken = UdpSocket::bind("127.0.0.1:0").unwrap();
    let port = taken.local_addr().unwrap().port();
    for key in ["control_port", "return_port", "team_port", "mate_port"] {
        create(&[], &format!("network.{key} = {port}")).unwrap();
    }
    // Who opens a run to a network means these ports.
    let open = format!("network.address = '0.0.0.0'\nnetwork.control_port = {port}");
    let message = create(&[], &open).err().unwrap().to_string();
    assert!(message.contains(&format!("UDP port {port}")), "{message}");
}

#[test]
fn hostile_datagrams_are_events_and_are_read_as_they_are_but_cut() {
    let hardware = create(&[], "").unwrap();
    hardware.send_to_control_port(b"hello").unwrap();
    hardware.send_to_team_port(&[7; 1000]).unwrap();
    hardware.send_to_team_port(b"").unwrap();
    let mut datagram = Datagram::default();
    for (channel, bytes) in [
        (Channel::GameController, b"hello".to_vec()),
        (Channel::Team, vec![7; 129]),
        (Channel::Team, Vec::new()),
    ] {
        let event = hardware.next_event().unwrap().unwrap();
        assert_eq!((event.instance, event.at), ("SplNetwork", Timestamp::ZERO));
        let captured_at = hardware.read_datagram(&mut datagram).unwrap();
        assert_eq!(captured_at, event.at);
        assert_eq!((datagram.channel, &datagram.bytes), (channel, &bytes));
    }
    let silence = hardware.read_datagram(&mut datagram).unwrap_err();
    assert!(silence.is_no_event());
}

#[test]
fn what_the_robot_says_is_heard_and_counted() {
    let table = "game.team = 24\ngame.player_number = 4";
    let hardware = create(&[], table).unwrap();
    let referee = Endpoint {
        address: [127, 0, 0, 1],
        port: 3939,
    };
    let data = ReturnData {
        player_number: 4,
        team_number: 24,
        ..ReturnData::default()
    };
    let stranger = ReturnData {
        team_number: 25,
        ..data
    };
    for bytes in [
        &return_data::encode(&data).unwrap()[..],
        &return_data::encode(&stranger).unwrap(),
        b"hello",
    ] {
        hardware.send_to_game_controller(referee, bytes).unwrap();
    }
    let message = TeamMessage {
        player_number: 4,
        ..TeamMessage::default()
    };
    let mut room = [0; team_message::GREATEST_LENGTH];
    let bytes = team_message::encode(&message, &mut room).unwrap();
    hardware.send_to_team(bytes).unwrap();
    let truth = hardware.network_truth();
    let at = Timestamp::ZERO;
    assert_eq!(truth.return_data, [Received { at, message: data }]);
    let counts = truth.return_data_counts;
    assert_eq!((counts.accepted, counts.rejected), (1, 2));
    assert_eq!(truth.team_messages, [Received { at, message }]);
    // A broadcast comes back.
    let event = hardware.next_event().unwrap().unwrap();
    assert_eq!(
        (event.instance, event.at.as_nanos()),
        ("SplNetwork", 1_000_000)
    );
}

#[test]
fn tones_lights_and_whistles_can_be_inspected() {
    let hardware = create(&[], "sound.whistles = [0.0, 12.0]").unwrap();
    let whistles = hardware.whistles();
    assert_eq!(whistles.len(), 1);
    assert_eq!(whistles[0].begins_at, 0.0);
    let message = Tone {
        frequency: 440.0,
        duration: 0.5,
        volume: 0.5,
    };
    hardware.play_tone(&message).unwrap();
    let at = Timestamp::ZERO;
    assert_eq!(hardware.tones(), [Received { at, message }]);
    let leds = Leds {
        chest: Color::new(0.0, 1.0, 0.0),
        ..Leds::default()
    };
    hardware
        .write_command(&MotorCommands::default(), &leds)
        .unwrap();
    while hardware.next_event().unwrap().unwrap().instance != "Control" {}
    assert_eq!(hardware.leds(), leds);
}

#[test]
fn an_identity_is_what_lola_says() {
    let hardware = create(&[], "head_id = 'ABCDEFGHIJKLMNOPQRST'").unwrap();
    let identities = hardware.identities();
    assert_eq!(
        identities[1],
        ("head".to_owned(), "ABCDEFGHIJKLMNOPQRST".to_owned())
    );
    assert_eq!(identities[0].1.len(), 20);
}

#[test]
fn unknown_keys_and_options_are_named() {
    let error = create(&[], "bal = 1").err().unwrap().to_string();
    assert!(error.contains("bal"), "{error}");
    let error = create(&["--bal"], "").err().unwrap().to_string();
    assert!(error.contains("`--bal`"), "{error}");
}

#[test]
fn nothing_is_read_before_it_is_there() {
    let hardware = create(&[], "").unwrap();
    assert!(hardware.read_sensors().unwrap_err().is_no_event());
    let image = hardware.read_image(CameraPosition::Top);
    assert!(image.unwrap_err().is_no_event());
    let datagram = hardware.read_datagram(&mut Datagram::default());
    assert!(datagram.unwrap_err().is_no_event());
    let sound = hardware.read_audio();
    assert!(sound.unwrap_err().is_no_event());
}

#[test]
fn in_safe_state_commands_of_nodes_are_ignored_and_stiffness_fades() {
    let hardware = create(&[], "").unwrap();
    let command = MotorCommands {
        positions: Joints::filled(0.1),
        stiffnesses: Joints::filled(0.5),
    };
    let tick = || while hardware.next_event().unwrap().unwrap().instance != "Control" {};
    hardware.write_command(&command, &Leds::default()).unwrap();
    tick();
    assert_eq!(hardware.ground_truth().commands, command);
    hardware.enter_safe_state();
    for _ in 0..50 {
        hardware.write_command(&command, &Leds::default()).unwrap();
        tick();
    }
    let commands = hardware.ground_truth().commands;
    assert_eq!(commands.stiffnesses, Joints::default());
    assert_eq!(commands.positions, command.positions);
    hardware.rearm();
    // Nodes that do not know yet command a body that is not so any more.
    hardware.write_command(&command, &Leds::default()).unwrap();
    tick();
    assert_eq!(hardware.ground_truth().commands, commands);
}

/// All joint angles over a second in which the head was told to go somewhere.
fn positions(options: &[&str], yaw: f32) -> Vec<u32> {
    let hardware = create(options, "").unwrap();
    let mut command = MotorCommands {
        positions: Joints::filled(0.1),
        stiffnesses: Joints::filled(0.5),
    };
    command.positions.head_yaw = yaw;
    hardware.write_command(&command, &Leds::default()).unwrap();
    while hardware.next_event().unwrap().unwrap().at.as_nanos() < 1_000_000_000 {}
    let ground_to_field = hardware.ground_truth().ground_to_field.translation.vector;
    let bodies = hardware.body_truths();
    let angles = bodies.iter().flat_map(|body| body.positions.to_array());
    angles
        .chain(ground_to_field.iter().copied())
        .map(f32::to_bits)
        .collect()
}

#[test]
fn the_same_options_and_commands_give_the_same_bits() {
    let pose = ["--pose", "1,0.5,0.3"];
    let once = positions(&pose, 0.7);
    assert!(once == positions(&pose, 0.7));
    assert!(once != positions(&pose, 0.7001));
    assert!(once != positions(&["--pose", "1,0.5001,0.3"], 0.7));
}

#[test]
fn a_camera_that_drops_out_has_no_images_for_as_long_and_a_lola_that_stalls_no_states() {
    let hardware = create(&["--no-sound", "--no-referee", "--no-mate"], "").unwrap();
    let disturb = |text: &str| {
        let deed = toml::from_str(text).unwrap();
        framework::Hardware::disturb(&hardware, &deed)
    };
    disturb("camera_drop_out = { camera = 'Top', lasts = 1.0 }").unwrap();
    // Of top camera, bottom camera and LoLA in each second.
    let mut counts = [[0; 3]; 3];
    let mut stalls = false;
    loop {
        let event = hardware.next_event().unwrap().unwrap();
        let second = (event.at.as_nanos() / 1_000_000_000) as usize;
        if second == 1 && !stalls {
            stalls = true;
            disturb("lola_stall = 0.9").unwrap();
        }
        let Some(counts) = counts.get_mut(second) else {
            break;
        };
        let instances = ["VisionTop", "VisionBottom", "Control"];
        let of = instances.iter().position(|name| *name == event.instance);
        counts[of.unwrap()] += 1;
    }
    let [without_top, without_lola, with_both] = counts;
    assert_eq!(without_top, [0, 29, 83]);
    assert_eq!(without_lola[..2], [30, 30]);
    assert!((8..=10).contains(&without_lola[2]), "{without_lola:?}");
    assert!(
        with_both[..2] == [30, 30] && with_both[2] >= 83,
        "{with_both:?}"
    );
    let message = disturb("lola_stall = -1.0").unwrap_err().to_string();
    assert!(message.contains("-1 s"), "{message}");
    assert!(disturb("camera_drop_out = { camera = 'Left', lasts = 1.0 }").is_err());
}
