//! Numbers that a seed draws.

/// From each state to the next.
pub(crate) const STEP: u64 = 0x9e37_79b9_7f4a_7c15;

/// Each bit depends on all: what the generator makes of its state. It can be undone.
#[inline]
pub(crate) const fn mixed(state: u64) -> u64 {
    let mixed = (state ^ (state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    mixed ^ (mixed >> 31)
}

/// SplitMix64 (Steele, Lea and Flood, 2014).
#[derive(Clone, Debug)]
pub(crate) struct SplitMix {
    state: u64,
}

impl SplitMix {
    pub(crate) fn new(seed: u64) -> Self {
        Self { state: seed }
    }

    /// 64 even bits.
    pub(crate) fn next(&mut self) -> u64 {
        self.state = self.state.wrapping_add(STEP);
        mixed(self.state)
    }

    /// Evenly from -1 to 1.
    #[expect(
        clippy::cast_precision_loss,
        reason = "53 bits are what the number has"
    )]
    pub(crate) fn signed(&mut self) -> f64 {
        let share = (self.next() >> 11) as f64 / (1_u64 << 53) as f64;
        2.0 * share - 1.0
    }
}
