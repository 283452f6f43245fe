//! Durations in buckets whose width grows with the duration: quantiles to about 3 %, no allocation after creation.

use std::time::Duration;

/// Buckets per doubling, as a power of two.
const PRECISION: u32 = 4;
const PER_DOUBLING: usize = 1 << PRECISION;
/// Longer durations (18 minutes) fall into the last bucket.
const LARGEST: u64 = (1 << 40) - 1;
const BUCKETS: usize = (40 - PRECISION as usize + 1) * PER_DOUBLING;

/// Counts durations in log-linear buckets of nanoseconds.
#[derive(PartialEq, Eq)]
pub struct Histogram {
    /// None where it is only filled by others.
    counts: Box<[u32]>,
    total: u64,
    longest: Duration,
}

impl Default for Histogram {
    fn default() -> Self {
        Self {
            counts: vec![0; BUCKETS].into_boxed_slice(),
            total: 0,
            longest: Duration::ZERO,
        }
    }
}

/// [`Clone::clone_from`] keeps the memory.
impl Clone for Histogram {
    fn clone(&self) -> Self {
        Self {
            counts: self.counts.clone(),
            total: self.total,
            longest: self.longest,
        }
    }

    fn clone_from(&mut self, other: &Self) {
        self.counts.clone_from(&other.counts);
        (self.total, self.longest) = (other.total, other.longest);
    }
}

impl Histogram {
    /// Owns no memory until it is filled from another one; it cannot record.
    pub(crate) fn nothing() -> Self {
        Self {
            counts: Box::default(),
            total: 0,
            longest: Duration::ZERO,
        }
    }

    /// Counts one duration.
    #[inline]
    pub fn record(&mut self, duration: Duration) {
        let nanos = u64::try_from(duration.as_nanos())
            .unwrap_or(LARGEST)
            .min(LARGEST);
        if let Some(count) = self.counts.get_mut(bucket(nanos)) {
            *count = count.saturating_add(1);
        }
        self.total += 1;
        self.longest = self.longest.max(duration);
    }

    /// Adds everything that `other` counted.
    pub fn merge(&mut self, other: &Self) {
        if self.counts.is_empty() {
            self.counts.clone_from(&other.counts);
        } else {
            for (count, more) in self.counts.iter_mut().zip(&other.counts) {
                *count = count.saturating_add(*more);
            }
        }
        self.total += other.total;
        self.longest = self.longest.max(other.longest);
    }

    /// How many durations were counted.
    pub fn count(&self) -> u64 {
        self.total
    }

    /// The longest duration, exactly; zero if there was none.
    pub fn longest(&self) -> Duration {
        self.longest
    }

    /// The duration that this share of all (0 to 1) does not exceed, to about 3 %; zero if there was none.
    pub fn quantile(&self, share: f64) -> Duration {
        let rank = (share.clamp(0.0, 1.0) * self.total as f64).ceil().max(1.0) as u64;
        let mut seen = 0;
        for (bucket, count) in self.counts.iter().enumerate() {
            seen += u64::from(*count);
            if seen >= rank {
                return Duration::from_nanos(middle(bucket)).min(self.longest);
            }
        }
        self.longest
    }
}

impl std::fmt::Debug for Histogram {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter
            .debug_struct("Histogram")
            .field("count", &self.total)
            .field("p50", &self.quantile(0.5))
            .field("longest", &self.longest)
            .finish()
    }
}

/// The first `PER_DOUBLING` buckets are one nanosecond wide, then each doubling has as many.
#[inline]
fn bucket(nanos: u64) -> usize {
    let doublings = (u64::BITS - nanos.leading_zeros()).saturating_sub(PRECISION + 1);
    let within = (nanos >> doublings) as usize;
    doublings as usize * PER_DOUBLING + within
}

fn middle(bucket: usize) -> u64 {
    let doublings = (bucket / PER_DOUBLING).saturating_sub(1);
    let within = (bucket - doublings * PER_DOUBLING) as u64;
    (within << doublings) + ((1 << doublings) >> 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_duration_has_a_bucket_whose_middle_is_near() {
        for power in 0..40 {
            for nanos in [
                1_u64 << power,
                (1 << power) + (1 << power) / 3,
                (2 << power) - 1,
            ] {
                let bucket = bucket(nanos.min(LARGEST));
                assert!(bucket < BUCKETS, "{nanos}");
                let error = middle(bucket).abs_diff(nanos.min(LARGEST));
                assert!(
                    error as f64 <= nanos as f64 * 0.035,
                    "{nanos}: {}",
                    middle(bucket)
                );
            }
        }
    }

    #[test]
    fn quantiles_of_a_ramp_are_its_shares() {
        let mut ramp = Histogram::default();
        assert_eq!(ramp.quantile(0.5), Duration::ZERO);
        for micros in 1..=1000 {
            ramp.record(Duration::from_micros(micros));
        }
        let near = |share: f64, micros: f64| {
            let found = ramp.quantile(share).as_secs_f64() * 1e6;
            assert!((found - micros).abs() < 0.035 * micros, "{share}: {found}");
        };
        near(0.5, 500.0);
        near(0.99, 990.0);
        assert_eq!(ramp.longest(), Duration::from_millis(1));
        assert_eq!(ramp.quantile(1.0).max(ramp.longest()), ramp.longest());
    }

    #[test]
    fn merging_counts_both() {
        let mut one = Histogram::default();
        one.record(Duration::from_millis(1));
        let mut both = one.clone();
        let mut other = Histogram::default();
        other.record(Duration::from_secs(3600));
        both.merge(&other);
        assert_eq!(
            (both.count(), both.longest()),
            (2, Duration::from_secs(3600))
        );
    }
}
