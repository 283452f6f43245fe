//! A machine that feeds the outpost in Rust, with what teams have for that.

use std::net::SocketAddr;
use std::path::PathBuf;
use std::time::{Duration, SystemTime, UNIX_EPOCH};

use hulkgen_zenoh::{Counts, Error, Feeder, Robot, Watched};
use protocol::{Ask, Good, Timings};
use serde::{Deserialize, Serialize};
use serde_json::json;

use super::*;

/// A lookout's main outputs.
#[derive(Serialize)]
struct Outputs {
    ship: Ship,
}

#[derive(Serialize)]
struct Ship {
    number: u64,
    distance: f32,
}

/// A line of the robot's book.
#[derive(Clone, Debug, Deserialize)]
struct Entry {
    /// In nanoseconds of the robot's clock.
    time: u64,
    number: u64,
}

/// An outpost behind its bridge.
struct Outpost {
    robot_at: SocketAddr,
    zenoh_at: SocketAddr,
    folder: PathBuf,
    bridge: Option<Running>,
    _robot: Running,
}

impl Outpost {
    fn start(test: &str) -> Result<Self, &'static str> {
        let program = robots()?.outpost;
        let folder = std::env::temp_dir().join(format!("hulkgen-{test}-{}", std::process::id()));
        let (robot_at, zenoh_at) = (free_address(), free_address());
        let here = Place(None);
        Ok(Self {
            robot_at,
            zenoh_at,
            bridge: Some(here.bridge(robot_at, zenoh_at)),
            _robot: here.robot(&program, robot_at, &folder),
            folder,
        })
    }

    /// As the other machine sees it, with its lookouts and its book.
    fn lookouts(&self) -> (Robot, Feeder, Feeder, Book) {
        let robot = Robot::connect(&format!("tcp/{}", self.zenoh_at), "").expect("it is one");
        let feeder = |key| robot.feeder(key).expect("it is a key");
        let (north, south) = (feeder("outpost/north"), feeder("outpost/south"));
        let book = Book(robot.watch("outpost/entries").expect("it is a key"));
        eventually("the bridge", || north.is_heard() && south.is_heard());
        eventually("the book", || {
            book.0.newest().is_ok_and(|one| one.is_some())
        });
        (robot, north, south, book)
    }

    fn timings(&self) -> Timings {
        let host = self.robot_at.to_string();
        let mut robot = client::Robot::connect(&host, None).expect("the robot runs");
        match robot.ask(Ask::Timings {}) {
            Ok(Good::Timings(timings)) => timings,
            other => panic!("{other:?}"),
        }
    }
}

impl Drop for Outpost {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.folder);
    }
}

struct Book(Watched<Vec<Entry>>);

impl Book {
    fn entries(&self) -> Vec<Entry> {
        let newest = self.0.newest().expect("it is a list of entries");
        newest.map(|newest| newest.value).unwrap_or_default()
    }

    /// Until this ship is in it.
    fn await_ship(&self, number: u64) {
        eventually(&format!("ship {number}"), || {
            self.entries().iter().any(|entry| entry.number == number)
        });
    }
}

fn eventually(what: &str, mut condition: impl FnMut() -> bool) {
    let begin = Instant::now();
    while !condition() {
        assert!(begin.elapsed() < PATIENCE, "no {what}");
        thread::sleep(Duration::from_millis(20));
    }
}

fn ship(number: u64) -> Outputs {
    Outputs {
        ship: Ship {
            number,
            distance: 120.5,
        },
    }
}

fn nanoseconds(time: SystemTime) -> u64 {
    let since = time.duration_since(UNIX_EPOCH).expect("it is after 1970");
    u64::try_from(since.as_nanos()).expect("it is before 2554")
}

/// Every tenth cycle of the north is abandoned, and every tenth comes only when the robot has gone on with what the south saw
/// later: those are late, and all others in the order in which they were seen.
#[test]
fn a_hundred_cycles_come_by_the_times_at_which_they_were_taken() {
    const TEST: &str = "a_hundred_cycles_come_by_the_times_at_which_they_were_taken";
    let outpost = match Outpost::start("hundred") {
        Ok(outpost) => outpost,
        Err(what) => return skip(TEST, what),
    };
    let (_robot, mut north, mut south, book) = outpost.lookouts();
    let base = SystemTime::now();
    thread::sleep(Duration::from_millis(1100));
    let mut expected = Vec::new();
    for number in 0..100 {
        // All of them are past.
        let taken = base + Duration::from_millis(10) * u32::try_from(number).expect("it is small");
        if number % 10 == 7 {
            let later = taken + Duration::from_millis(5);
            let cycle = south.announce(later).expect("it is a time");
            cycle
                .complete(&ship(1000 + number))
                .expect("it is a struct");
            expected.push((nanoseconds(later), 1000 + number));
            book.await_ship(1000 + number);
        }
        let cycle = north.announce(taken).expect("it is a time");
        assert_eq!(cycle.time(), nanoseconds(taken));
        if number % 10 == 3 {
            cycle.abandon();
            continue;
        }
        cycle.complete(&ship(number)).expect("it is a struct");
        expected.push((nanoseconds(taken), number));
        // The robot's queue has places for eight.
        if number % 4 == 2 {
            book.await_ship(number);
        }
    }
    book.await_ship(99);
    let entries = book.entries();
    let numbers = |numbers: &mut dyn Iterator<Item = u64>| numbers.collect::<Vec<_>>();
    assert_eq!(
        numbers(&mut entries.iter().map(|entry| entry.number)),
        numbers(&mut expected.iter().map(|(_, number)| *number))
    );
    let shift = expected[0].0 - entries[0].time;
    for ((seen, _), entry) in expected.iter().zip(&entries) {
        assert_eq!(
            seen - entry.time,
            shift,
            "the time of ship {}",
            entry.number
        );
    }
    assert!(north.settle(PATIENCE) && south.settle(PATIENCE));
    let all = |accepted| Counts {
        accepted,
        ..Counts::default()
    };
    assert_eq!((north.counts(), south.counts()), (all(200), all(20)));
    let timings = outpost.timings();
    let remotes: Vec<_> = (timings.remotes.iter())
        .map(|one| (one.completed, one.unannounced, one.abandoned, one.refused))
        .collect();
    assert_eq!(remotes, [(90, 0, 10, 0), (10, 0, 0, 0)]);
    let queues = &timings.instances[0].queues;
    let late: Vec<_> = queues
        .iter()
        .map(|queue| (queue.late, queue.dropped))
        .collect();
    assert_eq!(late, [(10, 0), (0, 0)]);
}

#[test]
fn who_feeds_is_told_what_is_wrong() {
    let outpost = match Outpost::start("told") {
        Ok(outpost) => outpost,
        Err(what) => return skip("who_feeds_is_told_what_is_wrong", what),
    };
    let (robot, mut north, _south, book) = outpost.lookouts();
    let now = SystemTime::now();
    let hour = Duration::from_secs(3600);
    let mut refused = |taken, outputs: serde_json::Value| {
        let cycle = north.announce(taken).expect("it is a time");
        cycle.complete(&outputs).expect("it is an object");
        assert!(north.settle(PATIENCE));
        let refusals = north.refusals().into_iter();
        refusals.map(|one| one.to_string()).collect::<String>()
    };
    let good = json!({ "ship": { "number": 1, "distance": 1.0 } });
    let told = refused(now + hour, good.clone());
    assert!(
        told.contains("is the clock of the other machine ahead?"),
        "{told}"
    );
    let told = refused(now - hour, good);
    assert!(told.contains("before the robot's clock started"), "{told}");
    let told = refused(now, json!({ "ship": { "number": "one", "distance": 1.0 } }));
    assert!(told.contains("`ship`"), "{told}");
    let told = refused(SystemTime::now(), json!({}));
    assert!(told.contains("ship"), "{told}");

    let before = UNIX_EPOCH - hour;
    let error = north.announce(before).expect_err("nothing was taken then");
    assert_eq!(error, Error::Time(before));
    let counts = north.counts();
    for outputs in [json!([1]), json!({ "ship": "0".repeat(1 << 20) })] {
        let cycle = north.announce(SystemTime::now()).expect("it is a time");
        let error = cycle.complete(&outputs).expect_err("these are none");
        assert!(matches!(error, Error::Outputs(_)), "{error}");
    }
    assert!(north.settle(PATIENCE));
    // Announced and abandoned.
    assert_eq!(north.counts().accepted, counts.accepted + 4);

    let nobody = robot.read::<u64>("outpost/nothing");
    assert_eq!(nobody, Err(Error::Unanswered("outpost/nothing".to_owned())));
    assert!(robot.feeder("outpost//north").is_err());
    assert!(Robot::connect("nowhere", "").is_err());
    assert_eq!(book.entries().len(), 0, "nothing of this is written down");
}

#[test]
fn a_feeder_finds_its_bridge_again() {
    let mut outpost = match Outpost::start("again") {
        Ok(outpost) => outpost,
        Err(what) => return skip("a_feeder_finds_its_bridge_again", what),
    };
    let (_robot, mut north, _south, book) = outpost.lookouts();
    let see = |north: &mut Feeder, number| {
        let cycle = north.announce(SystemTime::now()).expect("it is a time");
        cycle.complete(&ship(number)).expect("it is a struct");
        assert!(north.settle(PATIENCE));
    };
    see(&mut north, 1);
    book.await_ship(1);
    outpost.bridge = None;
    eventually("end of the bridge", || !north.is_heard());
    see(&mut north, 2);
    assert_eq!(north.counts().unanswered, 2);
    wait_until_free(outpost.zenoh_at);
    outpost.bridge = Some(Place(None).bridge(outpost.robot_at, outpost.zenoh_at));
    eventually("bridge", || north.is_heard());
    see(&mut north, 3);
    book.await_ship(3);
    assert_eq!((north.counts().accepted, north.refusals()), (4, Vec::new()));
}

#[test]
fn parameters_and_outputs_are_read_as_values() {
    #[derive(Deserialize)]
    struct Pose {
        heading: f32,
    }
    const TEST: &str = "parameters_and_outputs_are_read_as_values";
    let program = match robots() {
        Ok(parts) => parts.zoo,
        Err(what) => return skip(TEST, what),
    };
    let folder = std::env::temp_dir().join(format!("hulkgen-values-{}", std::process::id()));
    let (robot_at, zenoh_at) = (free_address(), free_address());
    let here = Place(None);
    let _robot = here.robot(&program, robot_at, &folder);
    let _bridge = here.bridge(robot_at, zenoh_at);
    let robot = Robot::connect(&format!("tcp/{zenoh_at}"), "").expect("it is one");
    let speed = robot.watch::<f32>("zoo/speed").expect("it is a key");
    let pose = robot
        .watch::<Option<Pose>>("zoo/pose")
        .expect("it is a key");
    let wrong = robot.watch::<Vec<u8>>("zoo/speed").expect("it is a key");
    let newest = || Some((speed.newest().ok()??, pose.newest().ok()??));
    eventually("values", || newest().is_some() && wrong.newest().is_err());
    let (first, pose) = newest().expect("they were there");
    assert!(pose.value.is_none_or(|pose| pose.heading.is_finite()));
    eventually("later value", || {
        newest().is_some_and(|(speed, _)| speed.cycle > first.cycle && speed.time > first.time)
    });
    let walking = robot.read::<f64>("zoo/walking_speed");
    assert!(walking.is_ok_and(|speed| speed > 0.0));
    let wrong = robot.read::<Vec<u8>>("zoo/walking_speed");
    assert!(matches!(wrong, Err(Error::Unreadable { .. })));
    let _ = std::fs::remove_dir_all(&folder);
}

/// The example beside this test, on another machine.
pub(super) fn example(place: &Place, zenoh_at: SocketAddr) {
    let test = std::env::current_exe().expect("this is a program");
    let folder = test
        .ancestors()
        .nth(2)
        .expect("cargo has a folder for each kind");
    let mut lookout = place.command(&folder.join("examples/lookout"));
    lookout
        .arg(format!("tcp/{zenoh_at}"))
        .args(["outpost/north", "100"]);
    let output = lookout.output().expect("cargo builds examples for tests");
    let said = String::from_utf8_lossy(&output.stdout);
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{said}{stderr}");
    assert_eq!(said, "200 accepted, 0 refused, 0 unanswered\n");
}

#[test]
fn the_example_feeds_a_robot() {
    let outpost = match Outpost::start("example") {
        Ok(outpost) => outpost,
        Err(what) => return skip("the_example_feeds_a_robot", what),
    };
    let (_robot, _north, _south, book) = outpost.lookouts();
    example(&Place(None), outpost.zenoh_at);
    book.await_ship(98);
    let numbers: Vec<u64> = book.entries().iter().map(|entry| entry.number).collect();
    let expected: Vec<u64> = (0..100).filter(|number| number % 5 != 4).collect();
    assert_eq!(numbers, expected);
}
