//! Observers see the same under both drivers: every cycle at its capture point, and again when it was published.

use std::time::Duration;

use framework::cycler::InstanceDescription;
use framework::driver::{Observer, Threads};
use framework::{Error, Instance, Lockstep, OnFailure, Stop, Timestamp};

use crate::body::{Plan, Setting, robot};
use crate::scripted::{Act, Log, Script, ScriptedHardware};

/// Writes down what it sees, between what the nodes write down.
struct Writing {
    log: Log,
    panics: bool,
}

impl Observer for Writing {
    fn begun(&mut self, instance: &mut dyn Instance) {
        let mut references = Vec::new();
        instance.references(&mut |reference| references.push(reference.instance));
        let mut states = 0;
        instance.states(&mut |_, _| states += 1);
        let number = instance.cycle().number;
        let line = format!("begun {number} with {references:?} and {states} states");
        self.log.add(line);
        assert!(!self.panics, "nowhere to write");
    }

    fn finished(&mut self, instance: &dyn Instance) {
        let value = instance.main_output("value").is_some();
        let number = instance.cycle().number;
        self.log
            .add(format!("finished {number}, has value: {value}"));
    }
}

/// An observer for `Legs` alone.
fn of_legs(
    log: &Log,
    panics: bool,
) -> impl FnMut(&InstanceDescription) -> Option<Box<dyn Observer>> {
    let log = log.clone();
    move |instance| {
        let writing = Writing {
            log: log.clone(),
            panics,
        };
        (instance.name == "Legs").then(|| Box::new(writing) as _)
    }
}

/// The second cycle of `Legs` is abandoned.
fn setting() -> (Setting, Log) {
    let legs = Plan {
        work: Script::new([Act::Work, Act::Fail]),
        ..Plan::default()
    };
    let log = legs.log.clone();
    let setting = Setting {
        legs,
        on_failure: OnFailure::Restart,
        ..Setting::default()
    };
    (setting, log)
}

fn assert_seen(log: &Log) {
    let begun = |number| format!("begun {number} with [\"parameters\"] and 2 states");
    let expected = [
        "Legs wait",
        "Legs begin",
        &begun(1),
        "Legs run",
        "Legs finish",
        "finished 1, has value: true",
        "Legs wait",
        "Legs begin",
        &begun(2),
        "Legs run",
        "Legs abandon",
        "Legs create",
        "Legs wait",
        "Legs begin",
        &begun(3),
        "Legs run",
        "Legs finish",
        "finished 3, has value: true",
    ];
    assert_eq!(log.lines()[..expected.len()], expected);
}

fn run_threads(
    setting: &Setting,
    cycles: u64,
    observer_of: impl FnMut(&InstanceDescription) -> Option<Box<dyn Observer>>,
) -> (Result<(), Error>, Vec<String>, framework::cycler::Counts) {
    let hardware = ScriptedHardware::threads();
    let mut robot = robot(&hardware, setting);
    let legs = robot.instances[1].counters().clone();
    let stop = Stop::new();
    let result = std::thread::scope(|scope| {
        scope.spawn(|| {
            while legs.cycles.get() < cycles && stop.wait(Duration::from_millis(1)).is_ok() {}
            stop.request();
        });
        Threads::new(&robot.clock, hardware.as_ref(), &stop)
            .run_observed(&mut robot.instances, observer_of)
    });
    (result, hardware.log.lines(), legs.read())
}

#[test]
fn lockstep_shows_every_cycle_at_its_capture_point_and_when_it_was_published() {
    let (setting, log) = setting();
    let hardware = ScriptedHardware::lockstep([(0, "Legs"), (12, "Legs"), (200, "Legs")]);
    let mut robot = robot(&hardware, &setting);
    Lockstep::new(&mut robot, hardware.as_ref())
        .observed(of_legs(&log, false))
        .run_until(Timestamp::NEVER, |_| ())
        .expect("nothing stops the robot");
    assert_seen(&log);
}

#[test]
fn threads_show_every_cycle_at_its_capture_point_and_when_it_was_published() {
    let (mut setting, log) = setting();
    // A queue of perception would refer to cycles that no test can foresee.
    setting.eye.receive = Script::new([Act::Take(400)]);
    let (result, ..) = run_threads(&setting, 2, of_legs(&log, false));
    result.expect("nothing stopped the robot");
    assert_seen(&log);
}

#[test]
fn an_observer_that_panics_stops_the_robot_in_order() {
    let log = Log::default();
    let (result, lines, counts) = run_threads(&Setting::default(), u64::MAX, of_legs(&log, true));
    let error = result.expect_err("the observer panicked").to_string();
    assert!(
        error.contains("Legs failed") && error.contains("nowhere to write"),
        "{error}"
    );
    assert_eq!(lines, ["safe state", "stop"]);
    assert_eq!((counts.cycles, counts.abandoned), (0, 1));

    let hardware = ScriptedHardware::lockstep([(0, "Legs")]);
    let mut robot = robot(&hardware, &Setting::default());
    let result = Lockstep::new(&mut robot, hardware.as_ref())
        .observed(of_legs(&log, true))
        .run_until(Timestamp::NEVER, |_| ());
    assert!(result.is_err());
    assert_eq!(hardware.log.lines(), ["safe state", "stop"]);
    assert_eq!(robot.instances[1].counters().read().abandoned, 1);
}
