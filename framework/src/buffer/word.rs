//! The word of a slot: `sequence: 32 | queued: 16 | held: 16`.

const BITS: u32 = 16;
const ONE_QUEUED: u64 = 1 << BITS;
const HELD: u64 = ONE_QUEUED - 1;
const QUEUED: u64 = HELD << BITS;

/// How many readers and consumers a word can count, with one value of `held` kept for the writer.
pub(super) const PARTIES: usize = HELD as usize - 1;

/// Which cycle a slot holds, how many consumers still have to take it, how many parties hold it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Word(pub(super) u64);

impl Word {
    /// The writer has the slot: more than all parties together could hold.
    pub(super) const WRITING: Self = Self(HELD);

    /// What holding adds to a word and letting go takes from it.
    pub(super) const ONE_HELD: u64 = 1;

    /// A complete cycle that so many consumers have queued and nobody holds.
    pub(super) const fn published(sequence: u32, queued: u16) -> Self {
        Self((sequence as u64) << (2 * BITS) | (queued as u64) << BITS)
    }

    #[inline]
    pub(super) const fn sequence(self) -> u32 {
        (self.0 >> (2 * BITS)) as u32
    }

    /// Whether it is the complete cycle with this number.
    #[inline]
    pub(super) const fn is(self, sequence: u32) -> bool {
        self.sequence() == sequence && self.0 & HELD != HELD
    }

    #[inline]
    pub(super) const fn is_held(self) -> bool {
        self.0 & HELD != 0
    }

    #[inline]
    pub(super) const fn is_queued(self) -> bool {
        self.0 & QUEUED != 0
    }

    /// One more party holds it.
    #[inline]
    pub(super) const fn hold(self) -> Self {
        Self(self.0 + Self::ONE_HELD)
    }

    /// One consumer less has it queued, and holds it.
    #[inline]
    pub(super) const fn take(self) -> Self {
        Self(self.0 - ONE_QUEUED + Self::ONE_HELD)
    }
}

#[cfg(test)]
mod tests {
    use super::Word;

    #[test]
    fn a_slot_being_written_is_no_complete_cycle() {
        assert!(!Word::WRITING.is(Word::WRITING.sequence()));
        assert!(Word::WRITING.is_held() && !Word::WRITING.is_queued());
    }

    #[test]
    fn taking_moves_one_count_and_leaves_the_others() {
        let word = Word::published(u32::MAX, 3).hold();
        assert!(word.is(u32::MAX) && word.is_held() && word.is_queued());
        assert_eq!(
            word.take().0 - 2 * Word::ONE_HELD,
            Word::published(u32::MAX, 2).0
        );
        let taken = word.take().take().take();
        assert!(taken.is(u32::MAX) && taken.is_held() && !taken.is_queued());
    }
}
