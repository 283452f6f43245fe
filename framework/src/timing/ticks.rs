//! The counter that is cheapest to read, for durations that are measured often.
//!
//! On x86-64 the processor's own where it is invariant, elsewhere the system's monotonic clock. Never for timestamps: over
//! minutes the two drift apart.
#![cfg_attr(
    target_arch = "x86_64",
    expect(unsafe_code, reason = "reading the counter is an unsafe intrinsic")
)]

use std::sync::OnceLock;
use std::time::{Duration, Instant};

/// How long the counter is compared with the clock, once per process.
const CALIBRATION: Duration = Duration::from_millis(2);
/// A comparison is the best of so many: between two looks at the clock a thread may have to wait.
const LOOKS: usize = 16;

/// A moment, in ticks of the counter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Ticks(u64);

/// What the counter counts.
#[derive(Clone, Copy, Debug)]
enum Counter {
    /// The processor's.
    Raw { nanos_per_tick: f64 },
    /// Nanoseconds since this moment.
    Clock { start: Instant },
}

static COUNTER: OnceLock<Counter> = OnceLock::new();

impl Ticks {
    /// Now.
    #[inline]
    pub(crate) fn now() -> Self {
        match COUNTER.get_or_init(Counter::choose) {
            Counter::Raw { .. } => Self(raw()),
            Counter::Clock { start } => Self(start.elapsed().as_nanos() as u64),
        }
    }

    /// Compares counter and clock, if nobody has yet: it takes milliseconds, which no cycle should wait for.
    pub(crate) fn calibrate() {
        COUNTER.get_or_init(Counter::choose);
    }

    /// Time since `earlier`; zero if that is not earlier.
    #[inline]
    pub(crate) fn since(self, earlier: Self) -> Duration {
        let ticks = self.0.saturating_sub(earlier.0);
        match COUNTER.get() {
            Some(Counter::Raw { nanos_per_tick }) => {
                Duration::from_nanos((ticks as f64 * nanos_per_tick) as u64)
            }
            _ => Duration::from_nanos(ticks),
        }
    }
}

impl Counter {
    #[cold]
    fn choose() -> Self {
        let start = Instant::now();
        if !is_invariant() {
            return Self::Clock { start };
        }
        let (first, first_raw) = look();
        while start.elapsed() < CALIBRATION {
            std::hint::spin_loop();
        }
        let (last, last_raw) = look();
        let ticks = last_raw.saturating_sub(first_raw);
        if ticks == 0 {
            return Self::Clock { start };
        }
        Self::Raw {
            nanos_per_tick: (last - first).as_nanos() as f64 / ticks as f64,
        }
    }
}

/// Clock and counter at one moment.
fn look() -> (Instant, u64) {
    let looks = (0..LOOKS).map(|_| {
        let before = Instant::now();
        let raw = raw();
        (before.elapsed(), before, raw)
    });
    let best = looks.min_by_key(|(took, ..)| *took);
    best.map_or_else(|| (Instant::now(), raw()), |(_, before, raw)| (before, raw))
}

#[cfg(target_arch = "x86_64")]
#[inline]
fn raw() -> u64 {
    // SAFETY: every x86-64 processor has the instruction, and it changes nothing.
    unsafe { std::arch::x86_64::_rdtsc() }
}

/// Whether the counter runs at one rate, whatever the processor does (leaf 8000_0007, EDX bit 8).
#[cfg(target_arch = "x86_64")]
fn is_invariant() -> bool {
    use std::arch::x86_64::__cpuid;

    const POWER: u32 = 0x8000_0007;
    __cpuid(0x8000_0000).eax >= POWER && __cpuid(POWER).edx & (1 << 8) != 0
}

#[cfg(not(target_arch = "x86_64"))]
fn raw() -> u64 {
    0
}

#[cfg(not(target_arch = "x86_64"))]
fn is_invariant() -> bool {
    false
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_and_the_clock_agree() {
        Ticks::calibrate();
        let agree = |_: &i32| {
            let (clock, ticks) = (Instant::now(), Ticks::now());
            std::thread::sleep(Duration::from_millis(20));
            let (counted, took) = (Ticks::now().since(ticks), clock.elapsed());
            // Between the two looks at either end the thread may wait.
            counted.abs_diff(took) < Duration::from_millis(1)
        };
        let agreed = (0..5).filter(agree).count();
        assert!(
            agreed > 0,
            "no sleep of 20 ms was counted as long as it was"
        );
    }

    #[test]
    fn nothing_is_shorter_than_zero() {
        let before = Ticks::now();
        let after = Ticks::now();
        assert_eq!(before.since(after), Duration::ZERO);
    }
}
