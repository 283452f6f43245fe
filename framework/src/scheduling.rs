//! What a cycler's own thread asks of the operating system, and what it gets.
//!
//! A thread asks for itself and reads back what holds for its own id: asking for another one, or for the process, is how
//! the wrong thread becomes real-time.

use std::fmt;

use rustix::mm::{MlockAllFlags, mlockall};
use rustix::thread::{CpuSet, sched_getaffinity, sched_setaffinity};
use thread_priority::{
    NormalThreadSchedulePolicy, RealtimeThreadSchedulePolicy, ScheduleParams, ThreadPriority,
    ThreadPriorityValue, ThreadSchedulePolicy, set_thread_priority_and_policy, thread_native_id,
    thread_schedule_policy_param,
};

/// What a cycler's own thread asks of the operating system; simulated targets ignore it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Scheduling {
    /// The system's own if `None`.
    pub policy: Option<Policy>,
    /// 1 to 99 for the real-time policies.
    pub priority: Option<u8>,
    /// The cores it may run on; empty: all.
    pub cores: &'static [usize],
}

/// A scheduling policy of Linux.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Policy {
    /// `SCHED_OTHER`: no real time.
    Other,
    /// `SCHED_FIFO`.
    Fifo,
    /// `SCHED_RR`.
    RoundRobin,
}

/// What holds for a thread, as the system says itself.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Granted {
    /// `None`: one that no manifest can ask for.
    pub policy: Option<Policy>,
    /// 0 without real time.
    pub priority: u8,
    /// The cores it may run on.
    pub cores: Vec<usize>,
    /// Whether this thread has locked the memory of the process; asked by real-time threads.
    pub memory_is_locked: bool,
}

/// What the system did not grant, and why.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Refused {
    /// What was asked: `SCHED_FIFO with priority 80`.
    pub(crate) wish: String,
    pub(crate) reason: String,
    pub(crate) deed: &'static str,
}

/// The same for priority and memory, so that it is told once.
const GRANT: &str = "grant it with `sudo setcap cap_sys_nice,cap_ipc_lock=ep PROGRAM`, or with `rtprio 99` and `memlock \
    unlimited` for the user in /etc/security/limits.conf";
const CHOOSE_CORES: &str =
    "name cores of this machine in the manifest: `nproc --all` counts them, the first is 0";
const CHOOSE_PRIORITY: &str = "a real-time policy takes `priority = 1` to `99`, `other` takes none";

impl Scheduling {
    /// Leaves everything to the system.
    pub const BY_THE_SYSTEM: Self = Self {
        policy: None,
        priority: None,
        cores: &[],
    };

    /// Whether it leaves everything to the system.
    pub fn is_default(&self) -> bool {
        *self == Self::BY_THE_SYSTEM
    }

    /// Asks for all of it, for the calling thread; what is refused stays as the system has it.
    pub(crate) fn apply(&self) -> Vec<Refused> {
        let wishes: [fn(&Self) -> Option<Refused>; 3] = [
            Self::ask_for_cores,
            Self::ask_for_policy,
            Self::ask_for_memory,
        ];
        wishes.iter().filter_map(|ask| ask(self)).collect()
    }

    /// A page that is not there costs a real-time thread milliseconds.
    fn asks_for_memory(&self) -> bool {
        matches!(self.policy, Some(Policy::Fifo | Policy::RoundRobin))
    }

    fn ask_for_cores(&self) -> Option<Refused> {
        if self.cores.is_empty() {
            return None;
        }
        let mut cores = CpuSet::new();
        let known = self.cores.iter().filter(|core| **core < CpuSet::MAX_CPU);
        known.for_each(|core| cores.set(*core));
        // The system drops cores that are not there from the set without a word.
        let asked = sched_setaffinity(None, &cores).and_then(|()| sched_getaffinity(None));
        let reason = match asked {
            Ok(granted) if self.cores.iter().all(|core| is_in(&granted, *core)) => return None,
            Ok(_) => "some of them are not there".to_owned(),
            Err(error) => error.to_string(),
        };
        Some(Refused {
            wish: format!("cores {:?}", self.cores),
            reason,
            deed: CHOOSE_CORES,
        })
    }

    fn ask_for_policy(&self) -> Option<Refused> {
        let policy = self.policy?;
        let priority = self.priority.unwrap_or_default();
        let value = ThreadPriorityValue::try_from(priority);
        let asked = value.and_then(|value| {
            let priority = ThreadPriority::Crossplatform(value);
            set_thread_priority_and_policy(thread_native_id(), priority, policy.of_system())
                .map_err(|error| format!("{error}"))
        });
        let reason = asked.err()?;
        let is_possible = policy.priorities().contains(&priority);
        Some(Refused {
            wish: format!("{policy} with priority {priority}"),
            reason,
            deed: if is_possible { GRANT } else { CHOOSE_PRIORITY },
        })
    }

    fn ask_for_memory(&self) -> Option<Refused> {
        if !self.asks_for_memory() {
            return None;
        }
        let error = mlockall(MlockAllFlags::CURRENT | MlockAllFlags::FUTURE).err()?;
        Some(Refused {
            wish: "memory that stays in place".to_owned(),
            reason: error.to_string(),
            deed: GRANT,
        })
    }

    /// What holds for the calling thread, after [`Scheduling::apply`] refused this much.
    pub(crate) fn granted(&self, refused: &[Refused]) -> Granted {
        let (policy, priority) = match thread_schedule_policy_param(thread_native_id()) {
            Ok((policy, ScheduleParams { sched_priority })) => (
                Policy::from_system(policy),
                u8::try_from(sched_priority).unwrap_or_default(),
            ),
            Err(_) => (None, 0),
        };
        let cores = sched_getaffinity(None).map_or_else(
            |_| Vec::new(),
            |granted| {
                (0..CpuSet::MAX_CPU)
                    .filter(|core| is_in(&granted, *core))
                    .collect()
            },
        );
        let memory_was_refused = refused
            .iter()
            .any(|refused| refused.wish.starts_with("memory"));
        Granted {
            policy,
            priority,
            cores,
            memory_is_locked: self.asks_for_memory() && !memory_was_refused,
        }
    }
}

fn is_in(cores: &CpuSet, core: usize) -> bool {
    core < CpuSet::MAX_CPU && cores.is_set(core)
}

impl Policy {
    fn of_system(self) -> ThreadSchedulePolicy {
        match self {
            Self::Other => ThreadSchedulePolicy::Normal(NormalThreadSchedulePolicy::Other),
            Self::Fifo => ThreadSchedulePolicy::Realtime(RealtimeThreadSchedulePolicy::Fifo),
            Self::RoundRobin => {
                ThreadSchedulePolicy::Realtime(RealtimeThreadSchedulePolicy::RoundRobin)
            }
        }
    }

    fn from_system(policy: ThreadSchedulePolicy) -> Option<Self> {
        [Self::Other, Self::Fifo, Self::RoundRobin]
            .into_iter()
            .find(|known| known.of_system() == policy)
    }

    fn priorities(self) -> std::ops::RangeInclusive<u8> {
        match self {
            Self::Other => 0..=0,
            Self::Fifo | Self::RoundRobin => 1..=99,
        }
    }

    /// As the manifest writes it.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Other => "other",
            Self::Fifo => "fifo",
            Self::RoundRobin => "round-robin",
        }
    }
}

impl fmt::Display for Policy {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(match self {
            Self::Other => "SCHED_OTHER",
            Self::Fifo => "SCHED_FIFO",
            Self::RoundRobin => "SCHED_RR",
        })
    }
}

impl fmt::Display for Granted {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.policy {
            Some(Policy::Other) => write!(formatter, "{}", Policy::Other)?,
            Some(policy) => write!(formatter, "{policy} {}", self.priority)?,
            None => formatter.write_str("a policy of its own")?,
        }
        let plural = if self.cores.len() == 1 { "" } else { "s" };
        let cores: Vec<_> = self.cores.iter().map(usize::to_string).collect();
        write!(formatter, ", core{plural} {}", cores.join(" "))?;
        if self.memory_is_locked {
            formatter.write_str(", memory locked")?;
        }
        Ok(())
    }
}

impl fmt::Display for Refused {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            formatter,
            "the system refuses {}: {}; {}",
            self.wish, self.reason, self.deed
        )
    }
}
