//! What clients cost: pairs that are measured in turns in one run, medians, and their ratios.
//!
//! `cargo bench -p hulkgen-communication`. On a machine with other work the single figures mean little, the ratios more.

#[path = "../tests/server/zoo.rs"]
#[expect(dead_code, reason = "tests need more of it")]
mod zoo;

use std::fs;
use std::hint::black_box;
use std::process::Command;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::thread;
use std::time::{Duration, Instant};

use framework::Reflect;
use framework::reflect::{Path, ResolvedPath, binary};
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use zoo::Zoo;

/// Of each pair.
const ROUNDS: usize = 3;

/// How long a robot is looked at.
const LOOK: Duration = Duration::from_secs(2);

/// How long for the slowest hundredth of its cycles.
const LONG_LOOK: Duration = Duration::from_secs(8);

/// From one image to the next.
const PERIOD: Duration = Duration::from_millis(33);

/// Bytes.
const IMAGE: usize = 300_000;

/// 50 kB in bytes, of what robots exchange most: numbers, names, and lists of structs.
#[derive(Clone, Debug, Default, Deserialize, Reflect, Serialize)]
struct Database {
    joints: Vec<f32>,
    obstacles: Vec<Obstacle>,
    state: String,
    counter: u64,
}

#[derive(Clone, Debug, Default, Deserialize, Reflect, Serialize)]
struct Obstacle {
    position: [f32; 2],
    radius: f32,
    is_seen: bool,
}

fn database() -> Database {
    let number = |index: usize| (index as f32 * 0.37).sin() * 3.0;
    Database {
        joints: (0..6000).map(number).collect(),
        obstacles: (0..2000)
            .map(|index| Obstacle {
                position: [number(index), number(index + 1)],
                radius: number(index + 2),
                is_seen: index % 3 == 0,
            })
            .collect(),
        state: "playing".to_owned(),
        counter: 123_456,
    }
}

fn main() {
    values();
    cycler();
    crowd();
    greed();
}

fn row(what: &str, one: f64, other: f64, unit: &str) {
    println!(
        "{what:<64} {one:>12.3} {other:>12.3} {unit:<4} {:>8.3}",
        other / one
    );
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}

/// Microseconds of both, in turns.
fn pair(times: u32, mut one: impl FnMut(), mut other: impl FnMut()) -> (f64, f64) {
    let measure = |deed: &mut dyn FnMut()| {
        let begin = Instant::now();
        (0..times).for_each(|_| deed());
        begin.elapsed().as_secs_f64() * 1e6 / f64::from(times)
    };
    let rounds: Vec<_> = (0..4 * ROUNDS)
        .map(|_| (measure(&mut one), measure(&mut other)))
        .collect();
    (
        median(rounds.iter().map(|round| round.0).collect()),
        median(rounds.iter().map(|round| round.1).collect()),
    )
}

fn values() {
    let value = database();
    let mut bytes = Vec::new();
    binary::encode(&value, &mut bytes).expect("it has a layout");
    println!("a database of {} bytes", bytes.len());
    let path: Path = "obstacles.7.radius".parse().expect("a path");
    let part = ResolvedPath::new(&Database::shape(), &path).expect("it is there");
    let mut text = Vec::new();
    let (whole, field) = pair(
        50,
        || {
            text.clear();
            serde_json::to_writer(&mut text, black_box(&value)).expect("JSON");
        },
        || {
            let found = part.find(black_box(&value)).expect("it is there");
            black_box(serde_json::to_vec(found.as_serialize()).expect("JSON"));
        },
    );
    row(
        "JSON of the whole database | of one field of it",
        whole,
        field,
        "µs",
    );
    let mut text = Vec::new();
    let mut bytes = Vec::new();
    let (json, binary) = pair(
        50,
        || {
            text.clear();
            serde_json::to_writer(&mut text, black_box(&value)).expect("JSON");
        },
        || {
            bytes.clear();
            binary::encode(black_box(&value), &mut bytes).expect("it has a layout");
        },
    );
    row("the database as JSON | as bytes", json, binary, "µs");
}

/// A figure of an instance (`cycle.p99`), in microseconds, as soon as one of its cycles was timed.
fn timing(client: &mut zoo::Client, instance: &str, figure: &str) -> f64 {
    let (part, figure) = figure.split_once('.').expect("part and figure");
    loop {
        let answer = client.ok(json!({ "timings": {} }));
        let instances = answer["timings"]["instances"].as_array().expect("a list");
        let found = instances.iter().find(|one| one["name"] == json!(instance));
        if let Some(figure) = found.expect("it runs")[part][figure].as_f64() {
            return figure;
        }
        thread::sleep(Duration::from_millis(20));
    }
}

fn cycler() {
    let image = json!({ "width": IMAGE, "height": 1, "data": vec![1_u8; IMAGE] });
    let path = "VisionTop.main_outputs.image";
    let look = |subscribes: bool| {
        let zoo = Zoo::new();
        let mut client = zoo.client();
        client.ok(json!({ "inject": { "path": path, "value": image } }));
        if subscribes {
            // Seldom enough for the server to have nothing else to do.
            client.ok(json!({ "subscribe": { "path": path, "rate": 0.1, "encoding": "binary" } }));
        }
        thread::sleep(Duration::from_millis(300));
        timing(&mut client, "VisionTop", "framework.p50");
        thread::sleep(LOOK);
        timing(&mut client, "VisionTop", "framework.p50")
    };
    let rounds: Vec<_> = (0..ROUNDS).map(|_| (look(false), look(true))).collect();
    let without = median(rounds.iter().map(|round| round.0).collect());
    let with = median(rounds.iter().map(|round| round.1).collect());
    // Into slots that come round, as those of a tap do, and as seldom: all that lies between has left the caches.
    let image = vec![1_u8; IMAGE];
    let mut source = image.clone();
    let mut slots = vec![source.clone(); 22];
    let clones = (0..slots.len() * ROUNDS).map(|round| {
        thread::sleep(PERIOD);
        source.clone_from(&image);
        let slot = round % slots.len();
        let begin = Instant::now();
        black_box(&mut slots[slot]).clone_from(black_box(&source));
        begin.elapsed().as_secs_f64() * 1e6
    });
    let clone = median(clones.collect());
    row(
        "framework in VisionTop's cycle (p50), 300 kB: unwatched | watched",
        without,
        with,
        "µs",
    );
    row(
        "  a clone of the image | what the cycle paid for it",
        clone,
        with - without,
        "µs",
    );
}

/// Seconds that the server's threads of this process have worked.
fn server_seconds() -> f64 {
    let tasks = fs::read_dir("/proc/self/task").expect("this is Linux");
    let ticks = tasks.flatten().filter_map(|task| {
        let name = fs::read_to_string(task.path().join("comm")).ok()?;
        let stat = fs::read_to_string(task.path().join("stat")).ok()?;
        let (_, rest) = stat.rsplit_once(')')?;
        let fields: Vec<&str> = rest.split_whitespace().collect();
        let work = fields.get(11)?.parse::<u64>().ok()? + fields.get(12)?.parse::<u64>().ok()?;
        (name.trim() == "communication").then_some(work)
    });
    // USER_HZ is 100 on Linux.
    ticks.sum::<u64>() as f64 / 100.0
}

/// Reads what comes until it is over; how many messages came.
fn drain(mut client: zoo::Client, is_over: &AtomicBool, received: &AtomicU64) {
    while !is_over.load(Ordering::Relaxed) {
        if client.try_receive().is_ok() {
            received.fetch_add(1, Ordering::Relaxed);
        }
    }
}

fn crowd() {
    let zoo = Zoo::new();
    let paths: Vec<Value> = outputs(&zoo, "Control");
    let (is_over, received) = (AtomicBool::new(false), AtomicU64::new(0));
    thread::scope(|scope| {
        for number in 0..20 {
            let mut client = zoo.client();
            for path in paths.iter().cycle().skip(number).take(50) {
                client.ok(json!({ "subscribe": { "path": path } }));
            }
            scope.spawn(|| drain(client, &is_over, &received));
        }
        thread::sleep(Duration::from_secs(1));
        let (before, work) = (received.load(Ordering::Relaxed), server_seconds());
        let begin = Instant::now();
        thread::sleep(2 * LOOK);
        let share = (server_seconds() - work) / begin.elapsed().as_secs_f64();
        let rate =
            (received.load(Ordering::Relaxed) - before) as f64 / begin.elapsed().as_secs_f64();
        println!(
            "20 clients with 50 subscriptions each: {rate:.0} updates/s received, the server works {share:.2} of a core"
        );
        is_over.store(true, Ordering::Relaxed);
    });
}

/// Paths of everything that Control writes in each cycle.
fn outputs(zoo: &Zoo, instance: &str) -> Vec<Value> {
    let below = format!("{instance}.main_outputs");
    let answer = zoo
        .client()
        .ok(json!({ "paths": { "below": below, "depth": 9 } }));
    let entries = answer["paths"].as_array().expect("a list");
    entries.iter().map(|entry| entry["path"].clone()).collect()
}

/// Gives a cycler's thread the policy that a robot's manifest asks for: else what is measured is who gets a processor.
fn favour(instance: &str) {
    let tasks = fs::read_dir("/proc/self/task").expect("this is Linux");
    let is_named = |task: &fs::DirEntry| {
        let name = fs::read_to_string(task.path().join("comm"));
        name.is_ok_and(|name| name.trim() == instance)
    };
    for task in tasks.flatten().filter(is_named) {
        let mut command = Command::new("chrt");
        command
            .args(["--fifo", "--pid", "80"])
            .arg(task.file_name());
        if !command.status().is_ok_and(|status| status.success()) {
            println!(
                "{instance} has no real-time priority: that needs a right that this user lacks"
            );
        }
    }
}

fn greed() {
    let look = |greedy: usize| {
        let zoo = Zoo::new();
        let paths = outputs(&zoo, "Control");
        let (is_over, received) = (AtomicBool::new(false), AtomicU64::new(0));
        favour("Control");
        thread::scope(|scope| {
            for _ in 0..greedy {
                let mut client = zoo.client();
                for path in &paths {
                    client.ok(json!({ "subscribe": { "path": path } }));
                }
                scope.spawn(|| drain(client, &is_over, &received));
            }
            let mut watching = zoo.client();
            timing(&mut watching, "Control", "cycle.p99");
            thread::sleep(LONG_LOOK);
            let p99 = timing(&mut watching, "Control", "cycle.p99");
            is_over.store(true, Ordering::Relaxed);
            p99
        })
    };
    let rounds: Vec<_> = (0..ROUNDS).map(|_| (look(0), look(8))).collect();
    let without = median(rounds.iter().map(|round| round.0).collect());
    let with = median(rounds.iter().map(|round| round.1).collect());
    row(
        "Control's cycle under FIFO (p99): nobody | 8 greedy clients",
        without,
        with,
        "µs",
    );
}
