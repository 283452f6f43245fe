//! One named thread per instance; the calling thread is the watchdog.

use std::collections::BTreeSet;
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;
use std::time::Duration;

use super::observer::Observed;
use super::{Observer, SafeState};
use crate::clock::Clock;
use crate::cycler::{
    Counters, Finished, Instance, InstanceDescription, Kind, PAUSE_AFTER_SETUP_FAILURE, Restarted,
    Waited,
};
use crate::error::{Error, Result};
use crate::guarded::contain;
use crate::hardware::Hardware;
use crate::rearm::Rearm;
use crate::report::tell;
use crate::stop::Stop;
use crate::time::Timestamp;

/// The watchdog looks at least so often, also where nobody moves.
const LONGEST_PERIOD: Duration = Duration::from_millis(50);

/// The robot's threads and what they share.
pub struct Threads<'robot> {
    clock: &'robot Clock,
    hardware: &'robot dyn Hardware,
    stop: &'robot Stop,
    rearm: Rearm,
    is_real_time: bool,
}

impl<'robot> Threads<'robot> {
    /// Threads that leave their scheduling to the system.
    pub fn new(clock: &'robot Clock, hardware: &'robot dyn Hardware, stop: &'robot Stop) -> Self {
        Self {
            clock,
            hardware,
            stop,
            rearm: Rearm::default(),
            is_real_time: false,
        }
    }

    /// Whether every thread asks for the `scheduling` of its instance; what is refused is told once.
    pub fn real_time(self, is_real_time: bool) -> Self {
        Self {
            is_real_time,
            ..self
        }
    }

    /// Gives the nodes the actuators back while it runs.
    pub fn rearming(&self) -> Rearm {
        self.rearm.clone()
    }

    /// Runs until the stop is requested or an instance fails for good, which is the error.
    ///
    /// Either way the robot stops in order: safe state, [`Hardware::stop`], then every thread ends its cycle. It takes the
    /// instances and not the robot, so that clients may use the rest of it meanwhile.
    pub fn run(&self, instances: &mut [Box<dyn Instance>]) -> Result<()> {
        self.run_observed(instances, |_| None)
    }

    /// As [`Threads::run`], with the observers that `observer_of` gives.
    pub fn run_observed<'run>(
        &self,
        instances: &mut [Box<dyn Instance>],
        mut observer_of: impl FnMut(&InstanceDescription) -> Option<Box<dyn Observer + 'run>>,
    ) -> Result<()> {
        if self.clock.is_stepped() {
            return Err(Error::new("threads need a wall clock: Clock::wall()"));
        }
        let stop = self.stop;
        let failure = Mutex::new(None);
        let fail = |error: Error| {
            let mut failure = failure.lock().unwrap_or_else(PoisonError::into_inner);
            match *failure {
                // The first failure stops the robot; what follows may be its consequence.
                Some(_) => tell(format_args!("{error}")),
                None => *failure = Some(error),
            }
            stop.request();
        };
        let safe_state = SafeState::new(self.hardware);
        let watched = Watched::all(instances);
        let refusals = Refusals::default();
        thread::scope(|scope| {
            for instance in instances {
                let description = *instance.description();
                let turning = Turning {
                    clock: self.clock,
                    stop,
                    safe_state: &safe_state,
                    refusals: self.is_real_time.then_some(&refusals),
                };
                let mut observed = Observed::by(observer_of(&description));
                let spawned = thread::Builder::new()
                    .name(description.name.to_owned())
                    .spawn_scoped(scope, move || {
                        // Nodes keep their panics to themselves; this is for everything around them.
                        let turned = contain(description.name, || {
                            turning.ask_for_scheduling(instance.as_ref());
                            turning.turn(instance.as_mut(), &mut observed)
                        });
                        match turned {
                            Ok(()) => stop.request(),
                            Err(error) => {
                                fail(error.context(format!("{} failed", description.name)));
                            }
                        }
                        // What a panic has left.
                        instance.abandon();
                    });
                if let Err(error) = spawned {
                    fail(Error::from(error).context(format!("no thread for {}", description.name)));
                    break;
                }
            }
            let watching = contain("watchdog", || {
                self.watch(&watched, &safe_state);
                Ok(())
            });
            watching.unwrap_or_else(|error| fail(error.context("the watchdog failed")));
            safe_state.enter();
            let stopped = contain("Hardware::stop", || {
                self.hardware.stop();
                Ok(())
            });
            stopped.unwrap_or_else(fail);
        });
        let failure = failure.into_inner().unwrap_or_else(PoisonError::into_inner);
        failure.map_or(Ok(()), Err)
    }
}

/// What the system refused and was told already: the same cause touches many threads.
type Refusals = Mutex<BTreeSet<&'static str>>;

/// What a thread needs besides its instance.
struct Turning<'run> {
    clock: &'run Clock,
    stop: &'run Stop,
    safe_state: &'run SafeState<'run>,
    /// `None`: scheduling is the system's.
    refusals: Option<&'run Refusals>,
}

impl Turning<'_> {
    /// For the calling thread, before its first cycle.
    fn ask_for_scheduling(&self, instance: &dyn Instance) {
        let InstanceDescription {
            name, scheduling, ..
        } = instance.description();
        let Some(refusals) = self.refusals.filter(|_| !scheduling.is_default()) else {
            return;
        };
        let refused = scheduling.apply();
        let granted = scheduling.granted(&refused);
        tell(format_args!("{name} runs with {granted}"));
        instance.counters().grant(granted);
        let mut told = refusals.lock().unwrap_or_else(PoisonError::into_inner);
        for refused in refused {
            if told.insert(refused.deed) {
                tell(format_args!("warning: {name}: {refused}"));
            }
        }
    }

    /// Cycle after cycle until the robot stops.
    fn turn(&self, instance: &mut dyn Instance, observed: &mut Observed<'_>) -> Result<()> {
        while !self.stop.is_requested() {
            let next = match instance.wait()? {
                Waited::Ready => {
                    instance.begin();
                    observed.begun(instance)?;
                    instance.run();
                    let finished = instance.finish()?;
                    observed.finished(instance, finished)?;
                    finished
                }
                Waited::NoEvent => Finished::Abandoned,
                Waited::Failed => {
                    // Stopped meanwhile: the loop sees it.
                    let _ = self.stop.wait(PAUSE_AFTER_SETUP_FAILURE);
                    Finished::Abandoned
                }
                Waited::Restarting { at } => Finished::Restarting { at },
                Waited::Stopped => Finished::Stopped,
            };
            match next {
                Finished::Completed | Finished::Abandoned => {}
                Finished::Recovered => self.safe_state.leave_after_restart(instance.description()),
                Finished::Restarting { at } => self.restart(instance, at)?,
                Finished::Stopped => break,
            }
        }
        Ok(())
    }

    /// Waits out the back-off and creates the nodes anew, until that succeeds or the robot stops.
    fn restart(&self, instance: &mut dyn Instance, mut at: Timestamp) -> Result<()> {
        self.safe_state
            .enter_while_restarting(instance.description());
        while self.stop.wait(at - self.clock.now()).is_ok() {
            match instance.restart()? {
                Restarted::Done => break,
                Restarted::Again { at: later } => at = later,
                Restarted::Stopped => self.stop.request(),
            }
        }
        Ok(())
    }
}

/// A real-time instance, as the watchdog sees it.
struct Watched {
    description: InstanceDescription,
    counters: Arc<Counters>,
}

impl Watched {
    fn all(instances: &[Box<dyn Instance>]) -> Vec<Self> {
        let real_time = instances
            .iter()
            .filter(|instance| instance.description().kind == Kind::RealTime);
        real_time
            .map(|instance| Self {
                description: *instance.description(),
                counters: instance.counters().clone(),
            })
            .collect()
    }

    /// When the cycle began that takes longer than the watchdog permits.
    fn hangs_since(&self, now: Timestamp) -> Option<Timestamp> {
        let begun_at = self.counters.begun_at()?;
        (now - begun_at > self.description.watchdog).then_some(begun_at)
    }
}

impl Threads<'_> {
    /// Until the robot stops, looks for cycles that have begun and are not finished after `watchdog`, and for whoever wants
    /// the actuators back.
    fn watch(&self, watched: &[Watched], safe_state: &SafeState<'_>) {
        let limits = watched.iter().map(|watched| watched.description.watchdog);
        let period = limits.min().map_or(LONGEST_PERIOD, |shortest| {
            (shortest / 4).clamp(Duration::from_millis(1), LONGEST_PERIOD)
        });
        // One alarm per cycle that hangs: after a re-arm the same cycle does not count again.
        let mut alarmed = vec![None; watched.len()];
        while self.stop.wait(period).is_ok() {
            safe_state.rearm_if_wanted(&self.rearm);
            let now = self.clock.now();
            for (watched, alarmed) in watched.iter().zip(&mut alarmed) {
                if let Some(begun_at) = watched.hangs_since(now)
                    && *alarmed != Some(begun_at)
                {
                    *alarmed = Some(begun_at);
                    let InstanceDescription { name, watchdog, .. } = watched.description;
                    tell(format_args!(
                        "{name} has not finished a cycle for {watchdog:?}: safe state"
                    ));
                    safe_state.enter();
                }
            }
        }
    }
}
