//! The generated zoo recorded and replayed: the same bits, or the place where they differ.

#[path = "recording/asked.rs"]
mod asked;
#[path = "recording/captured.rs"]
mod captured;
#[path = "recording/carried.rs"]
mod carried;
#[path = "recording/cost.rs"]
mod cost;
#[path = "recording/divergence.rs"]
mod divergence;
#[path = "recording/numerics.rs"]
mod numerics;
#[path = "recording/outputs.rs"]
mod outputs;
#[path = "recording/python.rs"]
mod python;
#[path = "recording/shelved.rs"]
mod shelved;
#[path = "recording/slow.rs"]
mod slow;
#[path = "recording/some.rs"]
mod some;
#[path = "recording/timeline.rs"]
mod timeline;
#[path = "recording/types.rs"]
mod types;

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

use framework::driver::Observer;
use framework::parameters::Layers;
use framework::recorded::{About, Recording, RecordingReport, Settings};
use framework::replay::{Players, Ran, Shelf, Verification, verify};
use framework::testing::created;
use framework::{
    Clock, Given, InstanceDescription, Lockstep, Record, Robot, Stop, Threads, Timestamp,
};
use hulkgen_recording::Recording as File;
use serde_json::json;
use zoo_hardware::Hardware;
use zoo_runtime::parameters::Parameters;
use zoo_runtime::{recording, runtime};

const INSTANCES: [&str; 6] = [
    "VisionTop",
    "VisionBottom",
    "Hearing",
    "Control",
    "Reflexes",
    "Lights",
];

/// Small enough that a second of the zoo has many blocks and chunks.
const SMALL: Settings = Settings {
    budget: 1 << 30,
    blocks: 16,
    block_bytes: 16 << 10,
    late: 0,
    chunk_bytes: 32 << 10,
    longest: Duration::from_secs(10),
};

struct Zoo {
    hardware: Arc<Hardware>,
    robot: Robot<Parameters>,
    stop: Stop,
}

impl Zoo {
    fn new(clock: Clock) -> Self {
        let directory = concat!(env!("CARGO_MANIFEST_DIR"), "/../parameters").into();
        let layers = Layers {
            directory,
            ..Layers::default()
        };
        let stop = Stop::default();
        let (hardware, robot) = created(&layers, "loud", &[], &clock, &stop, runtime::create);
        Self {
            hardware,
            robot,
            stop,
        }
    }
}

/// A folder for one recording.
struct Tape {
    _folder: tempfile::TempDir,
    path: PathBuf,
}

impl Tape {
    fn new() -> Self {
        let folder = tempfile::tempdir().expect("there is room for a folder");
        Self {
            path: folder.path().join("zoo.mcap"),
            _folder: folder,
        }
    }

    fn read(&self) -> File {
        File::open(&self.path).expect("it was written")
    }

    fn verify(&self) -> Verification {
        verify(&self.read(), recording::INSTANCES).expect("it is of this robot")
    }
}

type Wrap<'a> = &'a dyn Fn(&InstanceDescription, Box<dyn Observer>) -> Box<dyn Observer>;

/// Records some seconds in lockstep; a client calls, injects, listens and changes a parameter meanwhile.
fn record_in_lockstep(
    path: &Path,
    settings: Settings,
    record_of: impl Fn(&InstanceDescription) -> Record,
    wrap: Wrap<'_>,
) -> RecordingReport {
    let mut zoo = Zoo::new(Clock::stepped());
    let mut recording =
        Recording::start_with(path, &zoo.robot, About::default(), settings, record_of)
            .expect("the folder is empty");
    let hardware = zoo.hardware.clone();
    let mut lockstep = Lockstep::new(&mut zoo.robot, &*hardware).observed(|instance| {
        let observer = recording.observer(instance)?;
        Some(wrap(instance, observer))
    });
    for step in 1..=20_u64 {
        disturb(lockstep.robot_mut(), step);
        let end = Timestamp::from_nanos(step * 100_000_000);
        lockstep.run_until(end, |_| {}).expect("the zoo goes on");
    }
    drop(lockstep);
    recording.end()
}

/// What clients do.
fn disturb(robot: &mut Robot<Parameters>, step: u64) {
    let access = robot.access("Control").expect("it is an instance");
    match step {
        3 => {
            assert!(access.subscriptions.subscribe("debug.certainty"));
            let eye = robot.access("VisionTop").expect("it is an instance");
            assert!(eye.subscriptions.subscribe("vision_top.width"));
        }
        5 => {
            let (_, walk) = access
                .procedures
                .iter()
                .find(|(name, _)| *name == "walk")
                .expect("gait answers it");
            let request = json!({ "speed": 0.25 });
            drop(walk.call_any(&Given::from(&request)));
        }
        7 => access
            .injector
            .inject("speed", &Given::from(&json!(3.0)))
            .expect("it is a number"),
        9 => access.injector.release("speed").expect("it is injected"),
        11 => {
            let version = robot.parameters.change(&[("walking_speed", json!(0.7))]);
            version.expect("it is a number");
        }
        _ => {}
    }
}

fn as_it_is(_: &InstanceDescription, observer: Box<dyn Observer>) -> Box<dyn Observer> {
    observer
}

fn on(_: &InstanceDescription) -> Record {
    Record::On
}

fn assert_good(verification: &Verification) {
    assert!(verification.is_good(), "{verification}");
    let names: Vec<_> = verification
        .instances
        .iter()
        .map(|one| &*one.instance)
        .collect();
    assert_eq!(names, INSTANCES);
}

#[test]
fn a_run_in_lockstep_is_recomputed_bit_for_bit() {
    let tape = Tape::new();
    let report = record_in_lockstep(&tape.path, Settings::default(), on, &as_it_is);
    assert!(report.ended.is_complete, "{report}");
    let verification = tape.verify();
    assert_good(&verification);
    for (verified, recorded) in verification.instances.iter().zip(&report.instances) {
        let name = &verified.instance;
        assert_eq!(verified.wanted, Some(recorded.wanted), "{name}");
        assert_eq!(verified.frames, recorded.recorded, "{name}");
        let compared = verified.verified + verified.unfinished + verified.needs_hardware;
        assert_eq!(compared, verified.frames, "{name}");
        // Lights writes no outputs: that its cycles finish is all there is.
        assert_eq!(verified.outputs > 0, name != "Lights", "{name}");
    }
    let control = verification.instances[3].clone();
    assert!(control.verified > 150, "{verification}");
    assert!(tape.read().is_complete());
}

#[test]
fn a_run_in_threads_is_recomputed_bit_for_bit() {
    let tape = Tape::new();
    let clock = Clock::wall();
    let mut zoo = Zoo::new(clock.clone());
    let mut recording = Recording::start(
        &tape.path,
        &zoo.robot,
        About::default(),
        Settings::default(),
    )
    .expect("the folder is empty");
    let threads = Threads::new(&clock, &*zoo.hardware, &zoo.stop);
    let stop = zoo.stop.clone();
    let timer = std::thread::spawn(move || {
        std::thread::sleep(Duration::from_secs(1));
        stop.request();
    });
    threads
        .run_observed(&mut zoo.robot.instances, |instance| {
            recording.observer(instance)
        })
        .expect("the zoo goes on");
    timer.join().expect("it only waits");
    let report = recording.end();
    assert!(report.ended.is_complete, "{report}");
    assert_good(&tape.verify());
}

#[test]
fn every_cycle_can_be_the_first_and_time_can_go_back() {
    let tape = Tape::new();
    record_in_lockstep(&tape.path, SMALL, on, &as_it_is);
    let file = tape.read();
    assert!(file.chunks.len() > 3, "{} chunks", file.chunks.len());
    let shelf = Shelf::of(&file).expect("it is of this version");
    for instance in INSTANCES {
        // Alone from each of these, and on with one player: forwards, to the end, back, and to the end again.
        let mut played = Players::new(&shelf, recording::INSTANCES).expect("it fits");
        let (player, chunks) = played.of(instance).expect("it is an instance");
        let last = player.frames.len() - 1;
        for position in [0, last / 2, last / 2 + 1, last, last / 3, 1, last] {
            let mut fresh = Players::new(&shelf, recording::INSTANCES).expect("it fits");
            let (fresh, _) = fresh.of(instance).expect("it is an instance");
            for player in [&mut *player, fresh] {
                let recorded = player.digests(position, chunks);
                let Some(recorded) = recorded.expect("it can be read") else {
                    continue;
                };
                let ran = player.play(position, chunks).expect("the frame is whole");
                if ran == Ran::NeedsHardware {
                    continue;
                }
                let mut digests = Vec::new();
                let replay = player.replay().expect("it was loaded");
                let visited = replay
                    .instance()
                    .digests(&mut |_, _, digest| digests.push(digest));
                visited.expect("every output serialises");
                assert_eq!(digests, recorded, "{instance} {position}");
            }
        }
    }
}
