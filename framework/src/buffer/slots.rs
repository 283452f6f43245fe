//! The slots and who may touch them; all `unsafe` about memory of the framework is in this file.
//!
//! Access is by token: [`Pen`] exists once, [`Held`] once for each count of `held`, [`Taken`] once
//! for each cycle that a consumer took and did not release. Tokens are made only here, cannot be
//! copied, and stay in the party that has them, beside the one `Arc` of the slots that made them.
#![expect(
    unsafe_code,
    reason = "several threads share one slot under the rule of its word"
)]

use super::sync::{AtomicU32, AtomicU64, Ordering, Place, relax};
use super::word::Word;
use crate::time::Timestamp;

/// What a slot holds: the outputs of one cycle and where they come from.
#[derive(Clone, Debug, Default)]
pub struct Entry<T> {
    /// Number of the cycle that wrote it; 0 until a first cycle is complete.
    pub cycle: u64,
    /// Timestamp of that cycle.
    pub timestamp: Timestamp,
    /// What it wrote.
    pub value: T,
}

/// The slots of one instance with what tells parties where to look.
pub(super) struct Slots<T> {
    places: Box<[Place<Entry<T>>]>,
    words: Box<[AtomicU64]>,
    /// For each consumer: it has released every cycle with a sequence number before this.
    released: Box<[AtomicU32]>,
    /// Slot of the complete cycle with a sequence number, by the low bits of that number.
    by_sequence: Box<[AtomicU32]>,
    newest: AtomicU64,
    /// Sequence number of the newest cycle for consumers.
    completed: AtomicU32,
    /// Timestamp of the cycle on its way, or `NOTHING`.
    announced: AtomicU64,
    abandoned: AtomicU64,
}

const NOTHING: u64 = Timestamp::NEVER.as_nanos();

/// A slot and the sequence number it has to have.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) struct Newest(u64);

impl Newest {
    fn new(sequence: u32, slot: usize) -> Self {
        Self(u64::from(sequence) << 32 | slot as u64)
    }

    fn slot(self) -> usize {
        self.0 as u32 as usize
    }

    fn sequence(self) -> u32 {
        (self.0 >> 32) as u32
    }
}

/// How many may look at the slots.
#[derive(Clone, Copy)]
pub(super) struct Parties {
    readers: bool,
    consumers: u16,
}

impl Parties {
    pub(super) fn of<const R: usize, const C: usize>() -> Self {
        Self {
            readers: R > 0,
            consumers: C as u16,
        }
    }
}

/// The right to write: one slot is being written, one is the newest.
pub(super) struct Pen {
    writing: usize,
    newest: usize,
    /// Of the newest.
    sequence: u32,
    parties: Parties,
}

/// One count of `held` in the word of a slot.
pub(super) struct Held {
    slot: usize,
}

/// A cycle that a consumer took.
pub(super) struct Taken {
    slot: usize,
    sequence: u32,
}

impl Held {
    /// Stands for a token that was given back; reading through it finds no slot.
    pub(super) const NOWHERE: Self = Self { slot: usize::MAX };
}

// SAFETY: the only part that is not `Sync` by itself are the places. The protocol gives out either
// the exclusive reference of the pen (which needs `T: Send`, as the value may be written and
// dropped by another thread) or shared references of holders (which need `T: Sync`).
unsafe impl<T: Send + Sync> Sync for Slots<T> {}

impl<T> Slots<T> {
    /// Slots of which the first is the newest, never written, with the sequence number `first`.
    pub(super) fn new(
        mut initial: impl FnMut() -> T,
        slots: usize,
        first: u32,
        parties: Parties,
    ) -> (Self, Pen) {
        let entry = |_| {
            Place::new(Entry {
                cycle: 0,
                timestamp: Timestamp::ZERO,
                value: initial(),
            })
        };
        let word = |slot| match slot {
            1 => Word::WRITING,
            _ => Word::published(first, 0),
        };
        let slots = Self {
            places: (0..slots).map(entry).collect(),
            words: (0..slots)
                .map(|slot| AtomicU64::new(word(slot).0))
                .collect(),
            released: (0..parties.consumers)
                .map(|_| AtomicU32::new(first.wrapping_add(1)))
                .collect(),
            by_sequence: (0..slots.next_power_of_two())
                .map(|_| AtomicU32::new(0))
                .collect(),
            newest: AtomicU64::new(Newest::new(first, 0).0),
            completed: AtomicU32::new(first),
            announced: AtomicU64::new(NOTHING),
            abandoned: AtomicU64::new(0),
        };
        (
            slots,
            Pen {
                writing: 1,
                newest: 0,
                sequence: first,
                parties,
            },
        )
    }

    pub(super) fn len(&self) -> usize {
        self.places.len()
    }

    /// The slot being written and the newest.
    #[inline]
    pub(super) fn both<'a>(&'a self, pen: &'a mut Pen) -> (&'a mut Entry<T>, &'a Entry<T>) {
        let writing = self.places[pen.writing].exclusive();
        let newest = self.places[pen.newest].shared();
        // SAFETY: the word of `writing` is WRITING since its claim, which happened after the last
        // reader let go and the last consumer released, and nobody holds or takes a slot with that
        // word: the pen, borrowed mutably, is the only way to it. `newest` is another slot, published, and only the pen could claim it.
        unsafe { (&mut *writing, &*newest) }
    }

    /// The newest, for the writer.
    #[inline]
    pub(super) fn newest_of<'a>(&'a self, pen: &'a Pen) -> &'a Entry<T> {
        let newest = self.places[pen.newest].shared();
        // SAFETY: the newest is published, and the pen, borrowed here, is the only one who could
        // claim it.
        unsafe { &*newest }
    }

    /// What somebody holds.
    #[inline]
    pub(super) fn read<'a>(&'a self, held: &'a Held) -> &'a Entry<T> {
        let place = self.places[held.slot].shared();
        // SAFETY: this token is one count of `held` in the word of its slot, which can only be
        // taken back by giving up the token, borrowed here. A slot with a count is not claimed, so
        // nobody writes there. The change of the word that made the token was an `Acquire` of the
        // publication.
        unsafe { &*place }
    }

    /// What a consumer took.
    #[inline]
    pub(super) fn read_taken<'a>(&'a self, taken: &'a Taken) -> &'a Entry<T> {
        let place = self.places[taken.slot].shared();
        // SAFETY: this token, borrowed here, is given up when its consumer's `released` passes its
        // sequence number. Until then a slot with that number which is not queued for the consumer
        // is not claimed, so nobody writes there. The change of the word that made the token was an
        // `Acquire` of the publication.
        unsafe { &*place }
    }

    #[inline]
    pub(super) fn announce(&self, timestamp: Timestamp) {
        // Release: who sees it sees `completed` of the cycle before.
        self.announced
            .store(timestamp.as_nanos(), Ordering::Release);
    }

    pub(super) fn withdraw(&self) {
        self.abandoned.fetch_add(1, Ordering::Relaxed);
        // Release: as for an announcement.
        self.announced.store(NOTHING, Ordering::Release);
    }

    /// Ask before [`Slots::completed`].
    #[inline]
    pub(super) fn announced(&self) -> Option<Timestamp> {
        // Acquire: without the announcement comes what became of it.
        let nanos = self.announced.load(Ordering::Acquire);
        (nanos != NOTHING).then(|| Timestamp::from_nanos(nanos))
    }

    pub(super) fn abandoned(&self) -> u64 {
        self.abandoned.load(Ordering::Relaxed)
    }

    #[inline]
    pub(super) fn completed(&self) -> u32 {
        // Acquire: the slots up to there are published and listed.
        self.completed.load(Ordering::Acquire)
    }

    #[inline]
    pub(super) fn newest(&self) -> Newest {
        // Acquire: its slot is published.
        Newest(self.newest.load(Ordering::Acquire))
    }

    /// Makes the written slot the newest, queued for all consumers, and claims another one.
    #[inline]
    pub(super) fn publish(&self, pen: &mut Pen) {
        pen.sequence = pen.sequence.wrapping_add(1);
        pen.newest = pen.writing;
        let word = Word::published(pen.sequence, pen.parties.consumers);
        // Release: who holds the slot sees what was written there.
        self.words[pen.newest].store(word.0, Ordering::Release);
        let newest = Newest::new(pen.sequence, pen.newest);
        // Release: who sees it can hold the slot.
        self.newest.store(newest.0, Ordering::Release);
        if pen.parties.consumers != 0 {
            let listed = &self.by_sequence[self.listed(pen.sequence)];
            // Relaxed: read only by who has seen `completed`.
            listed.store(pen.newest as u32, Ordering::Relaxed);
            // Release: who sees it finds the slot and can take it.
            self.completed.store(pen.sequence, Ordering::Release);
            // Release: who does not see the announcement any more sees `completed`.
            self.announced.store(NOTHING, Ordering::Release);
        }
        pen.writing = self.claim(pen);
    }

    /// Holds the newest, `newest` as long as it is that.
    #[inline]
    pub(super) fn hold_newest(&self, mut newest: Newest) -> (Held, Newest) {
        loop {
            if let Some(held) = self.hold(newest) {
                return (held, newest);
            }
            relax();
            newest = self.newest();
        }
    }

    /// `None`: the writer went on, or another party changed the word at the same time.
    #[inline]
    fn hold(&self, newest: Newest) -> Option<Held> {
        let slot = newest.slot();
        let word = Word(self.words[slot].load(Ordering::Relaxed));
        let held =
            word.is(newest.sequence()) && self.exchange_word(slot, word, word.hold()).is_ok();
        held.then_some(Held { slot })
    }

    /// Takes the cycle with this number out of the queue of one consumer; `None`: it is overwritten.
    ///
    /// Each number once, and greater ones later.
    #[inline]
    pub(super) fn take(&self, consumer: usize, sequence: u32) -> Option<Taken> {
        // Relaxed: listed before `completed` was stored. If it lists a later cycle by now, the word
        // says so.
        let slot = self.by_sequence[self.listed(sequence)].load(Ordering::Relaxed) as usize;
        let mut word = Word(self.words[slot].load(Ordering::Relaxed));
        while word.is(sequence) && word.is_queued_for(consumer) {
            match self.exchange_word(slot, word, word.take(consumer)) {
                Ok(()) => return Some(Taken { slot, sequence }),
                Err(changed) => word = changed,
            }
        }
        None
    }

    /// Whether [`take`](Self::take) would find this cycle now.
    pub(super) fn can_take(&self, consumer: usize, sequence: u32) -> bool {
        let slot = self.by_sequence[self.listed(sequence)].load(Ordering::Relaxed) as usize;
        let word = Word(self.words[slot].load(Ordering::Relaxed));
        word.is(sequence) && word.is_queued_for(consumer)
    }

    /// Gives up everything that the consumer took, up to this token; the others of them are gone.
    #[inline]
    pub(super) fn release_up_to(&self, consumer: usize, last: Taken) {
        // Release: what was read happens before the writer claims the slots.
        self.released[consumer].store(last.sequence.wrapping_add(1), Ordering::Release);
    }

    /// Gives a token back.
    #[inline]
    pub(super) fn release(&self, held: Held) {
        // Release: what was read happens before the writer claims the slot.
        self.words[held.slot].fetch_sub(Word::ONE_HELD, Ordering::Release);
    }

    /// How many complete cycles are listed by number.
    pub(super) fn listed_cycles(&self) -> usize {
        self.by_sequence.len()
    }

    #[inline]
    fn listed(&self, sequence: u32) -> usize {
        sequence as usize & (self.by_sequence.len() - 1)
    }

    #[inline]
    fn claim(&self, pen: &Pen) -> usize {
        let mut slot = pen.newest;
        for _ in 1..self.words.len() {
            slot += 1;
            if slot == self.words.len() {
                slot = 0;
            }
            // Relaxed: a guess that the exchange checks.
            let word = Word(self.words[slot].load(Ordering::Relaxed));
            if word.is_held() || word.is_queued() || self.is_taken(word) {
                continue;
            }
            if !pen.parties.readers {
                // Relaxed: no consumer has it queued, so the writer alone changes the word.
                self.words[slot].store(Word::WRITING.0, Ordering::Relaxed);
                return slot;
            }
            if self.exchange_word(slot, word, Word::WRITING).is_ok() {
                return slot;
            }
        }
        self.claim_oldest(pen)
    }

    /// Whether a consumer took the cycle of this word and did not release it. Holds for as long as
    /// the word stays what it is.
    #[inline]
    fn is_taken(&self, word: Word) -> bool {
        self.released
            .iter()
            .enumerate()
            .any(|(consumer, released)| {
                // Acquire: what the consumer read happens before the claim.
                let released = released.load(Ordering::Acquire);
                !word.is_queued_for(consumer) && !is_before(word.sequence(), released)
            })
    }

    #[cold]
    fn claim_oldest(&self, pen: &Pen) -> usize {
        loop {
            let oldest = (0..self.words.len())
                .filter(|slot| *slot != pen.newest)
                .map(|slot| (slot, Word(self.words[slot].load(Ordering::Relaxed))))
                .filter(|(_, word)| !word.is_held() && !self.is_taken(*word))
                .max_by_key(|(_, word)| {
                    (
                        !word.is_queued(),
                        pen.sequence.wrapping_sub(word.sequence()),
                    )
                });
            // None, or changed: somebody took hold since; another look finds what it let go.
            if let Some((slot, word)) = oldest
                && self.exchange_word(slot, word, Word::WRITING).is_ok()
            {
                return slot;
            }
            relax();
        }
    }

    /// Every change of a word but publication and release.
    #[inline]
    fn exchange_word(&self, slot: usize, from: Word, to: Word) -> Result<(), Word> {
        // Acquire: for holders of the publication, for the writer of all that holders read. No
        // Release: neither has written anything yet that others must see.
        self.words[slot]
            .compare_exchange(from.0, to.0, Ordering::Acquire, Ordering::Relaxed)
            .map(drop)
            .map_err(Word)
    }
}

/// In the order of sequence numbers, which start over after the last.
#[inline]
fn is_before(sequence: u32, other: u32) -> bool {
    (sequence.wrapping_sub(other) as i32) < 0
}
