//! Instances that other machines run, fed by clients over real sockets.

use std::path::Path;
use std::sync::Arc;
use std::thread::{self, JoinHandle};

use framework::launch::{Listening, Served};
use framework::parameters::Layers;
use framework::testing::created;
use framework::{Clock, Rearm, Robot, Stop, Threads};
use hulkgen_communication::{Limits, Server};
use outpost_hardware::Hardware;
use outpost_runtime::parameters::Parameters;
use outpost_runtime::runtime;
use serde_json::{Value, json};

use crate::zoo::{Client, eventually};

const ENTRIES: &str = "Keeper.main_outputs.entries";
const PROVISIONAL: &str = "Keeper.main_outputs.provisional";

/// An outpost that runs until it is dropped.
struct Outpost {
    server: Server,
    stop: Stop,
    runs: Option<JoinHandle<framework::Result<()>>>,
}

impl Outpost {
    fn new(listening: Listening) -> Self {
        let folder = "../../tests/robots/outpost/parameters";
        let layers = Layers {
            directory: Path::new(env!("CARGO_MANIFEST_DIR")).join(folder),
            ..Layers::default()
        };
        let (clock, stop) = (Clock::wall(), Stop::new());
        let (hardware, mut robot): (Arc<Hardware>, Robot<Parameters>) =
            created(&layers, "tower", &[], &clock, &stop, runtime::create);
        let link = robot.link(&stop, Rearm::default());
        let listening = Listening {
            target: "tower",
            address: Some("127.0.0.1:0".to_owned()),
            ..listening
        };
        let server = Server::start(link, listening, Limits::default()).expect("a free port");
        let of_thread = stop.clone();
        let runs = thread::spawn(move || {
            Threads::new(&clock, hardware.as_ref(), &of_thread).run(&mut robot.instances)
        });
        Self {
            server,
            stop,
            runs: Some(runs),
        }
    }

    fn client(&self) -> Client {
        Client::connect(self.server.address()).expect("the server lets it in")
    }
}

impl Drop for Outpost {
    fn drop(&mut self) {
        self.stop.request();
        let ended = self.runs.take().map(JoinHandle::join);
        if !thread::panicking() {
            let ended = ended.expect("it ran").expect("no thread panics");
            ended.expect("the robot does not fail");
        }
    }
}

/// A moment that has passed on the robot.
fn passed(client: &mut Client) -> u64 {
    let ok = client.ok(json!({ "read": { "path": ENTRIES } }));
    ok["value"]["time"].as_u64().expect("a time")
}

fn announce(instance: &str, time: u64) -> Value {
    json!({ "announce": { "instance": instance, "time": time } })
}

fn abandon(instance: &str, time: u64) -> Value {
    json!({ "abandon": { "instance": instance, "time": time } })
}

fn complete(instance: &str, time: u64, number: u64) -> Value {
    let outputs = json!({ "ship": { "number": number, "distance": 1.5 } });
    json!({ "complete": { "instance": instance, "time": time, "outputs": outputs } })
}

fn entries(client: &mut Client, path: &str) -> Vec<(u64, u64)> {
    let ok = client.ok(json!({ "read": { "path": path } }));
    let entries = ok["value"]["value"].as_array().expect("a list").iter();
    let number = |value: &Value| value.as_u64().expect("a whole number");
    let entries = entries.map(|entry| (number(&entry["time"]), number(&entry["number"])));
    entries.collect()
}

/// Of an instance, as `timings` tells.
fn counts(client: &mut Client, instance: &str) -> Value {
    let ok = client.ok(json!({ "timings": {} }));
    let mut remotes = ok["timings"]["remotes"].as_array().expect("a list").iter();
    let found = remotes.find(|remote| remote["name"] == instance);
    found.expect("another machine runs it").clone()
}

#[test]
fn cycles_of_another_machine_are_consumed_by_their_capture_times() {
    let outpost = Outpost::new(Listening::default());
    let (mut feeder, mut watcher) = (outpost.client(), outpost.client());
    assert_eq!(feeder.welcome["instances"], json!(["Keeper"]));
    let time = passed(&mut feeder);
    feeder.ok(announce("LookoutNorth", time));
    feeder.ok(complete("LookoutSouth", time + 1, 2));
    // Five seconds are enough for what comes next, or this machine is too busy for any robot.
    eventually("the one in the south is seen at once", || {
        entries(&mut watcher, PROVISIONAL) == [(time + 1, 2)]
    });
    assert_eq!(entries(&mut watcher, ENTRIES), []);
    feeder.ok(complete("LookoutNorth", time, 1));
    let both = [(time, 1), (time + 1, 2)];
    eventually("both are written down", || {
        entries(&mut watcher, ENTRIES) == both
    });
    assert_eq!(entries(&mut watcher, PROVISIONAL), []);
    // Nobody waits for what is withdrawn.
    feeder.ok(announce("LookoutNorth", time + 2));
    feeder.ok(complete("LookoutSouth", time + 3, 3));
    feeder.ok(abandon("LookoutNorth", time + 2));
    eventually("the third is written down", || {
        entries(&mut watcher, ENTRIES) == [both[0], both[1], (time + 3, 3)]
    });
    let expected = json!({ "name": "LookoutNorth", "is_fed": true, "completed": 1, "unannounced": 0, "abandoned": 1, "refused": 0 });
    assert_eq!(counts(&mut watcher, "LookoutNorth"), expected);
}

#[test]
fn one_client_at_a_time_feeds_and_what_it_announced_goes_with_it() {
    let outpost = Outpost::new(Listening::default());
    let (mut first, mut second) = (outpost.client(), outpost.client());
    let time = passed(&mut first);
    first.ok(announce("LookoutNorth", time));
    let refused = second.error(announce("LookoutNorth", time + 1));
    assert_eq!(
        refused,
        "another client feeds `LookoutNorth`: end it, or let it be silent for 5s"
    );
    second.error(complete("LookoutNorth", time, 9));
    second.error(abandon("LookoutNorth", time));
    second.ok(complete("LookoutSouth", time + 1, 2));
    drop(first);
    // Nothing is announced any more that could come before.
    eventually("the one in the south is written down", || {
        entries(&mut second, ENTRIES) == [(time + 1, 2)]
    });
    let counted = counts(&mut second, "LookoutNorth");
    assert_eq!(
        (&counted["is_fed"], &counted["abandoned"]),
        (&json!(false), &json!(1))
    );
    second.error(complete("LookoutNorth", time, 1));
    second.ok(complete("LookoutNorth", time + 2, 3));
}

#[test]
fn a_silent_feeder_is_replaced() {
    let outpost = Outpost::new(Listening::default());
    let (mut first, mut second) = (outpost.client(), outpost.client());
    let time = passed(&mut first);
    first.ok(announce("LookoutNorth", time));
    eventually("it is silent for five seconds", || {
        second
            .ask(announce("LookoutNorth", time + 1))
            .get("ok")
            .is_some()
    });
    let refused = first.error(complete("LookoutNorth", time, 1));
    assert!(refused.starts_with("another client feeds"), "{refused}");
    second.ok(complete("LookoutNorth", time + 1, 2));
    drop(first);
    second.ok(complete("LookoutNorth", time + 2, 3));
}

#[test]
fn who_is_refused_takes_nothing_from_a_silent_feeder() {
    let outpost = Outpost::new(Listening::default());
    let (mut first, mut second) = (outpost.client(), outpost.client());
    let time = passed(&mut first);
    first.ok(announce("LookoutNorth", time));
    eventually("it is silent for five seconds", || {
        let refused = second.error(announce("LookoutNorth", u64::MAX));
        refused.contains("is the clock of the other machine ahead?")
    });
    first.ok(complete("LookoutNorth", time, 1));
}

#[test]
fn what_cannot_be_is_refused_with_the_reason() {
    let outpost = Outpost::new(Listening::default());
    let mut client = outpost.client();
    let time = passed(&mut client);
    let with = |outputs: Value| json!({ "complete": { "instance": "LookoutNorth", "time": time, "outputs": outputs } });
    for (ask, expected) in [
        (
            announce("Keeper", time),
            "no `Keeper` to feed: other machines run LookoutNorth, LookoutSouth",
        ),
        (announce(&"x".repeat(2000), time), "a path of 2000 bytes"),
        (
            announce("LookoutNorth", u64::MAX),
            "is the clock of the other machine ahead?",
        ),
        (abandon("LookoutNorth", time), "announced no cycle"),
        (with(Value::Null), "expected an object of main outputs"),
        (
            with(json!({})),
            "outputs of `LookoutNorth`: missing field `ship`",
        ),
        (
            with(json!({ "ship": { "number": 1 } })),
            "`ship`: missing field `distance`",
        ),
        (
            with(json!({ "ship": { "number": "1", "distance": 1 } })),
            "`ship`: invalid type: string \"1\", expected u64",
        ),
        (
            json!({ "read": { "path": "LookoutNorth.ship" } }),
            "no `LookoutNorth.ship`",
        ),
        (
            json!({ "inject": { "path": "LookoutNorth.main_outputs.ship", "value": 1 } }),
            "no `LookoutNorth",
        ),
    ] {
        let refused = client.error(ask.clone());
        assert!(refused.contains(expected), "{ask}: {refused}");
    }
    for text in [
        r#"{"id":900,"ask":{"announce":{"instance":"LookoutNorth","time":-1}}}"#,
        r#"{"id":900,"ask":{"announce":{"instance":"LookoutNorth","time":1.5}}}"#,
        r#"{"id":900,"ask":{"complete":{"instance":"LookoutNorth","time":1}}}"#,
    ] {
        client.send(text);
        let answer = client.answer(Some(900));
        assert!(answer.get("error").is_some(), "{text}: {answer}");
    }
    client.ok(complete("LookoutNorth", time, 1));
    let again = client.error(complete("LookoutNorth", time, 1));
    assert!(
        again.contains("in order of time, each cycle once"),
        "{again}"
    );
    eventually("the robot runs on", || {
        entries(&mut client, ENTRIES) == [(time, 1)]
    });
}

#[test]
fn feeding_is_writing() {
    let with_token = Listening {
        token: Some("secret".to_owned()),
        ..Listening::default()
    };
    let outpost = Outpost::new(with_token);
    let mut client = outpost.client();
    for ask in [
        announce("LookoutNorth", 1),
        complete("LookoutNorth", 1, 1),
        abandon("LookoutNorth", 1),
    ] {
        let refused = client.error(ask);
        assert!(refused.contains("token"), "{refused}");
    }
    client.ok(json!({ "authenticate": { "token": "secret" } }));
    let time = passed(&mut client);
    client.ok(announce("LookoutNorth", time));
}

#[test]
fn what_a_machine_may_feed_can_be_asked() {
    let outpost = Outpost::new(Listening::default());
    let mut client = outpost.client();
    let ok = client.ok(json!({ "paths": { "depth": 3 } }));
    let entries = ok["paths"].as_array().expect("a list").iter();
    let is_remote = |path: &Value| {
        path.as_str()
            .is_some_and(|path| path.starts_with("Lookout"))
    };
    let remote = entries.filter(|entry| is_remote(&entry["path"]));
    let paths = remote.map(|entry| {
        assert_eq!(entry["kind"], "message", "{entry}");
        entry["path"].clone()
    });
    let paths: Vec<_> = paths.collect();
    let expected = ["North", "South"].map(|suffix| {
        ["", ".ship", ".ship.number", ".ship.distance"]
            .map(|below| json!(format!("Lookout{suffix}{below}")))
    });
    assert_eq!(paths, expected.concat());
    let ok = client.ok(json!({ "schema": { "path": "LookoutNorth" } }));
    assert!(ok["schema"]["properties"]["ship"].is_object(), "{ok}");
    let ok = client.ok(json!({ "schema": { "path": "LookoutNorth.ship.distance" } }));
    assert_eq!(ok["schema"]["type"], "number", "{ok}");
}
