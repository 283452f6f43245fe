//! What comes behind the robot's threads: where it hangs, nothing ends it from outside, but the process ends all the same.

use std::sync::mpsc::{self, Receiver, RecvTimeoutError, Sender};
use std::thread;
use std::time::Duration;

use super::FAILED;
use crate::error::Error;
use crate::report::tell;

/// A ring of 2 GiB of which all is in the cache of the system is on a slow stick, of 10 MB/s, within this time.
const DISK: Duration = Duration::from_secs(300);

/// As the threads of the robot have.
const HARDWARE: Duration = Duration::from_secs(10);

/// Ends the process if a step of the end takes too long, until it is dropped.
pub(super) struct Ending(Sender<Step>);

#[derive(Debug)]
struct Step {
    /// What does not end.
    what: &'static str,
    patience: Duration,
    /// Why the run failed, which nobody tells otherwise.
    failure: Option<String>,
}

impl Ending {
    /// Nothing ends yet. Without a thread nobody looks: then it is waited for.
    pub(super) fn new() -> Self {
        Self::giving_up(|| std::process::exit(FAILED.into()))
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

    /// From now on the recording is ended.
    pub(super) fn of_recording(&self) {
        self.begin(
            "the recording: its disk has not taken all of it, since it is too slow or hangs",
            DISK,
        );
    }

    /// From now on the hardware and nodes are dropped, of a run that failed with this.
    pub(super) fn of_hardware(&self, failure: Option<&Error>) {
        // Without a thread nobody hears it.
        let _ = self.0.send(Step {
            what: "the hardware or a node: its `Drop` does not return",
            patience: HARDWARE,
            failure: failure.map(Error::to_string),
        });
    }

    /// From now on something else is done, which takes as long as it takes.
    pub(super) fn of_nothing(&self) {
        self.begin("", Duration::MAX);
    }

    fn begin(&self, what: &'static str, patience: Duration) {
        // Without a thread nobody hears it.
        let _ = self.0.send(Step {
            what,
            patience,
            failure: None,
        });
    }
}

fn look(steps: &Receiver<Step>, give_up: impl FnOnce()) {
    let mut next = steps.recv();
    while let Ok(step) = next {
        let Step {
            what,
            patience,
            failure,
        } = step;
        next = match steps.recv_timeout(patience) {
            Ok(step) => Ok(step),
            Err(RecvTimeoutError::Disconnected) => return,
            Err(RecvTimeoutError::Timeout) => {
                if let Some(failure) = failure {
                    tell(format_args!("error: {failure}"));
                }
                tell(format_args!(
                    "the run did not end within {patience:?} because of {what}"
                ));
                return give_up();
            }
        };
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_step_that_takes_too_long_is_given_up_and_no_other() {
        let (sender, given_up) = mpsc::channel();
        let ending = Ending::giving_up(move || {
            let _ = sender.send(());
        });
        let soon = Duration::from_millis(20);
        ending.begin("the first", Duration::from_secs(1000));
        ending.of_nothing();
        let wait = given_up.recv_timeout(10 * soon);
        assert_eq!(wait, Err(RecvTimeoutError::Timeout));
        ending.begin("the last", soon);
        assert_eq!(given_up.recv(), Ok(()));
        // One that ends in time says nothing.
        let (sender, given_up) = mpsc::channel();
        let ending = Ending::giving_up(move || {
            let _ = sender.send(());
        });
        ending.begin("it", Duration::from_secs(1000));
        drop(ending);
        assert!(given_up.recv().is_err());
    }
}
