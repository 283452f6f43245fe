//! What the manifest says about one instance.

use std::time::Duration;

use crate::guarded::OnFailure;
use crate::scheduling::Scheduling;

/// One instance as the manifest describes it; a struct literal in the generated crate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct InstanceDescription {
    /// `VisionTop`.
    pub name: &'static str,
    /// `Vision`.
    pub cycler: &'static str,
    /// Whether its cycles are announced and consumed in order, or consume.
    pub kind: Kind,
    /// For failures outside any node; nodes carry their own.
    pub on_failure: OnFailure,
    /// A longer cycle is an overrun.
    pub deadline: Option<Duration>,
    /// Perception: how old a capture time may be, and how long others wait for an announced cycle.
    pub pending_timeout: Duration,
    /// Real-time: a cycle that has begun and is not finished after so long puts the robot in safe state.
    pub watchdog: Duration,
    /// Real-time: how far historic inputs reach back, and how old a capture time may be.
    pub history: Duration,
    /// How long a cycle takes in lockstep; by default nothing if real-time, else the deadline.
    pub lockstep_duration: Option<Duration>,
    /// What its thread asks of the operating system.
    pub scheduling: Scheduling,
    /// Which cycles are recorded, while the robot records.
    pub record: Record,
}

/// Which cycles of an instance are recorded.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Record {
    /// All of them.
    #[default]
    On,
    /// None.
    Off,
    /// The first, and every so many cycles one.
    Every(u32),
    /// Those that begin while the newest finished cycle of an instance says so.
    While {
        instance: &'static str,
        /// A main output that is a `bool`, or the path of one in it.
        path: &'static str,
    },
}

/// The two kinds of cyclers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Announces its cycles; real-time cyclers consume them in order.
    Perception,
    /// Runs at the pace of the body.
    RealTime,
}

impl InstanceDescription {
    /// How long its cycles take in lockstep.
    pub fn duration_in_lockstep(&self) -> Duration {
        let by_default = match self.kind {
            Kind::RealTime => Duration::ZERO,
            Kind::Perception => self.deadline.unwrap_or_default(),
        };
        self.lockstep_duration.unwrap_or(by_default)
    }

    /// How old a capture time may be at `begin`.
    pub(crate) fn oldest_capture(&self) -> Duration {
        match self.kind {
            Kind::Perception => self.pending_timeout,
            Kind::RealTime => self.history,
        }
    }
}

impl Kind {
    /// As the manifest writes it.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Perception => "perception",
            Self::RealTime => "real-time",
        }
    }
}
