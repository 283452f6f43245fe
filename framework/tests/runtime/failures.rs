//! Stop, restart, skip, hold: what the failure of a node does, and what it does not.

use std::time::Duration;

use framework::driver::lockstep::Step;
use framework::{
    Cycle, CycleTime, Error, Finished, Given, Guarded, Held, Lockstep, OnFailure, Robot,
    State as _, Timestamp, Waited,
};
use serde_json::Value;

use crate::body::{Parameters, Plan, Setting, robot};
use crate::scripted::{Act, Log, Script, ScriptedHardware, millis};

struct Ran {
    robot: Robot<Parameters>,
    steps: Vec<(u64, &'static str, Step)>,
    values: Vec<u64>,
    error: Option<Error>,
    hardware_log: Log,
}

impl Ran {
    fn legs(&self) -> framework::cycler::Counts {
        self.robot.instances[1].counters().read()
    }
}

/// Lets `Legs` run every 12 ms.
fn run(plan: &Plan, on_failure: OnFailure, cycles: u64) -> Ran {
    let setting = Setting {
        legs: plan.clone(),
        on_failure,
        ..Setting::default()
    };
    let hardware = ScriptedHardware::lockstep((0..cycles).map(|number| (number * 12, "Legs")));
    let mut robot = robot(&hardware, &setting);
    let mut lockstep = Lockstep::new(&mut robot, hardware.as_ref());
    let (mut steps, mut values) = (Vec::new(), Vec::new());
    let error = loop {
        match lockstep.step() {
            Ok(Some(stepped)) => {
                let at = stepped.at.as_nanos() / 1_000_000;
                steps.push((at, stepped.instance, stepped.step));
                if matches!(
                    stepped.step,
                    Step::Finished(Finished::Completed | Finished::Recovered)
                ) {
                    let value = lockstep.robot().read("Legs.main_outputs.value");
                    values.push(value.expect("an output").as_u64().expect("a number"));
                }
            }
            Ok(None) => break None,
            Err(error) => break Some(error),
        }
    };
    drop(lockstep);
    Ran {
        robot,
        steps,
        values,
        error,
        hardware_log: hardware.log.clone(),
    }
}

fn works(acts: impl IntoIterator<Item = Act>) -> Plan {
    Plan {
        work: Script::new(acts),
        ..Plan::default()
    }
}

fn receives(acts: impl IntoIterator<Item = Act>) -> Plan {
    Plan {
        receive: Script::new(acts),
        ..Plan::default()
    }
}

#[test]
fn stop_ends_the_robot_in_order_with_the_nodes_name() {
    for act in [Act::Fail, Act::Panic] {
        let plan = works([Act::Work, act]);
        let ran = run(&plan, OnFailure::Stop, 5);
        let error = ran.error.as_ref().expect("the robot stopped").to_string();
        assert!(
            error.contains("node `test::worker`") && error.contains("as scripted"),
            "{error}"
        );
        assert!(error.contains("Legs failed at 0.012"), "{error}");
        assert_eq!(
            ran.error
                .and_then(|error| error.node().map(str::to_owned))
                .as_deref(),
            Some("test::worker")
        );
        assert_eq!(ran.values.len(), 1);
        assert_eq!(ran.hardware_log.lines(), ["safe state", "stop"]);
        assert_eq!(plan.log.count("Legs abandon"), 1);
    }
}

#[test]
fn skip_takes_defaults_for_this_cycle_and_the_cycle_counts() {
    for act in [Act::Fail, Act::Panic] {
        let ran = run(&works([Act::Work, act, Act::Work]), OnFailure::Skip, 4);
        assert!(ran.error.is_none());
        assert_eq!(ran.values, [1, 0, 3, 4]);
        assert_eq!(
            (ran.legs().cycles, ran.legs().failures, ran.legs().abandoned),
            (4, 1, 0)
        );
    }
}

#[test]
fn hold_repeats_the_last_good_outputs_for_a_tenth_of_a_second() {
    let ran = run(
        &works([Act::Work, Act::Work].into_iter().chain([Act::Fail; 12])),
        OnFailure::Hold,
        15,
    );
    // The last good cycle is at 12 ms, so up to 112 ms its value is held: eight cycles.
    let mut expected = vec![1, 2];
    expected.extend([2; 8]);
    expected.extend([0; 4]);
    expected.push(15);
    assert_eq!(ran.values, expected);
    assert_eq!(ran.legs().failures, 12);
}

#[test]
fn a_hold_that_was_never_good_is_a_skip() {
    assert_eq!(run(&works([Act::Fail]), OnFailure::Hold, 2).values, [0, 2]);
}

#[test]
fn a_panicked_node_is_created_anew_before_its_next_call() {
    let mut ran = run(
        &works([Act::Work, Act::Work, Act::Panic]),
        OnFailure::Skip,
        4,
    );
    let mut saved = Vec::new();
    ran.robot.instances[1].states(&mut |name, state| {
        let mut text = Vec::new();
        let mut serializer = serde_json::Serializer::new(&mut text);
        let mut erased = <dyn erased_serde::Serializer>::erase(&mut serializer);
        state.save(&mut erased).expect("states can be saved");
        saved.push((name, String::from_utf8(text).expect("JSON is text")));
    });
    // Its calls before the panic are forgotten; the other node's are not.
    let expected = [
        ("test::receiver", r#"{"received":4}"#),
        ("test::worker", r#"{"calls":1}"#),
    ];
    let saved: Vec<_> = saved
        .iter()
        .map(|(name, text)| (*name, text.as_str()))
        .collect();
    assert_eq!(saved, expected);
    let report = ran.robot.instances[1].report();
    assert_eq!(
        (report.nodes[1].calls, report.nodes[1].failures),
        (4, 1),
        "counts survive"
    );
}

#[test]
fn restart_abandons_the_cycle_and_creates_everything_anew_after_the_back_off() {
    for act in [Act::Fail, Act::Panic] {
        let plan = works([Act::Work, act]);
        let ran = run(&plan, OnFailure::Restart, 14);
        assert!(ran.error.is_none());
        let restarting = Step::Finished(Finished::Restarting { at: millis(112) });
        assert!(
            ran.steps.contains(&(12, "Legs", restarting)),
            "{:?}",
            ran.steps
        );
        // Events from 24 ms to 108 ms came while it was down: the last of eight is due at the restart.
        assert!(
            ran.steps.contains(&(112, "Legs", Step::Began)),
            "{:?}",
            ran.steps
        );
        assert_eq!(plan.log.count("Legs create"), 1);
        let legs = ran.legs();
        assert_eq!(
            (legs.restarts, legs.abandoned, legs.failures, legs.missed),
            (1, 1, 1, 7)
        );
        assert_eq!(legs.cycles, ran.values.len() as u64);
        assert_eq!(ran.hardware_log.lines()[..2], ["safe state", "rearm"]);
        let report = ran.robot.instances[1].report();
        assert_eq!(
            report.nodes[1].calls,
            legs.cycles + legs.abandoned,
            "counts survive"
        );
    }
}

#[test]
fn since_last_is_zero_in_the_first_cycle_and_after_a_restart() {
    let setting = Setting {
        legs: works([Act::Work, Act::Work, Act::Fail]),
        on_failure: OnFailure::Restart,
        ..Setting::default()
    };
    let hardware = ScriptedHardware::lockstep((0..16).map(|number| (number * 12, "Legs")));
    let mut robot = robot(&hardware, &setting);
    let mut since_last = Vec::new();
    Lockstep::new(&mut robot, hardware.as_ref())
        .run_until(Timestamp::NEVER, |instance| {
            since_last.push(instance.cycle().time.since_last)
        })
        .expect("nothing stops the robot");
    let zeros: Vec<_> = (0..since_last.len())
        .filter(|index| since_last[*index].is_zero())
        .collect();
    assert_eq!(zeros, [0, 2]);
}

#[test]
fn a_restart_that_fails_is_tried_again_later_and_the_fifth_failure_in_a_minute_is_for_good() {
    let again = Plan {
        create: Script::new([Act::Fail, Act::Panic]),
        ..works([Act::Fail])
    };
    let ran = run(&again, OnFailure::Restart, 100);
    assert!(ran.error.is_none());
    // 0.1 s, 0.2 s and 0.4 s after one another.
    assert!(
        ran.steps.contains(&(700, "Legs", Step::Began)),
        "{:?}",
        ran.steps
    );
    assert_eq!((ran.legs().restarts, ran.legs().failures), (3, 3));

    let ran = run(&works([Act::Fail; 5]), OnFailure::Restart, 1000);
    let error = ran.error.as_ref().expect("the robot stopped").to_string();
    assert!(
        error.contains("too often within a minute") && error.contains("test::worker"),
        "{error}"
    );
    assert_eq!(ran.legs().restarts, 4);
    // Once for the restarts; the stop finds the hardware in safe state already, unless a cycle ended well in between.
    assert_eq!(ran.hardware_log.lines(), ["safe state", "stop"]);
}

#[test]
fn a_setup_node_that_fails_under_skip_is_no_cycle_and_starts_over() {
    for (on_failure, act) in [
        (OnFailure::Skip, Act::Fail),
        (OnFailure::Hold, Act::Fail),
        (OnFailure::Skip, Act::Panic),
    ] {
        let ran = run(&receives([Act::Work, act, act]), on_failure, 4);
        assert!(ran.error.is_none());
        assert_eq!(ran.steps[2], (12, "Legs", Step::Waited(Waited::Failed)));
        let legs = ran.legs();
        assert_eq!((legs.cycles, legs.failures, legs.abandoned), (2, 2, 0));
    }
}

#[test]
fn a_setup_node_that_fails_under_stop_or_restart_does_that() {
    let error = run(&receives([Act::Fail]), OnFailure::Stop, 2)
        .error
        .expect("the robot stopped");
    assert_eq!(error.node(), Some("test::receiver"));
    let ran = run(&receives([Act::Panic]), OnFailure::Restart, 20);
    assert!(ran.error.is_none());
    assert_eq!(
        ran.steps[0],
        (
            0,
            "Legs",
            Step::Waited(Waited::Restarting { at: millis(100) })
        )
    );
    assert_eq!(ran.legs().restarts, 1);
}

#[test]
fn no_event_of_a_node_that_is_no_setup_node_is_its_failure() {
    let plan = works([Act::Work, Act::NoEvent]);
    let ran = run(&plan, OnFailure::Skip, 3);
    assert!(ran.error.is_none());
    assert_eq!(ran.values, [1, 0, 3]);
    let legs = ran.legs();
    assert_eq!((legs.failures, legs.no_events, legs.abandoned), (1, 0, 0));

    let plan = works([Act::Work, Act::Work, Act::NoEvent]);
    let ran = run(&plan, OnFailure::Hold, 3);
    assert_eq!(ran.values, [1, 2, 2]);

    let ran = run(&works([Act::NoEvent]), OnFailure::Stop, 3);
    let error = ran.error.expect("the robot stopped");
    assert_eq!(error.node(), Some("test::worker"));

    let ran = run(&works([Act::NoEvent]), OnFailure::Restart, 20);
    assert!(ran.error.is_none());
    let legs = ran.legs();
    assert_eq!((legs.restarts, legs.failures, legs.no_events), (1, 1, 0));
}

#[test]
fn a_node_that_could_not_be_created_anew_says_why_in_its_next_failure() {
    let mut node = Guarded::new("test::worker", OnFailure::Skip, 0_u32);
    let cycle = Cycle::default();
    let panicked = node.call_or_skip(&cycle, |_| -> framework::Result<()> {
        Act::Panic.perform()
    });
    assert!(panicked.expect("it is skipped").is_none());
    node.renew_if_broken(|| Err(Error::new("no such camera")))
        .expect("the next call fails");
    let work = |node: &mut u32| -> framework::Result<u32> {
        *node += 1;
        Ok(*node)
    };
    let message = node
        .call(&cycle, work)
        .expect_err("it is broken")
        .to_string();
    assert_eq!(
        message,
        "node `test::worker` in cycle 0: it panicked and could not be created anew: no such camera"
    );
    let report = node.report();
    assert_eq!((report.calls, report.failures), (2, 2));
    node.renew_if_broken(|| Ok(7)).expect("it can be created");
    assert_eq!(node.call(&cycle, work).expect("it works again"), 8);
}

#[test]
fn a_failed_perception_cycle_is_abandoned_and_nobody_waits_for_it() {
    let setting = Setting {
        eye: works([Act::Work, Act::Fail]),
        on_failure: OnFailure::Restart,
        eye_takes: Some(Duration::from_millis(5)),
        ..Setting::default()
    };
    let events = [
        (0, "Eye"),
        (6, "Legs"),
        (10, "Eye"),
        (12, "Legs"),
        (18, "Legs"),
        (200, "Eye"),
        (210, "Legs"),
    ];
    let hardware = ScriptedHardware::lockstep(events);
    let mut robot = robot(&hardware, &setting);
    Lockstep::new(&mut robot, hardware.as_ref())
        .run_until(Timestamp::NEVER, |_| ())
        .expect("nothing stops it");
    let eye = robot.instances[0].counters().read();
    assert_eq!((eye.cycles, eye.abandoned), (2, 1));
    let queue = robot.instances[1].report().queues[0].counts;
    assert_eq!((queue.delivered, queue.abandoned, queue.dropped), (2, 1, 0));
    assert!(
        !hardware.log.lines()[..].iter().any(|line| line == "rearm"),
        "perception commands no actuators"
    );
}

/// As a recording does it: state and condition, by way of a format.
fn saved(node: &Guarded<u32>) -> [String; 2] {
    let mut state = Vec::new();
    let mut json = serde_json::Serializer::new(&mut state);
    node.save(&mut <dyn erased_serde::Serializer>::erase(&mut json))
        .expect("a number serialises");
    let condition = serde_json::to_string(&node.condition()).expect("it serialises");
    [String::from_utf8(state).expect("JSON is text"), condition]
}

fn loaded([state, condition]: &[String; 2]) -> Guarded<u32> {
    let mut node = Guarded::new("test::worker", OnFailure::Hold, 0);
    let state: Value = serde_json::from_str(state).expect("it was saved");
    node.load(&Given::from(&state)).expect("it was saved");
    node.set_condition(serde_json::from_str(condition).expect("it was saved"));
    node
}

#[test]
fn what_failures_left_behind_is_saved_beside_the_state() {
    let at = |time| Cycle {
        time: CycleTime {
            start: millis(time),
            ..CycleTime::default()
        },
        ..Cycle::default()
    };
    let count = |node: &mut u32| -> framework::Result<u32> {
        *node += 1;
        Ok(*node)
    };
    let fail = |_: &mut u32| -> framework::Result<u32> { Err(Error::new("as scripted")) };
    let mut node = Guarded::new("test::worker", OnFailure::Hold, 7_u32);
    let good = saved(&node);
    node.call_or_hold(&at(10), count).expect("it works");
    let held = saved(&node);
    let panicked = node.call_or_hold(&at(20), |_| -> framework::Result<u32> { panic!("once") });
    assert_eq!(panicked.expect("held"), Held::Hold);
    let broken = saved(&node);

    // Where nothing was good there is nothing to hold, else for 100 ms from there.
    for (saved, time, expected) in [
        (&good, 20, Held::Skip),
        (&held, 110, Held::Hold),
        (&held, 111, Held::Skip),
    ] {
        let called = loaded(saved).call_or_hold(&at(time), fail);
        assert_eq!(called.expect("held"), expected, "{saved:?}");
    }
    // What panicked is not called before it is created anew.
    let mut node = loaded(&broken);
    let called = node.call_or_hold(&at(30), count);
    assert_eq!(called.expect("held"), Held::Hold);
    node.renew_if_broken(|| Ok(40)).expect("it can be created");
    let called = node.call_or_hold(&at(40), count);
    assert_eq!(called.expect("it works"), Held::Written(41));
    let called = loaded(&held).call_or_hold(&at(30), count);
    assert_eq!(called.expect("it works"), Held::Written(9));
}

#[test]
fn an_absent_required_input_is_a_skip_and_no_failure() {
    let ran = run(
        &Plan {
            required_is_absent: true,
            ..Plan::default()
        },
        OnFailure::Stop,
        3,
    );
    let legs = ran.legs();
    assert_eq!((legs.cycles, legs.skipped, legs.failures), (3, 3, 0));
    let report = ran.robot.instances[1].report();
    assert_eq!((report.nodes[1].calls, report.nodes[1].skipped), (0, 3));
}
