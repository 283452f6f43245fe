//! Robots that live side by side, on one thread or on several, in rounds.
//!
//! Invariant: in a round no robot sees what another one does in it, so that the number of threads changes nothing.

use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Barrier, Mutex, MutexGuard, PoisonError};

use crate::time::Timestamp;

/// Something that lives from one time to a later one.
pub(super) trait Lives: Send {
    /// Does all that comes until `until`, included.
    fn live(&mut self, until: Timestamp);
}

/// All of them, between two rounds.
pub(super) struct Ensemble<'run, A> {
    actors: &'run [Mutex<A>],
    rounds: &'run Rounds,
    threads: usize,
}

/// Where the threads meet.
struct Rounds {
    begin: Barrier,
    end: Barrier,
    /// Nanoseconds; [`OVER`] where no round comes any more.
    until: AtomicU64,
}

/// No time is that late.
const OVER: u64 = u64::MAX;

/// Lets `lead` lead the rounds of these actors on so many threads, of which this is one.
pub(super) fn together<A: Lives, R>(
    actors: &[Mutex<A>],
    threads: usize,
    lead: impl FnOnce(&Ensemble<'_, A>) -> R,
) -> R {
    let threads = threads.clamp(1, actors.len().max(1));
    let rounds = Rounds {
        begin: Barrier::new(threads),
        end: Barrier::new(threads),
        until: AtomicU64::new(0),
    };
    std::thread::scope(|scope| {
        for thread in 1..threads {
            let rounds = &rounds;
            scope.spawn(move || {
                while let Some(until) = rounds.next() {
                    live(actors, thread, threads, until);
                    rounds.end.wait();
                }
            });
        }
        // However `lead` ends, the others must not wait for a round that never comes.
        let _over = Over(&rounds);
        lead(&Ensemble {
            actors,
            rounds: &rounds,
            threads,
        })
    })
}

impl<A: Lives> Ensemble<'_, A> {
    /// One round.
    pub(super) fn live(&self, until: Timestamp) {
        // The barrier orders it; no time is `OVER`.
        let until_nanos = until.as_nanos().min(OVER - 1);
        self.rounds.until.store(until_nanos, Ordering::Relaxed);
        self.rounds.begin.wait();
        live(self.actors, 0, self.threads, until);
        self.rounds.end.wait();
    }

    /// One of them between two rounds.
    pub(super) fn actor(&self, index: usize) -> MutexGuard<'_, A> {
        lock(&self.actors[index])
    }

    /// Each of them between two rounds.
    pub(super) fn all(&self) -> impl Iterator<Item = MutexGuard<'_, A>> {
        self.actors.iter().map(lock)
    }
}

impl Rounds {
    fn next(&self) -> Option<Timestamp> {
        self.begin.wait();
        let until = self.until.load(Ordering::Relaxed);
        (until != OVER).then(|| Timestamp::from_nanos(until))
    }
}

struct Over<'run>(&'run Rounds);

impl Drop for Over<'_> {
    fn drop(&mut self) {
        self.0.until.store(OVER, Ordering::Relaxed);
        self.0.begin.wait();
    }
}

/// The share of one thread.
fn live<A: Lives>(actors: &[Mutex<A>], thread: usize, threads: usize, until: Timestamp) {
    for actor in actors.iter().skip(thread).step_by(threads) {
        lock(actor).live(until);
    }
}

/// What panics is contained by the actor itself.
fn lock<A>(actor: &Mutex<A>) -> MutexGuard<'_, A> {
    actor.lock().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;
    use std::time::Duration;

    use super::*;

    /// Adds what the others were at the end of the round before.
    struct Adder {
        own: u64,
        seen: Arc<Vec<AtomicU64>>,
    }

    impl Lives for Adder {
        fn live(&mut self, until: Timestamp) {
            let seen = self.seen.iter().map(|seen| seen.load(Ordering::Relaxed));
            let sum = seen.fold(0, u64::wrapping_add);
            self.own = self
                .own
                .wrapping_mul(31)
                .wrapping_add(sum ^ until.as_nanos());
        }
    }

    fn result(threads: usize) -> Vec<u64> {
        let seen: Arc<Vec<AtomicU64>> = Arc::new((1..=5).map(AtomicU64::new).collect());
        let adder = |own| {
            Mutex::new(Adder {
                own,
                seen: Arc::clone(&seen),
            })
        };
        let actors: Vec<_> = (1..=5).map(adder).collect();
        together(&actors, threads, |ensemble| {
            for round in 1..200 {
                ensemble.live(Timestamp::ZERO + Duration::from_millis(round));
                for (actor, seen) in ensemble.all().zip(seen.iter()) {
                    seen.store(actor.own, Ordering::Relaxed);
                }
            }
            ensemble.all().map(|actor| actor.own).collect()
        })
    }

    #[test]
    fn any_number_of_threads_gives_the_same() {
        let one = result(1);
        for threads in [2, 3, 5, 9] {
            assert_eq!(result(threads), one, "{threads} threads");
        }
    }

    #[test]
    fn whoever_leads_may_end_without_any_round() {
        let actors = [Mutex::new(Adder {
            own: 1,
            seen: Arc::default(),
        })];
        assert_eq!(together(&actors, 4, |ensemble| ensemble.all().count()), 1);
    }
}
