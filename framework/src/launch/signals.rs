//! Ctrl-C, the system's request to terminate, the end of the terminal: the first asks for an orderly stop, a second Ctrl-C
//! ends the process.

use std::fs;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
use signal_hook::flag;

use super::INTERRUPTED;
use crate::error::Result;

/// What signals have come.
#[derive(Clone, Debug)]
pub(super) struct Signals {
    interrupted: Arc<AtomicBool>,
    terminated: Arc<AtomicBool>,
}

impl Signals {
    /// From now on the signals only set flags.
    pub(super) fn new() -> Result<Self> {
        let signals = Self {
            interrupted: Arc::default(),
            terminated: Arc::default(),
        };
        // In this order: the first Ctrl-C finds its flag unset and sets it.
        flag::register_conditional_shutdown(
            SIGINT,
            INTERRUPTED.into(),
            signals.interrupted.clone(),
        )?;
        flag::register(SIGINT, signals.interrupted.clone())?;
        flag::register(SIGTERM, signals.terminated.clone())?;
        // The terminal or the connection to the robot is gone; the robot still has to stop in order, unless `nohup` or
        // whoever else started it wants it to go on.
        if !is_ignored(SIGHUP) {
            flag::register(SIGHUP, signals.terminated.clone())?;
        }
        Ok(signals)
    }

    /// Whether it was Ctrl-C.
    pub(super) fn interrupted(&self) -> bool {
        self.interrupted.load(Ordering::Relaxed)
    }

    /// Whether the run shall end.
    pub(super) fn any(&self) -> bool {
        self.interrupted() || self.terminated.load(Ordering::Relaxed)
    }
}

/// Whether whoever started the process had the signal ignored; only Linux tells.
fn is_ignored(signal: i32) -> bool {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mut lines = status.lines();
    let ignored = lines.find_map(|line| line.strip_prefix("SigIgn:"));
    let ignored = ignored.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok());
    ignored.is_some_and(|mask| (mask >> (signal - 1)) & 1 == 1)
}
