//! A recording that is served in place of a robot: what clients on real sockets get of it, whichever way the time goes.

use std::ffi::OsStr;
use std::net::SocketAddr;
use std::path::PathBuf;
use std::sync::mpsc::channel;
use std::sync::{LazyLock, Mutex, MutexGuard, PoisonError};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

use framework::launch;
use framework::logs::{self, Sink};
use framework::parameters::Layers;
use framework::recorded::{About, Recording, Settings};
use framework::testing::created;
use framework::{Clock, Lockstep, Record, Stop, Target, Timestamp};
use serde_json::{Value, json};
use zoo_hardware::Hardware;
use zoo_runtime::parameters::Parameters;
use zoo_runtime::{recording, runtime};

#[expect(dead_code, reason = "other tests need more of it")]
#[path = "server/zoo.rs"]
mod zoo;

#[path = "server/started.rs"]
mod started;

use zoo::{Client, PATIENCE, eventually};

const TIMELINE: &str = "Replay.procedures.timeline";
const SPEED: &str = "parameters.walking_speed";
const SEEN: &str = "Control.additional_outputs.debug.watcher.seen";

const TARGET: Target = Target {
    robot: "zoo",
    name: "loud",
    parameters: "parameters",
    location: None,
    identities: &[],
    graph: "{}",
    recording_budget: 0,
    manifest: "",
    dataflow: "",
    replayables: recording::INSTANCES,
};

/// Two seconds of the zoo, recorded before any replay runs.
static TAPE: LazyLock<Tape> = LazyLock::new(Tape::record);

/// Who listens hears every replay of the process: one at a time.
static TURN: Mutex<()> = Mutex::new(());

/// A recording, and what nodes said meanwhile.
struct Tape {
    _folder: tempfile::TempDir,
    path: PathBuf,
    said: Vec<logs::Record>,
}

impl Tape {
    /// After a second somebody walks faster.
    fn record() -> Self {
        let folder = tempfile::tempdir().expect("there is room for a folder");
        let path = folder.path().join("zoo.mcap");
        let directory = concat!(
            env!("CARGO_MANIFEST_DIR"),
            "/../../tests/robots/zoo/parameters"
        );
        let layers = Layers {
            directory: directory.into(),
            ..Layers::default()
        };
        let (clock, stop) = (Clock::stepped(), Stop::new());
        let (hardware, mut robot): (std::sync::Arc<Hardware>, _) =
            created(&layers, "loud", &[], &clock, &stop, runtime::create);
        let sink = Sink::new(clock);
        let mut recording =
            Recording::start_with(&path, &robot, About::default(), Settings::default(), |_| {
                Record::On
            })
            .expect("the folder is empty");
        let mut lockstep =
            Lockstep::new(&mut robot, &*hardware).observed(|one| recording.observer(one));
        for second in 1..=2 {
            let end = Timestamp::from_nanos(second * 1_000_000_000);
            lockstep.run_until(end, |_| {}).expect("the zoo goes on");
            let change = lockstep
                .robot_mut()
                .parameters
                .change(&[("walking_speed", json!(0.75))]);
            change.expect("it is a number");
        }
        drop(lockstep);
        let report = recording.end();
        assert!(report.ended.is_complete, "{report}");
        Self {
            said: std::iter::from_fn(|| sink.take()).collect(),
            path,
            _folder: folder,
        }
    }
}

/// A program that shows the recording, until it is dropped.
struct Replayed {
    address: SocketAddr,
    stop: Stop,
    runs: Option<JoinHandle<u8>>,
    _turn: MutexGuard<'static, ()>,
}

impl Replayed {
    /// It stands still.
    fn new() -> (Self, Client) {
        let turn = TURN.lock().unwrap_or_else(PoisonError::into_inner);
        let path = &TAPE.path;
        let (started, starts) = channel();
        let runs = thread::spawn(move || {
            started::tell(started);
            let words = [
                OsStr::new("--replay"),
                path.as_os_str(),
                OsStr::new("--listen=127.0.0.1:0"),
            ];
            launch::run::<Hardware, Parameters>(
                TARGET,
                words.map(OsStr::to_owned),
                &mut Vec::new(),
                |_, _| unreachable!("a replay has no robot"),
                started::serve,
            )
        });
        let (address, stop) = starts.recv().expect("it starts");
        let replayed = Self {
            address,
            stop,
            runs: Some(runs),
            _turn: turn,
        };
        let mut client = replayed.client();
        go(&mut client, json!({ "play": false }));
        (replayed, client)
    }

    fn client(&self) -> Client {
        Client::connect(self.address).expect("the server lets it in")
    }
}

impl Drop for Replayed {
    fn drop(&mut self) {
        self.stop.request();
        let ended = self.runs.take().map(JoinHandle::join);
        if !thread::panicking() {
            assert_eq!(ended.expect("it ran").expect("no thread panics"), 0);
        }
    }
}

/// Moves the time; where it is then.
fn go(client: &mut Client, to: Value) -> Value {
    client.ok(json!({ "call": { "path": TIMELINE, "argument": to } }))["called"].clone()
}

fn to_cycle(client: &mut Client, instance: &str, cycle: u64) {
    go(client, json!({ "instance": instance, "cycle": cycle }));
}

/// The cycles of a subscription until this one; one that stands still runs again, which counts once.
fn cycles_until(client: &mut Client, subscription: u32, last: u64) -> Vec<u64> {
    let (started, mut cycles) = (Instant::now(), Vec::new());
    while cycles.last() != Some(&last) {
        assert!(started.elapsed() < PATIENCE, "{last} is not in {cycles:?}");
        let update = client.update(subscription);
        cycles.push(update["cycle"].as_u64().expect("a number"));
        cycles.dedup();
    }
    cycles
}

#[test]
fn additional_outputs_are_computed_for_whoever_listens() {
    let (_replayed, mut client) = Replayed::new();
    let below = "Control.additional_outputs.debug.watcher";
    let listed = client.ok(json!({ "paths": { "below": below } }));
    assert_eq!(listed["paths"][0]["path"], json!(SEEN), "{listed}");
    assert_eq!(listed["paths"][0]["kind"], json!("additional_output"));

    to_cycle(&mut client, "Control", 90);
    let main = json!({ "read": { "path": "Control.main_outputs.pose" } });
    let alone = client.ok(main.clone());
    let seen = client.subscribe(SEEN);
    // Nobody had listened when it was recorded; the cycle that is shown already has it, too.
    assert_eq!(cycles_until(&mut client, seen, 90), [90]);
    assert_eq!(client.ok(main), alone, "main outputs do not depend on it");

    for (move_, cycle) in [
        (json!({ "instance": "Control", "step": 1 }), 91),
        (json!({ "instance": "Control", "step": -3 }), 88),
        (json!({ "instance": "Control", "cycle": 40 }), 40),
    ] {
        go(&mut client, move_);
        let cycles = cycles_until(&mut client, seen, cycle);
        assert!(
            cycles.len() <= 2,
            "only those at which time stood: {cycles:?}"
        );
    }
    let update = client.update(seen);
    let read = client.ok(json!({ "read": { "path": "Control.main_outputs.seen" } }));
    assert_eq!(read["value"]["cycle"], 40, "{read}");
    assert_eq!(update["cycle"], 40, "{update}");
    assert_eq!(
        update["value"][0].as_f64(),
        read["value"]["value"].as_f64(),
        "{update} {read}"
    );

    go(&mut client, json!({ "play": true, "speed": 0.5 }));
    let forwards = cycles_until(&mut client, seen, 60);
    assert!(forwards.iter().copied().eq(40..=60), "{forwards:?}");
    go(&mut client, json!({ "play": true, "speed": -2.0 }));
    let backwards = cycles_until(&mut client, seen, 50);
    let turned = backwards.iter().copied().max().expect("there are some");
    let down = backwards.iter().position(|cycle| *cycle == turned);
    let down = &backwards[down.expect("it is there")..];
    assert!(
        down.iter().copied().eq((50..=turned).rev()),
        "{backwards:?}"
    );

    client.ok(json!({ "unsubscribe": { "subscription": seen } }));
    let other = client.subscribe("Control.additional_outputs.debug.certainty");
    go(&mut client, json!({ "play": false }));
    client.update(other);
}

#[test]
fn a_replay_is_one_run_whichever_way_its_time_goes() {
    let run = |client: &Client| client.welcome["run"].as_str().map(str::to_owned);
    let (replayed, mut client) = Replayed::new();
    let first = run(&client);
    assert!(first.is_some());
    let mut told = Vec::new();
    for time in [1.5, 0.25] {
        go(&mut client, json!({ "time": time }));
        told.push(replayed.client().welcome);
    }
    assert!(told[0]["time"].as_u64() > told[1]["time"].as_u64());
    assert!(told.iter().all(|welcome| welcome["run"] == json!(first)));
    drop((replayed, client));
    let (_replayed, client) = Replayed::new();
    assert_ne!(run(&client), first, "the same recording, shown once more");
}

#[test]
fn what_is_told_beside_cycles_has_the_time_that_is_shown() {
    let (_replayed, mut client) = Replayed::new();
    go(&mut client, json!({ "time": 0.5 }));
    let speed = client.subscribe(SPEED);
    client.update(speed);
    for (seconds, nanoseconds) in [(1.5, 1_500_000_000_u64), (0.25, 250_000_000)] {
        go(&mut client, json!({ "time": seconds }));
        assert_eq!(client.update(speed)["time"], json!(nanoseconds));
        let timings = client.ok(json!({ "timings": {} }));
        assert_eq!(timings["timings"]["time"], json!(nanoseconds));
    }
}

#[test]
fn parameters_are_those_of_the_time_that_is_shown() {
    let (_replayed, mut client) = Replayed::new();
    let events = go(&mut client, json!({ "events": true, "time": 0.0 }));
    let events = events["events"].as_array().expect("a list").clone();
    let changed: Vec<_> = events
        .iter()
        .filter(|event| event["what"] == json!("parameters"))
        .collect();
    let [changed] = changed[..] else {
        panic!("once: {events:?}");
    };
    let at = changed["from"].as_f64().expect("a time");
    assert!((1.0..1.1).contains(&at), "{changed}");

    let speed = client.subscribe(SPEED);
    let told = |client: &mut Client| {
        let update = client.update(speed);
        (update["cycle"].clone(), update["value"].clone())
    };
    let (before, after) = ((json!(0), json!(0.2)), (json!(1), json!(0.75)));
    assert_eq!(told(&mut client), before);
    let whose = changed["instance"].clone();
    for (move_, expected) in [
        (json!({ "time": 1.5 }), &after),
        (json!({ "time": 0.5 }), &before),
        (json!({ "time": at }), &after),
        (json!({ "instance": whose, "step": -1 }), &before),
        (json!({ "instance": whose, "step": 1 }), &after),
        (json!({ "speed": -1000.0, "play": true }), &before),
        (json!({ "speed": 1000.0, "play": true }), &after),
    ] {
        go(&mut client, move_.clone());
        assert_eq!(told(&mut client), *expected, "{move_}");
        let read = client.ok(json!({ "parameters": { "path": "walking_speed" } }));
        let read = &read["parameters"];
        assert_eq!(
            (&read["version"], &read["value"]),
            (&expected.0, &expected.1)
        );
    }
    let changes = client.waiting.iter();
    let changes = changes.filter(|message| message.get("parameters_changed").is_some());
    assert_eq!(changes.count(), 7);

    let changes = json!([{ "path": "walking_speed", "value": 0.5 }]);
    let refused = client.ask(json!({ "write": { "changes": changes } }));
    let refused = refused["error"]["refusals"].to_string();
    assert!(refused.contains("--set PATH=VALUE"), "{refused}");
    for ask in [
        json!({ "reload": {} }),
        json!({ "store": { "layer": "default", "paths": ["walking_speed"] } }),
    ] {
        let refused = client.ask(ask)["error"].to_string();
        assert!(refused.contains("this is a recording"), "{refused}");
    }
    assert_eq!(
        client.ok(json!({ "unstored": {} }))["unstored"]["changes"],
        json!([])
    );
}

/// The messages that a client got since it last looked.
fn heard(client: &mut Client) -> Vec<Value> {
    // What was said before a call is told before its answer.
    go(client, json!({}));
    let (logs, others) = std::mem::take(&mut client.waiting)
        .into_iter()
        .partition(|message| message.get("log").is_some());
    client.waiting = others;
    let logs: Vec<Value> = logs;
    logs.into_iter().map(|mut log| log["log"].take()).collect()
}

/// What a message is, whenever it comes.
fn identity(log: &Value) -> (u64, String, u64, String) {
    let text = |key: &str| log[key].as_str().unwrap_or_default().to_owned();
    let whole = |key: &str| log[key].as_u64().expect("a number");
    (
        whole("time"),
        text("instance"),
        whole("cycle"),
        text("message"),
    )
}

#[test]
fn what_was_said_is_said_again_when_the_time_passes_it() {
    let (_replayed, mut client) = Replayed::new();
    let all: Vec<_> = TAPE.said.iter().map(said).collect();
    assert!(all.len() >= 4, "nodes fail: {all:?}");
    assert!(all[0].3.contains("failure 1 of this node"), "{all:?}");
    go(&mut client, json!({ "time": 0.0 }));
    client.ok(json!({ "logs": {} }));
    heard(&mut client);

    // Forwards and back, as fast as can be: each once and in order.
    go(&mut client, json!({ "play": true, "speed": 100.0 }));
    let mut forwards = Vec::new();
    eventually("it comes to the end", || {
        forwards.extend(heard(&mut client));
        !go(&mut client, json!({}))["is_playing"]
            .as_bool()
            .expect("it says so")
    });
    forwards.extend(heard(&mut client));
    let levels: Vec<_> = forwards.iter().map(|log| log["level"].clone()).collect();
    assert!(
        levels.iter().all(|level| *level == json!("error")),
        "{forwards:?}"
    );
    let forwards: Vec<_> = forwards.iter().map(identity).collect();
    assert_eq!(forwards, all);
    go(&mut client, json!({ "time": 0.0 }));
    let backwards: Vec<_> = heard(&mut client).iter().map(identity).collect();
    let reversed: Vec<_> = all.iter().rev().cloned().collect();
    assert_eq!(backwards, reversed);

    // The cycle that said something, each time that it is come to, and not while it is looked at.
    let place = all
        .iter()
        .position(|one| (&*one.1, one.2) == ("Hearing", 50));
    let (before, from) = all.split_at(place.expect("it is deafening"));
    let (_, instance, cycle, _) = &from[0];
    to_cycle(&mut client, instance, cycle - 1);
    let until: Vec<_> = heard(&mut client).iter().map(identity).collect();
    assert_eq!(until, before, "what was said until there");
    for (step, expected) in [(1, 1), (-2, 0), (1, 0), (1, 1), (1, 0), (-1, 1)] {
        go(&mut client, json!({ "instance": instance, "step": step }));
        let now: Vec<_> = heard(&mut client).iter().map(identity).collect();
        assert_eq!(now, from[..expected], "step {step}");
    }
    // Longer than a cycle at which time stands takes to run again.
    thread::sleep(Duration::from_millis(300));
    assert_eq!(heard(&mut client), [Value::Null; 0]);
}

fn said(record: &logs::Record) -> (u64, String, u64, String) {
    (
        record.time.as_nanos(),
        record.instance.as_deref().unwrap_or_default().to_owned(),
        record.cycle.expect("nodes alone said something"),
        record.message.clone(),
    )
}
