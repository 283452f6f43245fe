//! The client against a server on a real socket.

use std::io::{Read, Write};
use std::os::unix::net::{UnixListener, UnixStream};
use std::path::PathBuf;
use std::thread;
use std::time::{Duration, Instant};

use crate::wire::{sample_command, sample_state};
use framework::{Clock, Stop};
use lola::{COMMAND_BYTES, Client, Command, STATE_BYTES, command, state};
use tempfile::TempDir;
use types::leds::Leds;
use types::motor_commands::MotorCommands;

/// 100 ms are promised for a stop, which a unit test of the client holds; a busy machine may take longer.
const BUSY: Duration = Duration::from_secs(20);

struct Server {
    path: PathBuf,
    listener: UnixListener,
    _folder: TempDir,
}

impl Server {
    fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("robocup");
        Self {
            listener: UnixListener::bind(&path).unwrap(),
            path,
            _folder: folder,
        }
    }

    fn client(&self) -> Client {
        Client::connect(&self.path, Clock::wall(), Stop::new())
    }

    fn accept(&self) -> UnixStream {
        self.listener.accept().unwrap().0
    }
}

fn packet() -> Vec<u8> {
    let mut bytes = Vec::new();
    state::encode(&sample_state(), &mut bytes).unwrap();
    bytes
}

#[test]
fn states_come_in_and_commands_go_out() {
    let server = Server::new();
    let client = server.client();
    thread::scope(|scope| {
        scope.spawn(|| {
            let mut stream = server.accept();
            let mut received = [0; COMMAND_BYTES];
            for _ in 0..3 {
                stream.write_all(&packet()).unwrap();
                stream.read_exact(&mut received).unwrap();
                let mut command = Command::default();
                command::decode(&received, &mut command).unwrap();
                assert_eq!(command.motors, sample_command().motors);
                assert_eq!(command.leds, sample_command().leds);
                assert_eq!(command.sonars, [true, true]);
            }
        });
        let mut last = framework::Timestamp::ZERO;
        for _ in 0..3 {
            let (arrived, state) = client.read_state().unwrap();
            assert!(arrived > last);
            last = arrived;
            assert_eq!(state, sample_state());
            client
                .write_command(&sample_command().motors, &sample_command().leds)
                .unwrap();
        }
    });
    let counts = client.counts();
    assert_eq!(
        (counts.connections, counts.states, counts.commands),
        (1, 3, 3)
    );
}

#[test]
fn a_state_in_pieces_is_put_together() {
    let server = Server::new();
    let client = server.client();
    thread::scope(|scope| {
        scope.spawn(|| {
            let mut stream = server.accept();
            for piece in packet().chunks(300) {
                stream.write_all(piece).unwrap();
                thread::sleep(Duration::from_millis(60));
            }
        });
        assert_eq!(client.read_state().unwrap().1, sample_state());
    });
}

#[test]
fn two_states_in_one_write_are_two_states() {
    let server = Server::new();
    let client = server.client();
    thread::scope(|scope| {
        scope.spawn(|| server.accept().write_all(&packet().repeat(2)).unwrap());
        client.read_state().unwrap();
        client.read_state().unwrap();
        assert!(client.read_state().unwrap_err().is_no_event());
    });
    assert_eq!(client.counts().states, 2);
}

#[test]
fn a_stop_is_noticed_though_the_server_is_silent() {
    let server = Server::new();
    let stop = Stop::new();
    let client = Client::connect(&server.path, Clock::wall(), stop.clone());
    let waited = thread::scope(|scope| {
        let reading = scope.spawn(|| (client.read_state().unwrap_err(), Instant::now()));
        thread::sleep(Duration::from_millis(120));
        let requested = Instant::now();
        stop.request();
        let (error, noticed) = reading.join().unwrap();
        assert!(error.is_stopped(), "{error}");
        noticed - requested
    });
    assert!(waited < BUSY, "{waited:?}");
}

#[test]
fn a_stop_is_noticed_though_there_is_no_server() {
    let stop = Stop::new();
    let client = Client::connect("/nonexistent/robocup", Clock::wall(), stop.clone());
    assert!(client.read_state().unwrap_err().is_no_event());
    let waited = thread::scope(|scope| {
        let reading = scope.spawn(|| (client.read_state().unwrap_err(), Instant::now()));
        thread::sleep(Duration::from_millis(50));
        let requested = Instant::now();
        stop.request();
        let (error, noticed) = reading.join().unwrap();
        assert!(error.is_stopped(), "{error}");
        noticed - requested
    });
    assert!(waited < BUSY, "{waited:?}");
}

#[test]
fn a_silent_server_is_no_event_after_a_second() {
    let server = Server::new();
    let client = server.client();
    let begun = Instant::now();
    assert!(client.read_state().unwrap_err().is_no_event());
    let waited = begun.elapsed();
    assert!(
        waited >= Duration::from_millis(900) && waited < BUSY,
        "{waited:?}"
    );
}

#[test]
fn a_garbled_packet_is_no_event_and_the_next_one_counts() {
    let server = Server::new();
    let client = server.client();
    thread::scope(|scope| {
        scope.spawn(|| {
            let mut stream = server.accept();
            stream.write_all(&[0xc1; STATE_BYTES]).unwrap();
            stream.write_all(&packet()).unwrap();
        });
        let error = client.read_state().unwrap_err();
        assert!(error.is_no_event(), "{error}");
        assert_eq!(client.read_state().unwrap().1, sample_state());
    });
    assert_eq!(
        (client.counts().rejected, client.counts().connections),
        (1, 1)
    );
}

#[test]
fn a_stream_that_lost_its_place_is_connected_anew() {
    let server = Server::new();
    let client = server.client();
    thread::scope(|scope| {
        scope.spawn(|| {
            let mut stream = server.accept();
            stream.write_all(&[0]).unwrap();
            stream.write_all(&packet().repeat(3)).unwrap();
            server.accept().write_all(&packet()).unwrap();
        });
        for _ in 0..3 {
            assert!(client.read_state().unwrap_err().is_no_event());
        }
        assert_eq!(client.read_state().unwrap().1, sample_state());
    });
    assert_eq!(
        (client.counts().rejected, client.counts().connections),
        (3, 2)
    );
}

#[test]
fn a_server_that_comes_back_is_found_again_after_a_second() {
    let server = Server::new();
    let client = server.client();
    thread::scope(|scope| {
        scope.spawn(|| {
            server.accept().write_all(&packet()).unwrap();
            server.accept().write_all(&packet()).unwrap();
        });
        client.read_state().unwrap();
        assert!(client.read_state().unwrap_err().is_no_event());
        let begun = Instant::now();
        client.read_state().unwrap();
        let waited = begun.elapsed();
        assert!(
            waited >= Duration::from_millis(900) && waited < BUSY,
            "{waited:?}"
        );
    });
    assert_eq!(client.counts().connections, 2);
}

#[test]
fn of_states_that_are_discarded_the_last_may_be_half_there() {
    let server = Server::new();
    let client = server.client();
    client.discard_states();
    let mut stream = server.accept();
    stream
        .write_all(&packet().repeat(3)[..STATE_BYTES * 5 / 2])
        .unwrap();
    client.discard_states();
    stream.write_all(&packet()[STATE_BYTES / 2..]).unwrap();
    assert_eq!(client.read_state().unwrap().1, sample_state());
    assert!(client.read_state().unwrap_err().is_no_event());
    let counts = client.counts();
    assert_eq!((counts.states, counts.rejected), (1, 0));
}

#[test]
fn who_discards_states_behind_a_stop_finds_a_server_again() {
    let server = Server::new();
    let stop = Stop::new();
    let client = Client::connect(&server.path, Clock::wall(), stop.clone());
    client.discard_states();
    drop(server.accept());
    stop.request();
    let begun = Instant::now();
    while client.counts().connections < 2 {
        client.discard_states();
        assert!(begun.elapsed() < BUSY);
        thread::sleep(Duration::from_millis(12));
    }
    client
        .write_command(&MotorCommands::default(), &Leds::default())
        .unwrap();
    assert_eq!(client.counts().commands, 1);
}

#[test]
fn commands_without_a_server_are_counted_and_no_error() {
    let client = Client::connect("/nonexistent/robocup", Clock::wall(), Stop::new());
    client
        .write_command(&MotorCommands::default(), &Leds::default())
        .unwrap();
    assert_eq!(client.counts().lost_commands, 1);
}

#[test]
fn a_server_that_went_away_while_writing_is_noticed_by_reading() {
    let server = Server::new();
    let client = server.client();
    thread::scope(|scope| {
        scope.spawn(|| server.accept().write_all(&packet()).unwrap());
        client.read_state().unwrap();
    });
    for _ in 0..2 {
        client
            .write_command(&MotorCommands::default(), &Leds::default())
            .unwrap();
    }
    assert!(client.counts().lost_commands > 0);
    thread::scope(|scope| {
        scope.spawn(|| server.accept().write_all(&packet()).unwrap());
        client.read_state().unwrap();
    });
    assert_eq!(client.counts().connections, 2);
}

#[test]
fn a_command_that_is_no_number_never_reaches_the_robot() {
    let client = Client::connect("/nonexistent/robocup", Clock::wall(), Stop::new());
    let mut motors = MotorCommands::default();
    motors.positions.right_knee_pitch = f32::NAN;
    assert!(client.write_command(&motors, &Leds::default()).is_err());
}
