//! The NAO's hardware on the sockets of a simulated body: what it reads, and what it does when the body is silent or goes.

use std::io::{Read, Write};
use std::os::unix::net::{UnixListener, UnixStream};
use std::path::{Path, PathBuf};
use std::sync::mpsc;
use std::time::{Duration, Instant};

use framework::{Clock, Hardware as _, HardwareContext, Stop};
use hardware::{ActuatorInterface, CameraInterface, MicrophoneInterface, SensorInterface};
use lola::Command;
use nao::Hardware;
use simulated_nao::Simulator;
use simulated_nao::settings::{PhysicsChoice, Settings};
use types::camera::CameraPosition;
use types::joints::Joints;
use types::leds::Leds;
use types::motor_commands::MotorCommands;
use types::sensor_data::SensorData;

/// A busy machine may take so long for anything.
const PATIENCE: Duration = Duration::from_secs(60);

fn serve(path: &Path) -> Simulator {
    let settings = Settings {
        socket: Some(path.to_owned()),
        physics: PhysicsChoice::Kinematic,
        ..Settings::default()
    };
    Simulator::serve(&settings, Clock::wall()).unwrap()
}

fn connect(path: &Path, options: &[&str], stop: &Stop) -> Hardware {
    let path = path.to_str().unwrap();
    let simulator = ["--simulator", path];
    let options = simulator.iter().chain(options);
    Hardware::new(HardwareContext {
        options: options.map(|&option| option.to_owned()).collect(),
        table: toml::Table::new(),
        run_folder: std::env::temp_dir(),
        clock: Clock::wall(),
        stop: stop.clone(),
    })
    .unwrap()
}

/// Asks until there is an answer; other errors than `NoEvent` fail.
fn until<T>(mut ask: impl FnMut() -> framework::Result<T>) -> T {
    let begun = Instant::now();
    loop {
        match ask() {
            Ok(answer) => return answer,
            Err(error) => assert!(error.is_no_event(), "{error}"),
        }
        assert!(begun.elapsed() < PATIENCE);
    }
}

/// A LoLA of its own: what it sends and takes is up to the test.
struct OwnLola {
    _folder: tempfile::TempDir,
    path: PathBuf,
    listener: UnixListener,
    state: Vec<u8>,
}

impl OwnLola {
    fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("lola");
        let mut sensors = SensorData::default();
        sensors.configuration.body_id = "P0000073A03S83I00011".parse().unwrap();
        sensors.configuration.head_id = "P0000074A05S93M00061".parse().unwrap();
        sensors.configuration.body_version = "6.0.0".parse().unwrap();
        sensors.configuration.head_version = "6.0.0".parse().unwrap();
        let mut state = Vec::new();
        lola::state::encode(&sensors, &mut state).unwrap();
        Self {
            listener: UnixListener::bind(&path).unwrap(),
            _folder: folder,
            path,
            state,
        }
    }

    /// The hardware, once it has read its first state.
    fn connect(&self, stop: &Stop) -> (Hardware, UnixStream) {
        std::thread::scope(|scope| {
            let connecting = scope.spawn(|| connect(&self.path, &[], stop));
            let (mut stream, _) = self.listener.accept().unwrap();
            stream.write_all(&self.state).unwrap();
            (connecting.join().unwrap(), stream)
        })
    }
}

#[test]
fn sensors_images_and_sound_come_and_say_when() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("lola");
    let simulator = serve(&path);
    let stop = Stop::new();
    let hardware = connect(&path, &[], &stop);
    let identities = hardware.identities();
    assert_eq!(
        identities[0],
        ("body".to_owned(), "SIMULATED-BODY-00001".to_owned())
    );
    let one = until(|| hardware.read_sensors()).0;
    let other = until(|| hardware.read_sensors()).0;
    assert!(one < other);
    for position in [CameraPosition::Top, CameraPosition::Bottom] {
        let (first, image) = until(|| hardware.read_image(position));
        assert_eq!((image.width, image.height), (640, 480));
        assert!(image.data.iter().any(|byte| *byte != image.data[0]));
        let heap = image.data.as_ptr();
        let (second, held) = until(|| hardware.read_image(position));
        assert!(first < second);
        assert_ne!(held.data.as_ptr(), heap, "a reader has it");
        drop(image);
        let (_, image) = until(|| hardware.read_image(position));
        assert_eq!(image.data.as_ptr(), heap, "nothing is allocated again");
    }
    let (heard_at, block) = until(|| hardware.read_audio());
    assert!(heard_at > one);
    assert!(block.channels.iter().all(|channel| channel.len() == 2048));
    drop(hardware);
    drop(simulator);
}

#[test]
fn a_body_that_was_started_again_is_found_again() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("lola");
    let simulator = serve(&path);
    let stop = Stop::new();
    let hardware = connect(&path, &["--no-sound"], &stop);
    until(|| hardware.read_image(CameraPosition::Top));
    drop(simulator);
    let begun = Instant::now();
    while hardware.read_sensors().is_ok() {
        assert!(begun.elapsed() < PATIENCE);
    }
    let simulator = serve(&path);
    until(|| hardware.read_sensors());
    until(|| hardware.read_image(CameraPosition::Top));
    let motors = MotorCommands::holding(Joints::filled(0.1), 1.0);
    let begun = Instant::now();
    while simulator.exchange().commands == 0 {
        until(|| hardware.read_sensors());
        hardware.write_command(&motors, &Leds::default()).unwrap();
        assert!(begun.elapsed() < PATIENCE);
    }
}

#[test]
fn a_body_that_falls_silent_is_told_of_and_a_stop_is_noticed_meanwhile() {
    let lola = OwnLola::new();
    let stop = Stop::new();
    let (hardware, mut stream) = lola.connect(&stop);
    // Half a state, and then nothing.
    stream.write_all(&lola.state[..400]).unwrap();
    let error = hardware.read_sensors().unwrap_err();
    assert!(
        error.is_no_event() && error.to_string().contains("silent"),
        "{error}"
    );
    std::thread::scope(|scope| {
        let reading = scope.spawn(|| hardware.read_sensors());
        std::thread::sleep(Duration::from_millis(20));
        hardware.stop();
        assert!(reading.join().unwrap().unwrap_err().is_stopped());
    });
    // It goes on where it was: the other half.
    assert_eq!(lola.state.len(), lola::STATE_BYTES);
}

#[test]
fn in_safe_state_the_hardware_lets_the_robot_down_and_reads_what_nobody_reads() {
    let lola = OwnLola::new();
    let stop = Stop::new();
    let (hardware, mut stream) = lola.connect(&stop);
    let motors = MotorCommands::holding(Joints::filled(0.2), 0.8);
    hardware.write_command(&motors, &Leds::default()).unwrap();
    let (send, received) = mpsc::channel();
    let mut reading = stream.try_clone().unwrap();
    let commands = std::thread::spawn(move || {
        let mut bytes = [0; lola::COMMAND_BYTES];
        while reading.read_exact(&mut bytes).is_ok() {
            let mut command = Command::default();
            lola::command::decode(&bytes, &mut command).unwrap();
            let _ = send.send(command.motors);
        }
    });
    assert_eq!(received.recv_timeout(PATIENCE).unwrap(), motors);
    hardware.enter_safe_state();
    // Nodes are not heard any more.
    let other = MotorCommands::holding(Joints::filled(-0.7), 1.0);
    let mut stiffnesses = Vec::new();
    let begun = Instant::now();
    // States pile up until somebody reads: more than a socket holds would block this thread.
    while stiffnesses.last() != Some(&0.0) || stiffnesses.len() < 100 {
        hardware.write_command(&other, &Leds::default()).unwrap();
        stream.write_all(&lola.state).unwrap();
        let told = received.recv_timeout(PATIENCE).unwrap();
        assert_eq!(told.positions, motors.positions);
        stiffnesses.push(told.stiffnesses.head_yaw);
        assert!(begun.elapsed() < PATIENCE);
    }
    assert!(
        stiffnesses.is_sorted_by(|one, next| one >= next),
        "{stiffnesses:?}"
    );
    assert!(stiffnesses.iter().any(|value| *value > 0.1 && *value < 0.7));
    hardware.rearm();
    // Nodes that have not read of it command a body that is not so any more.
    hardware.write_command(&other, &Leds::default()).unwrap();
    let known = MotorCommands::holding(Joints::filled(0.4), 0.5);
    let mut is_in_safe_state = || {
        let (_, sensors) = until(|| {
            stream.write_all(&lola.state).unwrap();
            hardware.read_sensors()
        });
        sensors.is_in_safe_state
    };
    assert!(is_in_safe_state());
    hardware.write_command(&known, &Leds::default()).unwrap();
    let told = std::iter::from_fn(|| received.recv_timeout(PATIENCE).ok());
    let told = told.take(1000).find(|told| told.stiffnesses.head_yaw > 0.0);
    assert_eq!(told, Some(known));
    assert!(!is_in_safe_state());
    // The end is let down to the end, too.
    hardware.enter_safe_state();
    drop(hardware);
    commands.join().unwrap();
    let last = received.try_iter().last().unwrap();
    assert_eq!(last.stiffnesses, Joints::filled(0.0));
}

#[test]
fn behind_a_stop_the_robot_is_let_down_at_lolas_pace_and_no_state_stays_unread() {
    let lola = OwnLola::new();
    let stop = Stop::new();
    let (hardware, mut stream) = lola.connect(&stop);
    stream.set_write_timeout(Some(PATIENCE)).unwrap();
    let motors = MotorCommands::holding(Joints::filled(0.2), 0.8);
    hardware.write_command(&motors, &Leds::default()).unwrap();
    let begun = Instant::now();
    // As the driver does it: who reads is gone before the robot lies.
    stop.request();
    hardware.enter_safe_state();
    hardware.stop();
    let mut bytes = [0; lola::COMMAND_BYTES];
    let mut stiffness_of = |stream: &mut UnixStream| {
        stream.read_exact(&mut bytes).ok()?;
        let mut command = Command::default();
        lola::command::decode(&bytes, &mut command).unwrap();
        Some(command.motors.stiffnesses)
    };
    // More states than a socket holds: where they stayed, this would end by the timeout.
    let mut stiffnesses: Vec<_> = (0..300)
        .map(|_| {
            stream.write_all(&lola.state).unwrap();
            stiffness_of(&mut stream).unwrap()
        })
        .collect();
    drop(hardware);
    stiffnesses.extend(std::iter::from_fn(|| stiffness_of(&mut stream)));
    let most = begun.elapsed().as_millis() / 12 + 2;
    assert!(
        (stiffnesses.len() as u128) <= most,
        "{} commands, at most {most}",
        stiffnesses.len()
    );
    assert_eq!(stiffnesses.last(), Some(&Joints::filled(0.0)));
}

#[test]
fn without_sound_there_is_silence_and_no_error() {
    let lola = OwnLola::new();
    let stop = Stop::new();
    let (hardware, _stream) = lola.connect(&stop);
    // Nobody serves the microphones of this one.
    let error = hardware.read_audio().unwrap_err();
    assert!(error.is_no_event(), "{error}");
}

#[test]
fn lockstep_is_refused() {
    let refused = Hardware::new(HardwareContext {
        options: Vec::new(),
        table: toml::Table::new(),
        run_folder: std::env::temp_dir(),
        clock: Clock::stepped(),
        stop: Stop::new(),
    });
    let message = refused.err().unwrap().to_string();
    assert!(message.contains("`simulated`"), "{message}");
}
