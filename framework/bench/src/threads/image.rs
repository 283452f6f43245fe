//! An image that another thread waits for: through the framework's slots, and through the least that would do.

use std::sync::atomic::{AtomicU64, AtomicUsize, Ordering};
use std::thread::{self, Thread};
use std::time::{Duration, Instant};

use framework::{Reader, Timestamp, Writer, buffer_of};

use super::quantiles;
use crate::measure::Measured;

const IMAGE: usize = 614_400;
const IMAGES: u64 = 600;
const PERIOD: Duration = Duration::from_millis(4);
/// Neither of them is looked at before everything is warm.
const WARM_UP: u64 = 20;

/// Two images, of which one is complete; whoever reads it trusts that it is not written meanwhile.
struct Flipped {
    stamps: [AtomicU64; 2],
    images: [Vec<u8>; 2],
    complete: AtomicUsize,
}

/// Images alternate: one through the one, one through the other.
pub(super) fn measure() -> Vec<Measured> {
    let start = Instant::now();
    let flipped = Flipped {
        stamps: Default::default(),
        images: [vec![0; IMAGE], vec![0; IMAGE]],
        complete: AtomicUsize::new(0),
    };
    let (mut writer, [mut reader], []) = buffer_of(|| (0_u64, vec![0_u8; IMAGE]), []);
    let sent = AtomicU64::new(0);
    let (mut floor, mut ours) = (Vec::new(), Vec::new());
    thread::scope(|scope| {
        let waiting = scope.spawn(|| receive(start, &sent, &flipped, &mut reader));
        send(start, &sent, &flipped, &mut writer, waiting.thread());
        (floor, ours) = waiting.join().expect("receiving does not panic");
    });
    let floor_names = ["image: slot and futex, p50", "image: slot and futex, p99"];
    let mut measured = quantiles(floor_names, &mut floor).to_vec();
    measured.extend(quantiles(
        ["image: ours, p50", "image: ours, p99"],
        &mut ours,
    ));
    measured
}

fn send(
    start: Instant,
    sent: &AtomicU64,
    flipped: &Flipped,
    writer: &mut Writer<(u64, Vec<u8>)>,
    waiting: &Thread,
) {
    for number in 1..=IMAGES {
        thread::sleep(PERIOD);
        let stamp = start.elapsed().as_nanos() as u64;
        if number.is_multiple_of(2) {
            writer.slots().0.0 = stamp;
            writer.complete(number, Timestamp::from_nanos(stamp));
        } else {
            let next = 1 - flipped.complete.load(Ordering::Relaxed);
            flipped.stamps[next].store(stamp, Ordering::Relaxed);
            flipped.complete.store(next, Ordering::Release);
        }
        sent.store(number, Ordering::Release);
        waiting.unpark();
    }
}

/// How long each image was on its way.
fn receive(
    start: Instant,
    sent: &AtomicU64,
    flipped: &Flipped,
    reader: &mut Reader<(u64, Vec<u8>)>,
) -> (Vec<f64>, Vec<f64>) {
    let (mut floor, mut ours) = (Vec::new(), Vec::new());
    for number in 1..=IMAGES {
        while sent.load(Ordering::Acquire) < number {
            thread::park();
        }
        let is_ours = number.is_multiple_of(2);
        let (stamp, size) = if is_ours {
            reader.take();
            let (stamp, image) = reader.view().value();
            (*stamp, image.len())
        } else {
            let complete = flipped.complete.load(Ordering::Acquire);
            let stamp = flipped.stamps[complete].load(Ordering::Relaxed);
            (stamp, flipped.images[complete].len())
        };
        let took = start.elapsed().as_nanos() as f64 - stamp as f64;
        assert_eq!(size, IMAGE, "the whole image is there");
        if number > WARM_UP {
            if is_ours { &mut ours } else { &mut floor }.push(took);
        }
    }
    (floor, ours)
}
