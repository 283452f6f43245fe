//! What clients may do: inject, subscribe, call, read, change parameters.

use std::time::Duration;

use framework::parameters::Version;
use framework::{Given, Lockstep, Robot};
use serde_json::{Value, json};

use crate::body::{Parameters, Plan, Setting, robot};
use crate::scripted::{ScriptedHardware, millis};

const EVENTS: u64 = 12;

/// `Legs` run at 0, 10, 20 … ms; `between` is called before each of them.
fn run(
    setting: &Setting,
    mut between: impl FnMut(u64, &mut Robot<Parameters>),
) -> Robot<Parameters> {
    let hardware = ScriptedHardware::lockstep((0..EVENTS).map(|number| (number * 10, "Legs")));
    let mut robot = robot(&hardware, setting);
    let mut lockstep = Lockstep::new(&mut robot, hardware.as_ref());
    for number in 0..EVENTS {
        between(number, lockstep.robot_mut());
        lockstep
            .run_until(millis(number * 10), |_| ())
            .expect("nothing stops the robot");
    }
    drop(lockstep);
    robot
}

fn inject(robot: &mut Robot<Parameters>, output: &str, value: &Value) -> framework::Result<()> {
    let access = robot.access("Legs")?;
    access.injector.inject(output, &Given::from(value))
}

fn read(robot: &Robot<Parameters>, path: &str) -> Value {
    robot.read(path).expect("an output")
}

#[test]
fn an_injected_value_replaces_an_output_in_the_same_cycle_and_is_released() {
    run(&Setting::default(), |number, robot| {
        let legs = |robot: &Robot<_>| {
            (
                read(robot, "Legs.main_outputs.raw"),
                read(robot, "Legs.main_outputs.value"),
            )
        };
        match number {
            1 => inject(robot, "value", &json!(77)).expect("a valid value"),
            2 => assert_eq!(legs(robot), (json!(1), json!(77))),
            3 => {
                assert_eq!(legs(robot), (json!(2), json!(77)), "until it is released");
                robot
                    .access("Legs")
                    .expect("Legs")
                    .injector
                    .release("value")
                    .expect("an output");
            }
            4 => {
                assert_eq!(legs(robot), (json!(3), json!(4)), "the node's own again");
                // What a setup node wrote is replaced before any node reads it.
                inject(robot, "raw", &json!(1000)).expect("a valid value");
            }
            5 => {
                assert_eq!(legs(robot), (json!(1000), json!(1001)));
                inject(robot, "value", &json!(5)).expect("a valid value");
            }
            6 => {
                assert_eq!(legs(robot), (json!(1000), json!(5)));
                robot.access("Legs").expect("Legs").injector.release_all();
            }
            7 => assert_eq!(legs(robot), (json!(6), json!(7))),
            _ => {}
        }
    });
}

#[test]
fn a_wrong_value_or_name_changes_nothing() {
    run(&Setting::default(), |number, robot| match number {
        1 => {
            inject(robot, "value", &json!(77)).expect("a valid value");
            let error = inject(robot, "value", &json!("text"))
                .expect_err("not a number")
                .to_string();
            assert!(error.contains("value"), "{error}");
            let error = inject(robot, "valve", &json!(1))
                .expect_err("no such output")
                .to_string();
            assert!(error.contains("`valve`"), "{error}");
            assert!(
                robot
                    .access("Legs")
                    .expect("Legs")
                    .injector
                    .release("valve")
                    .is_err()
            );
        }
        2 => assert_eq!(read(robot, "Legs.main_outputs.value"), json!(77)),
        _ => {}
    });
}

#[test]
fn an_additional_output_is_computed_only_while_somebody_listens() {
    const PATH: &str = "Legs.additional_outputs.debug.raw";
    run(&Setting::default(), |number, robot| {
        let subscriptions = robot.access("Legs").expect("Legs").subscriptions.clone();
        match number {
            1 => {
                let error = robot.read(PATH).expect_err("nobody listens").to_string();
                assert!(error.contains("nobody was subscribed"), "{error}");
                assert!(
                    subscriptions.subscribe("debug.raw") && subscriptions.subscribe("debug.raw")
                );
                assert!(!subscriptions.subscribe("debug.row"));
            }
            2 => {
                assert_eq!(read(robot, PATH), json!(100));
                subscriptions.unsubscribe("debug.raw");
            }
            3 => {
                assert_eq!(read(robot, PATH), json!(200), "one still listens");
                subscriptions.unsubscribe("debug.raw");
                subscriptions.unsubscribe("debug.raw");
            }
            4 => {
                assert!(robot.read(PATH).is_err());
                let mut wanted = subscriptions.wanted();
                assert!(!wanted.next_one());
                assert!(!wanted.next_one(), "behind the last name");
            }
            _ => {}
        }
    });
}

#[test]
fn a_procedure_is_answered_refused_or_refused_for_want_of_an_answer() {
    let answer = |request: u32| {
        if request < 100 {
            Ok(request * 2)
        } else {
            Err("too large".to_owned())
        }
    };
    let legs = Plan {
        answer: Some(answer),
        ..Plan::default()
    };
    let mut pending = Vec::new();
    let setting = Setting {
        legs,
        ..Setting::default()
    };
    run(&setting, |number, robot| match number {
        1 => {
            let access = robot.access("Legs").expect("Legs");
            let (name, double) = &access.procedures[0];
            assert_eq!(*name, "double");
            for request in [json!(21), json!(100)] {
                let called = double.call_any(&Given::from(&request));
                pending.push(called.expect("a valid request"));
            }
            assert!(double.call_any(&Given::from(&json!("many"))).is_err());
            assert!(
                pending[0].wait_any(Duration::ZERO).is_none(),
                "no cycle has come yet"
            );
        }
        2 => {
            let response = pending[0]
                .wait_any(Duration::ZERO)
                .expect("answered")
                .expect("not refused");
            assert_eq!(serde_json::to_value(&response).expect("JSON"), json!(42));
            assert!(
                pending[1].wait_any(Duration::ZERO).is_none(),
                "at most one call a cycle"
            );
        }
        3 => {
            let refused = pending[1].wait_any(Duration::ZERO).expect("answered");
            assert_eq!(
                refused.err().map(|refused| refused.to_string()).as_deref(),
                Some("refused: too large")
            );
        }
        _ => {}
    });

    let mut pending = None;
    let robot = run(&Setting::default(), |number, robot| match number {
        1 => {
            let (_, double) = &robot.access[1].procedures[0];
            let called = double.call_any(&Given::from(&json!(1)));
            pending = Some(called.expect("a valid request"));
        }
        2 => {
            let pending = pending.take().expect("called before");
            let refused = pending
                .wait_any(Duration::ZERO)
                .expect("decided")
                .err()
                .expect("refused");
            assert!(refused.to_string().contains("did not answer"));
        }
        _ => {}
    });
    drop(robot);
}

#[test]
fn calls_after_the_end_and_too_many_calls_are_refused() {
    let (caller, answerer) = framework::procedure::<u32, u32>();
    let waiting: Vec<_> = (0..64).map(|request| caller.call(request)).collect();
    assert!(waiting.iter().all(|pending| pending.try_answer().is_none()));
    let refused = caller
        .call(64)
        .try_answer()
        .expect("refused at once")
        .expect_err("too many");
    assert!(refused.to_string().contains("too many"), "{refused}");
    drop(answerer);
    let refused = caller
        .call(1)
        .try_answer()
        .expect("refused at once")
        .expect_err("nobody there");
    assert!(refused.to_string().contains("stopped"), "{refused}");
    assert!(waiting[0].try_answer().expect("decided").is_err());
}

#[test]
fn parameters_are_seen_from_the_next_begin_on() {
    let robot = run(&Setting::default(), |number, robot| {
        if number == 3 {
            let changed = robot.parameters.change(&[("gain", json!(9))]);
            assert_eq!(changed, Ok(Version(1)));
        } else if number > 3 {
            assert_eq!(read(robot, "Legs.main_outputs.gain"), json!(9));
        } else if number > 0 {
            assert_eq!(read(robot, "Legs.main_outputs.gain"), json!(1));
        }
    });
    let mut references = Vec::new();
    robot.instances[1]
        .references(&mut |reference| references.push((reference.instance, reference.cycle)));
    assert_eq!(references, [("parameters", 1)]);
}

#[test]
fn reading_goes_into_a_value_and_tells_what_there_is() {
    let robot = run(&Setting::default(), |_, _| ());
    assert_eq!(read(&robot, "Legs.main_outputs.persistent"), json!([]));
    assert_eq!(
        read(&robot, "Legs.main_outputs.since_last"),
        json!({"secs": 0, "nanos": 10_000_000})
    );
    for (path, hint) in [
        ("Arms.main_outputs.value", "Eye, Legs"),
        ("Legs.main_outputs.valve", "value"),
        ("Legs.outputs.value", "Instance.main_outputs.name"),
        ("Legs", "Instance.main_outputs.name"),
        ("Legs.main_outputs.persistent.7", "persistent"),
    ] {
        let error = robot.read(path).expect_err(path).to_string();
        assert!(error.contains(hint), "{path}: {error}");
    }
}
