//! The wish that the nodes get the actuators back after a safe state that lasts.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Asks for the actuators after a stop of the watchdog; clones are the same wish.
///
/// For clients: `framework.procedures.rearm`. The hardware's own button is [`crate::Hardware::is_rearm_wanted`].
#[derive(Clone, Debug, Default)]
pub struct Rearm {
    requested: Arc<AtomicBool>,
}

impl Rearm {
    /// The driver grants it soon. Where the nodes have the actuators, nothing changes.
    pub fn request(&self) {
        self.requested.store(true, Ordering::Release);
    }

    /// Whether somebody asked since the last time.
    pub(crate) fn take(&self) -> bool {
        self.requested.swap(false, Ordering::AcqRel)
    }
}
