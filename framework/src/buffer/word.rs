//! The word of a slot: `sequence: 32 | queued: 20 | held: 12`.

const QUEUED_BITS: u32 = 20;
const HELD_BITS: u32 = 12;
const HELD: u64 = (1 << HELD_BITS) - 1;
const QUEUED: u64 = ((1 << QUEUED_BITS) - 1) << HELD_BITS;

/// How many readers a word can count, with one value of `held` kept for the writer.
pub(super) const READERS: usize = HELD as usize - 1;

/// How many consumers a word can name: each is one bit of `queued`. `cli/src/resolve/consumers.rs` has the number, too.
pub(super) const CONSUMERS: usize = QUEUED_BITS as usize;

/// Which cycle a slot holds, which consumers still have to take it, how many readers hold it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Word(pub(super) u64);

impl Word {
    /// The writer has the slot: more than all readers together could hold.
    pub(super) const WRITING: Self = Self(HELD);

    /// What holding adds to a word and letting go takes from it.
    pub(super) const ONE_HELD: u64 = 1;

    /// A complete cycle that is queued for the first so many consumers and that nobody holds.
    pub(super) const fn published(sequence: u32, consumers: u16) -> Self {
        let queued = (1 << consumers) - 1;
        Self((sequence as u64) << (QUEUED_BITS + HELD_BITS) | queued << HELD_BITS)
    }

    #[inline]
    pub(super) const fn sequence(self) -> u32 {
        (self.0 >> (QUEUED_BITS + HELD_BITS)) as u32
    }

    /// Whether it is the complete cycle with this number.
    #[inline]
    pub(super) const fn is(self, sequence: u32) -> bool {
        self.sequence() == sequence && self.0 & HELD != HELD
    }

    /// Whether readers hold it, or the writer has it.
    #[inline]
    pub(super) const fn is_held(self) -> bool {
        self.0 & HELD != 0
    }

    #[inline]
    pub(super) const fn is_queued(self) -> bool {
        self.0 & QUEUED != 0
    }

    /// Whether this consumer still has to take it.
    #[inline]
    pub(super) const fn is_queued_for(self, consumer: usize) -> bool {
        self.0 >> HELD_BITS >> consumer & 1 != 0
    }

    /// One more reader holds it.
    #[inline]
    pub(super) const fn hold(self) -> Self {
        Self(self.0 + Self::ONE_HELD)
    }

    /// This consumer, for which it is queued, takes it.
    #[inline]
    pub(super) const fn take(self, consumer: usize) -> Self {
        Self(self.0 - (1 << HELD_BITS << consumer))
    }
}

#[cfg(test)]
mod tests {
    use super::{CONSUMERS, Word};

    #[test]
    fn a_slot_being_written_is_no_complete_cycle() {
        assert!(!Word::WRITING.is(Word::WRITING.sequence()));
        assert!(Word::WRITING.is_held() && !Word::WRITING.is_queued());
    }

    #[test]
    fn taking_is_for_one_consumer_and_leaves_the_others() {
        let word = Word::published(u32::MAX, 3).hold();
        assert!(word.is(u32::MAX) && word.is_held() && word.is_queued());
        let taken = word.take(1);
        let queued = [0, 1, 2, 3].map(|consumer| taken.is_queued_for(consumer));
        assert_eq!(queued, [true, false, true, false]);
        let taken = taken.take(0).take(2);
        assert!(taken.is(u32::MAX) && taken.is_held() && !taken.is_queued());
    }

    #[test]
    fn a_word_has_room_for_all_consumers() {
        let mut word = Word::published(7, CONSUMERS as u16);
        for consumer in 0..CONSUMERS {
            assert!(word.is_queued_for(consumer));
            word = word.take(consumer);
        }
        assert_eq!(word, Word::published(7, 0));
    }
}
