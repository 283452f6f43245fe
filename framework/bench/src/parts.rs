//! The parts that cycles meet in: the newest database, and queues, each beside the least that such a thing can cost.

mod floors;

use std::hint::black_box;
use std::time::Duration;

use framework::{Consumer, Horizon, PerceptionInput, Queue, Reader, Timestamp, Writer, buffer_of};

use crate::floor::Floor;
use crate::measure::Row;
use crate::report::{Limit, Report, Section};
use floors::{Ring, Rotating};

const SMALL: usize = 64;
const PAYLOAD: [u8; SMALL] = [1; SMALL];
const PAGE: usize = 4096;
const LARGE: usize = 65_536;
const IMAGE: usize = 614_400;
const WINDOW: usize = 32;

/// The rows, in the order of the table.
pub(crate) fn rows() -> Vec<Row<'static>> {
    let mut rows = latest_rows();
    rows.extend(large_rows());
    rows.extend(queue_rows());
    let mut temporal = Temporal::new();
    rows.push(Row::new("temporal mix of four producers", move || {
        temporal.once();
    }));
    rows
}

fn latest_rows() -> Vec<Row<'static>> {
    let mut rotating = Rotating::new(|| [0_u8; SMALL]);
    let rotating_again = Rotating::new(|| [0_u8; SMALL]);
    let mut rotating_news = Rotating::new(|| [0_u8; SMALL]);
    let (mut writer, [_reader], []) = buffer_of(|| [0_u8; SMALL], []);
    let (_silent, [mut reader], []) = buffer_of::<_, 1, 0>(|| [0_u8; SMALL], []);
    let (mut busy, [mut follower], []) = buffer_of(|| [0_u8; SMALL], []);
    let mut cycle = 0;
    let mut busy_cycle = 0;
    vec![
        Row::new("rotating buffer: write", move || {
            rotating.write(|value| {
                black_box(value);
            })
        }),
        Row::new("latest: write", move || {
            cycle += 1;
            publish(&mut writer, cycle);
        }),
        Row::new("rotating buffer: read", move || {
            rotating_again.read(|value| {
                black_box(value);
            })
        }),
        Row::new("latest: read", move || read(&mut reader)),
        Row::new("rotating buffer: write and read", move || {
            rotating_news.write(|value| {
                black_box(value);
            });
            rotating_news.read(|value| {
                black_box(value);
            });
        }),
        Row::new("latest: write and read", move || {
            busy_cycle += 1;
            publish(&mut busy, busy_cycle);
            read(&mut follower);
        }),
    ]
}

#[inline]
fn publish<const SIZE: usize>(writer: &mut Writer<[u8; SIZE]>, cycle: u64) {
    black_box(&mut *writer.slots().0);
    writer.complete(cycle, Timestamp::from_nanos(cycle));
}

#[inline]
fn read<const SIZE: usize>(reader: &mut Reader<[u8; SIZE]>) {
    reader.take();
    black_box(reader.view().value());
}

/// 60 calls, and their cycle published with 64 KiB beside it.
fn large_rows() -> Vec<Row<'static>> {
    let (mut floor, mut before) = (Floor::new(), Floor::new());
    let (mut writer, [mut reader], []) = buffer_of(|| [0_u8; LARGE], []);
    let mut memory = Box::new([0_u8; LARGE]);
    let mut cycle = 0;
    vec![
        Row::new("60 calls and 64 B of 64 KiB, in place", move || {
            floor.cycle();
            memory[..SMALL].fill(1);
            black_box(&mut memory);
        }),
        Row::new("60 calls and 64 B of 64 KiB, published", move || {
            before.cycle();
            cycle += 1;
            writer.slots().0[..SMALL].fill(1);
            publish(&mut writer, cycle);
            read(&mut reader);
        }),
    ]
}

fn queue_rows() -> Vec<Row<'static>> {
    let mut ring = Ring::new(WINDOW, || [0_u8; SMALL]);
    let mut nanos = 0;
    vec![
        Row::new("ring: 64 B", move || {
            nanos += 1;
            ring.announce(nanos);
            ring.complete(|value| value.copy_from_slice(black_box(&PAYLOAD)));
            ring.consume(|value| {
                black_box(value);
            });
        }),
        Row::new("queue: 64 B", {
            let mut item = QueueItem::<SMALL>::new();
            move || item.once()
        }),
        Row::new("queue: 64 B, temporal view", {
            let mut item = ViewItem::<SMALL>::new();
            move || item.once()
        }),
        Row::new("queue: 4 KiB, 64 B written in place", {
            let mut item = QueueItem::<PAGE>::new();
            move || item.once()
        }),
        Row::new("queue: 600 kB, 64 B written in place", {
            let mut item = QueueItem::<IMAGE>::new();
            move || item.once()
        }),
        Row::new("queue: 600 kB, 64 B, temporal view", {
            let mut item = ViewItem::<IMAGE>::new();
            move || item.once()
        }),
    ]
}

/// One cycle through a queue.
struct QueueItem<const SIZE: usize> {
    writer: Writer<[u8; SIZE]>,
    queue: Queue<[u8; SIZE]>,
    cycle: u64,
}

/// Slots as large as an image must not pass over the stack.
fn slots<const SIZE: usize>() -> (Writer<[u8; SIZE]>, Queue<[u8; SIZE]>) {
    let window = if SIZE > LARGE { 4 } else { WINDOW };
    let (writer, [], [queue]) = buffer_of(|| [0_u8; SIZE], [window]);
    (writer, queue)
}

impl<const SIZE: usize> QueueItem<SIZE> {
    fn new() -> Self {
        let (writer, queue) = slots();
        Self {
            writer,
            queue,
            cycle: 0,
        }
    }

    #[inline]
    fn once(&mut self) {
        self.cycle += 1;
        let time = Timestamp::from_nanos(self.cycle);
        self.writer.announce(time);
        self.writer.slots().0[..SMALL].copy_from_slice(black_box(&PAYLOAD));
        self.writer.complete(self.cycle, time);
        let entry = self.queue.take().expect("it is complete");
        black_box(&entry.value);
        self.queue.release(1);
    }
}

/// One cycle through a queue, seen as a node sees it.
struct ViewItem<const SIZE: usize> {
    writer: Writer<[u8; SIZE]>,
    consumer: Consumer<[u8; SIZE]>,
    horizon: Horizon,
    cycle: u64,
}

impl<const SIZE: usize> ViewItem<SIZE> {
    fn new() -> Self {
        let (writer, queue) = slots();
        Self {
            writer,
            consumer: Consumer::new(queue, Duration::from_secs(1)),
            horizon: Horizon::new(),
            cycle: 0,
        }
    }

    #[inline]
    fn once(&mut self) {
        self.cycle += 1;
        let time = Timestamp::from_nanos(self.cycle);
        self.writer.announce(time);
        self.writer.slots().0[..SMALL].copy_from_slice(black_box(&PAYLOAD));
        self.writer.complete(self.cycle, time);
        self.horizon.consume(time, [&mut self.consumer]);
        let values = self.consumer.project(|value: &[u8; SIZE]| value);
        let input = PerceptionInput::new(&values);
        assert_eq!(input.persistent.len(), 1, "it is consumed at once");
        for (_, value) in input.persistent {
            black_box(value);
        }
    }
}

/// Four producers at the rates of a robot, and the cycler that consumes them.
///
/// News from each camera every third cycle, from the microphones every fourth, from the network every eighth.
struct Temporal {
    writers: [Writer<[u8; SMALL]>; 4],
    consumers: [Consumer<[u8; SMALL]>; 4],
    horizon: Horizon,
    cycle: u64,
}

/// Every how many cycles an instance has news.
const EVERY: [u64; 4] = [3, 3, 4, 8];

impl Temporal {
    fn new() -> Self {
        let [first, second, third, fourth] = std::array::from_fn(|_| {
            let (writer, queue) = slots();
            (writer, Consumer::new(queue, Duration::from_secs(1)))
        });
        let all = [first, second, third, fourth];
        let mut consumers = Vec::new();
        let writers = all.map(|(writer, consumer)| {
            consumers.push(consumer);
            writer
        });
        Self {
            writers,
            consumers: consumers
                .try_into()
                .unwrap_or_else(|_| unreachable!("there are four")),
            horizon: Horizon::new(),
            cycle: 0,
        }
    }

    #[inline]
    fn once(&mut self) {
        self.cycle += 1;
        let time = Timestamp::from_nanos(self.cycle);
        for (writer, every) in self.writers.iter_mut().zip(EVERY) {
            match self.cycle % every {
                // The cameras' cycles last until the next but one begins.
                0 => writer.announce(time),
                1 if self.cycle > every => {
                    let before = Timestamp::from_nanos(self.cycle - 1);
                    black_box(&mut *writer.slots().0);
                    writer.complete(self.cycle / every, before);
                }
                _ => {}
            }
        }
        let [first, second, third, fourth] = &mut self.consumers;
        self.horizon.consume(time, [first, second, third, fourth]);
        for consumer in &self.consumers {
            let values = consumer.project(|value: &[u8; SMALL]| value);
            let input = PerceptionInput::new(&values);
            for (_, value) in input.persistent.iter().chain(input.transient.iter()) {
                black_box(value);
            }
        }
    }
}

/// What is asked of the rows.
pub(crate) fn section(report: &Report) -> Section {
    let ratio = |ours: &str, floor: &str| report.nanos(ours) / report.nanos(floor);
    let latest = |what, ours: &str, floor: &str| Limit::new(what, ratio(ours, floor), 1.5, "x");
    let queues = [
        "queue: 64 B",
        "queue: 64 B, temporal view",
        "queue: 600 kB, 64 B, temporal view",
        "latest: write and read",
        "temporal mix of four producers",
    ];
    Section {
        title: "Latest and queues",
        unit: ("F", report.nanos("F")),
        rows: report.rows_until("rotating buffer: write", "temporal mix of four producers"),
        limits: vec![
            latest("latest: write", "latest: write", "rotating buffer: write"),
            latest("latest: read", "latest: read", "rotating buffer: read"),
            latest(
                "latest: write and read",
                "latest: write and read",
                "rotating buffer: write and read",
            ),
            Limit::new(
                "64 KiB published in place",
                ratio(
                    "60 calls and 64 B of 64 KiB, published",
                    "60 calls and 64 B of 64 KiB, in place",
                ),
                1.1,
                "x",
            ),
            Limit::new("queue, 64 B", ratio("queue: 64 B", "ring: 64 B"), 2.5, "x"),
            Limit::new(
                "queue with temporal view, 64 B",
                ratio("queue: 64 B, temporal view", "ring: 64 B"),
                3.5,
                "x",
            ),
            Limit::new(
                "queue, 4 KiB over 64 B: no copy",
                ratio("queue: 4 KiB, 64 B written in place", "queue: 64 B"),
                1.5,
                "x",
            ),
            Limit::new(
                "queue, 600 kB over 64 B: no copy",
                ratio("queue: 600 kB, 64 B written in place", "queue: 64 B"),
                1.5,
                "x",
            ),
            Limit::new(
                "temporal mix per control cycle",
                ratio("temporal mix of four producers", "F"),
                0.4,
                "F",
            ),
            Limit::new(
                "allocations",
                queues.iter().map(|name| report.allocations(name)).sum(),
                0.0,
                "",
            ),
        ],
    }
}
