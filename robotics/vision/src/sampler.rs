//! Owns the choice of samples for robust fits: the same numbers in every cycle.
//!
//! Invariant: no parameter makes a fit endless.

/// More attempts find nothing better: after 500 a line on which a tenth of all points lie was missed
/// with 1 % probability.
const MOST_ATTEMPTS: u32 = 500;

/// What is tried for one fit, one number for each attempt.
pub(crate) fn attempts(wanted: u32) -> std::ops::Range<u32> {
    0..wanted.min(MOST_ATTEMPTS)
}

/// Numbers without a pattern (xorshift, Marsaglia 2003), always in the same sequence.
pub(crate) struct Sampler(u32);

impl Sampler {
    /// From the beginning of the sequence.
    pub(crate) fn new() -> Self {
        Self(0x9e37_79b9)
    }

    /// Two different numbers below `count`, which must be at least 2.
    pub(crate) fn pair(&mut self, count: usize) -> (usize, usize) {
        let first = self.below(count);
        let distance = 1 + self.below(count - 1);
        (first, (first + distance) % count)
    }

    fn below(&mut self, limit: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 17;
        self.0 ^= self.0 << 5;
        self.0 as usize % limit
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pairs_differ_and_come_from_everywhere() {
        let mut sampler = Sampler::new();
        let pairs: Vec<_> = (0..200).map(|_| sampler.pair(5)).collect();
        assert!(pairs.iter().all(|(one, other)| one != other));
        for number in 0..5 {
            let count = pairs.iter().filter(|(one, _)| *one == number).count();
            assert!(count > 20, "{number} was first {count} times");
        }
        assert_eq!(Sampler::new().pair(5), pairs[0]);
    }

    #[test]
    fn as_many_attempts_are_made_as_wanted_but_not_endlessly_many() {
        for (wanted, made) in [(0, 0), (40, 40), (u32::MAX, 500)] {
            assert_eq!(attempts(wanted).count(), made);
        }
    }
}
