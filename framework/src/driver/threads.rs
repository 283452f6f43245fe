//! One named thread per instance, and one of the watchdog; the calling thread waits for them.

use std::collections::BTreeSet;
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::{self, Scope};
use std::time::Duration;

use super::observer::Observed;
use super::overdue::{Overdue, Running};
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

/// A perception cycle that takes longer is told: nobody else says why its instance shows nothing.
const LONGEST_PERCEPTION: Duration = Duration::from_secs(5);

/// The robot's threads and what they share.
pub struct Threads<'robot> {
    clock: &'robot Clock,
    hardware: &'robot dyn Hardware,
    stop: &'robot Stop,
    rearm: Rearm,
    is_real_time: bool,
    overdue: Overdue<'robot>,
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
            overdue: Overdue::default(),
        }
    }

    /// Whether every thread asks for the `scheduling` of its instance; what is refused is told once.
    pub fn real_time(self, is_real_time: bool) -> Self {
        Self {
            is_real_time,
            ..self
        }
    }

    /// What is done about hardware that has not stopped within 10 s, and about threads that have not ended 10 s later, once it
    /// was told whose they are. Nothing ends a thread from outside: without this, or where it returns, they are waited for.
    pub fn giving_up(self, give_up: &'robot (dyn Fn() + Sync)) -> Self {
        Self {
            overdue: Overdue::then(give_up),
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
            let mut running = Running::default();
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
                match spawned {
                    Ok(thread) => running.add(description.name, thread),
                    Err(error) => {
                        let what = format!("no thread for {}", description.name);
                        fail(Error::from(error).context(what));
                        break;
                    }
                }
            }
            self.await_stop(scope, watched, &safe_state, &fail);
            self.overdue.await_end(
                &running,
                "a node of it, or the hardware that it reads, does not return",
            );
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

/// An instance, as the watchdog sees it.
struct Watched {
    description: InstanceDescription,
    counters: Arc<Counters>,
    /// The cycle for which there was an alarm: after a re-arm it does not count again.
    alarmed: Option<Timestamp>,
}

impl Watched {
    fn all(instances: &[Box<dyn Instance>]) -> Vec<Self> {
        let watched = instances.iter().map(|instance| Self {
            description: *instance.description(),
            counters: instance.counters().clone(),
            alarmed: None,
        });
        watched.collect()
    }

    fn is_real_time(&self) -> bool {
        self.description.kind == Kind::RealTime
    }

    /// A cycle may take so long.
    fn limit(&self) -> Duration {
        match self.is_real_time() {
            true => self.description.watchdog,
            false => LONGEST_PERCEPTION,
        }
    }

    /// Whether a cycle takes longer now, and this was not told yet.
    fn hangs_anew(&mut self, now: Timestamp) -> bool {
        let begun_at = self.counters.begun_at();
        let hangs = begun_at.is_some_and(|begun_at| now - begun_at > self.limit());
        let is_new = hangs && self.alarmed != begun_at;
        if is_new {
            self.alarmed = begun_at;
        }
        is_new
    }
}

impl Threads<'_> {
    /// Until the robot has come down. The watchdog and all that it asks of the hardware have a thread of their own: somebody has
    /// to tell where that does not return.
    fn await_stop<'scope>(
        &'scope self,
        scope: &'scope Scope<'scope, '_>,
        mut watched: Vec<Watched>,
        safe_state: &'scope SafeState<'_>,
        fail: &'scope (dyn Fn(Error) + Sync),
    ) {
        let thread = thread::Builder::new().name("watchdog".to_owned());
        let thread = thread.spawn_scoped(scope, move || {
            let watching = contain("watchdog", || {
                self.watch(&mut watched, safe_state);
                Ok(())
            });
            watching.unwrap_or_else(|error| fail(error.context("the watchdog failed")));
            self.bring_down(safe_state, fail);
        });
        let thread = match thread {
            Ok(thread) => thread,
            Err(error) => {
                fail(Error::from(error).context("no thread for the watchdog"));
                // Better waited for than not done.
                return self.bring_down(safe_state, fail);
            }
        };
        while self.stop.wait(Duration::from_secs(3600)).is_ok() {}
        let mut running = Running::default();
        running.add("The hardware", thread);
        self.overdue.await_end(
            &running,
            "its `enter_safe_state`, `rearm`, `is_rearm_wanted` or `stop` does not return",
        );
    }

    fn bring_down(&self, safe_state: &SafeState<'_>, fail: &dyn Fn(Error)) {
        safe_state.enter();
        let stopped = contain("Hardware::stop", || {
            self.hardware.stop();
            Ok(())
        });
        stopped.unwrap_or_else(fail);
    }

    /// Until the robot stops, looks for cycles that have begun and are not finished for too long, and for whoever wants the
    /// actuators back. Perception commands no actuators: it is told, and nothing else.
    fn watch(&self, watched: &mut [Watched], safe_state: &SafeState<'_>) {
        let limits = watched.iter().map(Watched::limit);
        let period = limits.min().map_or(LONGEST_PERIOD, |shortest| {
            (shortest / 4).clamp(Duration::from_millis(1), LONGEST_PERIOD)
        });
        while self.stop.wait(period).is_ok() {
            safe_state.rearm_if_wanted(&self.rearm);
            let now = self.clock.now();
            let hanging = watched.iter_mut();
            let hanging: Vec<_> = hanging
                .filter_map(|watched| watched.hangs_anew(now).then_some(&*watched))
                .collect();
            // First: whoever is told may not be listening.
            if hanging.iter().any(|watched| watched.is_real_time()) {
                safe_state.enter();
            }
            for watched in hanging {
                let (name, limit) = (watched.description.name, watched.limit());
                let is_real_time = watched.is_real_time();
                let then = if is_real_time { ": safe state" } else { "" };
                tell(format_args!(
                    "{name} has not finished a cycle for {limit:?}{then}"
                ));
            }
        }
    }
}
