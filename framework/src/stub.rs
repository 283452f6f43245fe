//! What stands in for an instance that is left out of a partial robot: whoever uses the robot feeds it.
//!
//! For those who read it a stub is what the instance would be: absent or default before its first cycle, then latest by
//! its newest cycle and in order of time by all of them, an announced one waited for.
//!
//! Invariant: timestamps of one stub only grow and are never later than the robot's clock.

use crate::buffer::Writer;
use crate::clock::Clock;
use crate::error::{Error, Result};
use crate::time::Timestamp;

/// The writing end of an instance that does not run here; `T` is what others read of it.
pub struct Stub<T> {
    instance: &'static str,
    writer: Writer<T>,
    clock: Clock,
    /// Of the newest cycle, complete or not; counts from 1.
    cycle: u64,
    /// Of the newest cycle, complete or not.
    newest: Option<Timestamp>,
    is_announced: bool,
}

impl<T> Stub<T> {
    /// For the instance of this name; `clock` is the robot's.
    pub fn new(instance: &'static str, writer: Writer<T>, clock: Clock) -> Self {
        Self {
            instance,
            writer,
            clock,
            cycle: 0,
            newest: None,
            is_announced: false,
        }
    }

    /// The instance that it stands in for.
    pub fn instance(&self) -> &'static str {
        self.instance
    }

    /// Timestamp of the newest cycle, complete or not.
    pub(crate) fn newest(&self) -> Option<Timestamp> {
        self.newest
    }

    /// Timestamp of the cycle that is announced.
    pub(crate) fn announced(&self) -> Option<Timestamp> {
        self.newest.filter(|_| self.is_announced)
    }

    /// A whole cycle whose data was taken at `timestamp`: others see it from their next `begin` on.
    ///
    /// # Errors
    /// As [`Self::announce`].
    pub fn feed(&mut self, timestamp: Timestamp, outputs: T) -> Result<()> {
        self.announce(timestamp)?;
        self.complete(outputs)
    }

    /// A cycle has begun with data taken at `timestamp`: who reads in order of time waits for its outputs.
    ///
    /// # Errors
    /// If the time has not come, if it is not after the cycle before, or if that is neither complete nor abandoned; then
    /// nothing has changed.
    pub fn announce(&mut self, timestamp: Timestamp) -> Result<()> {
        let (instance, now) = (self.instance, self.clock.now());
        if self.is_announced {
            return Err(Error::new(format!(
                "`{instance}` has announced a cycle: complete or abandon it before the one at {timestamp}"
            )));
        }
        if timestamp > now {
            return Err(Error::new(format!(
                "`{instance}` cannot have data of {timestamp}: it is {now}; let the robot run until then first"
            )));
        }
        if let Some(newest) = self.newest
            && timestamp <= newest
        {
            return Err(Error::new(format!(
                "`{instance}` cannot have data of {timestamp} after that of {newest}: feed it in order of time"
            )));
        }
        self.cycle += 1;
        self.newest = Some(timestamp);
        self.is_announced = true;
        self.writer.announce(timestamp);
        Ok(())
    }

    /// Ends the cycle that was announced with what it wrote.
    ///
    /// # Errors
    /// If none is announced.
    pub fn complete(&mut self, outputs: T) -> Result<()> {
        let timestamp = self.announced().ok_or_else(|| {
            let instance = self.instance;
            Error::new(format!("`{instance}` has announced no cycle to complete"))
        })?;
        *self.writer.slots().0 = outputs;
        self.writer.complete(self.cycle, timestamp);
        self.is_announced = false;
        Ok(())
    }

    /// Ends the cycle that was announced as if it had never been; harmless without one.
    pub fn abandon(&mut self) {
        self.writer.abandon();
        self.is_announced = false;
    }
}

#[cfg(test)]
mod tests;
