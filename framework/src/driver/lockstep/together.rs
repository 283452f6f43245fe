//! Several robots in lockstep, on as many threads as one likes: the bits do not depend on how many.
//!
//! ```text
//! in the order of the robots:  each hardware says what comes next       <- here alone a world that robots share goes on
//! on threads:                  whatever comes next of all, at one time  <- one thread for each robot
//! in the order of the robots:  what was finished is observed
//! ```
//! Robots share nothing but what their hardwares share. What a node commands may reach others only when the world goes on:
//! a hardware keeps it until it is asked for its next event.

use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread::scope;

use super::{Deed, Lockstep, Step, Stepped};
use crate::cycler::{Finished, Instance};
use crate::error::{Error, Result};
use crate::guarded::contain;
use crate::time::Timestamp;

/// Turns several robots, each on its own virtual clock, always the one that is behind; robots at one time turn in parallel.
pub struct Together<'robot, P> {
    /// `None` only while a thread has it.
    locksteps: Vec<Option<Lockstep<'robot, P>>>,
    threads: usize,
}

/// What one robot does next.
#[derive(Clone, Copy)]
struct Turn {
    robot: usize,
    deed: Deed,
    index: usize,
}

struct Task<'robot, P> {
    lockstep: Lockstep<'robot, P>,
    at: Timestamp,
    turn: Turn,
}

struct Done<'robot, P> {
    lockstep: Lockstep<'robot, P>,
    turn: Turn,
    stepped: Result<Stepped>,
}

const AT_HOME: &str = "between two rounds no thread has a robot";

impl<'robot, P: Send + Sync> Together<'robot, P> {
    /// The robots, whose order is that in which their hardwares are asked, on so many threads, at least one.
    pub fn new(locksteps: Vec<Lockstep<'robot, P>>, threads: usize) -> Self {
        Self {
            threads: threads.min(locksteps.len()).max(1),
            locksteps: locksteps.into_iter().map(Some).collect(),
        }
    }

    /// One of the robots between two runs.
    pub fn lockstep(&mut self, robot: usize) -> Option<&mut Lockstep<'robot, P>> {
        self.locksteps.get_mut(robot)?.as_mut()
    }

    /// As [`Lockstep::run_until`] for all robots; `observe` is told which one it sees. The first that fails ends the run.
    pub fn run_until(
        &mut self,
        end: Timestamp,
        mut observe: impl FnMut(usize, &dyn Instance),
    ) -> Result<()> {
        if self.threads == 1 {
            let perform = |tasks: Vec<Task<'robot, P>>| tasks.into_iter().map(Task::perform);
            return self.rounds(end, &mut observe, |tasks| perform(tasks).collect());
        }
        scope(|scope| {
            let (done, finished) = channel();
            let workers: Vec<Sender<Task<'_, P>>> = (0..self.threads)
                .map(|_| {
                    let (worker, tasks) = channel();
                    let done = done.clone();
                    scope.spawn(move || work(tasks, &done));
                    worker
                })
                .collect();
            self.rounds(end, &mut observe, |tasks| {
                let count = tasks.len();
                for (task, worker) in tasks.into_iter().zip(workers.iter().cycle()) {
                    let sent = worker.send(task);
                    assert!(sent.is_ok(), "workers outlive the rounds");
                }
                finished.iter().take(count).collect()
            })
        })
    }

    fn rounds(
        &mut self,
        end: Timestamp,
        observe: &mut dyn FnMut(usize, &dyn Instance),
        mut perform: impl FnMut(Vec<Task<'robot, P>>) -> Vec<Done<'robot, P>>,
    ) -> Result<()> {
        while let Some((at, turns)) = self.next()? {
            if at > end {
                break;
            }
            let tasks = turns.into_iter().map(|turn| Task {
                lockstep: self.locksteps[turn.robot].take().expect(AT_HOME),
                at,
                turn,
            });
            let tasks = tasks.collect();
            let mut all = perform(tasks);
            all.sort_by_key(|done| done.turn.robot);
            let mut failure = Ok(());
            for Done {
                lockstep,
                turn,
                stepped,
            } in all
            {
                match stepped {
                    Ok(stepped) => {
                        if let Step::Finished(Finished::Completed | Finished::Recovered) =
                            stepped.step
                        {
                            observe(turn.robot, lockstep.robot.instances[turn.index].as_ref());
                        }
                    }
                    Err(error) => failure = failure.and(Err(named(error, turn.robot))),
                }
                self.locksteps[turn.robot] = Some(lockstep);
            }
            failure?;
        }
        for lockstep in self.locksteps.iter_mut().flatten() {
            let is_done = lockstep.world_has_ended && lockstep.is_idle();
            if !lockstep.stopped && !is_done {
                lockstep.robot.clock.advance_to(end);
            }
        }
        Ok(())
    }

    /// The earliest time at which there is something to do, and which robots have to.
    fn next(&mut self) -> Result<Option<(Timestamp, Vec<Turn>)>> {
        let mut earliest = None;
        let mut turns = Vec::new();
        for (robot, lockstep) in self.locksteps.iter_mut().enumerate() {
            let lockstep = lockstep.as_mut().expect(AT_HOME);
            let next = lockstep.next().map_err(|error| named(error, robot))?;
            let Some((at, deed, index)) = next else {
                continue;
            };
            if earliest.is_none_or(|earliest| at < earliest) {
                earliest = Some(at);
                turns.clear();
            }
            if earliest == Some(at) {
                turns.push(Turn { robot, deed, index });
            }
        }
        Ok(earliest.map(|at| (at, turns)))
    }
}

impl<'robot, P> Task<'robot, P> {
    fn perform(self) -> Done<'robot, P> {
        let Self {
            mut lockstep,
            at,
            turn,
        } = self;
        // Whatever happens the robot comes home.
        let stepped = contain("lockstep", || lockstep.carry_out(at, turn.deed, turn.index));
        Done {
            lockstep,
            turn,
            stepped,
        }
    }
}

fn work<'robot, P>(tasks: Receiver<Task<'robot, P>>, done: &Sender<Done<'robot, P>>) {
    for task in tasks {
        if done.send(task.perform()).is_err() {
            return;
        }
    }
}

fn named(error: Error, robot: usize) -> Error {
    error.context(format!("robot {}", robot + 1))
}
