//! Feeds one instance of a robot with its cycles: one at a time, each announced with the time at which its data were taken.
//!
//! What is said goes as queries: the robot's answer comes back by itself, and nobody has to wait for it.

use std::collections::VecDeque;
use std::fmt::{Display, Formatter};
use std::sync::{Arc, Condvar, Mutex, PoisonError};
use std::time::{Duration, SystemTime, UNIX_EPOCH};

use serde::Serialize;
use serde_json::Value;
use zenoh::bytes::Encoding;
use zenoh::handlers::CallbackDrop;
use zenoh::query::{Querier, Reply};
use zenoh::{Session, Wait as _};

use crate::robot::{PATIENCE, answer, lock, of_zenoh};
use crate::said::LONGEST;
use crate::{Error, Said};

/// Refusals that nobody has asked for yet; of more the oldest are forgotten.
const KEPT: usize = 64;

/// Feeds one instance.
#[derive(Debug)]
pub struct Feeder {
    /// Its session lives no longer than whoever holds it.
    _session: Session,
    querier: Querier<'static>,
    answers: Arc<Answers>,
}

/// A cycle that is announced; one that is dropped without an end is abandoned.
#[derive(Debug)]
#[must_use = "a cycle that is dropped is abandoned"]
pub struct Cycle<'feeder> {
    feeder: &'feeder mut Feeder,
    /// In nanoseconds since 1970.
    time: u64,
    is_ended: bool,
}

/// What became of all that was said.
#[derive(Clone, Copy, Debug, Default, Eq, PartialEq)]
pub struct Counts {
    /// The robot took it.
    pub accepted: u64,
    /// The robot or the bridge refused it.
    pub refused: u64,
    /// Nobody answered: robot and bridge were away, or the answer got lost.
    pub unanswered: u64,
    /// Nobody has answered yet.
    pub awaited: u64,
}

/// Something that was said and refused.
#[derive(Clone, Debug, PartialEq)]
pub struct Refusal {
    /// Of the cycle, in nanoseconds since 1970.
    pub time: u64,
    /// In the words of the robot or the bridge.
    pub message: String,
}

/// Shared with Zenoh's threads.
#[derive(Debug, Default)]
struct Answers {
    told: Mutex<Told>,
    changed: Condvar,
}

#[derive(Debug, Default)]
struct Told {
    counts: Counts,
    refusals: VecDeque<Refusal>,
}

impl Feeder {
    pub(crate) fn new(session: Session, key: String) -> Result<Self, Error> {
        let querier = session.declare_querier(key).timeout(PATIENCE).wait();
        Ok(Self {
            _session: session,
            querier: querier.map_err(of_zenoh)?,
            answers: Arc::default(),
        })
    }

    /// Whether a bridge is there whose robot has this instance; what is said else is lost (`unanswered`).
    pub fn is_heard(&self) -> bool {
        let status = self.querier.matching_status().wait();
        status.is_ok_and(|status| status.matching())
    }

    /// Announces a cycle whose data were taken at that time on this machine's clock, which has to be that of the robot (NTP,
    /// PTP). At once is best: who reads in order of time waits from then on.
    ///
    /// # Errors
    /// If the time is none, or the session is closed.
    pub fn announce(&mut self, taken: SystemTime) -> Result<Cycle<'_>, Error> {
        let time = since_1970(taken).ok_or(Error::Time(taken))?;
        self.say(time, &Said::Announce { time })?;
        Ok(Cycle {
            feeder: self,
            time,
            is_ended: false,
        })
    }

    /// What became of all that was said.
    pub fn counts(&self) -> Counts {
        lock(&self.answers.told).counts
    }

    /// What was refused since this was asked last, at most the newest 64.
    pub fn refusals(&mut self) -> Vec<Refusal> {
        lock(&self.answers.told).refusals.drain(..).collect()
    }

    /// Waits until everything that was said has its answer: before this program ends, for example. `false`: it took longer.
    pub fn settle(&self, at_most: Duration) -> bool {
        let told = lock(&self.answers.told);
        let is_awaited = |told: &mut Told| told.counts.awaited > 0;
        let changed = &self.answers.changed;
        let waited = changed.wait_timeout_while(told, at_most, is_awaited);
        let waited = waited.unwrap_or_else(PoisonError::into_inner);
        !waited.1.timed_out()
    }

    /// Waits for a busy network, not for the answer.
    fn say(&self, time: u64, said: &Said) -> Result<(), Error> {
        let payload = serde_json::to_vec(said).expect("it is made of JSON");
        if payload.len() > LONGEST {
            let length = payload.len();
            let message = format!("{length} bytes of JSON, and the bridge reads {LONGEST}");
            return Err(Error::Outputs(message));
        }
        lock(&self.answers.told).counts.awaited += 1;
        let is_answered = Arc::new(Mutex::new(false));
        let (answers, has_answer) = (self.answers.clone(), is_answered.clone());
        let callback = move |reply: Reply| {
            // Two bridges may answer.
            if !std::mem::replace(&mut *lock(&has_answer), true) {
                answers.tell(time, answer(&reply).map(drop));
            }
        };
        let answers = self.answers.clone();
        let drop = move || {
            if !*lock(&is_answered) {
                answers.miss();
            }
        };
        let query = self.querier.get().payload(payload);
        let query = query.encoding(Encoding::APPLICATION_JSON);
        let query = query.with(CallbackDrop { callback, drop });
        query.wait().map_err(of_zenoh)
    }
}

impl Cycle<'_> {
    /// Gives the robot what the cycle wrote: a struct with a field for each main output of the cycler that the robot reads
    /// (others are ignored), in the form of the node's types. The robot compares, and refuses what is of another type.
    ///
    /// # Errors
    /// If the outputs are no struct that can be JSON, are longer than 1 MiB of it, or the session is closed; the cycle is
    /// abandoned then.
    pub fn complete(mut self, outputs: &impl Serialize) -> Result<(), Error> {
        let outputs = serde_json::to_value(outputs);
        let outputs = outputs.map_err(|error| Error::Outputs(error.to_string()))?;
        if !outputs.is_object() {
            let message = "give a struct with a field for each main output that the robot reads";
            return Err(Error::Outputs(message.to_owned()));
        }
        self.end(outputs)
    }

    /// The cycle has no outputs, and nobody has to wait for it any longer.
    pub fn abandon(self) {}

    /// When its data were taken, in nanoseconds since 1970.
    pub fn time(&self) -> u64 {
        self.time
    }

    fn end(&mut self, outputs: Value) -> Result<(), Error> {
        let time = self.time;
        self.feeder.say(time, &Said::Complete { time, outputs })?;
        self.is_ended = true;
        Ok(())
    }
}

impl Drop for Cycle<'_> {
    fn drop(&mut self) {
        if !self.is_ended {
            let time = self.time;
            // What gets lost does no harm: the next cycle ends this one.
            let _ = self.feeder.say(time, &Said::Abandon { time });
        }
    }
}

impl Answers {
    fn tell(&self, time: u64, answer: Result<(), String>) {
        let mut told = lock(&self.told);
        told.counts.awaited -= 1;
        match answer {
            Ok(()) => told.counts.accepted += 1,
            Err(message) => {
                told.counts.refused += 1;
                if told.refusals.len() == KEPT {
                    told.refusals.pop_front();
                }
                told.refusals.push_back(Refusal { time, message });
            }
        }
        self.changed.notify_all();
    }

    fn miss(&self) {
        let mut told = lock(&self.told);
        told.counts.awaited -= 1;
        told.counts.unanswered += 1;
        self.changed.notify_all();
    }
}

impl Display for Refusal {
    fn fmt(&self, formatter: &mut Formatter<'_>) -> std::fmt::Result {
        let Self { time, message } = self;
        write!(formatter, "the cycle of {time} ns since 1970: {message}")
    }
}

fn since_1970(time: SystemTime) -> Option<u64> {
    let since = time.duration_since(UNIX_EPOCH).ok()?;
    u64::try_from(since.as_nanos()).ok()
}
