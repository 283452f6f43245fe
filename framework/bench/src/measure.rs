//! Rows that are measured round-robin: whatever else the machine does, it does to all of them.

use std::time::{Duration, Instant};

use crate::counting::allocations;

/// How long one sample of a row takes, about.
const SAMPLE: Duration = Duration::from_micros(500);
const WARM_UP: Duration = Duration::from_millis(20);

/// One row: something that is done again and again.
pub(crate) struct Row<'a> {
    name: &'static str,
    /// Does it so often, and tells how long that took.
    run: Box<dyn FnMut(u64) -> Duration + 'a>,
}

/// What one process measured of one row.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Measured {
    pub(crate) name: String,
    /// Nanoseconds each time.
    pub(crate) nanos: f64,
    /// Heap allocations each time.
    pub(crate) allocations: f64,
}

impl<'a> Row<'a> {
    /// Something that is timed as a whole.
    pub(crate) fn new(name: &'static str, mut once: impl FnMut() + 'a) -> Self {
        Self::timed(name, move |times| timed(times, &mut once))
    }

    /// Something that times itself.
    pub(crate) fn timed(name: &'static str, run: impl FnMut(u64) -> Duration + 'a) -> Self {
        Self {
            name,
            run: Box::new(run),
        }
    }

    /// Whether it has this name.
    pub(crate) fn is(&self, name: &str) -> bool {
        self.name == name
    }

    /// Does it so often.
    pub(crate) fn repeat(&mut self, times: u64) {
        (self.run)(times);
    }

    /// How often it is done in one sample; warms it up.
    fn times(&mut self) -> u64 {
        let started = Instant::now();
        let mut times = 1;
        loop {
            let took = (self.run)(times);
            if started.elapsed() > WARM_UP && took * 2 > SAMPLE {
                return times;
            }
            if took < SAMPLE {
                times *= 2;
            }
        }
    }
}

/// How long it takes to do it so often.
#[inline]
pub(crate) fn timed(times: u64, mut once: impl FnMut()) -> Duration {
    let started = Instant::now();
    for _ in 0..times {
        once();
    }
    started.elapsed()
}

/// Measures all rows, one sample of each in every round; the medians.
pub(crate) fn measure(mut rows: Vec<Row<'_>>, rounds: usize) -> Vec<Measured> {
    let times: Vec<_> = rows.iter_mut().map(Row::times).collect();
    let mut samples = vec![Vec::with_capacity(rounds); rows.len()];
    let mut allocated = vec![0.0; rows.len()];
    for round in 0..rounds {
        for index in 0..rows.len() {
            // Not always behind the same one.
            let index = (index + round) % rows.len();
            let before = allocations();
            let took = (rows[index].run)(times[index]);
            allocated[index] = (allocations() - before) as f64 / times[index] as f64;
            samples[index].push(took.as_nanos() as f64 / times[index] as f64);
        }
    }
    let measured = rows.iter().zip(samples).zip(allocated);
    measured
        .map(|((row, mut samples), allocations)| Measured {
            name: row.name.to_owned(),
            nanos: quantile(&mut samples, 0.5),
            allocations,
        })
        .collect()
}

/// The value that this share does not exceed.
pub(crate) fn quantile(values: &mut [f64], share: f64) -> f64 {
    values.sort_by(f64::total_cmp);
    let last = values.len().saturating_sub(1);
    values
        .get((last as f64 * share).round() as usize)
        .copied()
        .unwrap_or(f64::NAN)
}
