//! What becomes of a recording, as clients on real sockets see it while the robot runs.

use std::ffi::{OsStr, OsString};
use std::sync::mpsc::channel;
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;
use std::time::Duration;

use framework::launch::{self, Listening, Served as _};
use framework::parameters::Layers;
use framework::recorded::{About, Recording, Settings};
use framework::testing::created;
use framework::{Clock, Rearm, Record, Stop, Target, Threads};
use hulkgen_communication::{Limits, Server};
use serde_json::{Value, json};
use zoo_hardware::Hardware;
use zoo_runtime::parameters::Parameters;
use zoo_runtime::{recording, runtime};

#[expect(dead_code, reason = "other tests need more of it")]
#[path = "server/zoo.rs"]
mod zoo;

#[path = "server/started.rs"]
mod started;

use zoo::{Client, eventually};

const PARAMETERS: &str = concat!(
    env!("CARGO_MANIFEST_DIR"),
    "/../../tests/robots/zoo/parameters"
);

const TARGET: Target = Target {
    robot: "zoo",
    name: "loud",
    parameters: PARAMETERS,
    location: None,
    identities: &[],
    graph: "{}",
    recording_budget: 1 << 20,
    manifest: "",
    dataflow: "",
    replayables: recording::INSTANCES,
};

/// Signals and log messages are of the process: one program at a time.
static TURN: Mutex<()> = Mutex::new(());

/// What a client of the robot's program sees, which is started with these options.
fn while_it_runs(options: &[&OsStr], look: impl FnOnce(&mut Client)) {
    let _turn = TURN.lock().unwrap_or_else(PoisonError::into_inner);
    let (started, starts) = channel();
    let words = [OsStr::new("--listen=127.0.0.1:0")];
    let words = words.iter().chain(options).copied();
    let words: Vec<OsString> = words.map(OsStr::to_owned).collect();
    thread::scope(|scope| {
        let runs = scope.spawn(|| {
            started::tell(started);
            let output = &mut Vec::new();
            launch::run::<Hardware, Parameters>(
                TARGET,
                words,
                output,
                runtime::create,
                started::serve,
            )
        });
        let (address, stop) = starts.recv().expect("it starts");
        // Also where an assertion fails.
        let _end = End(stop.clone());
        look(&mut Client::connect(address).expect("the server lets it in"));
        stop.request();
        assert_eq!(runs.join().expect("no thread panics"), 0);
    });
}

/// Ends a robot when it is dropped.
struct End(Stop);

impl Drop for End {
    fn drop(&mut self) {
        self.0.request();
    }
}

fn timings(client: &mut Client) -> Value {
    client.ok(json!({ "timings": {} }))["timings"].clone()
}

/// Of whom there are counts, in their order.
fn names(timings: &Value) -> Vec<&str> {
    let counts = timings["recording"].as_array().expect("a list");
    counts.iter().filter_map(|one| one["of"].as_str()).collect()
}

/// How many frames of an instance are recorded, and how many are dropped.
fn counts(timings: &Value, instance: &str) -> (u64, u64) {
    let mut all = timings["recording"].as_array().expect("a list").iter();
    let one = all.find(|one| one["of"] == instance).expect("it has one");
    let count = |key: &str| one[key].as_u64().expect("a number");
    assert_eq!(
        (count("failed"), count("lost"), count("overwritten")),
        (0, 0, 0)
    );
    (count("recorded"), count("dropped"))
}

#[test]
fn whose_frames_find_no_block_is_seen_while_the_robot_runs() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let layers = Layers {
        directory: PARAMETERS.into(),
        ..Layers::default()
    };
    let (clock, stop) = (Clock::wall(), Stop::new());
    let (hardware, mut robot): (Arc<Hardware>, _) =
        created(&layers, "loud", &[], &clock, &stop, runtime::create);
    // Whoever comes first keeps the only block; it has room for longer than this takes.
    let settings = Settings {
        blocks: 1,
        block_bytes: 64 << 20,
        longest: Duration::from_secs(3600),
        ..Settings::default()
    };
    let two = ["VisionTop", "Control"];
    let path = folder.path().join("zoo.mcap");
    let recording = Recording::start_with(&path, &robot, About::default(), settings, |one| {
        if two.contains(&one.name) {
            Record::On
        } else {
            Record::Off
        }
    });
    let mut recording = recording.expect("the folder is empty");
    let mut link = robot.link(&stop, Rearm::default());
    link.recorded = recording.shared_counts();
    let listening = Listening {
        target: "loud",
        address: Some("127.0.0.1:0".to_owned()),
        ..Listening::default()
    };
    let server = Server::start(link, listening, Limits::default()).expect("a free port");
    thread::scope(|scope| {
        let runs = scope.spawn(|| {
            Threads::new(&clock, hardware.as_ref(), &stop)
                .run_observed(&mut robot.instances, |one| recording.observer(one))
        });
        let _end = End(stop.clone());
        let mut client = Client::connect(server.address()).expect("the server lets it in");
        eventually("one has the block, the other has none", || {
            let now = timings(&mut client);
            let mut seen = two.map(|instance| counts(&now, instance));
            seen.sort_unstable();
            assert!(seen[0].0 == 0 && seen[1].1 == 0, "{now}");
            seen[0].1 > 1 && seen[1].0 > 1
        });
        let now = timings(&mut client);
        assert_eq!(counts(&now, "VisionBottom"), (0, 0), "it is not recorded");
        stop.request();
        let ended = runs.join().expect("no thread panics");
        ended.expect("the robot does not fail");
    });
    assert_eq!(recording.end().state(), "INCOMPLETE");
}

#[test]
fn a_program_that_records_tells_its_clients_so() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("zoo.mcap");
    while_it_runs(&[OsStr::new("--record"), path.as_os_str()], |client| {
        let now = timings(client);
        let instances = now["instances"].as_array().expect("a list");
        let instances = instances.iter().filter_map(|one| one["name"].as_str());
        assert_eq!(names(&now), Vec::from_iter(instances.chain(["logs"])));
        let before = counts(&now, "Control").0;
        eventually("more frames are recorded", || {
            counts(&timings(client), "Control").0 > before
        });
    });
}

#[test]
fn where_nothing_is_recorded_there_is_nothing_about_it() {
    while_it_runs(&["--record", "off"].map(OsStr::new), |client| {
        let now = timings(client);
        assert!(now["instances"][0]["cycles"].is_u64(), "{now}");
        assert_eq!(now.get("recording"), None);
    });
}
