//! A cycle that was recorded, about to run again.

use hulkgen_recording::Writing;

use super::{Cycler, Phase};
use crate::cycler::{Cycle, Instance, Slots};
use crate::error::{Error, Result};
use crate::guarded::only;
use crate::recorded::{Head, Loaded, Loading, Recorded, SaveError, Saving, Stored};
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
        self.body.load(slots, outside, from, stored)?;
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

    /// What a next cycle would find, as the content of a frame behind its head that needs no frame before it.
    ///
    /// # Errors
    /// If a value cannot be serialised.
    pub(crate) fn left_behind(&mut self) -> Result<Vec<u8>, SaveError> {
        let mut bytes = Vec::new();
        let mut writing = Writing::growing(&mut bytes);
        let (current, previous) = self.writer.slots();
        let slots = Slots { current, previous };
        self.body
            .save(slots, None, &mut Saving::new(&mut writing))?;
        Ok(bytes)
    }

    /// Why the cycle that ran will not be published.
    pub(crate) fn failure(&self) -> Option<&Error> {
        self.failure.as_ref()
    }
}
