//! The mix at a robot's pace: the cycler every 12 ms, four producers at theirs, each on a thread of its own.
//!
//! Between two cycles a robot's thread sleeps and others use the caches; here each walks through memory after its cycle, so that
//! nothing of the cycle is left in the core's own caches.

use std::hint::black_box;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::{Duration, Instant};

use framework::timing::{self, Timing};
use framework::{Instance, Result};
use mix_at_83_hz_runtime::runtime;

use super::{become_real_time, quantiles};
use crate::measure::Measured;
use crate::mix::{ByHand, EVERY, PARAMETERS};
use crate::recorded::{self, Recorder};
use crate::turn::{robot, take, turn};

const PERIOD: Duration = Duration::from_millis(12);
/// By hand so long after ours, and a copy so long after that.
const LATER: Duration = Duration::from_millis(4);
/// Every other cycle of ours is recorded.
const CYCLES: u32 = 2000;
/// Until history reaches as far back as it ever will.
const WARM_UP: u32 = 100;
/// More than a core's own caches hold.
const MEMORY: usize = 8 << 20;
/// As much as a recording has for its frames.
const BLOCKS: usize = 64 << 20;

/// What memory alone takes for a frame: its bytes, once, to where nothing was written for long.
struct Copies {
    bytes: Vec<u8>,
    blocks: Vec<u8>,
    place: usize,
    length: usize,
}

impl Copies {
    fn new() -> Self {
        Self {
            bytes: vec![1; BLOCKS],
            blocks: vec![2; BLOCKS],
            place: 0,
            length: 0,
        }
    }

    fn next(&mut self) -> Duration {
        let started = Instant::now();
        let range = self.place..self.place + self.length;
        self.blocks[range.clone()].copy_from_slice(&self.bytes[range]);
        black_box(&mut self.blocks);
        let took = started.elapsed();
        self.place = (self.place + self.length) % (BLOCKS / 2);
        took
    }
}

pub(super) fn measure() -> Result<Vec<Measured>> {
    timing::set(Timing::Off);
    let mut robot = robot(runtime::create, PARAMETERS)?;
    let mut recorder = Recorder::of(&robot, "Control")?;
    let mut control = take(&mut robot, "Control");
    let producers = EVERY.map(|(name, every)| (take(&mut robot, name), every));
    let mut hand = ByHand::new()?;
    let done = AtomicBool::new(false);
    let [mut by_hand, mut ours, mut recorded, mut copied] = thread::scope(|scope| {
        for (mut producer, every) in producers {
            let done = &done;
            scope.spawn(move || produce(producer.as_mut(), PERIOD * every as u32, done));
        }
        let control = scope.spawn(|| turn_control(control.as_mut(), &mut recorder, &mut hand));
        let measured = control.join();
        done.store(true, Ordering::Relaxed);
        measured.expect("no cycle panics")
    });
    let mut measured = quantiles(["83 Hz: HAND, p50", "83 Hz: HAND, p99"], &mut by_hand).to_vec();
    measured.extend(quantiles(
        ["83 Hz: ours, p50", "83 Hz: ours, p99"],
        &mut ours,
    ));
    measured.extend(quantiles(
        ["83 Hz: ours, recorded, p50", "83 Hz: ours, recorded, p99"],
        &mut recorded,
    ));
    measured.extend(quantiles(
        [
            "83 Hz: a frame's bytes copied, p50",
            "83 Hz: a frame's bytes copied, p99",
        ],
        &mut copied,
    ));
    Ok(measured)
}

fn produce(instance: &mut dyn Instance, period: Duration, done: &AtomicBool) {
    let mut memory = vec![0_u8; MEMORY];
    while !done.load(Ordering::Relaxed) {
        thread::sleep(period);
        turn(instance);
        walk(&mut memory);
    }
}

/// What each cycle took: by hand, ours, ours recorded, and as many bytes copied as are recorded of one.
fn turn_control(
    control: &mut dyn Instance,
    recorder: &mut Recorder,
    hand: &mut ByHand,
) -> [Vec<f64>; 4] {
    become_real_time();
    let (mut by_hand, mut ours, mut recorded) = (Vec::new(), Vec::new(), Vec::new());
    let (mut copied, mut copies) = (Vec::new(), Copies::new());
    let mut memory = vec![0_u8; MEMORY];
    let mut due = Instant::now();
    for cycle in 0..CYCLES {
        due += PERIOD;
        sleep_until(due);
        let is_recorded = cycle % 2 == 1;
        // Looked at in no cycle that is measured: it would be in a cache.
        let before = (cycle < WARM_UP).then(|| control.cycle().time.start);
        let started = Instant::now();
        match is_recorded {
            true => recorder.turn(control),
            false => turn(control),
        }
        let took = started.elapsed();
        walk(&mut memory);
        sleep_until(due + LATER);
        let took_by_hand = hand.cycle();
        walk(&mut memory);
        sleep_until(due + 2 * LATER);
        let took_to_copy = copies.next();
        walk(&mut memory);
        if cycle >= WARM_UP {
            let row = if is_recorded {
                &mut recorded
            } else {
                &mut ours
            };
            row.push(took.as_nanos() as f64);
            by_hand.push(took_by_hand.as_nanos() as f64);
            copied.push(took_to_copy.as_nanos() as f64);
        } else if is_recorded {
            // Histories of two cycles, as of a recorded cycle.
            copies.length = recorded::bytes(control, before);
        }
    }
    recorder.rest();
    [by_hand, ours, recorded, copied]
}

fn sleep_until(due: Instant) {
    thread::sleep(due.saturating_duration_since(Instant::now()));
}

/// Through all of it, line by line.
fn walk(memory: &mut [u8]) {
    for line in memory.chunks_mut(64) {
        line[0] = line[0].wrapping_add(1);
    }
    black_box(memory);
}
