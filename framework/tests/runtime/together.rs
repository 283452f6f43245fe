//! Several robots in one world: the number of threads changes no bit.

use std::sync::atomic::AtomicU64;
use std::sync::{Arc, Mutex};
use std::thread::ThreadId;
use std::time::Duration;

use framework::cycler::Counts;
use framework::driver::observer::Observer;
use framework::logs::Sink;
use framework::{Digest, Instance, Lockstep, Result, Timestamp, Together};

use crate::body::{Plan, Setting, robot};
use crate::scripted::{Act, Script, ScriptedHardware, millis};

const ROBOTS: usize = 4;

/// What came of four robots that share a world.
#[derive(Debug, PartialEq)]
struct Ran {
    digest: Digest,
    /// Which robot finished a cycle of which instance, in the order that was observed.
    finished: Vec<(usize, &'static str)>,
    counts: Vec<Counts>,
    clocks: Vec<Timestamp>,
    error: Option<String>,
    threads: usize,
}

/// Notes on which threads cycles begin.
struct Noting<'run>(&'run Mutex<Vec<ThreadId>>);

impl Observer for Noting<'_> {
    fn begun(&mut self, _: &mut dyn Instance) {
        let mut noted = self.0.lock().expect("not poisoned");
        let thread = std::thread::current().id();
        if !noted.contains(&thread) {
            noted.push(thread);
        }
    }
}

/// Says whose cycle begins.
struct Saying(usize);

impl Observer for Saying {
    fn begun(&mut self, _: &mut dyn Instance) {
        tracing::warn!(target: "together", robot = self.0, "a cycle begins");
    }
}

/// Two run in step, one is a little behind, one has other images; each draws a chaos of its own.
fn run(threads: usize, chaos: Option<u64>, fails: bool) -> Ran {
    let world = Arc::new(AtomicU64::new(0));
    let hardwares = [0, 0, 1, 0].map(|behind| {
        let mut events: Vec<_> = (0..30).map(|one| (behind + 3 + one * 33, "Eye")).collect();
        events.extend((0..90).map(|one| (behind + one * 12, "Legs")));
        events.sort_unstable();
        let hardware = ScriptedHardware::lockstep(events);
        let mut hardware = Arc::into_inner(hardware).expect("nobody else has it");
        hardware.world = Some(world.clone());
        Arc::new(hardware)
    });
    let mut robots: Vec<_> = (hardwares.iter().enumerate())
        .map(|(number, hardware)| {
            let acts = if fails && number == 2 {
                vec![Act::Fail]
            } else {
                Vec::new()
            };
            let setting = Setting {
                legs: Plan {
                    work: Script::new(acts),
                    ..Plan::default()
                },
                eye_takes: Some(Duration::from_millis(if number == 3 { 27 } else { 11 })),
                ..Setting::default()
            };
            robot(hardware, &setting)
        })
        .collect();
    let noted = Mutex::default();
    let locksteps = robots.iter_mut().zip(&hardwares).zip(0..);
    let locksteps = locksteps.map(|((robot, hardware), number)| {
        let lockstep = Lockstep::new(robot, hardware.as_ref());
        let lockstep = lockstep.observed(|_| Some(Box::new(Noting(&noted))));
        match chaos {
            Some(seed) => lockstep.chaotic(seed + number),
            None => lockstep,
        }
    });
    let mut together = Together::new(locksteps.collect(), threads);
    let (mut digest, mut finished) = (Digest::new(), Vec::new());
    // In two runs, of which the first ends amid cycles.
    let mut run = |end| -> Result<()> {
        together.run_until(end, |robot, instance| {
            digest
                .add_cycle(instance)
                .expect("outputs can be serialised");
            finished.push((robot, instance.description().name));
        })
    };
    let error = run(millis(500)).and_then(|()| run(millis(900))).err();
    drop(together);
    Ran {
        digest,
        finished,
        counts: robots
            .iter()
            .flat_map(|robot| &robot.instances)
            .map(|one| one.counters().read())
            .collect(),
        clocks: hardwares
            .iter()
            .map(|hardware| hardware.clock.now())
            .collect(),
        error: error.map(|error| error.to_string()),
        threads: noted.into_inner().expect("not poisoned").len(),
    }
}

#[test]
fn the_number_of_threads_changes_no_bit() {
    for chaos in [None, Some(7)] {
        let one = run(1, chaos, false);
        assert!(one.error.is_none(), "{:?}", one.error);
        assert_eq!((one.threads, one.clocks.len()), (1, ROBOTS));
        assert!(
            one.clocks.iter().all(|now| *now == millis(900)),
            "{:?}",
            one.clocks
        );
        assert!(one.finished.len() > 390, "{} cycles", one.finished.len());
        for threads in [2, 4, 4] {
            let several = run(threads, chaos, false);
            // Each of the two runs has threads of its own; three robots at least are at one time.
            let used = several.threads;
            assert!(chaos.is_some() || used >= 2 * threads.min(3), "{used}");
            assert_eq!(
                Ran {
                    threads: 1,
                    ..several
                },
                one,
                "{threads} threads"
            );
        }
    }
    assert_ne!(run(1, None, false).digest, run(1, Some(7), false).digest);
}

#[test]
fn robots_at_one_time_are_observed_in_their_order() {
    let finished = run(4, None, false).finished;
    let legs = [(0, "Legs"), (1, "Legs"), (3, "Legs"), (2, "Legs")];
    assert_eq!(finished[..4], legs);
}

#[test]
fn the_robot_that_fails_is_named_and_ends_the_run_for_all() {
    let one = run(1, None, true);
    let error = one.error.as_deref().expect("the third stops");
    assert!(
        error.contains("robot 3") && error.contains("as scripted"),
        "{error}"
    );
    assert_eq!(one.counts[2 * 2 + 1].abandoned, 1);
    let four = run(4, None, true);
    assert_eq!(
        Ran {
            threads: one.threads,
            ..four
        },
        one
    );
}

#[test]
fn each_robot_hears_itself_on_whatever_thread_it_lives() {
    for threads in [1, 2] {
        let events = || (0..20).map(|one| (one * 12, "Legs"));
        let hardwares = [(); 2].map(|()| ScriptedHardware::lockstep(events()));
        let setting = Setting::default();
        let mut robots =
            (hardwares.iter().map(|hardware| robot(hardware, &setting))).collect::<Vec<_>>();
        let sinks = hardwares
            .each_ref()
            .map(|hardware| Sink::new(hardware.clock.clone()));
        let locksteps = robots.iter_mut().zip(&hardwares).zip(0..);
        let locksteps = locksteps.map(|((robot, hardware), number)| {
            let lockstep = Lockstep::new(robot, hardware.as_ref());
            lockstep.observed(move |_| Some(Box::new(Saying(number))))
        });
        let mut together = Together::new(locksteps.collect(), threads);
        together
            .run_until(millis(500), |_, _| {})
            .expect("nothing fails");
        for (sink, robot) in sinks.iter().zip(0..) {
            let said = std::iter::from_fn(|| sink.take()).filter(|said| said.module == "together");
            let whose: Vec<_> = said.map(|said| said.fields["robot"].as_u64()).collect();
            assert_eq!(whose, [Some(robot); 20], "{threads} threads");
        }
    }
}
