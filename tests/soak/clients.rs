//! Four clients, each with a way of its own.

use std::net::SocketAddr;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::{Scope, ScopedJoinHandle, sleep};
use std::time::Duration;

use client::{Frame, Heard, Robot};
use protocol::{Ask, Change, Encoding, Good, Message};
use serde_json::json;

use crate::Result;

/// What a client has seen.
pub(crate) struct Told {
    pub(crate) name: &'static str,
    /// For people.
    pub(crate) what: String,
    /// What did not add up.
    pub(crate) wrong: Vec<String>,
}

/// Connects and is welcomed.
pub(crate) fn connect(address: SocketAddr) -> Result<Robot> {
    Ok(Robot::connect(&address.to_string(), None)?)
}

type Client = fn(SocketAddr, &AtomicBool) -> Result<Told>;

/// All of them, until it is over.
pub(crate) fn start<'scope>(
    scope: &'scope Scope<'scope, '_>,
    address: SocketAddr,
    over: &'scope AtomicBool,
) -> Vec<ScopedJoinHandle<'scope, Result<Told>>> {
    let all: [Client; 4] = [watch, look, stall, be_restless];
    let started = all.map(|client| scope.spawn(move || client(address, over)));
    started.into()
}

pub(crate) fn join(client: ScopedJoinHandle<'_, Result<Told>>) -> Result<Told> {
    client
        .join()
        .unwrap_or_else(|_| Err("a client panicked".to_owned()))
}

/// Wants every cycle: each either comes or is told as lost, in order.
fn watch(address: SocketAddr, over: &AtomicBool) -> Result<Told> {
    let mut robot = connect(address)?;
    let subscribe = |path: &str| Ask::Subscribe {
        path: path.to_owned(),
        rate: None,
        encoding: Encoding::Json,
    };
    robot.ask(subscribe("Control.main_outputs.sensor_data.positions"))?;
    let (mut first, mut last, mut updates, mut lost) = (None, None, 0_u64, 0_u64);
    let mut wrong = Vec::new();
    while !over.load(Ordering::Relaxed) {
        if let Some(heard) = robot.hear()? {
            match heard {
                Heard::Message(Message::Update(update)) => {
                    if last.is_some_and(|last| update.cycle <= last) {
                        wrong.push(format!("cycle {} after {last:?}", update.cycle));
                    }
                    first.get_or_insert(update.cycle);
                    last = Some(update.cycle);
                    updates += 1;
                }
                Heard::Message(Message::Lost(told)) => lost += told.updates,
                _ => {}
            }
        }
    }
    let cycles = last.zip(first).map_or(0, |(last, first)| last - first + 1);
    if updates == 0 || updates > cycles || updates + lost < cycles {
        wrong.push(format!(
            "{cycles} cycles, {updates} updates, {lost} told as lost"
        ));
    }
    Ok(Told {
        name: "watcher",
        what: format!("{updates} updates of {cycles} cycles, {lost} told as lost"),
        wrong,
    })
}

/// Wants both cameras' images as JPEG.
fn look(address: SocketAddr, over: &AtomicBool) -> Result<Told> {
    let mut robot = connect(address)?;
    for camera in ["Top", "Bottom"] {
        robot.ask(Ask::Subscribe {
            path: format!("Vision{camera}.main_outputs.image"),
            rate: Some(10.0),
            encoding: Encoding::Jpeg { quality: 60 },
        })?;
    }
    let (mut images, mut broken) = (0_u64, 0_u64);
    while !over.load(Ordering::Relaxed) {
        if let Some(Heard::Frame(Frame { value: file, .. })) = robot.hear()?
            && !file.is_empty()
        {
            images += 1;
            broken += u64::from(!(file.starts_with(b"\xff\xd8") && file.ends_with(b"\xff\xd9")));
        }
    }
    let mut wrong = Vec::new();
    if images == 0 || broken > 0 {
        wrong.push(format!("{images} images, {broken} of them broken"));
    }
    Ok(Told {
        name: "pictures",
        what: format!("{images} images"),
        wrong,
    })
}

/// Wants everything and reads nothing: a network that stalls. The robot has to give it up, and nobody else has to notice.
fn stall(address: SocketAddr, over: &AtomicBool) -> Result<Told> {
    let (mut connections, mut given_up, mut wrong) = (0_u64, 0_u64, Vec::new());
    while !over.load(Ordering::Relaxed) {
        let mut robot = connect(address)?;
        connections += 1;
        let Good::Paths(entries) = robot.ask(Ask::Paths {
            below: "Control.main_outputs".to_owned(),
            depth: Some(1),
        })?
        else {
            return Err("no paths".to_owned());
        };
        for entry in entries {
            robot.ask(Ask::Subscribe {
                path: entry.path,
                rate: None,
                encoding: Encoding::Json,
            })?;
        }
        // Longer than the robot waits for a client that takes nothing.
        for _ in 0..300 {
            if over.load(Ordering::Relaxed) {
                break;
            }
            sleep(Duration::from_millis(100));
        }
        if over.load(Ordering::Relaxed) {
            break;
        }
        // What was on its way, and then the end.
        if (0..100_000).any(|_| robot.hear().is_err()) {
            given_up += 1;
        } else {
            wrong.push("30 s without a byte taken, and the robot goes on".to_owned());
        }
    }
    Ok(Told {
        name: "stalled",
        what: format!("{connections} connections, {given_up} given up by the robot"),
        wrong,
    })
}

/// Comes, asks, changes a parameter, goes without a word; what was said to be written has to be there.
fn be_restless(address: SocketAddr, over: &AtomicBool) -> Result<Told> {
    const PATH: &str = "ball_filter.gate";
    let (mut connections, mut version, mut wrong) = (0_u64, 0, Vec::new());
    while !over.load(Ordering::Relaxed) {
        let mut robot = connect(address)?;
        connections += 1;
        #[expect(clippy::cast_precision_loss, reason = "a few thousand")]
        let value = json!(1.0 + (connections % 16) as f64 / 8.0);
        let written = robot.ask(Ask::Write {
            changes: vec![Change {
                path: PATH.to_owned(),
                value: value.clone(),
            }],
        })?;
        let Good::Written { version: newer } = written else {
            return Err("a change is not answered by its version".to_owned());
        };
        if newer <= version {
            wrong.push(format!("version {newer} after {version}"));
        }
        version = newer;
        let path = format!("parameters.{PATH}");
        match robot.ask(Ask::Read { path })? {
            Good::Value(read) if read.value == value => {}
            other => wrong.push(format!("wrote {value}, read {other:?}")),
        }
        sleep(Duration::from_millis(100));
    }
    Ok(Told {
        name: "restless",
        what: format!("{connections} connections, parameters at version {version}"),
        wrong,
    })
}
