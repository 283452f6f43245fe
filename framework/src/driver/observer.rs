//! Who sees every cycle from inside the driver: recordings, and whatever sends values to clients.
//!
//! Invariant: an observer is called on the thread of its instance, between two calls of the instance.

use crate::cycler::{Finished, Instance};
use crate::error::Result;
use crate::guarded::contain;

/// Sees the cycles of one instance. Its panic stops the robot in order, with an error.
pub trait Observer: Send {
    /// A cycle has begun: all that it may read was taken, and only setup nodes have run.
    fn begun(&mut self, _instance: &mut dyn Instance) {}

    /// The cycle that began was published; of one that is abandoned nothing more is heard.
    fn finished(&mut self, _instance: &dyn Instance) {}
}

/// The observer of one instance, if there is one.
#[derive(Default)]
pub(super) struct Observed<'run>(Option<Box<dyn Observer + 'run>>);

impl<'run> Observed<'run> {
    pub(super) fn by(observer: Option<Box<dyn Observer + 'run>>) -> Self {
        Self(observer)
    }

    #[inline]
    pub(super) fn begun(&mut self, instance: &mut dyn Instance) -> Result<()> {
        match &mut self.0 {
            Some(observer) => contain("Observer::begun", || {
                observer.begun(instance);
                Ok(())
            }),
            None => Ok(()),
        }
    }

    #[inline]
    pub(super) fn finished(&mut self, instance: &dyn Instance, finished: Finished) -> Result<()> {
        match (&mut self.0, finished) {
            (Some(observer), Finished::Completed | Finished::Recovered) => {
                contain("Observer::finished", || {
                    observer.finished(instance);
                    Ok(())
                })
            }
            _ => Ok(()),
        }
    }
}
