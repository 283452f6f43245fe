//! The simulated NAO turned by `next_event`, as the lockstep driver does.

use std::time::Duration;

use framework::{Clock, Hardware as _, HardwareContext, Stop};
use hardware::{ActuatorInterface, CameraInterface, SensorInterface};
use simulated_nao::Hardware;
use types::camera::CameraPosition;
use types::image::YuyvImage;
use types::joints::Joints;
use types::leds::Leds;
use types::motor_commands::MotorCommands;

fn create(options: &[&str], table: &str) -> framework::Result<Hardware> {
    Hardware::new(HardwareContext {
        options: options.iter().map(|&option| option.to_owned()).collect(),
        table: toml::from_str(table).unwrap(),
        run_folder: std::env::temp_dir(),
        clock: Clock::stepped(),
        stop: Stop::new(),
    })
}

#[test]
fn events_come_at_the_rates_of_lola_and_the_cameras() {
    let hardware = create(&[], "").unwrap();
    let mut counts = [0; 3];
    let mut last = None;
    loop {
        let event = hardware.next_event().unwrap().unwrap();
        assert!(last <= Some(event.at));
        last = Some(event.at);
        if event.at.as_nanos() > Duration::from_secs(3).as_nanos() as u64 {
            break;
        }
        let names = ["Control", "VisionTop", "VisionBottom"];
        counts[names
            .iter()
            .position(|name| *name == event.instance)
            .unwrap()] += 1;
    }
    assert_eq!(counts, [250, 90, 89]);
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
    let image = hardware.read_image(CameraPosition::Top, &mut YuyvImage::default());
    assert!(image.unwrap_err().is_no_event());
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
    hardware.write_command(&command, &Leds::default()).unwrap();
    tick();
    assert_eq!(hardware.ground_truth().commands, command);
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
