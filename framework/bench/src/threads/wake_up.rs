//! How late a real-time thread wakes up: as hardware interfaces wait with the framework's clock, and with the bare system call.

use std::thread;
use std::time::{Duration, Instant};

use framework::{Clock, Result, Stop, Timestamp};
use rustix::thread::{ClockId, Timespec, clock_nanosleep_absolute};
use rustix::time::clock_gettime;

use super::{become_real_time, quantiles};
use crate::measure::Measured;

const PERIOD: Duration = Duration::from_millis(12);
const PERIODS: u32 = 1000;

/// Wake-ups alternate between the two.
pub(super) fn measure() -> Result<Vec<Measured>> {
    let thread = thread::spawn(|| -> Result<_> {
        become_real_time();
        let (clock, stop) = (Clock::wall(), Stop::new());
        let (mut bare, mut ours) = (Vec::new(), Vec::new());
        for period in 0..PERIODS {
            if period.is_multiple_of(2) {
                bare.push(late_by_the_system()?);
            } else {
                ours.push(late_by_the_clock(&clock, &stop)?);
            }
        }
        Ok((bare, ours))
    });
    let (mut bare, mut ours) = thread.join().expect("waiting does not panic")?;
    let bare_names = [
        "wake-up: clock_nanosleep, p50",
        "wake-up: clock_nanosleep, p99",
    ];
    let mut measured = quantiles(bare_names, &mut bare).to_vec();
    measured.extend(quantiles(
        ["wake-up: ours, p50", "wake-up: ours, p99"],
        &mut ours,
    ));
    Ok(measured)
}

fn late_by_the_system() -> Result<f64> {
    let now = Duration::try_from(clock_gettime(rustix::time::ClockId::Monotonic))?;
    let due = now + PERIOD;
    let request = Timespec::try_from(due)?;
    clock_nanosleep_absolute(ClockId::Monotonic, &request)?;
    let woken = Duration::try_from(clock_gettime(rustix::time::ClockId::Monotonic))?;
    Ok((woken - due).as_nanos() as f64)
}

fn late_by_the_clock(clock: &Clock, stop: &Stop) -> Result<f64> {
    let due: Timestamp = clock.now() + PERIOD;
    let started = Instant::now();
    clock.wait_until(due, stop)?;
    assert!(started.elapsed() >= PERIOD / 2, "it waits");
    Ok((clock.now() - due).as_nanos() as f64)
}
