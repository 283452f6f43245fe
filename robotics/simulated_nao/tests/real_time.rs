//! The simulated NAO with the wall clock.

use std::collections::BTreeSet;
use std::net::UdpSocket;
use std::time::{Duration, Instant};

use framework::{Clock, Hardware as _, HardwareContext, Stop};
use hardware::{
    ActuatorInterface, CameraInterface, MOST_BLOCKS, MOST_IMAGES, MicrophoneInterface,
    NetworkInterface, SensorInterface,
};
use nalgebra::{Point3, Vector3};
use simulated_nao::Hardware;
use simulated_nao::physics::Disturbance;
use types::audio::AudioBlock;
use types::camera::CameraPosition;
use types::joints::Joints;
use types::leds::Leds;
use types::motor_commands::MotorCommands;
use types::network::Datagram;

/// A busy machine may take so long for anything.
const PATIENCE: Duration = Duration::from_secs(20);

fn create(stop: &Stop) -> Hardware {
    create_with(stop, "")
}

/// With these settings of `[hardware.simulated]`.
fn create_with(stop: &Stop, table: &str) -> Hardware {
    try_to_create(stop, &[], table).unwrap()
}

fn try_to_create(stop: &Stop, options: &[&str], table: &str) -> framework::Result<Hardware> {
    Hardware::new(HardwareContext {
        // The machine may be slow, and nobody looks at the body.
        options: ["--physics", "kinematic"]
            .iter()
            .chain(options)
            .map(|&option| option.to_owned())
            .collect(),
        table: table.parse().unwrap(),
        run_folder: std::env::temp_dir(),
        clock: Clock::wall(),
        stop: stop.clone(),
    })
}

/// Asks until it is so; whether it was in time.
fn until(mut is_so: impl FnMut() -> bool) -> bool {
    let begun = Instant::now();
    std::iter::repeat_with(&mut is_so)
        .take_while(|_| begun.elapsed() < PATIENCE)
        .any(|is_so| is_so)
}

#[test]
fn sensors_are_sampled_every_12_ms_of_the_world() {
    let hardware = create(&Stop::new());
    for _ in 0..25 {
        hardware.read_sensors().unwrap();
    }
    let times: Vec<_> = hardware
        .body_truths()
        .iter()
        .map(|truth| truth.at)
        .collect();
    assert!(times.len() >= 24);
    for time in &times {
        assert_eq!(time.as_nanos() % 12_000_000, 0, "{time}");
    }
    assert!(times.is_sorted());
}

#[test]
fn a_port_in_use_is_named_with_its_setting_and_the_way_out() {
    let taken = UdpSocket::bind("127.0.0.1:0").unwrap();
    let port = taken.local_addr().unwrap().port();
    for key in ["control_port", "return_port", "team_port", "mate_port"] {
        let table = format!("network.{key} = {port}");
        let create = |options: &[&str]| try_to_create(&Stop::new(), options, &table);
        let message = create(&[]).err().unwrap().to_string();
        for part in [&format!("UDP port {port}"), key, "--free-ports"] {
            assert!(message.contains(part), "{message}");
        }
        assert!(create(&["--free-ports"]).is_ok());
    }
}

#[test]
fn somebody_presses_the_chest_button() {
    // Long enough that no stall hides it.
    let buttons = "buttons = [{ at = 0.5, button = 'chest', lasts = 5.0 }]";
    let hardware = create_with(&Stop::new(), buttons);
    for expected in [true, false] {
        assert!(until(|| match hardware.read_sensors() {
            Ok((_, sensors)) => sensors.touch.chest_button == expected,
            Err(error) => {
                assert!(error.is_no_event(), "{error}");
                false
            }
        }));
    }
}

#[test]
fn blocks_of_sound_come_one_after_the_other() {
    let hardware = create(&Stop::new());
    let mut last = None;
    for _ in 0..5 {
        let (captured_at, block) = hardware.read_audio().unwrap();
        assert!(last < Some(captured_at));
        last = Some(captured_at);
        assert_eq!(block.sample_rate, 44_100);
        assert!(block.channels.iter().all(|channel| channel.len() == 2048));
    }
}

#[test]
fn blocks_that_nobody_holds_are_filled_again_and_readers_hold_so_many_at_most() {
    let hardware = create(&Stop::new());
    let place = |block: &AudioBlock| block.channels.each_ref().map(|channel| channel.as_ptr());
    let (_, held) = hardware.read_audio().unwrap();
    let heard = held.channels.clone();
    let places: BTreeSet<_> = (0..3)
        .map(|_| place(&hardware.read_audio().unwrap().1))
        .collect();
    assert_eq!(places.len(), 1, "who holds none needs one");
    assert!(!places.contains(&place(&held)));
    assert_eq!(held.channels, heard, "what is held stays as it was");

    let more: Vec<_> = (1..MOST_BLOCKS)
        .map(|_| hardware.read_audio().unwrap())
        .collect();
    let error = hardware.read_audio().unwrap_err();
    assert!(error.is_no_event(), "{error}");
    let last = more.last().map(|(captured_at, _)| *captured_at);
    drop(held);
    assert!(Some(hardware.read_audio().unwrap().0) > last);
}

#[test]
fn images_are_those_of_their_exposures() {
    let hardware = create(&Stop::new());
    let mut last = None;
    for _ in 0..5 {
        let (captured_at, image) = hardware.read_image(CameraPosition::Bottom).unwrap();
        assert!(last < Some(captured_at));
        last = Some(captured_at);
        assert_eq!((image.width, image.height), (640, 480));
        assert!(image.is_complete());
        assert!(
            hardware
                .image_truth(CameraPosition::Bottom, captured_at)
                .is_some()
        );
    }
}

#[test]
fn images_that_nobody_holds_are_drawn_where_others_were() {
    let hardware = create(&Stop::new());
    let read = || hardware.read_image(CameraPosition::Top).unwrap().1;
    let held = read();
    let pixels = held.data.clone();
    let places: BTreeSet<_> = (0..5).map(|_| read().data.as_ptr()).collect();
    assert_eq!(places.len(), 1, "who holds none needs one");
    assert!(!places.contains(&held.data.as_ptr()));
    assert_eq!(held.data, pixels, "what is held stays as it was");
}

#[test]
fn a_reader_that_holds_all_images_gets_the_newest_once_it_lets_one_go() {
    let hardware = create(&Stop::new());
    let read = || hardware.read_image(CameraPosition::Top);
    let mut held: Vec<_> = (0..MOST_IMAGES).map(|_| read().unwrap()).collect();
    let error = read().unwrap_err();
    assert!(error.is_no_event(), "{error}");
    assert!(hardware.read_image(CameraPosition::Bottom).is_ok());
    let last = held.pop().map(|(captured_at, _)| captured_at);
    assert!(Some(read().unwrap().0) > last);
    assert!(read().is_ok(), "it was not held");
}

#[test]
fn a_world_that_ends_is_told_and_keeps_nobody() {
    let mate = "robots = [{ position = [1.0, 0.5], team = 'own', number = 2 }]";
    let options = ["--free-ports", "--ball", "2,1"];
    let hardware = try_to_create(&Stop::new(), &options, mate).unwrap();
    hardware.read_sensors().unwrap();
    // The mate cannot say where that is.
    hardware.disturb(&Disturbance::MoveBall {
        position: Point3::new(f64::INFINITY, 0.0, 0.1),
        velocity: Vector3::zeros(),
    });
    let has_ended = || match hardware.read_sensors() {
        Err(error) => error
            .to_string()
            .contains("the world of the simulated NAO has ended"),
        Ok(_) => false,
    };
    assert!(until(has_ended));
    // It lets nobody down any more, and goes.
    hardware.enter_safe_state();
    hardware.stop();
    drop(hardware);
}

#[test]
fn a_stop_ends_blocked_reads() {
    let stop = Stop::new();
    let hardware = create(&stop);
    std::thread::scope(|scope| {
        let reads = [
            scope.spawn(|| {
                loop {
                    if let Err(error) = hardware.read_datagram(&mut Datagram::default()) {
                        break error;
                    }
                }
            }),
            scope.spawn(|| {
                loop {
                    if let Err(error) = hardware.read_audio() {
                        break error;
                    }
                }
            }),
            scope.spawn(|| {
                loop {
                    if let Err(error) = hardware.read_image(CameraPosition::Top) {
                        break error;
                    }
                }
            }),
            scope.spawn(|| {
                loop {
                    if let Err(error) = hardware.read_sensors() {
                        break error;
                    }
                }
            }),
        ];
        std::thread::sleep(Duration::from_millis(100));
        hardware.stop();
        let begun = Instant::now();
        for read in reads {
            assert!(read.join().unwrap().is_stopped());
        }
        // 100 ms are promised, and the constants of the readers are held below by unit tests; here
        // a busy machine may need longer to wake the threads.
        assert!(begun.elapsed() < PATIENCE, "{:?}", begun.elapsed());
    });
}

#[test]
fn garbled_data_is_no_event() {
    let hardware = create(&Stop::new());
    hardware.garble_next_image(CameraPosition::Top);
    let error = hardware.read_image(CameraPosition::Top).unwrap_err();
    assert!(error.is_no_event(), "{error}");
    assert!(hardware.read_image(CameraPosition::Top).is_ok());
    hardware.garble_next_state();
    let read = (0..20)
        .filter_map(|_| hardware.read_sensors().err())
        .collect::<Vec<_>>();
    assert_eq!(read.len(), 1, "{read:?}");
    assert!(read[0].is_no_event());
    assert_eq!(hardware.counts().rejected, 1);
}

#[test]
fn the_robot_is_let_down_when_the_run_ends() {
    let stop = Stop::new();
    let hardware = create(&stop);
    let command = MotorCommands {
        positions: Joints::filled(0.1),
        stiffnesses: Joints::filled(0.5),
    };
    let stiffnesses = || hardware.ground_truth().commands.stiffnesses;
    assert!(until(|| {
        // Reading connects.
        let _ = hardware.read_sensors();
        hardware.write_command(&command, &Leds::default()).unwrap();
        stiffnesses() == command.stiffnesses
    }));
    hardware.enter_safe_state();
    stop.request();
    hardware.stop();
    assert!(until(|| {
        std::thread::sleep(Duration::from_millis(10));
        stiffnesses() == Joints::default()
    }));
}

#[test]
fn nodes_get_the_motors_back_once_they_have_read_that_they_had_lost_them() {
    let hardware = create(&Stop::new());
    let read = || {
        let read = (0..60).find_map(|_| hardware.read_sensors().ok());
        read.expect("the body reports").1
    };
    let command = MotorCommands::holding(Joints::filled(0.1), 0.5);
    let obeys = || {
        until(|| {
            hardware.write_command(&command, &Leds::default()).unwrap();
            read().stiffnesses == command.stiffnesses
        })
    };
    assert!(!read().is_in_safe_state);
    assert!(obeys());
    hardware.enter_safe_state();
    assert!(until(|| {
        hardware.write_command(&command, &Leds::default()).unwrap();
        let sensors = read();
        assert!(sensors.is_in_safe_state);
        sensors.stiffnesses == Joints::default()
    }));
    hardware.rearm();
    assert!(!read().is_in_safe_state);
    assert!(obeys());
    // Somebody re-arms while a node still hangs in the cycle that lost the motors.
    hardware.enter_safe_state();
    hardware.rearm();
    assert!(read().is_in_safe_state);
    assert!(!read().is_in_safe_state);
    assert!(obeys());
}
