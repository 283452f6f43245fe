//! A cycle that was recorded, about to run again.

use super::{Cycler, Phase};
use crate::cycler::restarts::Restarts;
use crate::cycler::{Cycle, Instance};
use crate::error::{Error, Result};
use crate::guarded::only;
use crate::recorded::{Head, Loaded, Loading, Recorded, Stored};
use crate::time::CycleTime;

impl<B: Recorded> Cycler<B> {
    /// Makes the cycle that a frame is of the one that has just begun.
    ///
    /// # Errors
    /// If the bytes are none of such a frame, or a value is not found.
    pub(crate) fn load(
        &mut self,
        outside: &mut B::Outside,
        head: Head,
        from: &mut Loading<'_>,
        stored: &Stored<'_>,
    ) -> Result<()> {
        self.abandon();
        let mut current = B::Shared::default();
        let mut previous = B::Shared::default();
        let slots = Loaded {
            current: &mut current,
            previous: &mut previous,
        };
        self.body.load(head.number, slots, outside, from, stored)?;
        *self.writer.slots().0 = previous;
        self.writer.complete(self.finished, self.cycle.time.start);
        *self.writer.slots().0 = current;
        self.cycle = Cycle {
            number: head.number,
            time: CycleTime {
                start: head.start,
                since_last: head.since_last,
            },
            timed: false,
            in_setup: false,
            partial: false,
        };
        self.phase = Phase::Begun {
            restarted: head.restarted,
        };
        self.failure = None;
        // Failures of other replayed cycles are none of this one's past.
        self.restarts = Restarts::default();
        Ok(())
    }

    /// Runs the nodes of the cycle, as far as they are among these; what they wrote is published by `finish`.
    pub(crate) fn run_only(&mut self, nodes: Option<&[String]>) {
        let Some(nodes) = nodes else {
            return self.run();
        };
        (self.cycle.timed, self.cycle.partial) = (true, true);
        only(nodes, || self.run());
        (self.cycle.timed, self.cycle.partial) = (false, false);
        if self.failure.as_ref().is_some_and(Error::is_stopped) {
            self.failure = None;
        }
    }

    /// Why the cycle that ran will not be published.
    pub(crate) fn failure(&self) -> Option<&Error> {
        self.failure.as_ref()
    }
}
