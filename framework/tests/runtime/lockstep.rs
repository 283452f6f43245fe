//! The virtual clock: order, ties, missed events, same events same bits.

use std::time::Duration;

use framework::driver::lockstep::Step;
use framework::driver::observer::Observer;
use framework::logs::Sink;
use framework::{
    Digest, Event, Finished, Hardware, HardwareContext, Instance, Lockstep, OnFailure, Result,
    Timestamp, Waited,
};
use serde_json::json;

use crate::body::{Mistake, Plan, Setting, robot};
use crate::scripted::{Act, Script, ScriptedHardware, millis};

/// All steps until the end of the world, as (milliseconds, instance, step).
fn steps(
    events: &[(u64, &'static str)],
    setting: &Setting,
) -> (
    Vec<(u64, &'static str, Step)>,
    [framework::cycler::Counts; 2],
) {
    let hardware = ScriptedHardware::lockstep(events.iter().copied());
    let mut robot = robot(&hardware, setting);
    let mut lockstep = Lockstep::new(&mut robot, hardware.as_ref());
    let mut steps = Vec::new();
    while let Some(stepped) = lockstep.step().expect("nothing stops the robot") {
        steps.push((
            stepped.at.as_nanos() / 1_000_000,
            stepped.instance,
            stepped.step,
        ));
    }
    drop(lockstep);
    let counts = [0, 1].map(|index| robot.instances[index].counters().read());
    (steps, counts)
}

const COMPLETED: Step = Step::Finished(Finished::Completed);

#[test]
fn a_cycle_is_wait_begin_run_finish() {
    let plan = Plan::default();
    let setting = Setting {
        legs: plan.clone(),
        ..Setting::default()
    };
    steps(&[(0, "Legs"), (12, "Legs")], &setting);
    let once = ["Legs wait", "Legs begin", "Legs run", "Legs finish"];
    assert_eq!(plan.log.lines(), [once, once].concat());
}

#[test]
fn all_finish_before_all_wait_then_manifest_order() {
    let setting = Setting {
        eye_takes: Some(Duration::from_millis(10)),
        ..Setting::default()
    };
    let (steps, _) = steps(
        &[(0, "Eye"), (0, "Legs"), (10, "Eye"), (10, "Legs")],
        &setting,
    );
    let expected = [
        (0, "Eye", Step::Began),
        (0, "Legs", Step::Began),
        (0, "Legs", COMPLETED),
        (10, "Eye", COMPLETED),
        (10, "Eye", Step::Began),
        (10, "Legs", Step::Began),
        (10, "Legs", COMPLETED),
        (20, "Eye", COMPLETED),
    ];
    assert_eq!(steps, expected);
}

#[test]
fn an_event_of_a_busy_instance_stays_due_and_a_replaced_one_is_missed() {
    let setting = Setting {
        eye_takes: Some(Duration::from_millis(25)),
        ..Setting::default()
    };
    let (steps, [eye, _]) = steps(&[(0, "Eye"), (10, "Eye"), (20, "Eye")], &setting);
    let expected = [
        (0, "Eye", Step::Began),
        (10, "Eye", Step::Postponed),
        (20, "Eye", Step::Postponed),
        (25, "Eye", COMPLETED),
        (25, "Eye", Step::Began),
        (50, "Eye", COMPLETED),
    ];
    assert_eq!(steps, expected);
    assert_eq!((eye.cycles, eye.missed), (2, 1));
}

#[test]
fn cycles_take_as_long_as_somebody_says_and_others_as_the_manifest_does() {
    let setting = Setting {
        eye_takes: Some(Duration::from_millis(10)),
        ear_takes: Some(Duration::from_millis(7)),
        ..Setting::default()
    };
    let hardware = ScriptedHardware::lockstep([(0, "Eye"), (0, "Ear")]);
    let mut robot = robot(&hardware, &setting);
    let finishes = |lockstep: &mut Lockstep<'_, _>| {
        let mut finishes = Vec::new();
        while let Some(stepped) = lockstep.step().expect("nothing stops the robot") {
            if stepped.step == COMPLETED {
                finishes.push((stepped.instance, stepped.at));
            }
        }
        finishes
    };
    let mut lockstep = Lockstep::new(&mut robot, hardware.as_ref())
        .lasting(|instance| (instance.name == "Eye").then_some(Duration::from_millis(100)));
    let begun = lockstep.step().expect("nothing stops the robot");
    assert_eq!(begun.map(|stepped| stepped.step), Some(Step::Began));
    // Where it was left, cycles go on as they were told to last.
    let paused = lockstep.pause();
    let mut lockstep = Lockstep::new(&mut robot, hardware.as_ref()).after(paused);
    let expected = [("Ear", millis(7)), ("Eye", millis(100))];
    assert_eq!(finishes(&mut lockstep), expected);
}

#[test]
fn an_event_at_the_very_finish_begins_then_and_none_is_missed() {
    let setting = Setting {
        eye_takes: Some(Duration::from_millis(10)),
        ..Setting::default()
    };
    let (_, [eye, _]) = steps(&[(0, "Eye"), (10, "Eye"), (20, "Eye")], &setting);
    assert_eq!((eye.cycles, eye.missed), (3, 0));
}

#[test]
fn nothing_coming_is_no_cycle_and_is_counted() {
    let receive = Script::new([Act::NoEvent, Act::Work]);
    let setting = Setting {
        legs: Plan {
            receive,
            ..Plan::default()
        },
        ..Setting::default()
    };
    let (steps, [_, legs]) = steps(&[(0, "Legs"), (12, "Legs")], &setting);
    assert_eq!(steps[0], (0, "Legs", Step::Waited(Waited::NoEvent)));
    assert_eq!((legs.cycles, legs.no_events, legs.failures), (1, 1, 0));
}

#[test]
fn stopped_ends_the_run_in_order() {
    let receive = Script::new([Act::Work, Act::Stopped]);
    let setting = Setting {
        legs: Plan {
            receive,
            ..Plan::default()
        },
        ..Setting::default()
    };
    let hardware = ScriptedHardware::lockstep([(0, "Legs"), (12, "Legs"), (24, "Legs")]);
    let mut robot = robot(&hardware, &setting);
    let mut lockstep = Lockstep::new(&mut robot, hardware.as_ref());
    lockstep
        .run_until(Timestamp::NEVER, |_| ())
        .expect("a stop is no error");
    assert_eq!(lockstep.step().expect("a stop is no error"), None);
    drop(lockstep);
    let legs = robot.instances[1].counters().read();
    assert_eq!((legs.cycles, legs.failures), (1, 0));
    assert_eq!(hardware.log.lines(), ["safe state", "stop"]);
}

#[test]
fn others_see_a_cycle_only_from_its_finish_on_and_transient_before_persistent() {
    let setting = Setting {
        eye_takes: Some(Duration::from_millis(10)),
        ear_takes: Some(Duration::from_millis(28)),
        ..Setting::default()
    };
    let mut events = vec![(10, "Ear"), (12, "Eye")];
    events.extend([15, 22, 30, 38, 50].map(|at| (at, "Legs")));
    let hardware = ScriptedHardware::lockstep(events);
    let mut robot = robot(&hardware, &setting);
    let mut lockstep = Lockstep::new(&mut robot, hardware.as_ref());
    let mut seen = Vec::new();
    while let Some(stepped) = lockstep.step().expect("nothing stops the robot") {
        if stepped.instance == "Legs" && stepped.step == COMPLETED {
            let read = |path| lockstep.robot().read(path).expect("an output");
            seen.push((
                stepped.at.as_nanos() / 1_000_000,
                read("Legs.main_outputs.persistent"),
                read("Legs.main_outputs.transient"),
            ));
        }
    }
    // `Ear` read 0 and gives 1, `Eye` read 1 and gives 2; each instance stands in manifest order.
    let expected = [
        // Both are pending.
        (15, json!([]), json!([])),
        // `Eye` finishes now, but `Ear`, which began earlier, may still come before it.
        (22, json!([]), json!([2])),
        // Again, as long as that is so.
        (30, json!([]), json!([2])),
        // `Ear` finishes now: nothing can come before either of them any more.
        (38, json!([2, 1]), json!([])),
        // Persistent is delivered once.
        (50, json!([]), json!([])),
    ];
    assert_eq!(seen, expected);
}

#[test]
fn an_event_of_an_instance_that_is_left_out_is_told_and_nothing_comes_of_it() {
    let events = [(0, "Legs"), (3, "Ear"), (3, "Legs"), (12, "Legs")];
    let hardware = ScriptedHardware::lockstep(events);
    let mut robot = robot(&hardware, &Setting::default());
    robot.left_out = &["Nose", "Ear"];
    let mut lockstep = Lockstep::new(&mut robot, hardware.as_ref());
    let mut told = Vec::new();
    while let Some(stepped) = lockstep.step().expect("nothing stops the robot") {
        if stepped.step == Step::LeftOut {
            assert_eq!(lockstep.robot().clock.now(), stepped.at);
            told.push((stepped.at, stepped.instance));
        }
    }
    assert_eq!(told, [(millis(3), "Ear")]);
    drop(lockstep);
    assert_eq!(robot.instances[1].counters().read().cycles, 3);
}

#[test]
fn it_is_the_end_of_a_run_then_unless_the_world_has_ended() {
    let hardware = ScriptedHardware::lockstep([(0, "Legs"), (12, "Legs"), (24, "Legs")]);
    let mut robot = robot(&hardware, &Setting::default());
    let clock = robot.clock.clone();
    let mut lockstep = Lockstep::new(&mut robot, hardware.as_ref());
    for (end, now) in [(20, 20), (23, 23), (30, 24)] {
        lockstep
            .run_until(millis(end), |_| ())
            .expect("nothing stops the robot");
        assert_eq!(clock.now(), millis(now), "run until {end} ms");
    }
}

#[test]
fn run_until_includes_its_end_and_observes_finished_cycles() {
    let hardware = ScriptedHardware::lockstep((0..10).map(|number| (number * 10, "Legs")));
    let mut robot = robot(&hardware, &Setting::default());
    let mut lockstep = Lockstep::new(&mut robot, hardware.as_ref());
    let mut observed = Vec::new();
    lockstep
        .run_until(millis(50), |instance| {
            observed.push(instance.cycle().number)
        })
        .expect("nothing stops the robot");
    assert_eq!(observed, [1, 2, 3, 4, 5, 6]);
}

#[test]
fn events_for_nobody_or_in_the_past_are_errors() {
    for events in [vec![(0, "Arms")], vec![(10, "Legs"), (5, "Legs")]] {
        let hardware = ScriptedHardware::lockstep(events);
        let mut robot = robot(&hardware, &Setting::default());
        let mut lockstep = Lockstep::new(&mut robot, hardware.as_ref());
        assert!(lockstep.run_until(Timestamp::NEVER, |_| ()).is_err());
        assert_eq!(hardware.log.lines(), ["safe state", "stop"]);
        assert_eq!(lockstep.step().expect("it has stopped"), None);
    }
}

#[test]
fn a_lockstep_that_is_dropped_abandons_what_has_begun() {
    let eye = Plan::default();
    let setting = Setting {
        eye: eye.clone(),
        eye_takes: Some(Duration::from_millis(10)),
        ..Setting::default()
    };
    let hardware = ScriptedHardware::lockstep([(0, "Eye")]);
    let mut robot = robot(&hardware, &setting);
    Lockstep::new(&mut robot, hardware.as_ref())
        .run_until(millis(5), |_| ())
        .expect("nothing stops the robot");
    let counts = robot.instances[0].counters().read();
    assert_eq!((counts.cycles, counts.abandoned), (0, 1));
    assert_eq!(eye.log.count("Eye abandon"), 1);
}

#[test]
fn a_cycle_that_begins_abandons_the_one_that_was_not_finished() {
    let hardware = ScriptedHardware::lockstep([]);
    let mut robot = robot(&hardware, &Setting::default());
    let eye = robot.instances[0].as_mut();
    for _ in 0..3 {
        assert_eq!(eye.wait().expect("data"), Waited::Ready);
        eye.begin();
        eye.run();
    }
    assert_eq!(eye.finish().expect("no failure"), Finished::Completed);
    let counts = eye.counters().read();
    assert_eq!((counts.cycles, counts.abandoned), (1, 2));
}

#[test]
fn each_driver_needs_its_clock() {
    let hardware = ScriptedHardware::threads();
    let mut robot = robot(&hardware, &Setting::default());
    assert!(Lockstep::new(&mut robot, hardware.as_ref()).step().is_err());
}

fn digest_of_a_run(setting: &Setting) -> Digest {
    digest_of_runs(setting, None, &[Timestamp::NEVER])
}

/// Of one run after the other, each up to its end.
fn digest_of_runs(setting: &Setting, chaos: Option<u64>, ends: &[Timestamp]) -> Digest {
    let mut events: Vec<_> = (0..40).map(|number| (3 + number * 33, "Eye")).collect();
    events.extend((0..120).map(|number| (number * 12, "Legs")));
    events.sort_unstable();
    let hardware = ScriptedHardware::lockstep(events);
    let mut robot = robot(&hardware, setting);
    let mut digest = Digest::new();
    let mut paused = None;
    for end in ends {
        let mut lockstep = Lockstep::new(&mut robot, hardware.as_ref());
        lockstep = match (paused.take(), chaos) {
            (Some(paused), _) => lockstep.after(paused),
            (None, Some(seed)) => lockstep.chaotic(seed),
            (None, None) => lockstep,
        };
        lockstep
            .run_until(*end, |instance| {
                digest
                    .add_cycle(instance)
                    .expect("outputs can be serialised");
            })
            .expect("nothing stops the robot");
        paused = Some(lockstep.pause());
    }
    digest
}

#[test]
fn runs_one_after_the_other_are_as_one() {
    let setting = Setting {
        eye_takes: Some(Duration::from_millis(27)),
        ..Setting::default()
    };
    // The second ends while `Eye` is busy, the third between two events.
    let ends = [millis(0), millis(40), millis(500), Timestamp::NEVER];
    for chaos in [None, Some(7)] {
        let one = digest_of_runs(&setting, chaos, &[Timestamp::NEVER]);
        assert_eq!(digest_of_runs(&setting, chaos, &ends), one, "{chaos:?}");
    }
}

#[test]
fn one_seed_is_the_same_bits_and_another_is_not() {
    let digest = |seed| digest_of_runs(&Setting::default(), Some(seed), &[Timestamp::NEVER]);
    assert_eq!(digest(1), digest(1));
    assert_ne!(digest(1), digest(2));
    assert_ne!(digest(1), digest_of_a_run(&Setting::default()));
}

#[test]
fn same_events_same_bits() {
    let setting = Setting {
        eye_takes: Some(Duration::from_millis(27)),
        ..Setting::default()
    };
    let digest = digest_of_a_run(&setting);
    assert_eq!(digest, digest_of_a_run(&setting));
    assert_ne!(
        digest,
        digest_of_a_run(&Setting::default()),
        "durations matter"
    );
}

#[test]
fn a_node_that_does_not_do_the_same_twice_shows_in_the_bits() {
    for mistake in [Mistake::AsksTheRealTime, Mistake::IteratesAHashMap] {
        let legs = Plan {
            mistake: Some(mistake),
            ..Plan::default()
        };
        let setting = Setting {
            legs,
            ..Setting::default()
        };
        for chaos in [None, Some(1)] {
            let digests = [0; 3].map(|_| digest_of_runs(&setting, chaos, &[Timestamp::NEVER]));
            assert!(
                digests.iter().any(|digest| *digest != digests[0]),
                "{mistake:?}: {digests:?}"
            );
        }
    }
}

#[test]
fn capture_times_never_break_the_order_of_time() {
    let timestamps = |captured: fn(Timestamp) -> Timestamp| {
        let plan = Plan {
            captured: Some(captured),
            ..Plan::default()
        };
        let setting = Setting {
            legs: plan,
            ..Setting::default()
        };
        let hardware = ScriptedHardware::lockstep((1..4).map(|number| (number * 2000, "Legs")));
        let mut robot = robot(&hardware, &setting);
        let mut timestamps = Vec::new();
        Lockstep::new(&mut robot, hardware.as_ref())
            .run_until(Timestamp::NEVER, |instance| {
                timestamps.push(instance.cycle().time.start)
            })
            .expect("nothing stops the robot");
        (timestamps, robot.instances[1].counters().read().corrected)
    };
    let clock = vec![millis(2000), millis(4000), millis(6000)];
    assert_eq!(
        timestamps(|now| now + Duration::from_nanos(1)),
        (clock.clone(), 3),
        "future"
    );
    assert_eq!(timestamps(|_| millis(999)), (clock.clone(), 3), "too old");
    assert_eq!(timestamps(|now| now), (clock.clone(), 0), "in order");
    let constant = |now: Timestamp| {
        if now < millis(3000) {
            now
        } else {
            millis(3000)
        }
    };
    let (timestamps, corrected) = timestamps(constant);
    assert_eq!(
        (timestamps, corrected),
        (vec![millis(2000), millis(3000), millis(6000)], 1)
    );
}

#[test]
fn a_capture_time_not_after_the_last_is_one_nanosecond_later() {
    let plan = Plan {
        captured: Some(|_| millis(50)),
        ..Plan::default()
    };
    let setting = Setting {
        legs: plan,
        ..Setting::default()
    };
    let hardware = ScriptedHardware::lockstep([(60, "Legs"), (72, "Legs"), (84, "Legs")]);
    let mut robot = robot(&hardware, &setting);
    let mut times = Vec::new();
    Lockstep::new(&mut robot, hardware.as_ref())
        .run_until(Timestamp::NEVER, |instance| {
            times.push(instance.cycle().time)
        })
        .expect("nothing stops the robot");
    let starts: Vec<_> = times.iter().map(|time| time.start.as_nanos()).collect();
    assert_eq!(starts, [50_000_000, 50_000_001, 50_000_002]);
    let since_last: Vec<_> = times
        .iter()
        .map(|time| time.since_last.as_nanos())
        .collect();
    assert_eq!(since_last, [0, 1, 1]);
}

/// The steps of two seconds under chaos, in nanoseconds, and what was counted.
fn chaotic(
    seed: u64,
    deadline: Option<Duration>,
) -> (
    Vec<(u64, &'static str, Step)>,
    [framework::cycler::Counts; 2],
) {
    let images = (0..60).map(|number| (number * 33, "Eye"));
    let states = (0..166).map(|number| (number * 12, "Legs"));
    let mut events: Vec<_> = images.chain(states).collect();
    events.sort_by_key(|(at, _)| *at);
    let hardware = ScriptedHardware::lockstep(events);
    let setting = Setting {
        deadline,
        ..Setting::default()
    };
    let mut robot = robot(&hardware, &setting);
    let mut lockstep = Lockstep::new(&mut robot, hardware.as_ref()).chaotic(seed);
    let mut steps = Vec::new();
    while let Some(stepped) = lockstep.step().expect("nothing stops the robot") {
        steps.push((stepped.at.as_nanos(), stepped.instance, stepped.step));
    }
    drop(lockstep);
    let counts = [0, 1].map(|index| robot.instances[index].counters().read());
    (steps, counts)
}

#[test]
fn chaos_delays_what_happens_and_loses_nothing() {
    let (steps, [eye, legs]) = chaotic(7, None);
    assert_eq!((eye.cycles, eye.missed), (60, 0));
    assert_eq!((legs.cycles, legs.missed), (166, 0));
    let began = |instance| {
        let all = steps.iter();
        let began = all.filter(move |(_, name, step)| *name == instance && *step == Step::Began);
        began.map(|(at, ..)| *at)
    };
    let late = began("Eye")
        .zip(0..)
        .map(|(at, number)| at - number * millis(33).as_nanos());
    let late: Vec<_> = late.collect();
    assert!(
        late.iter().all(|late| *late <= millis(2).as_nanos()),
        "{late:?}"
    );
    assert!(
        late.iter().any(|late| *late > millis(1).as_nanos()),
        "{late:?}"
    );
    assert!(steps.is_sorted_by_key(|(at, ..)| *at));
}

#[test]
fn data_faster_than_waking_up_still_wakes_in_time() {
    let hardware = ScriptedHardware::lockstep((0..200).map(|number| (number, "Eye")));
    let setting = Setting {
        deadline: Some(Duration::ZERO),
        ..Setting::default()
    };
    let mut robot = robot(&hardware, &setting);
    let mut lockstep = Lockstep::new(&mut robot, hardware.as_ref()).chaotic(7);
    let (mut came, mut waited, mut began) = (None, Vec::new(), 0);
    while let Some(stepped) = lockstep.step().expect("nothing stops the robot") {
        match stepped.step {
            Step::Postponed => came = came.or(Some(stepped.at)),
            Step::Began => {
                began += 1;
                waited.extend(came.take().map(|came| stepped.at - came));
            }
            _ => {}
        }
    }
    drop(lockstep);
    let longest = waited.iter().max().expect("it began");
    assert!(*longest <= Duration::from_millis(2), "{longest:?}");
    let eye = robot.instances[0].counters().read();
    assert!(eye.missed > 0, "data came more often than it woke");
    assert_eq!((eye.cycles, eye.cycles + eye.missed), (began, 200));
}

#[test]
fn one_seed_is_one_chaos() {
    assert_eq!(chaotic(1, None).0, chaotic(1, None).0);
    assert_ne!(chaotic(1, None).0, chaotic(2, None).0);
}

/// From `begin` to `finish` of each cycle.
fn durations(steps: &[(u64, &'static str, Step)], instance: &str) -> Vec<Duration> {
    let at = |wanted: Step| {
        let steps = steps.iter();
        let steps = steps.filter(move |(_, name, step)| *name == instance && *step == wanted);
        steps.map(|(at, ..)| *at)
    };
    let cycles = at(Step::Began).zip(at(COMPLETED));
    cycles
        .map(|(began, finished)| Duration::from_nanos(finished - began))
        .collect()
}

fn assert_drawn_up_to(greatest: Duration, durations: &[Duration]) {
    let within = |from, to| durations.iter().any(|one| (from..=to).contains(one));
    assert!(
        durations.iter().all(|one| *one <= greatest),
        "{durations:?}"
    );
    assert!(within(Duration::ZERO, greatest / 4), "{durations:?}");
    assert!(within(greatest * 3 / 4, greatest), "{durations:?}");
}

#[test]
fn cycles_in_chaos_take_up_to_the_deadline_or_half_of_it_in_real_time() {
    let deadline = Duration::from_millis(12);
    let (steps, [eye, legs]) = chaotic(7, Some(deadline));
    assert_eq!((eye.missed, legs.missed), (0, 0));
    let (eye, legs) = (durations(&steps, "Eye"), durations(&steps, "Legs"));
    assert_eq!((eye.len(), legs.len()), (60, 166));
    assert_drawn_up_to(deadline, &eye);
    assert_drawn_up_to(deadline / 2, &legs);
}

#[test]
fn cycles_in_chaos_without_deadline_take_up_to_20_ms() {
    let (steps, _) = chaotic(7, None);
    assert_drawn_up_to(Duration::from_millis(20), &durations(&steps, "Eye"));
}

/// Says something whenever a cycle is published.
struct Publishing;

impl Observer for Publishing {
    fn finished(&mut self, _: &dyn Instance) {
        tracing::info!(target: "publishing", "one more");
    }
}

/// Says something whenever it is asked for what comes next.
struct Talking<'hardware>(&'hardware ScriptedHardware);

impl Hardware for Talking<'_> {
    fn new(_: HardwareContext) -> Result<Self> {
        Err("it stands before another one".into())
    }

    fn stop(&self) {}

    fn enter_safe_state(&self) {}

    fn next_event(&self) -> Result<Option<Event>> {
        tracing::info!(target: "talking", "the next one");
        self.0.next_event()
    }
}

#[test]
fn what_is_said_between_two_cycles_is_of_no_other_instance() {
    let legs = Plan {
        work: Script::new([Act::Fail]),
        create: Script::new([Act::Say("anew")]),
        ..Plan::default()
    };
    let setting = Setting {
        legs,
        on_failure: OnFailure::Restart,
        ..Setting::default()
    };
    let hardware = ScriptedHardware::lockstep([(0, "Legs"), (50, "Eye"), (200, "Legs")]);
    let mut robot = robot(&hardware, &setting);
    let sink = Sink::new(hardware.clock.clone());
    let talking = Talking(&hardware);
    let lockstep = Lockstep::new(&mut robot, &talking);
    let mut lockstep = lockstep.observed(|_| Some(Box::new(Publishing)));
    while lockstep.step().expect("nothing stops it").is_some() {}
    let said: Vec<_> = std::iter::from_fn(|| sink.take()).collect();
    let places = |module| -> Vec<_> {
        let said = said.iter().filter(|said| said.module == module);
        said.map(|said| (said.instance.as_deref(), said.cycle))
            .collect()
    };
    assert_eq!(places("talking"), [(None, None); 4]);
    assert_eq!(places("scripted"), [(Some("Legs"), Some(2))]);
    let published = [(Some("Eye"), Some(1)), (Some("Legs"), Some(2))];
    assert_eq!(places("publishing"), published);
}
