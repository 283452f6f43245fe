//! What stands in for an instance that runs on another machine: whoever speaks for that machine feeds it.
//!
//! Cycles are named by their capture time, so that nothing has to be agreed on before one is announced and nothing has to
//! be asked again when a message got lost: a completion that nobody announced counts as both, and the next cycle ends one
//! that was never completed.
//!
//! A capture time that has not come, or is not after the cycle before, is refused and counted instead of replaced: a
//! filter could not tell a replaced one from a true one, while whoever feeds is told, and can set its clock right.
//!
//! Invariant: what comes is checked whole before anything changes, and no cycle of the robot waits for it.

use std::time::Duration;

use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::Value;

use crate::buffer::Writer;
use crate::clock::Clock;
use crate::error::{Error, Result};
use crate::reflect::{Reflect, Shape};
use crate::stub::Stub;
use crate::time::Timestamp;

/// The writing end of an instance that runs on another machine, whatever it writes.
pub trait Feed: Send {
    /// The instance.
    fn instance(&self) -> &'static str;

    /// What a cycle writes: an object of the main outputs that are read here.
    fn shape(&self) -> Shape;

    /// For how long the robot waits for a cycle that was announced.
    fn pending_timeout(&self) -> Duration;

    /// A cycle has begun with data taken at `timestamp`: who reads in order of time waits for its outputs. One that was
    /// announced before is abandoned.
    ///
    /// # Errors
    /// If the time has not come, or is not after that of the cycle before; then nothing has changed.
    fn announce(&mut self, timestamp: Timestamp) -> Result<()>;

    /// Ends the cycle of this time with what it wrote; one that was not announced begins and ends at once.
    ///
    /// # Errors
    /// If an output is missing or has another type, or if the cycle can neither end nor begin; then nothing has changed.
    fn complete(&mut self, timestamp: Timestamp, outputs: &Value) -> Result<()>;

    /// Ends the cycle of this time as if it had never been.
    ///
    /// # Errors
    /// If it is not the one that is announced.
    fn abandon(&mut self, timestamp: Timestamp) -> Result<()>;

    /// Who fed it has gone: abandons what is announced.
    fn let_go(&mut self);

    /// Counters since the start.
    fn counts(&self) -> FeedCounts;
}

/// What became of the cycles of an instance that runs on another machine.
///
/// Every cycle that began was completed, was abandoned, or is the one that is announced.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct FeedCounts {
    /// Complete.
    pub completed: u64,
    /// Of those: never announced, so that nobody waited for them.
    pub unannounced: u64,
    /// Announced and not completed: withdrawn, ended by the next, or left by who fed them.
    pub abandoned: u64,
    /// Messages that were refused.
    pub refused: u64,
}

/// The writing end of an instance that runs on another machine; `T` is what is read of it here.
pub struct Remote<T> {
    stub: Stub<T>,
    clock: Clock,
    pending_timeout: Duration,
    counts: FeedCounts,
}

impl<T> Remote<T> {
    /// For the instance of this name; `clock` is the robot's.
    pub fn new(
        instance: &'static str,
        writer: Writer<T>,
        pending_timeout: Duration,
        clock: Clock,
    ) -> Self {
        Self {
            stub: Stub::new(instance, writer, clock.clone()),
            clock,
            pending_timeout,
            counts: FeedCounts::default(),
        }
    }

    /// Whether a cycle may begin with data of this time.
    fn check(&self, timestamp: Timestamp) -> Result<()> {
        let (instance, now) = (self.stub.instance(), self.clock.now());
        if timestamp > now {
            return Err(Error::new(format!(
                "`{instance}` cannot have data of {timestamp}: it is {now} here; is the clock of the other machine ahead?"
            )));
        }
        match self.stub.newest() {
            Some(newest) if timestamp <= newest => Err(Error::new(format!(
                "`{instance}` cannot have data of {timestamp} after that of {newest}: feed it in order of time, each cycle once"
            ))),
            _ => Ok(()),
        }
    }

    fn is_announced(&self, timestamp: Timestamp) -> bool {
        self.stub.announced() == Some(timestamp)
    }

    /// Begins a cycle whose time was checked.
    fn begin(&mut self, timestamp: Timestamp) -> Result<()> {
        self.let_go_of_announced();
        self.stub.announce(timestamp)
    }

    fn let_go_of_announced(&mut self) {
        if self.stub.announced().is_some() {
            self.stub.abandon();
            self.counts.abandoned += 1;
        }
    }

    fn counted<V>(&mut self, result: Result<V>) -> Result<V> {
        self.counts.refused += u64::from(result.is_err());
        result
    }
}

impl<T: Default + DeserializeOwned + Serialize> Remote<T> {
    fn end(&mut self, timestamp: Timestamp, outputs: &Value) -> Result<()> {
        let is_announced = self.is_announced(timestamp);
        if !is_announced {
            self.check(timestamp)?;
        }
        let outputs = read::<T>(outputs).map_err(|message| {
            let instance = self.stub.instance();
            Error::new(format!("outputs of `{instance}`: {message}"))
        })?;
        if !is_announced {
            self.begin(timestamp)?;
            self.counts.unannounced += 1;
        }
        self.stub.complete(outputs)?;
        self.counts.completed += 1;
        Ok(())
    }
}

impl<T> Feed for Remote<T>
where
    T: Default + DeserializeOwned + Serialize + Reflect + Send + Sync,
{
    fn instance(&self) -> &'static str {
        self.stub.instance()
    }

    fn shape(&self) -> Shape {
        T::shape()
    }

    fn pending_timeout(&self) -> Duration {
        self.pending_timeout
    }

    fn announce(&mut self, timestamp: Timestamp) -> Result<()> {
        let begun = self.check(timestamp).and_then(|()| self.begin(timestamp));
        self.counted(begun)
    }

    fn complete(&mut self, timestamp: Timestamp, outputs: &Value) -> Result<()> {
        let ended = self.end(timestamp, outputs);
        self.counted(ended)
    }

    fn abandon(&mut self, timestamp: Timestamp) -> Result<()> {
        let announced = if self.is_announced(timestamp) {
            Ok(())
        } else {
            let instance = self.stub.instance();
            Err(Error::new(format!(
                "`{instance}` has announced no cycle of {timestamp} to abandon"
            )))
        };
        self.counted(announced)?;
        self.let_go_of_announced();
        Ok(())
    }

    fn let_go(&mut self) {
        self.let_go_of_announced();
    }

    fn counts(&self) -> FeedCounts {
        self.counts
    }
}

/// The outputs of one cycle, or what is wrong with them and in which.
fn read<T: Default + DeserializeOwned + Serialize>(outputs: &Value) -> Result<T, String> {
    let Value::Object(given) = outputs else {
        return Err("expected an object of main outputs by their names".to_owned());
    };
    T::deserialize(outputs).map_err(|error| {
        // serde does not say where: it is the output that cannot be put among those of a default.
        let default = serde_json::to_value(T::default()).unwrap_or_default();
        let is_wrong = |(name, value): &(&String, &Value)| {
            if default.get(name.as_str()).is_none() {
                return false;
            }
            let mut one = default.clone();
            let Some(place) = one.get_mut(name.as_str()) else {
                return false;
            };
            *place = (*value).clone();
            T::deserialize(&one).is_err()
        };
        match given.iter().find(is_wrong) {
            Some((name, _)) => format!("`{name}`: {error}"),
            None => error.to_string(),
        }
    })
}

#[cfg(test)]
mod tests;
