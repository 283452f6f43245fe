//! What comes behind the robot's threads: where it hangs, nothing ends it from outside, but the process ends all the same.

use std::sync::mpsc::{self, Receiver, RecvTimeoutError, Sender};
use std::thread;
use std::time::{Duration, Instant};

use super::{FAILED, INTERRUPTED};
use crate::error::Error;
use crate::recorded::{Recording, RecordingReport};
use crate::report::{flush, tell};

/// A ring of 2 GiB of which all is in the cache of the system is on a slow stick, of 10 MB/s, within this time.
const DISK: Duration = Duration::from_secs(300);

/// Who has waited so long wants to know for what.
const SOON: Duration = Duration::from_secs(2);

/// As the threads of the robot have.
const HARDWARE: Duration = Duration::from_secs(10);

/// How a run ended that did not fail before.
#[derive(Clone, Copy, Debug)]
pub(super) enum Ended {
    With(u8),
    /// Not all of its recording is known to be on the disk.
    WithoutItsDisk,
}

impl Ended {
    /// What the process exits with. Who interrupts a run asks for its end, not for the loss of its recording.
    pub(super) fn status(self, is_interrupted: bool) -> u8 {
        match self {
            Self::WithoutItsDisk => FAILED,
            Self::With(_) if is_interrupted => INTERRUPTED,
            Self::With(status) => status,
        }
    }
}

/// Ends a recording: of one that its disk does not take in time, what is known then.
pub(super) fn end(recording: Recording) -> RecordingReport {
    let begun = Instant::now();
    let mut is_told = false;
    recording.end_while(|| {
        let waited = begun.elapsed();
        if waited > SOON && !is_told {
            is_told = true;
            tell(format_args!(
                "the recording waits for its disk, {DISK:?} at most"
            ));
        }
        waited < DISK
    })
}

/// Ends the process if the hardware and nodes do not end, until it is dropped.
pub(super) struct Ending(Sender<Step>);

#[derive(Debug, PartialEq)]
struct Step {
    patience: Duration,
    /// Why the run failed, which nobody tells otherwise.
    failure: Option<String>,
}

impl Ending {
    /// Nothing ends yet. Without a thread nobody looks: then it is waited for.
    pub(super) fn new() -> Self {
        Self::giving_up(exit)
    }

    fn giving_up(give_up: impl FnOnce() + Send + 'static) -> Self {
        let (sender, steps) = mpsc::channel();
        let spawned = thread::Builder::new()
            .name("ending".to_owned())
            .spawn(move || look(&steps, give_up));
        if let Err(error) = spawned {
            tell(format_args!(
                "nobody looks after the end of the run: {error}"
            ));
        }
        Self(sender)
    }

    /// From now on the hardware and nodes are dropped, of a run that failed with this.
    pub(super) fn of_hardware(&self, failure: Option<&Error>) {
        self.begin(HARDWARE, failure.map(Error::to_string));
    }

    fn begin(&self, patience: Duration, failure: Option<String>) {
        // Without a thread nobody hears it.
        let _ = self.0.send(Step { patience, failure });
    }
}

/// Ends the process in place of whatever does not end.
pub(super) fn exit() {
    flush();
    std::process::exit(FAILED.into());
}

fn look(steps: &Receiver<Step>, give_up: impl FnOnce()) {
    let Ok(Step { patience, failure }) = steps.recv() else {
        return;
    };
    if steps.recv_timeout(patience) == Err(RecvTimeoutError::Timeout) {
        if let Some(failure) = failure {
            tell(format_args!("error: {failure}"));
        }
        tell(format_args!(
            "the run did not end within {patience:?} because of the hardware or a node: its `Drop` does not return"
        ));
        give_up();
    }
}

#[cfg(test)]
mod tests {
    use super::super::DONE;
    use super::*;

    #[test]
    fn a_disk_that_hangs_is_a_failure_whoever_ended_the_run() {
        for is_interrupted in [false, true] {
            assert_eq!(Ended::WithoutItsDisk.status(is_interrupted), FAILED);
        }
        // A scenario that somebody interrupts has shown nothing.
        for status in [DONE, FAILED] {
            assert_eq!(Ended::With(status).status(false), status);
            assert_eq!(Ended::With(status).status(true), INTERRUPTED);
        }
    }

    #[test]
    fn an_end_that_takes_too_long_is_given_up_and_no_other() {
        let (sender, given_up) = mpsc::channel();
        let ending = Ending::giving_up(move || {
            let _ = sender.send(());
        });
        let soon = Duration::from_millis(20);
        // Before it begins there is no hurry.
        let wait = given_up.recv_timeout(5 * soon);
        assert_eq!(wait, Err(RecvTimeoutError::Timeout));
        ending.begin(soon, None);
        assert_eq!(given_up.recv(), Ok(()));
        // One that ends in time says nothing.
        let (sender, given_up) = mpsc::channel();
        let ending = Ending::giving_up(move || {
            let _ = sender.send(());
        });
        ending.begin(Duration::from_secs(1000), None);
        drop(ending);
        assert!(given_up.recv().is_err());
    }
}
