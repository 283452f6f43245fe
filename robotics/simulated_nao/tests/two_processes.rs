//! What a robot's program in another process finds: LoLA, cameras and microphones on sockets.

use std::io::{Read, Write};
use std::os::unix::net::UnixStream;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use framework::Clock;
use lola::Command;
use simulated_nao::Simulator;
use simulated_nao::settings::{PhysicsChoice, Settings};

/// A busy machine may take so long for anything.
const PATIENCE: Duration = Duration::from_secs(20);

fn serve(folder: &Path) -> Simulator {
    let settings = Settings {
        socket: Some(folder.join("lola")),
        physics: PhysicsChoice::Kinematic,
        ..Settings::default()
    };
    Simulator::serve(&settings, Clock::wall()).unwrap()
}

fn connect(path: PathBuf) -> UnixStream {
    let stream = UnixStream::connect(path).unwrap();
    stream.set_read_timeout(Some(PATIENCE)).unwrap();
    stream
}

fn read<const LENGTH: usize>(stream: &mut UnixStream) -> [u8; LENGTH] {
    let mut bytes = [0; LENGTH];
    stream.read_exact(&mut bytes).unwrap();
    bytes
}

fn command(head_yaw: f32) -> Vec<u8> {
    let mut command = Command::default();
    command.motors.positions.head_yaw = head_yaw;
    command.motors.stiffnesses.head_yaw = 1.0;
    let mut bytes = Vec::new();
    lola::command::encode(&command, &mut bytes);
    bytes
}

/// Kind, length, time in ns, size.
fn header(stream: &mut UnixStream) -> ([u8; 4], usize, u64, [u32; 2]) {
    let bytes: [u8; 24] = read(stream);
    let number = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap());
    (
        bytes[..4].try_into().unwrap(),
        number(4) as usize,
        u64::from_le_bytes(bytes[8..16].try_into().unwrap()),
        [number(16), number(20)],
    )
}

#[test]
fn a_program_moves_the_head_through_the_socket_and_hears_of_it() {
    let folder = tempfile::tempdir().unwrap();
    let simulator = serve(folder.path());
    let mut client = connect(simulator.socket());
    let begun = Instant::now();
    loop {
        let state: [u8; 896] = read(&mut client);
        let sensors = lola::state::decode(&state).unwrap();
        if (sensors.positions.head_yaw - 0.3).abs() < 0.02 {
            break;
        }
        assert!(begun.elapsed() < PATIENCE, "{}", sensors.positions.head_yaw);
        client.write_all(&command(0.3)).unwrap();
    }
}

#[test]
fn images_and_sound_come_beside_it_and_the_sockets_go_with_the_simulator() {
    let folder = tempfile::tempdir().unwrap();
    let simulator = serve(folder.path());
    for (name, size) in [("top", [640, 480]), ("bottom", [640, 480])] {
        let mut client = connect(folder.path().join(format!("lola.{name}")));
        let mut times = Vec::new();
        for _ in 0..3 {
            let (kind, length, time, is) = header(&mut client);
            assert_eq!((&kind, length, is), (b"NAOI", 640 * 480 * 2, size));
            let mut image = vec![0; length];
            client.read_exact(&mut image).unwrap();
            assert!(
                image.iter().any(|byte| *byte != image[0]),
                "there is something to see"
            );
            times.push(time);
        }
        assert!(times.is_sorted_by(|one, other| one < other), "{times:?}");
    }
    let mut client = connect(folder.path().join("lola.microphones"));
    for _ in 0..2 {
        let (kind, length, _, size) = header(&mut client);
        assert_eq!((&kind, length, size), (b"NAOS", 2048 * 4 * 4, [2048, 4]));
        let mut samples = vec![0; length];
        client.read_exact(&mut samples).unwrap();
        let samples = samples
            .chunks_exact(4)
            .map(|four| f32::from_le_bytes(four.try_into().unwrap()));
        let loudest = samples.fold(0.0_f32, |loudest, sample| loudest.max(sample.abs()));
        assert!(loudest > 0.01 && loudest <= 1.0, "{loudest}");
    }
    drop(simulator);
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
}

#[test]
fn who_floods_stalls_or_crashes_is_dropped_and_the_next_one_is_served() {
    let folder = tempfile::tempdir().unwrap();
    let simulator = serve(folder.path());
    let mut flooding = connect(simulator.socket());
    flooding
        .set_write_timeout(Some(Duration::from_millis(100)))
        .unwrap();
    let much: Vec<u8> = std::iter::repeat_n(command(0.1), 200).flatten().collect();
    let begun = Instant::now();
    while simulator.dropped_clients() == 0 && begun.elapsed() < PATIENCE {
        // Once it is dropped, nothing can be written.
        let _ = flooding.write(&much);
    }
    assert_eq!(simulator.dropped_clients(), 1, "it flooded");
    let deaf = connect(simulator.socket());
    while simulator.dropped_clients() == 1 && begun.elapsed() < PATIENCE {
        std::thread::sleep(Duration::from_millis(20));
    }
    assert_eq!(simulator.dropped_clients(), 2, "it does not read");
    drop(deaf);
    let mut crashing = connect(simulator.socket());
    let _: [u8; 896] = read(&mut crashing);
    // In the midst of a command.
    crashing.write_all(&command(0.1)[..100]).unwrap();
    drop(crashing);
    let mut next = connect(simulator.socket());
    let state: [u8; 896] = read(&mut next);
    assert!(lola::state::decode(&state).is_ok());
    assert!(simulator.is_running());
}
