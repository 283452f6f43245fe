//! The generated outpost in lockstep, fed in the name of the machine that runs its lookouts.

use std::path::Path;
use std::sync::Arc;

use framework::parameters::Layers;
use framework::recorded::{About, Recording, Settings};
use framework::replay::verify;
use framework::testing::created;
use framework::{Clock, Feed, Lockstep, QueueCounts, Record, Stop, Timestamp};
use hulkgen_recording::Recording as File;
use outpost_hardware::Hardware;
use outpost_runtime::parameters::Parameters;
use outpost_runtime::{recording, runtime};
use serde_json::{Value, json};

type Robot = framework::Robot<Parameters>;

fn outpost() -> (Arc<Hardware>, Robot) {
    let layers = Layers {
        directory: Path::new(env!("CARGO_MANIFEST_DIR")).join("../parameters"),
        ..Layers::default()
    };
    let (clock, stop) = (Clock::stepped(), Stop::new());
    created(&layers, "tower", &[], &clock, &stop, runtime::create)
}

fn at(millis: u64) -> Timestamp {
    Timestamp::from_nanos(millis * 1_000_000)
}

fn ship(number: u64) -> Value {
    json!({ "ship": { "number": number, "distance": 120.5 }, "echo": "not read here" })
}

/// Times in milliseconds and numbers of the ships in an output of the keeper.
fn written(robot: &Robot, output: &str) -> Vec<(u64, u64)> {
    let path = format!("Keeper.main_outputs.{output}");
    let value = robot.read(&path).expect("it is an output");
    let number = |value: &Value| value.as_u64().expect("a whole number");
    let entry = |entry: &Value| (number(&entry["time"]) / 1_000_000, number(&entry["number"]));
    match &value {
        Value::Array(entries) => entries.iter().map(entry).collect(),
        Value::Null => Vec::new(),
        one => vec![entry(one)],
    }
}

#[test]
fn what_runs_elsewhere_is_there_and_was_never_written() {
    let (hardware, mut robot) = outpost();
    let names = ["LookoutNorth", "LookoutSouth"];
    assert_eq!(robot.left_out, names);
    let remotes = robot.remotes.iter().map(|remote| remote.instance());
    assert_eq!(remotes.collect::<Vec<_>>(), names);
    assert!(robot.instance("LookoutNorth").is_err());
    let mut lockstep = Lockstep::new(&mut robot, &*hardware);
    lockstep.run_until(at(1005), |_| {}).expect("no node fails");
    let robot = lockstep.robot();
    let cycles = robot.instance("Keeper").expect("it runs").cycle().number;
    assert_eq!(cycles, 100);
    for output in ["entries", "provisional", "newest_in_the_north"] {
        assert_eq!(written(robot, output), [], "{output}");
    }
}

/// What happens when, in milliseconds, and what the keeper has written a cycle later.
struct Scene<'story> {
    at: u64,
    deed: &'story dyn Fn(&mut dyn Feed, &mut dyn Feed),
    entries: &'story [(u64, u64)],
    provisional: &'story [(u64, u64)],
}

#[test]
fn ships_are_written_down_by_the_times_at_which_they_were_seen_and_replayed_so() {
    let story = [
        Scene {
            at: 25,
            deed: &|north, south| {
                north.announce(at(12)).expect("it was 12 ms");
                south.complete(at(14), &ship(2)).expect("it was 14 ms");
            },
            entries: &[],
            provisional: &[(14, 2)],
        },
        Scene {
            at: 45,
            deed: &|north, _| north.complete(at(12), &ship(1)).expect("it is announced"),
            entries: &[(12, 1), (14, 2)],
            provisional: &[],
        },
        // The completion from the north gets lost.
        Scene {
            at: 65,
            deed: &|north, south| {
                north.announce(at(60)).expect("it was 60 ms");
                south.announce(at(62)).expect("it was 62 ms");
                south.complete(at(62), &ship(4)).expect("it is announced");
            },
            entries: &[(12, 1), (14, 2)],
            provisional: &[(62, 4)],
        },
        Scene {
            at: 5055,
            deed: &|_, _| {},
            entries: &[(12, 1), (14, 2)],
            provisional: &[(62, 4)],
        },
        Scene {
            at: 5065,
            deed: &|_, _| {},
            entries: &[(12, 1), (14, 2), (62, 4)],
            provisional: &[],
        },
        // It was only late.
        Scene {
            at: 5075,
            deed: &|north, _| north.complete(at(60), &ship(3)).expect("it is announced"),
            entries: &[(12, 1), (14, 2), (62, 4), (60, 3)],
            provisional: &[],
        },
        // The other machine goes away.
        Scene {
            at: 5095,
            deed: &|north, south| {
                north.announce(at(5080)).expect("it was that");
                south.complete(at(5081), &ship(5)).expect("it was that");
                north.let_go();
            },
            entries: &[(12, 1), (14, 2), (62, 4), (60, 3), (5081, 5)],
            provisional: &[],
        },
    ];
    let (hardware, mut robot) = outpost();
    let mut remotes = std::mem::take(&mut robot.remotes);
    let [north, south] = remotes.as_mut_slice() else {
        panic!("two instances run elsewhere");
    };
    let folder = tempfile::tempdir().expect("there is room for a folder");
    let path = folder.path().join("outpost.mcap");
    let (about, settings) = (About::default(), Settings::default());
    let tape = Recording::start_with(&path, &robot, about, settings, |_| Record::On);
    let mut tape = tape.expect("the folder is empty");
    let observe = |instance: &_| tape.observer(instance);
    let mut lockstep = Lockstep::new(&mut robot, &*hardware).observed(observe);
    for scene in story {
        let mut run_until = |millis| {
            lockstep
                .run_until(at(millis), |_| {})
                .expect("no node fails")
        };
        run_until(scene.at);
        (scene.deed)(north.as_mut(), south.as_mut());
        run_until(scene.at + 10);
        let robot = lockstep.robot();
        assert_eq!(written(robot, "entries"), scene.entries, "{}", scene.at);
        let provisional = written(robot, "provisional");
        assert_eq!(provisional, scene.provisional, "{}", scene.at);
    }
    let robot = lockstep.robot();
    assert_eq!(written(robot, "newest_in_the_north"), [(60, 3)]);
    let report = robot.instance("Keeper").expect("it runs").report();
    let counts = report.queues.iter().map(|queue| (queue.from, queue.counts));
    let north_counts = QueueCounts {
        delivered: 2,
        late: 1,
        expired: 1,
        abandoned: 1,
        dropped: 0,
    };
    let south_counts = QueueCounts {
        delivered: 3,
        ..QueueCounts::default()
    };
    let expected = [
        ("LookoutNorth", north_counts),
        ("LookoutSouth", south_counts),
    ];
    assert_eq!(counts.collect::<Vec<_>>(), expected);
    drop(lockstep);

    // What was consumed is in the recording by value: nobody has to feed its replay.
    let report = tape.end();
    assert!(report.ended.is_complete, "{report}");
    let file = File::open(&path).expect("it was written");
    let verification = verify(&file, recording::INSTANCES).expect("it is of this robot");
    assert_eq!(verification.divergence, None, "{verification}");
    let [keeper] = verification.instances.as_slice() else {
        panic!("one instance runs here: {verification}");
    };
    assert_eq!(
        (keeper.instance.as_str(), keeper.verified),
        ("Keeper", 510),
        "{verification}"
    );
    assert!(keeper.outputs > 0, "{verification}");
}
