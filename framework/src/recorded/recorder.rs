//! The cycles of one instance on their way into a recording.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use hulkgen_recording::{ChannelId, Recorded, Track};

use super::condition::Condition;
use super::output::OutputRecorder;
use super::target::Target;
use super::{Capture, DIGEST, Digests, FINISHED, SaveError, Written};
use crate::cycler::{Instance, Record};
use crate::driver::Observer;
use crate::report::tell;
use crate::time::Timestamp;

/// Bytes of a message without its digests.
const END: usize = 64;

/// Puts the cycles of one instance into a recording. It never waits and allocates nothing in the steady state.
pub(super) struct CycleRecorder {
    pub(super) track: Track,
    pub(super) own: ChannelId,
    pub(super) channels: Arc<[(&'static str, ChannelId)]>,
    pub(super) wanted: Wanted,
    /// Bytes that a frame leaves free for its end.
    keep: usize,
    written: Written,
    /// When the last recorded cycle started.
    since: Option<Timestamp>,
    /// The cycle whose frame awaits its end.
    open: Option<u64>,
}

/// Which cycles are wanted now.
pub(super) enum Wanted {
    /// The first, and every so many cycles one.
    Every {
        cycles: u64,
        seen: u64,
    },
    While(Arc<AtomicBool>),
}

impl Wanted {
    /// `None`: none at all.
    pub(super) fn new(record: Record, condition: &Arc<AtomicBool>) -> Option<Self> {
        let every = |cycles| Some(Self::Every { cycles, seen: 0 });
        match record {
            Record::On => every(1),
            Record::Off => None,
            Record::Every(cycles) => every(u64::from(cycles.max(1))),
            Record::While { .. } => Some(Self::While(condition.clone())),
        }
    }

    fn next(&mut self) -> bool {
        match self {
            Self::Every { cycles, seen } => {
                *seen += 1;
                (*seen - 1).is_multiple_of(*cycles)
            }
            // Relaxed: a flag, with which no other memory comes.
            Self::While(holds) => holds.load(Ordering::Relaxed),
        }
    }
}

impl CycleRecorder {
    /// Of an instance whose frames end with so many digests.
    pub(super) fn new(
        track: Track,
        own: ChannelId,
        channels: Arc<[(&'static str, ChannelId)]>,
        wanted: Wanted,
        digests: usize,
    ) -> Self {
        Self {
            keep: END + DIGEST * digests,
            track,
            own,
            channels,
            wanted,
            written: Written::default(),
            since: None,
            open: None,
        }
    }

    fn tell(&self, instance: &dyn Instance, error: &str) {
        let failed = self.track.counts().failed();
        if failed.is_power_of_two() {
            let (name, cycle) = (instance.description().name, instance.cycle().number);
            tell(format_args!(
                "{name}: cycle {cycle} is not recorded: {error} (failure {failed} of this kind)"
            ));
        }
    }
}

impl CycleRecorder {
    fn begun(&mut self, instance: &mut dyn Instance) {
        self.open = None;
        let cycle = instance.cycle();
        if !self.wanted.next() {
            return self.track.pass(cycle.time.start.as_nanos());
        }
        self.track.want();
        let Self {
            track,
            own,
            channels,
            written,
            since,
            keep,
            ..
        } = self;
        let recorded = track.frame(cycle.time.start.as_nanos(), *keep, |frame| {
            instance.save(&mut Capture {
                target: Target::Frame {
                    frame,
                    own: *own,
                    channels,
                },
                written: &mut *written,
                since: *since,
            })
        });
        match recorded {
            Recorded::Whole => {
                self.written.keep();
                self.since = Some(cycle.time.start);
                self.open = Some(cycle.number);
            }
            Recorded::Dropped => {}
            Recorded::Failed(error) => self.tell(instance, &error.to_string()),
        }
    }

    fn finished(&mut self, instance: &dyn Instance) {
        let cycle = instance.cycle();
        if self.open.take() == Some(cycle.number) {
            let time = cycle.time.start.as_nanos();
            let own = self.own;
            let ended = self.track.end(time, |frame| {
                frame.message(own, cycle.number as u32, time, |writing| {
                    writing.add([FINISHED]);
                    let mut digests = Digests::new(writing);
                    instance.save_digests(&mut digests);
                    match digests.end() {
                        _ if writing.is_full() => Err(SaveError::Full),
                        Err(error) => Err(SaveError::value(error.to_string())),
                        Ok(()) => Ok(()),
                    }
                })
            });
            if let Recorded::Failed(error) = ended {
                self.tell(instance, &error.to_string());
            }
        }
    }
}

/// All that a recording wants of one instance.
pub(super) struct CycleObserver {
    pub(super) frames: Option<CycleRecorder>,
    pub(super) outputs: Option<OutputRecorder>,
    /// What the conditions of instances, this one among them, ask of its outputs.
    pub(super) conditions: Vec<Condition>,
}

impl CycleObserver {
    /// Whether there is nothing to do.
    pub(super) fn is_idle(&self) -> bool {
        self.frames.is_none() && self.outputs.is_none() && self.conditions.is_empty()
    }
}

impl Observer for CycleObserver {
    fn begun(&mut self, instance: &mut dyn Instance) {
        if let Some(frames) = &mut self.frames {
            frames.begun(instance);
        }
    }

    fn finished(&mut self, instance: &dyn Instance) {
        if let Some(frames) = &mut self.frames {
            frames.finished(instance);
        }
        if let Some(outputs) = &mut self.outputs {
            outputs.finished(instance);
        }
        for condition in &mut self.conditions {
            condition.look(instance);
        }
    }
}
