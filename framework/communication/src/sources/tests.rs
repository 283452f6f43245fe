//! What is sent is what was wanted, made once.

use std::collections::BTreeMap;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

use framework::parameters::Layers;
use framework::reflect::{Reflect, Shape, binary};
use framework::{
    Clock, Given, Hardware as _, HardwareContext, Robot, Start, Stop, Tapped, Threads, Timestamp,
};
use protocol::Encoding;
use serde::{Serialize, Serializer};
use serde_json::json;

use super::{Rate, Reader, Source, Stream, Subscriber, as_many_as_wait, resolve};
use crate::connection::News;
use crate::hub::{Client, ClientId, Hub, PATIENCE, Rules};
use crate::limits::Limits;
use crate::outbox::Outbox;
use crate::press::Press;

fn sent(rate: Option<f64>, period: u64) -> usize {
    let mut rate = Rate::new(rate);
    let times = (0..1_000_000_000).step_by(usize::try_from(period).expect("small"));
    times.filter(|time| rate.is_due(*time)).count()
}

#[test]
fn a_late_value_is_not_followed_at_once() {
    let mut rate = Rate::new(Some(20.0));
    let times = [48, 60, 98, 100, 148, 240, 252, 268];
    let sent: Vec<_> = times
        .into_iter()
        .filter(|time| rate.is_due(time * 1_000_000))
        .collect();
    assert_eq!(sent, [48, 98, 148, 240, 268]);
}

#[test]
fn a_replay_that_goes_back_or_in_small_steps_is_seen() {
    let mut rate = Rate::new(Some(50.0));
    let millis = |rate: &mut Rate, time: u64| rate.is_due(time * 1_000_000);
    assert!(millis(&mut rate, 100_000));
    assert!(millis(&mut rate, 5_000), "somebody went back");
    assert!(!millis(&mut rate, 5_001));
    assert!(millis(&mut rate, 5_020));
    std::thread::sleep(Duration::from_millis(41));
    assert!(millis(&mut rate, 5_021), "somebody takes steps");
}

#[test]
fn rates_are_met_and_never_exceeded() {
    // 83.3 Hz for a second.
    for (rate, expected) in [
        (None, 84),
        (Some(1e9), 84),
        (Some(40.0), 40),
        (Some(10.0), 10),
        (Some(1.0), 1),
        (Some(1e-30), 1),
    ] {
        assert_eq!(sent(rate, 12_000_000), expected, "{rate:?}");
    }
}

#[test]
fn an_instance_that_always_has_one_more_is_left_for_others() {
    let mut taken = 0;
    as_many_as_wait(|| {
        taken += 1;
        assert!(taken < 1000, "nobody else is heard");
        true
    });
    assert_eq!(taken, framework::tap::WINDOW);
    let mut left = 3;
    as_many_as_wait(|| {
        left -= 1;
        left > 0
    });
    assert_eq!(left, 0, "all of them");
}

/// A value that counts how often it is written, as a text of 1000 bytes.
#[derive(Default)]
struct Large(AtomicUsize);

impl Serialize for Large {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.0.fetch_add(1, Ordering::Relaxed);
        serializer.serialize_str(&"x".repeat(998))
    }
}

impl Reflect for Large {
    fn shape() -> Shape {
        String::shape()
    }

    fn encode(&self, _: &mut Vec<u8>) -> Result<(), binary::EncodeError> {
        Ok(())
    }

    fn as_serialize(&self) -> &dyn erased_serde::Serialize {
        self
    }

    fn deserialize_from(&mut self, _: &Given<'_>) -> framework::Result<()> {
        Ok(())
    }
}

fn client() -> Client {
    Client {
        outbox: Outbox::default(),
        news: News::default(),
        is_trusted: false,
        wrong_tokens: 0,
        subscriptions: BTreeMap::new(),
        next_subscription: 1,
        waiting: 0,
        logs: None,
    }
}

/// The whole of a value.
fn stream() -> Stream {
    Stream {
        part: resolve(&Large::shape(), "").expect("the whole is there"),
        encoding: Encoding::Json,
        subscribers: Vec::new(),
        readers: Vec::new(),
    }
}

fn hand_out(
    stream: &mut Stream,
    cycle: u64,
    value: &Large,
    clients: &mut BTreeMap<ClientId, Client>,
    limits: &Limits,
) -> usize {
    let tapped = Tapped {
        cycle,
        timestamp: Timestamp::from_nanos(7),
        value,
    };
    stream.hand_out(tapped, cycle == 2, clients, &mut Press::new(), limits)
}

fn texts(client: &mut Client) -> Vec<serde_json::Value> {
    let texts = std::iter::from_fn(|| client.outbox.next());
    let texts = texts.map(|text| text.into_text().expect("text"));
    let json = texts.map(|text| serde_json::from_str(&text).expect("JSON"));
    json.collect()
}

#[test]
fn whoever_reads_a_cycle_gets_the_one_text_that_is_made_of_it() {
    let (mut stream, value) = (stream(), Large::default());
    let [one, other] = [ClientId::of_test(1), ClientId::of_test(2)];
    let mut clients = BTreeMap::from([(one, client()), (other, client())]);
    for request in 0..64 {
        stream.readers.push(Reader {
            client: one,
            request,
            is_passed_over: false,
        });
    }
    stream.subscribers.push(Subscriber {
        client: other,
        subscription: 3,
        rate: Rate::new(None),
    });
    let limits = Limits::default();
    for cycle in 1..4 {
        let read = hand_out(&mut stream, cycle, &value, &mut clients, &limits);
        assert_eq!(read, if cycle == 1 { 64 } else { 0 });
        assert_eq!(value.0.load(Ordering::Relaxed) as u64, cycle);
    }
    stream.subscribers.clear();
    stream.readers.push(Reader {
        client: other,
        request: 9,
        is_passed_over: false,
    });
    assert_eq!(hand_out(&mut stream, 2, &value, &mut clients, &limits), 1);
    let texts: Vec<_> = clients.values_mut().map(texts).collect();
    let written = "x".repeat(998);
    assert_eq!(texts[0].len(), 64);
    for (request, text) in texts[0].iter().enumerate() {
        let expected = json!({ "answer": { "id": request, "ok": { "value": {
            "cycle": 1, "time": 7, "value": written,
        } } } });
        assert_eq!(*text, expected);
        serde_json::from_value::<protocol::Message>(expected).expect("the protocol says so");
    }
    let injected = json!({ "answer": { "id": 9, "ok": { "value": {
        "cycle": 2, "time": 7, "value": written, "injected": true,
    } } } });
    assert_eq!(texts[1][0], injected);
    assert_eq!(texts[1].len(), 4);
}

#[test]
fn who_does_not_take_its_answers_reads_nothing_meanwhile() {
    let (mut first, mut second) = (stream(), stream());
    let value = Large::default();
    let one = ClientId::of_test(1);
    let mut clients = BTreeMap::from([(one, client())]);
    let limits = Limits {
        queued_bytes: 100,
        ..Limits::default()
    };
    for stream in [&mut first, &mut second] {
        stream.readers.push(Reader {
            client: one,
            request: 0,
            is_passed_over: false,
        });
    }
    assert_eq!(hand_out(&mut first, 1, &value, &mut clients, &limits), 1);
    for cycle in 1..4 {
        let read = hand_out(&mut second, cycle, &value, &mut clients, &limits);
        assert_eq!(read, 0);
    }
    assert_eq!(value.0.load(Ordering::Relaxed), 1, "nothing is made of it");
    let own = clients.get_mut(&one).expect("it is there");
    assert_eq!(texts(own).len(), 1);
    assert_eq!(hand_out(&mut second, 4, &value, &mut clients, &limits), 1);
    let own = clients.get_mut(&one).expect("it is there");
    assert_eq!(texts(own)[0]["answer"]["ok"]["value"]["cycle"], 4);
}

/// The zoo, that nobody looks at yet.
fn zoo(stop: Stop) -> (Hub, impl FnOnce() -> framework::Result<()> + Send) {
    let directory = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../tests/robots/zoo/parameters"
    );
    let layers = Layers {
        directory: directory.into(),
        ..Layers::default()
    };
    let loaded = layers.load().expect("the file is there");
    let clock = Clock::wall();
    let hardware = zoo_hardware::Hardware::new(HardwareContext {
        options: Vec::new(),
        table: loaded.hardware("loud").expect("there is a table"),
        run_folder: std::env::temp_dir(),
        clock: clock.clone(),
        stop: stop.clone(),
    });
    let hardware = Arc::new(hardware.expect("the zoo needs nothing"));
    let start = Start {
        clock: clock.clone(),
        stop: stop.clone(),
        parameters: loaded.deserialize().expect("the parameters fit"),
    };
    let mut robot: Robot<zoo_runtime::parameters::Parameters> =
        zoo_runtime::runtime::create(&hardware, start).expect("every node can be created");
    let rules = Rules {
        target: "loud",
        token: None,
        is_read_only: true,
        graph: "",
        peers: Vec::new(),
    };
    let link = robot.link(&stop, framework::Rearm::default());
    let hub = Hub::new(link, rules, Limits::default());
    let run = move || Threads::new(&clock, hardware.as_ref(), &stop).run(&mut robot.instances);
    (hub, run)
}

#[test]
fn what_a_late_server_did_not_see_is_lost_for_those_who_want_every_cycle_alone() {
    let stop = Stop::new();
    let (mut hub, run) = zoo(stop.clone());
    let (client, _) = hub.connect();
    for rate in ["", r#","rate":1.0"#] {
        let path = "Control.main_outputs.cycles";
        hub.receive(
            client,
            &format!(r#"{{"id":1,"ask":{{"subscribe":{{"path":"{path}"{rate}}}}}}}"#),
        );
    }
    let runs = std::thread::spawn(run);
    // The server comes much later than there is room for copies.
    std::thread::sleep(Duration::from_secs(1));
    stop.request();
    runs.join().expect("it ran").expect("no node fails");
    hub.look();
    let own = hub.clients.get_mut(&client).expect("it is there");
    let lost: Vec<_> = texts(own)
        .into_iter()
        .filter_map(|text| text.get("lost").cloned())
        .collect();
    assert_eq!(lost.len(), 1, "{lost:?}");
    assert_eq!(lost[0]["subscription"], 1);
    assert!(lost[0]["updates"].as_u64() > Some(0));
}

#[test]
fn a_read_without_a_value_says_whether_there_was_none_or_the_client_was_slow() {
    for (is_written, expected) in [
        (false, "no cycle wrote"),
        (true, "cycles wrote it when too many answers waited"),
    ] {
        let stop = Stop::new();
        let (mut hub, run) = zoo(stop.clone());
        hub.limits.queued_bytes = 10;
        let (client, _) = hub.connect();
        hub.receive(
            client,
            r#"{"id":1,"ask":{"read":{"path":"Control.main_outputs.cycles"}}}"#,
        );
        let own = hub.clients.get_mut(&client).expect("it is there");
        let other = r#""cycle":1,"time":1,"value":0}}"#.to_owned();
        own.outbox.say_value(0, Arc::new(other));
        if is_written {
            let runs = std::thread::spawn(run);
            std::thread::sleep(Duration::from_millis(200));
            stop.request();
            runs.join().expect("it ran").expect("no node fails");
            hub.look();
            // It takes them just before the time is over.
            let own = hub.clients.get_mut(&client).expect("it is there");
            assert!(!texts(own).is_empty());
        }
        hub.waiting[0].until = Instant::now();
        hub.look();
        let own = hub.clients.get_mut(&client).expect("it is there");
        let last = texts(own).pop().expect("an answer").to_string();
        assert!(last.contains(expected), "{last}");
    }
}

#[test]
fn each_of_two_reads_with_one_number_has_an_answer() {
    let (mut hub, _run) = zoo(Stop::new());
    let (client, _) = hub.connect();
    for part in ["", ".heading"] {
        for _ in 0..2 {
            let path = format!("Control.main_outputs.pose{part}");
            let read = format!(r#"{{"id":7,"ask":{{"read":{{"path":"{path}"}}}}}}"#);
            hub.receive(client, &read);
        }
    }
    // Nobody runs it, so no cycle writes anything.
    std::thread::sleep(PATIENCE);
    hub.look();
    assert!(hub.waiting.is_empty());
    assert!(!hub.sources.iter().any(Source::is_open));
    let own = hub.clients.get_mut(&client).expect("it is there");
    let answers = texts(own).into_iter().skip(1);
    let numbers: Vec<_> = answers.map(|text| text["answer"]["id"].clone()).collect();
    assert_eq!(numbers, [7, 7, 7, 7]);
}
