//! What the failure of a cycle leads to.

use super::Cycler;
use crate::cycler::Body;
use crate::error::{Error, Result};
use crate::guarded::{OnFailure, contain};
use crate::report::tell;
use crate::time::Timestamp;

/// What a failure leads to, if the robot need not stop.
pub(super) enum Consequence {
    Stopped,
    StartOver,
    Restart { at: Timestamp },
}

impl<B: Body> Cycler<B> {
    /// Applies the policy of the node that failed, or else the cycler's.
    #[cold]
    pub(super) fn judge(&mut self, error: Error, unless_of_node: OnFailure) -> Result<Consequence> {
        if error.is_stopped() {
            return Ok(Consequence::Stopped);
        }
        if error.on_failure().is_none() {
            // Nodes count their own failures.
            self.counters.failures.add(1);
        }
        match error.on_failure().unwrap_or(unless_of_node) {
            OnFailure::Stop => Err(error),
            OnFailure::Skip | OnFailure::Hold => {
                // Setup starts over soon: what fails every time must not flood the terminal.
                let failures = self.counters.failures.get();
                if failures.is_power_of_two() {
                    let name = self.description.name;
                    tell(format_args!(
                        "{name}: {error} (failure {failures} of this instance)"
                    ));
                }
                Ok(Consequence::StartOver)
            }
            OnFailure::Restart => match self.restarts.after_failure(self.clock.now()) {
                Some(at) => {
                    tell(format_args!("{} restarts: {error}", self.description.name));
                    Ok(Consequence::Restart { at })
                }
                None => Err(error.context("failed too often within a minute")),
            },
        }
    }

    /// Ends a cycle that is not published.
    #[cold]
    pub(super) fn give_up(&mut self) {
        self.writer.abandon();
        self.counters.abandoned.add(1);
        self.counters.end();
        self.stopwatch.discard(self.cycle.number);
        let body = &mut self.body;
        let abandoned = contain(self.description.name, || {
            body.abandon();
            Ok(())
        });
        if let Err(error) = abandoned {
            let name = self.description.name;
            tell(format_args!("{name} while abandoning a cycle: {error}"));
        }
    }
}
