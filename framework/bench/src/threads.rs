//! What only threads show: an image to another one, the wake-up, and the pace of a robot with cold caches.

mod image;
mod pace;
mod wake_up;

use framework::Result;
use rustix::mm::{MlockAllFlags, mlockall};
use thread_priority::{
    RealtimeThreadSchedulePolicy, ThreadPriority, ThreadPriorityValue, ThreadSchedulePolicy,
    set_thread_priority_and_policy, thread_native_id,
};

use crate::measure::{Measured, quantile};
use crate::report::{Limit, Report, Section};

/// As a robot's motion asks for it.
const PRIORITY: u8 = 50;

/// All of it, one after the other; each compares what alternates within it.
pub(crate) fn measure() -> Result<Vec<Measured>> {
    let mut measured = image::measure();
    measured.extend(wake_up::measure()?);
    measured.extend(pace::measure()?);
    Ok(measured)
}

/// Quantiles of one row.
fn quantiles(names: [&str; 2], nanos: &mut [f64]) -> [Measured; 2] {
    [(names[0], 0.5), (names[1], 0.99)].map(|(name, share)| Measured {
        name: name.to_owned(),
        nanos: quantile(nanos, share),
        allocations: 0.0,
    })
}

/// Makes the calling thread real-time, if the system lets it; whether it did.
fn become_real_time() -> bool {
    // A page that is not there would be measured, too.
    let is_locked = mlockall(MlockAllFlags::CURRENT | MlockAllFlags::FUTURE).is_ok();
    let priority = ThreadPriorityValue::try_from(PRIORITY).map(ThreadPriority::Crossplatform);
    let is_fifo = priority.is_ok_and(|priority| {
        let policy = ThreadSchedulePolicy::Realtime(RealtimeThreadSchedulePolicy::Fifo);
        set_thread_priority_and_policy(thread_native_id(), priority, policy).is_ok()
    });
    if !is_locked || !is_fifo {
        eprintln!("no real time here: run it as root, or grant CAP_SYS_NICE and CAP_IPC_LOCK");
    }
    is_fifo
}

/// What is asked of the image and of the wake-up.
pub(crate) fn section(report: &Report) -> Section {
    let ratio = |ours: &str, floor: &str| report.nanos(ours) / report.nanos(floor);
    Section {
        title: "An image to another thread; a wake-up every 12 ms under FIFO",
        unit: ("floor", report.nanos("image: slot and futex, p50")),
        rows: report.rows_until("image: slot and futex, p50", "wake-up: ours, p99"),
        limits: vec![
            Limit::new(
                "image to another thread, p50",
                ratio("image: ours, p50", "image: slot and futex, p50"),
                1.1,
                "x",
            ),
            Limit::new(
                "wake-up, p50",
                ratio("wake-up: ours, p50", "wake-up: clock_nanosleep, p50"),
                1.1,
                "x",
            ),
            Limit::new(
                "wake-up, p99",
                ratio("wake-up: ours, p99", "wake-up: clock_nanosleep, p99"),
                1.1,
                "x",
            ),
        ],
    }
}

/// What is asked at a robot's pace.
pub(crate) fn section_of_pace(report: &Report) -> Section {
    let names = ["HAND, p50", "ours, p50", "ours, p99", "ours, recorded, p50"];
    let [hand, ours, slow, recorded] = names.map(|name| report.nanos(&format!("83 Hz: {name}")));
    Section {
        title: "83 Hz, five threads, cold caches",
        unit: ("HAND", hand),
        rows: report.rows_until("83 Hz: HAND, p50", "83 Hz: a frame's bytes copied, p99"),
        limits: vec![
            Limit::new(
                "overhead over HAND, p50",
                (ours - hand) / hand,
                0.45,
                "HAND",
            ),
            Limit::new("p99 over own p50", slow / ours, 2.0, "x"),
            Limit::new("a recording, p50", (recorded - ours) / hand, 0.2, "HAND"),
        ],
    }
}
