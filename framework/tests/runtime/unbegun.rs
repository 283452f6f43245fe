//! What is wrong with a scenario is told before anything is played, and leaves no file of a run that did not begin.

use std::ffi::OsString;
use std::sync::Arc;

use framework::launch;
use framework::testing::TARGET;
use framework::{Result, Robot, Start};
use serde_json::Value;

use crate::body::{Parameters, Setting, robot};
use crate::scenario::{TWO_ROBOTS, assertion, play, written};
use crate::scripted::ScriptedHardware;

#[test]
fn a_robot_that_is_not_there_is_named() {
    let scenario = format!(
        "{}robot = 2\n",
        assertion("value = 'truth.events'\nabove = 0")
    );
    assert_eq!(play(&scenario, &[]), (1, Value::Null));
    let text = format!("ends = 1\n{scenario}");
    let error = framework::scenario::Scenario::parse(&text).expect_err("there is one robot");
    assert!(
        error
            .to_string()
            .contains("assertion `it`: there is no robot 2"),
        "{error}"
    );
}

#[test]
fn where_nothing_would_be_played_nothing_passes() {
    for options in [
        ["--repeat", "0", "--seed", "1"],
        ["--repeat", "2", "--seed", "18446744073709551615"],
    ] {
        let (status, outcome) = play(TWO_ROBOTS, &options);
        assert_ne!(status, 0, "{options:?}");
        assert_eq!(outcome, Value::Null, "{options:?}");
    }
}

#[test]
fn where_nobody_can_watch_no_recording_is_left() {
    let taken = std::net::TcpListener::bind("127.0.0.1:0").expect("a free port");
    let address = taken.local_addr().expect("it has one").to_string();
    let (folder, mut all) = written(&format!(
        "ends = 1.0\n{}",
        assertion("value = 'truth.events'\nabove = 0")
    ));
    all.extend(["--listen", &address, "--record", "on"].map(OsString::from));
    let create = |hardware: &Arc<ScriptedHardware>,
                  _: Start<Parameters>|
     -> Result<Robot<Parameters>> { Ok(robot(hardware, &Setting::default())) };
    let status = launch::run(TARGET, all, &mut Vec::new(), create, listens);
    assert_eq!(status, 1);
    assert!(!folder.path().join("run").exists());
}

fn listens(
    _: framework::link::Link,
    listening: launch::Listening,
) -> Result<Option<Box<dyn launch::Served>>> {
    listening.open().map(|_| None)
}

#[test]
fn a_word_that_the_type_does_not_have_is_refused_before_anything_is_played() {
    let value = |name: &str, rest: &str| {
        assertion(&format!(
            "value = 'Legs.main_outputs.{name}'\n{rest}\nfrom = 0.1"
        ))
    };
    for wrong in [
        value("phase", "is_not = 'Stnad'"),
        value("phase", "equals = { Walk = { side = 'Lfet' } }"),
        value("phase.Walk.side", "is_not = 'Up'"),
    ] {
        assert_eq!(play(&wrong, &[]), (1, Value::Null), "{wrong}");
    }
    for (right, passed) in [
        (
            value("phase", "is_not = { Walk = { side = 'Left' } }"),
            true,
        ),
        (value("phase", "equals = 'Stand'"), true),
        (value("phase", "is_not = 'Stand'"), false),
    ] {
        let (_, outcome) = play(&right, &[]);
        assert_eq!(outcome["passed"], passed, "{right}: {outcome:#}");
    }
}

#[test]
fn an_instance_that_there_is_not_is_refused_before_anything_is_played() {
    for name in ["Nobody", "Leg"] {
        for condition in ["above = 0", "is_not = 1", "is_there = false"] {
            let wrong = assertion(&format!("value = '{name}.main_outputs.raw'\n{condition}"));
            assert_eq!(play(&wrong, &[]), (1, Value::Null), "{wrong}");
        }
    }
}

#[test]
fn what_is_wrong_for_a_later_robot_leaves_no_recording_of_an_earlier_one() {
    let wrong = assertion("value = 'Legs.main_outputs.phase'\nequals = 'Stnad'\nrobot = 2");
    let (folder, mut all) = written(&format!("ends = 0.1\n{wrong}[[robot]]\n[[robot]]\n"));
    all.extend(["--record", "on"].map(OsString::from));
    let mut created = 0;
    let create = |hardware: &Arc<ScriptedHardware>, _: Start<Parameters>| {
        created += 1;
        Ok(robot(hardware, &Setting::default()))
    };
    let status = launch::run(TARGET, all, &mut Vec::new(), create, launch::nobody);
    assert_eq!((status, created), (1, 2));
    assert!(!folder.path().join("run").exists());
}
