//! One thread, one virtual clock: the hardware says whose data is ready next, nothing ever waits.
//!
//! ```text
//! time  t: wait, begin, run                of the instance whose event it is
//!   t + d: finish                          others see the cycle from here on; d from the manifest, unless somebody says it
//! ```
//! At equal times: every `finish`, then restarts, then every `wait`, each in manifest order. An event of an instance that
//! has not finished stays due. An event of an instance that a partial robot does without is only told: who feeds its stub
//! does it then. Same events, same bits.

mod together;

use std::time::Duration;

pub use together::Together;

use super::chaos::Chaos;
use super::observer::Observed;
use super::safe_state::Causes;
use super::{Observer, SafeState};
use crate::cycler::{Finished, Instance, InstanceDescription, Restarted, Waited};
use crate::error::{Error, Result};
use crate::hardware::{Event, Hardware};
use crate::logs;
use crate::rearm::Rearm;
use crate::robot::Robot;
use crate::time::Timestamp;

/// Turns the instances of one robot, step by step.
///
/// Dropping it abandons the cycles that are not finished, and forgets the event that the hardware told last: who wants to
/// go on calls [`Lockstep::pause`].
pub struct Lockstep<'robot, P> {
    robot: &'robot mut Robot<P>,
    hardware: &'robot dyn Hardware,
    safe_state: SafeState<'robot>,
    rearm: Rearm,
    tracks: Vec<Track>,
    /// In the order of the instances.
    observers: Vec<Observed<'robot>>,
    /// Asked of the hardware, not done yet.
    ahead: Option<Arrival>,
    /// The hardware has no more events.
    world_has_ended: bool,
    /// That is since it was told to stop, not since it waits for other robots.
    hardware_stopped: bool,
    stopped: bool,
    chaos: Option<Chaos>,
}

/// What was done in one step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stepped {
    /// The virtual time.
    pub at: Timestamp,
    /// The instance it was done with.
    pub instance: &'static str,
    /// What it was.
    pub step: Step,
}

/// What can be done with one instance at one time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Step {
    /// Its data was ready, its nodes ran; the cycle is not finished.
    Began,
    /// Its data was ready, and no cycle came of it.
    Waited(Waited),
    /// Its data was ready, but it was busy: it begins when it has finished.
    Postponed,
    /// A cycle ended.
    Finished(Finished),
    /// Its nodes were created anew.
    Restarted(Restarted),
    /// Its data was ready, but it is left out of this robot: what stands in for it may be fed now.
    LeftOut,
}

/// Where a [`Lockstep`] was left, for the next one with the same robot and hardware.
#[derive(Debug)]
pub struct Paused {
    tracks: Vec<Track>,
    ahead: Option<Arrival>,
    world_has_ended: bool,
    hardware_stopped: bool,
    stopped: bool,
    chaos: Option<Chaos>,
    causes: Causes,
}

/// Where one instance is.
#[derive(Debug)]
struct Track {
    state: State,
    /// Its data is ready since then, and it could not begin.
    due: Option<Timestamp>,
    /// How long its cycles take, unless chaos draws that.
    lasts: Duration,
}

#[derive(Clone, Copy, Debug)]
enum State {
    Idle,
    Running { until: Timestamp },
    Restarting { at: Timestamp },
}

#[derive(Clone, Copy, Debug)]
struct Arrival {
    at: Timestamp,
    whose: Whose,
}

/// To whom an event belongs, by position.
#[derive(Clone, Copy, Debug)]
enum Whose {
    Instance(usize),
    LeftOut(usize),
}

#[derive(Clone, Copy)]
enum Deed {
    Finish,
    Restart,
    BeginDue,
    Arrive,
    /// An event of the instance with this position among those that are left out.
    PassBy,
}

impl Deed {
    /// The order at equal times. Waits are one class: among them only the manifest order counts.
    fn rank(self) -> u8 {
        match self {
            Self::Finish => 0,
            Self::Restart => 1,
            Self::BeginDue | Self::Arrive | Self::PassBy => 2,
        }
    }
}

impl<'robot, P> Lockstep<'robot, P> {
    /// For a robot that was created with [`crate::Clock::stepped`].
    pub fn new(robot: &'robot mut Robot<P>, hardware: &'robot dyn Hardware) -> Self {
        let tracks = robot.instances.iter().map(|instance| Track {
            state: State::Idle,
            due: None,
            lasts: instance.description().duration_in_lockstep(),
        });
        Self {
            tracks: tracks.collect(),
            observers: robot
                .instances
                .iter()
                .map(|_| Observed::default())
                .collect(),
            robot,
            hardware,
            safe_state: SafeState::new(hardware),
            rearm: Rearm::default(),
            ahead: None,
            world_has_ended: false,
            hardware_stopped: false,
            stopped: false,
            chaos: None,
        }
    }

    /// The same with chaos: how late an instance wakes after its data came and how long its cycles take is drawn from
    /// `seed`. It wakes within 2 ms (a real-time cycler within 1 ms); a cycle takes up to the deadline of a perception
    /// cycler, 20 ms without one, and up to half the deadline of a real-time cycler. Whoever's data come at a slower pace
    /// than both together misses none. Shows what depends on the order in which computers happen to be done.
    #[must_use]
    pub fn chaotic(mut self, seed: u64) -> Self {
        self.chaos = Some(Chaos::new(seed));
        self
    }

    /// The same where cycles of some instances take as long as `duration_of` says, and not as long as the manifest does. Chaos
    /// draws its own durations nevertheless.
    #[must_use]
    pub fn lasting(
        mut self,
        mut duration_of: impl FnMut(&InstanceDescription) -> Option<Duration>,
    ) -> Self {
        for (track, instance) in self.tracks.iter_mut().zip(&self.robot.instances) {
            let description = instance.description();
            track.lasts = duration_of(description).unwrap_or(track.lasts);
        }
        self
    }

    /// The same with the observers that `observer_of` gives.
    #[must_use]
    pub fn observed<'observer: 'robot>(
        mut self,
        mut observer_of: impl FnMut(&InstanceDescription) -> Option<Box<dyn Observer + 'observer>>,
    ) -> Self {
        for (observed, instance) in self.observers.iter_mut().zip(&self.robot.instances) {
            *observed = Observed::by(observer_of(instance.description()));
        }
        self
    }

    /// Goes on where another one was left: cycles that have begun go on, and nothing that the hardware told is lost.
    #[must_use]
    pub fn after(mut self, paused: Paused) -> Self {
        self.tracks = paused.tracks;
        self.ahead = paused.ahead;
        self.world_has_ended = paused.world_has_ended;
        self.hardware_stopped = paused.hardware_stopped;
        self.stopped = paused.stopped;
        self.chaos = paused.chaos;
        self.safe_state.set_causes(paused.causes);
        self
    }

    /// Lets go of the robot; [`Self::after`] goes on.
    pub fn pause(mut self) -> Paused {
        Paused {
            // Without them nothing is left to be abandoned.
            tracks: std::mem::take(&mut self.tracks),
            ahead: self.ahead,
            world_has_ended: self.world_has_ended,
            hardware_stopped: self.hardware_stopped,
            stopped: self.stopped,
            chaos: self.chaos.take(),
            causes: self.safe_state.take_causes(),
        }
    }

    /// The world that had no more events may have some now, as one that waits for other robots: it is asked again.
    pub fn world_goes_on(&mut self) {
        self.world_has_ended = false;
    }

    /// Whether a node or the hardware ended the run.
    pub(crate) fn ended_itself(&self) -> bool {
        self.stopped || self.hardware_stopped
    }

    /// Gives the nodes the actuators back before the next step.
    pub fn rearming(&self) -> Rearm {
        self.rearm.clone()
    }

    /// The robot between two steps.
    pub fn robot(&self) -> &Robot<P> {
        self.robot
    }

    /// The robot between two steps, to inject, subscribe, call or change parameters.
    pub fn robot_mut(&mut self) -> &mut Robot<P> {
        self.robot
    }

    /// Does what comes next; `None` at the end of the world, or when the robot has stopped.
    pub fn step(&mut self) -> Result<Option<Stepped>> {
        match self.next()? {
            Some((at, deed, index)) => self.carry_out(at, deed, index).map(Some),
            None => Ok(None),
        }
    }

    /// Does everything up to `end`, included; `observe` sees each instance after each cycle that it finished. Then it is
    /// `end`, unless the world has ended before or the robot has stopped.
    pub fn run_until(
        &mut self,
        end: Timestamp,
        mut observe: impl FnMut(&dyn Instance),
    ) -> Result<()> {
        while let Some((at, deed, index)) = self.next()? {
            if at > end {
                self.robot.clock.advance_to(end);
                break;
            }
            let stepped = self.carry_out(at, deed, index)?;
            if let Step::Finished(Finished::Completed | Finished::Recovered) = stepped.step {
                observe(self.robot.instances[index].as_ref());
            }
        }
        Ok(())
    }

    /// Ends the run in order: cycles that are not finished are abandoned.
    pub fn stop(&mut self) {
        if !self.stopped {
            self.stopped = true;
            self.abandon();
            self.safe_state.enter();
            self.hardware.stop();
        }
    }

    fn abandon(&mut self) {
        let instances = self.robot.instances.iter_mut();
        instances.for_each(|instance| instance.abandon());
    }

    fn next(&mut self) -> Result<Option<(Timestamp, Deed, usize)>> {
        if !self.robot.clock.is_stepped() {
            return Err(Error::new(
                "lockstep needs a virtual clock: Clock::stepped()",
            ));
        }
        if self.stopped {
            return Ok(None);
        }
        let _within = logs::within(&self.robot.clock);
        self.look_ahead()?;
        let tracks = self.tracks.iter().enumerate().filter_map(|(index, track)| {
            let (at, deed) = match track.state {
                State::Running { until } => (until, Deed::Finish),
                State::Restarting { at } => (at, Deed::Restart),
                State::Idle => (track.due?, Deed::BeginDue),
            };
            Some((at, deed, index))
        });
        let arrival = self.ahead.map(|Arrival { at, whose }| match whose {
            Whose::Instance(index) => (at, Deed::Arrive, index),
            Whose::LeftOut(index) => (at, Deed::PassBy, index),
        });
        // Of equals the first is taken: new data replaces what is due before that begins.
        let deeds = arrival.into_iter().chain(tracks);
        Ok(deeds.min_by_key(|(at, deed, index)| (*at, deed.rank(), *index)))
    }

    /// Whether there is nothing left to do of what the hardware told.
    fn is_idle(&self) -> bool {
        let mut tracks = self.tracks.iter();
        self.ahead.is_none()
            && tracks.all(|track| matches!(track.state, State::Idle) && track.due.is_none())
    }

    fn look_ahead(&mut self) -> Result<()> {
        if self.ahead.is_some() || self.world_has_ended {
            return Ok(());
        }
        let event = self
            .hardware
            .next_event()
            .map_err(|error| error.context("the hardware has no next event"));
        match event.and_then(|event| event.map(|event| self.arrival(event)).transpose()) {
            Ok(Some(arrival)) => self.ahead = Some(arrival),
            Ok(None) => self.world_has_ended = true,
            Err(error) if error.is_stopped() => {
                (self.world_has_ended, self.hardware_stopped) = (true, true);
            }
            Err(error) => {
                self.stop();
                return Err(error);
            }
        }
        Ok(())
    }

    fn arrival(&self, Event { at, instance }: Event) -> Result<Arrival> {
        let mut instances = self.robot.instances.iter();
        let mut left_out = self.robot.left_out.iter();
        let whose = (instances.position(|known| known.description().name == instance))
            .map(Whose::Instance)
            .or_else(|| Some(Whose::LeftOut(left_out.position(|name| *name == instance)?)));
        let whose = whose.ok_or_else(|| {
            Error::new(format!(
                "the hardware has an event for `{instance}`, which is no instance"
            ))
        })?;
        let now = self.robot.clock.now();
        if at < now {
            let message =
                format!("the hardware has an event for `{instance}` at {at}, but it is {now}");
            return Err(Error::new(message));
        }
        Ok(Arrival { at, whose })
    }

    fn carry_out(&mut self, at: Timestamp, deed: Deed, index: usize) -> Result<Stepped> {
        self.robot.clock.advance_to(at);
        let _within = logs::within(&self.robot.clock);
        self.safe_state.rearm_if_wanted(&self.rearm);
        let step = match deed {
            Deed::Finish => self.finish(at, index),
            Deed::Restart => self.restart(at, index),
            Deed::BeginDue => self.begin(at, index),
            Deed::Arrive => {
                self.ahead = None;
                self.arrive(at, index)
            }
            Deed::PassBy => {
                self.ahead = None;
                let (instance, step) = (self.robot.left_out[index], Step::LeftOut);
                return Ok(Stepped { at, instance, step });
            }
        };
        let instance = self.robot.instances[index].description().name;
        match step {
            Ok(step) => Ok(Stepped { at, instance, step }),
            Err(error) => {
                self.stop();
                Err(error.context(format!("{instance} failed at {at}")))
            }
        }
    }

    fn arrive(&mut self, at: Timestamp, index: usize) -> Result<Step> {
        let description = self.robot.instances[index].description();
        let wakes = self.chaos.as_mut().map(|chaos| chaos.wake(description));
        let track = &mut self.tracks[index];
        if matches!(track.state, State::Idle) && track.due.is_none() && wakes.is_none() {
            return self.begin(at, index);
        }
        let due = at + wakes.unwrap_or_default();
        let earlier = track.due;
        // It wakes for the first data; the newest is what it then gets.
        track.due = Some(earlier.map_or(due, |earlier| earlier.min(due)));
        if earlier.is_some() {
            // The hardware has replaced what was due by newer data.
            self.robot.instances[index].counters().missed.add(1);
        }
        Ok(Step::Postponed)
    }

    fn begin(&mut self, at: Timestamp, index: usize) -> Result<Step> {
        let instance = self.robot.instances[index].as_mut();
        let track = &mut self.tracks[index];
        track.due = None;
        match instance.wait()? {
            Waited::Ready => {
                instance.begin();
                self.observers[index].begun(instance)?;
                instance.run();
                let description = instance.description();
                let duration = match &mut self.chaos {
                    Some(chaos) => chaos.cycle(description),
                    None => track.lasts,
                };
                let until = at + duration;
                track.state = State::Running { until };
                Ok(Step::Began)
            }
            waited @ Waited::Restarting { at } => {
                track.state = State::Restarting { at };
                self.safe_state
                    .enter_while_restarting(instance.description());
                Ok(Step::Waited(waited))
            }
            waited @ (Waited::NoEvent | Waited::Failed) => Ok(Step::Waited(waited)),
            Waited::Stopped => {
                self.stop();
                Ok(Step::Waited(Waited::Stopped))
            }
        }
    }

    fn finish(&mut self, at: Timestamp, index: usize) -> Result<Step> {
        self.become_idle(at, index);
        let instance = self.robot.instances[index].as_mut();
        // Others may have run since it did.
        logs::enter(instance.description().name, instance.cycle().number);
        let finished = instance.finish()?;
        self.observers[index].finished(instance, finished)?;
        let description = instance.description();
        match finished {
            Finished::Completed | Finished::Abandoned => {}
            Finished::Recovered => self.safe_state.leave_after_restart(description),
            Finished::Restarting { at } => {
                self.tracks[index].state = State::Restarting { at };
                self.safe_state.enter_while_restarting(description);
            }
            Finished::Stopped => self.stop(),
        }
        Ok(Step::Finished(finished))
    }

    fn restart(&mut self, at: Timestamp, index: usize) -> Result<Step> {
        let restarted = self.robot.instances[index].restart()?;
        match restarted {
            Restarted::Done => self.become_idle(at, index),
            Restarted::Again { at } => self.tracks[index].state = State::Restarting { at },
            Restarted::Stopped => self.stop(),
        }
        Ok(Step::Restarted(restarted))
    }

    /// What is due can begin now.
    fn become_idle(&mut self, now: Timestamp, index: usize) {
        let track = &mut self.tracks[index];
        track.state = State::Idle;
        track.due = track.due.map(|due| due.max(now));
    }
}

impl<P> Drop for Lockstep<'_, P> {
    fn drop(&mut self) {
        let is_paused = self.tracks.is_empty();
        if !is_paused {
            self.abandon();
        }
    }
}
