//! What a recording costs Control of the simulated NAO, beside postcard writing the same bytes into a slice: each row in the cycles
//! in which it comes first, medians. And how fast the writer is with what the cameras give it.
//!
//! `cargo bench -p hulkgen-tests --bench recording --features yardstick`

use std::hint::black_box;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use framework::driver::{Lockstep, Observer};
use framework::recorded::{About, Recording, Saving, Settings, Yardstick};
use framework::{CountingAllocator, Instance, InstanceDescription, Record, Timestamp};
use hulkgen_recording::{
    Channel, ChannelId, Description, Full, Recorded, Recorder, Track, Writing,
};
use support::nao::Nao;

#[global_allocator]
static ALLOCATOR: CountingAllocator = CountingAllocator;

/// Of the robot's time.
const LENGTH: Duration = Duration::from_secs(60);
/// More than any frame takes, in bytes, and as much as a block has.
const SLICE: usize = 1 << 20;
/// As much as the recording has: it comes back to the same memory when that is in no cache.
const MEMORY: usize = 64 << 20;
/// Until the robot stands and its nodes have the memory that they need.
const WARM_UP: u64 = 200;

/// [`Measured`] has so many that take turns.
const ROWS: usize = 4;

/// A frame also has what came from other instances: alone nothing comes.
const ROBOTS: [(&str, &[(&str, &str)]); 2] = [
    (
        "without cameras and microphones",
        &[
            ("hardware.simulated.cameras", "false"),
            ("hardware.simulated.microphones", "false"),
        ],
    ),
    ("with all senses", &[]),
];

/// Of each cycle.
#[derive(Default)]
struct Measured {
    bytes: Vec<f64>,
    /// postcard, into the same slice again and again.
    again: Vec<f64>,
    /// postcard, into memory behind the memory before.
    fresh: Vec<f64>,
    /// The code that writes frames, but for values of other instances, into the same slice again and again.
    alone: Vec<f64>,
    frame: Vec<f64>,
    digests: Vec<f64>,
    allocations: u64,
}

/// The recording of Control, measured.
struct Timed {
    observer: Box<dyn Observer>,
    memory: Vec<u8>,
    again: Yardstick,
    fresh: Yardstick,
    /// Where the next fresh slice begins.
    place: usize,
    /// When the cycle before started: histories are saved since.
    since: Option<Timestamp>,
    measured: Arc<Mutex<Measured>>,
}

impl Timed {
    fn new(observer: Box<dyn Observer>, measured: &Arc<Mutex<Measured>>) -> Self {
        Self {
            observer,
            memory: vec![1; MEMORY],
            again: Yardstick::default(),
            fresh: Yardstick::default(),
            place: 2 * SLICE,
            since: None,
            measured: measured.clone(),
        }
    }

    /// How many bytes postcard writes, and how long it takes; into the same slice as ever or into the next one.
    fn write(&mut self, instance: &mut dyn Instance, is_fresh: bool) -> (usize, f64) {
        let (place, postcard) = match is_fresh {
            false => (0, &mut self.again),
            true => (self.place, &mut self.fresh),
        };
        let slice = &mut self.memory[place..place + SLICE];
        let started = Instant::now();
        let written = postcard.write(instance, slice);
        let took = nanos(started);
        let length = written.expect("the slice is longer than any frame");
        if is_fresh {
            let next = self.place + length;
            self.place = if next + SLICE > MEMORY {
                2 * SLICE
            } else {
                next
            };
        }
        black_box(&mut self.memory);
        (length, took)
    }

    /// As the recording writes it, into a slice.
    fn write_alone(&mut self, instance: &mut dyn Instance) -> (usize, f64) {
        let mut writing = Writing::new(&mut self.memory[SLICE..2 * SLICE]);
        let started = Instant::now();
        let mut saving = Saving::new(&mut writing);
        instance.save_alone(self.since, &mut saving);
        let saved = saving.end();
        let took = nanos(started);
        saved.expect("the slice is longer than any frame");
        (writing.length(), took)
    }

    /// How long the recording takes, and how often it allocates.
    fn record(&mut self, instance: &mut dyn Instance) -> (f64, u64) {
        let before = allocations();
        let started = Instant::now();
        self.observer.begun(instance);
        let took = nanos(started);
        (took, allocations() - before)
    }
}

impl Observer for Timed {
    fn begun(&mut self, instance: &mut dyn Instance) {
        let cycle = instance.cycle();
        // Whoever comes later has values and code in the caches: the first counts, each in its turn.
        let first = cycle.number as usize % ROWS;
        let fresh = self.place;
        let (mut bytes, mut alone, mut allocations) = (0, 0, 0);
        let mut counts = None;
        for turn in 0..ROWS {
            let took = match (first + turn) % ROWS {
                row @ (0 | 1) => {
                    let (length, took) = self.write(instance, row == 1);
                    bytes = length;
                    took
                }
                2 => {
                    let (length, took) = self.write_alone(instance);
                    alone = length;
                    took
                }
                _ => {
                    let (took, allocated) = self.record(instance);
                    allocations = allocated;
                    took
                }
            };
            counts.get_or_insert(took);
        }
        let (postcard, ours) = (&self.memory[..bytes], &self.memory[SLICE..][..alone]);
        assert!(postcard.ends_with(ours), "postcard writes the same bytes");
        assert_eq!(postcard, &self.memory[fresh..][..bytes]);
        self.since = Some(cycle.time.start);
        if cycle.number > WARM_UP {
            let mut measured = lock(&self.measured);
            measured.bytes.push(bytes as f64);
            measured.allocations += allocations;
            let Measured {
                again,
                fresh,
                alone,
                frame,
                ..
            } = &mut *measured;
            [again, fresh, alone, frame][first].extend(counts);
        }
    }

    fn finished(&mut self, instance: &dyn Instance) {
        let before = allocations();
        let started = Instant::now();
        self.observer.finished(instance);
        let (took, allocated) = (nanos(started), allocations() - before);
        if instance.cycle().number > WARM_UP {
            let mut measured = lock(&self.measured);
            measured.allocations += allocated;
            measured.digests.push(took);
        }
    }
}

fn allocations() -> u64 {
    CountingAllocator::of_this_thread().expect("it is installed")
}

fn nanos(since: Instant) -> f64 {
    since.elapsed().as_nanos() as f64
}

fn lock<T>(shared: &Mutex<T>) -> MutexGuard<'_, T> {
    shared.lock().unwrap_or_else(PoisonError::into_inner)
}

fn quantile(values: &mut [f64], share: f64) -> f64 {
    values.sort_by(f64::total_cmp);
    let last = values.len().saturating_sub(1);
    values[(last as f64 * share).round() as usize]
}

const CAMERAS: [&str; 2] = ["VisionTop", "VisionBottom"];
/// A second, a camera.
const IMAGES: usize = 30;
/// Those images again and again.
const SECONDS: usize = 20;

/// Keeps the frames of a camera's instance.
struct Seen(Arc<Mutex<Vec<Vec<u8>>>>);

impl Observer for Seen {
    fn begun(&mut self, instance: &mut dyn Instance) {
        let mut seen = lock(&self.0);
        if seen.len() == IMAGES || instance.cycle().time.start < PLAYS {
            return;
        }
        let mut bytes = vec![0; SLICE];
        let mut writing = Writing::new(&mut bytes);
        let mut saving = Saving::new(&mut writing);
        instance.save_alone(None, &mut saving);
        saving.end().expect("the slice is longer than any frame");
        let length = writing.length();
        bytes.truncate(length);
        seen.push(bytes);
    }

    fn finished(&mut self, _: &dyn Instance) {}
}

/// When they see more than what lies before a robot that gets up.
const PLAYS: Timestamp = Timestamp::from_nanos(27_000_000_000);

/// A second of frames of each camera, as the robot's play shows them.
fn seen() -> [Vec<Vec<u8>>; 2] {
    let seen = CAMERAS.map(|_| Arc::<Mutex<Vec<_>>>::default());
    let mut nao = Nao::dynamic(&[], &[]);
    let hardware = nao.hardware.clone();
    let mut lockstep = Lockstep::new(&mut nao.robot, &*hardware).observed(|instance| {
        let place = CAMERAS.iter().position(|name| *name == instance.name)?;
        Some(Box::new(Seen(seen[place].clone())))
    });
    lockstep
        .run_until(PLAYS + Duration::from_secs(2), |_| {})
        .expect("the robot goes on");
    drop(lockstep);
    seen.map(|seen| std::mem::take(&mut *lock(&seen)))
}

/// Hands a frame to the writer, as soon as it has a block for it.
fn write(track: &mut Track, channel: ChannelId, time: u64, bytes: &[u8]) {
    let mut once = || {
        track.frame::<Full>(time, 0, |frame| {
            frame.message(channel, 0, time, |writing| writing.put(bytes))
        })
    };
    while once() != Recorded::Whole {
        std::thread::sleep(Duration::from_micros(100));
    }
}

/// What part of a second goes by until a second of both cameras is in the file, compressed, with check sums: at least what the
/// writer takes for it.
fn write_images() -> f64 {
    let cameras = seen();
    let folder = tempfile::tempdir().expect("a folder");
    let description = Description {
        channels: CAMERAS
            .map(|name| Channel {
                topic: name.to_owned(),
                schema: None,
                encoding: "bench".to_owned(),
                metadata: Vec::new(),
                once_per_chunk: false,
            })
            .into(),
        ..Description::default()
    };
    let path = folder.path().join("run.mcap");
    let started = Instant::now();
    let (recorder, mut tracks) =
        Recorder::start(&path, description, &CAMERAS, Settings::default()).expect("it is new");
    for image in 0..IMAGES * SECONDS {
        let time = image as u64 * 1_000_000_000 / IMAGES as u64;
        for (place, (track, frames)) in tracks.iter_mut().zip(&cameras).enumerate() {
            let frame = &frames[image % frames.len()];
            write(track, ChannelId(place as u16), time, frame);
        }
    }
    drop(tracks);
    assert!(recorder.end().error.is_none(), "the disk takes all of it");
    started.elapsed().as_secs_f64() / SECONDS as f64
}

/// The robot with these settings, for a minute.
fn measure(settings: &[(&str, &str)]) -> Measured {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.mcap");
    let mut nao = Nao::dynamic(&[], settings);
    let record = |one: &InstanceDescription| match one.name {
        "Control" => Record::On,
        _ => Record::Off,
    };
    let (about, sizes) = (About::default(), Settings::default());
    let recording = Recording::start_with(&path, &nao.robot, about, sizes, record);
    let mut recording = recording.expect("the folder is empty");
    let measured = Arc::<Mutex<Measured>>::default();
    let hardware = nao.hardware.clone();
    let mut lockstep = Lockstep::new(&mut nao.robot, &*hardware).observed(|instance| {
        Some(Box::new(Timed::new(
            recording.observer(instance)?,
            &measured,
        )))
    });
    let end = Timestamp::from_nanos(LENGTH.as_nanos() as u64);
    lockstep.run_until(end, |_| {}).expect("the robot goes on");
    drop(lockstep);
    let report = recording.end();
    assert_eq!(report.state(), "COMPLETE", "every cycle is recorded");
    std::mem::take(&mut *lock(&measured))
}

fn main() {
    for (title, settings) in ROBOTS {
        let mut measured = measure(settings);
        println!("{title}: {} cycles of Control, ns", measured.bytes.len());
        let [slice, fresh, alone, frame, _] = print(&mut measured);
        let others = [
            ("the slice", slice),
            ("fresh memory", fresh),
            ("its own part", alone),
        ];
        for (name, other) in others {
            println!("a frame beside {name:<13} {:>9.2}", frame / other);
        }
    }
    let share = write_images();
    println!("the writer with two cameras at 30 Hz: {share:.2} of its time");
}

/// Gives the medians.
fn print(measured: &mut Measured) -> [f64; 5] {
    println!("{:<28} {:>9} {:>8}", "", "p50", "p99");
    let rows = [
        ("postcard into a slice", &mut measured.again),
        ("postcard into fresh memory", &mut measured.fresh),
        ("as a frame, into a slice", &mut measured.alone),
        ("a frame of the recording", &mut measured.frame),
        ("digests of main outputs", &mut measured.digests),
    ];
    let medians = rows.map(|(name, values)| {
        let [median, slow] = [0.5, 0.99].map(|share| quantile(values, share));
        println!("{name:<28} {median:>9.0} {slow:>8.0}");
        median
    });
    let bytes = quantile(&mut measured.bytes, 0.5);
    println!("{:<28} {bytes:>9.0}", "bytes that postcard writes");
    let allocations = measured.allocations;
    println!("{:<28} {allocations:>9}", "allocations");
    medians
}
