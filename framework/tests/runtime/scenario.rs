//! A scenario from its file to the exit status of the program that plays it.

use std::ffi::OsString;
use std::sync::Arc;

use framework::launch;
use framework::logs::Sink;
use framework::testing::TARGET;
use framework::{Result, Robot, Start};
use serde_json::Value;
use tempfile::TempDir;

use crate::body::{Parameters, Setting, robot};
use crate::scripted::ScriptedHardware;

/// A scenario in a folder of its own, and what a robot's program is told to play it and answer in JSON.
pub(crate) fn written(scenario: &str) -> (TempDir, Vec<OsString>) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let write = |name: &str, text: &str| {
        let path = folder.path().join(name);
        std::fs::write(&path, text).expect("it can be written");
        OsString::from(path)
    };
    write("default.toml", "gain = 1\n[hardware.simulated]\nstep = 1\n");
    let arguments = [
        "--parameters".into(),
        folder.path().into(),
        "--scenario".into(),
        write("scenario.toml", scenario),
        // Where what does not pass is recorded.
        "--run-folder".into(),
        folder.path().join("run").into_os_string(),
        "--format".into(),
        "json".into(),
    ];
    (folder, arguments.to_vec())
}

/// Status and outcome of a scenario of one second, in which `Legs` has data every 10 ms and the world counts the events.
pub(crate) fn play(scenario: &str, arguments: &[&str]) -> (u8, Value) {
    play_until("1.0", scenario, arguments)
}

/// As [`play`], of a scenario that says when it ends; the world has events for one second.
fn play_until(ends: &str, scenario: &str, arguments: &[&str]) -> (u8, Value) {
    let (_folder, mut all) = written(&format!("ends = {ends}\n{scenario}"));
    all.extend(arguments.iter().map(OsString::from));
    let create =
        |hardware: &Arc<ScriptedHardware>, start: Start<Parameters>| -> Result<Robot<Parameters>> {
            assert_eq!(
                start.parameters.gain, 7,
                "the scenario's parameters are the robot's"
            );
            Ok(robot(hardware, &Setting::default()))
        };
    let mut output = Vec::new();
    let status = launch::run(TARGET, all, &mut output, create, launch::nobody);
    (status, serde_json::from_slice(&output).unwrap_or_default())
}

const PARAMETERS: &str = "parameters = { gain = 7 }\n";

pub(crate) fn assertion(what: &str) -> String {
    format!("{PARAMETERS}[[assertion]]\nwhat = 'it'\n{what}\n")
}

#[test]
fn assertions_are_judged_over_outputs_and_truth() {
    for (what, passed, at, seen) in [
        // The world has counted every event when its cycle ends.
        ("value = 'truth.events'\nabove = 0", true, Some(0.01), "1"),
        ("value = 'truth.events'\nbelow = 50", false, Some(0.5), "50"),
        (
            "value = 'truth.events'\nbelow = 50\nuntil = 0.4",
            true,
            Some(0.4),
            "40",
        ),
        (
            "value = 'truth.events'\nequals = 30\nbefore = 0.5",
            true,
            Some(0.3),
            "30",
        ),
        (
            "value = 'truth.events'\nequals = 30\nfrom = 0.35\nbefore = 0.5",
            false,
            Some(0.5),
            "50",
        ),
        (
            "value = 'truth.events'\nequals = 100\nat_end = true",
            true,
            Some(1.0),
            "100",
        ),
        (
            "value = 'truth.events'\nis_not = 12",
            false,
            Some(0.12),
            "12",
        ),
        (
            "value = 'truth.late'\nis_there = false\nuntil = 0.5",
            true,
            Some(0.5),
            "null",
        ),
        (
            "value = 'truth.late'\nis_there = false",
            false,
            Some(0.51),
            "51",
        ),
        (
            "value = 'truth.nothing'\nis_there = true\nat_end = true",
            false,
            Some(1.0),
            "\"there is no `truth.nothing`\"",
        ),
        (
            "value = 'truth.nothing'\nis_there = false",
            false,
            Some(0.01),
            "\"there is no `truth.nothing`\"",
        ),
        (
            "value = 'truth.late'\nis_there = true\nbefore = 0.7",
            true,
            Some(0.51),
            "51",
        ),
        (
            "value = 'truth.events'\nbelow = 51\nshare = 0.5",
            true,
            Some(1.0),
            r#"{"share":0.5,"median":51.0}"#,
        ),
        (
            "value = 'truth.events'\nbelow = 51\nshare = 0.51",
            false,
            Some(1.0),
            r#"{"share":0.5,"#,
        ),
        (
            "value = 'truth.events'\napart_from = 'truth.events'\nbelow = 0.1",
            true,
            Some(0.01),
            "0.0",
        ),
        (
            "value = 'truth.events'\napart_from = 'truth.nothing'\nbelow = 0.1",
            false,
            Some(0.01),
            "\"there is no `truth.nothing`",
        ),
        (
            "value = 'truth.is_late'\napart_from = 'truth.events'\nbelow = 0.1",
            false,
            Some(0.01),
            "\"`truth.is_late` is false and `truth.events` is 1: expected two numbers",
        ),
        (
            "value = 'truth.events'\nabove = 50\nwhile = 'truth.is_late'",
            true,
            Some(0.51),
            "51",
        ),
        (
            "value = 'truth.events'\nabove = 60\nshare = 0.8\nwhile = 'truth.is_late'",
            true,
            Some(1.0),
            r#"{"share":0.8,"median":76.0}"#,
        ),
        // Neither what is not there nor what is no yes or no is a moment that counts.
        (
            "value = 'truth.events'\nabove = 0\nwhile = 'truth.late'",
            false,
            None,
            "\"nothing: `truth.late` is 51, neither true nor false\"",
        ),
        (
            "value = 'truth.events'\nabove = 0\nwhile = 'truth.late'\nuntil = 0.4",
            false,
            None,
            "\"nothing: no cycle ended in that time while `truth.late`\"",
        ),
        (
            "value = 'truth.events'\nabove = 0\nwhile = 'truth.is_lat'",
            false,
            None,
            "\"nothing: there is no `truth.is_lat`; did you mean `truth.is_late`?\"",
        ),
        (
            "value = 'truth.events'\nabove = 0\nwhile = 'truth.is_late'\nuntil = 0.4",
            false,
            None,
            "\"nothing: no cycle ended in that time while `truth.is_late`\"",
        ),
        (
            "value = 'truth.nothing'\nis_not = 0\nat_end = true",
            true,
            Some(1.0),
            "\"there is no `truth.nothing`\"",
        ),
        (
            "value = 'Legs.main_outputs.raw'\nabove = -1",
            true,
            None,
            "",
        ),
        (
            "value = 'Legs.main_outputs.rwa'\nabove = -1",
            false,
            Some(0.01),
            "\"`Legs` has no main output",
        ),
        // That is no other value, it is a mistake.
        (
            "value = 'Legs.main_outputs.rwa'\nis_not = -1",
            false,
            Some(0.01),
            "\"`Legs` has no main output",
        ),
        (
            "value = 'Legs.main_output.raw'\nis_not = -1",
            false,
            Some(0.01),
            "\"no `Legs.main_output.raw`",
        ),
    ] {
        let (status, outcome) = play(&assertion(what), &[]);
        let verdict = &outcome["runs"][0]["assertions"][0];
        assert_eq!(verdict["passed"], passed, "{what}: {outcome:#}");
        assert_eq!(
            (status == 0, outcome["passed"].as_bool()),
            (passed, Some(passed)),
            "{what}"
        );
        assert!(
            verdict["seen"].to_string().starts_with(seen),
            "{what}: {verdict}"
        );
        if at.is_some() {
            assert_eq!(verdict["at"].as_f64(), at, "{what}");
        }
    }
}

#[test]
fn events_happen_and_clients_call_when_the_file_says() {
    let scenario = format!(
        "{PARAMETERS}[[event]]\nat = 0.5\njump = 1000\n\
         [[call]]\npath = 'Legs.procedures.double'\nargument = 4\nfrom = 0.2\nuntil = 0.4\nevery = 0.1\n\
         [[assertion]]\nwhat = 'not before'\nvalue = 'truth.events'\nbelow = 51\nuntil = 0.5\n\
         [[assertion]]\nwhat = 'then'\nvalue = 'truth.events'\nabove = 1050\nfrom = 0.51\n"
    );
    let (status, outcome) = play(&scenario, &[]);
    assert_eq!(status, 0, "{outcome:#}");
    for (wrong, expected) in [
        ("[[event]]\nat = 0.5\njmp = 1\n", 1),
        ("[[call]]\npath = 'Legs.procedures.tripel'\nfrom = 0.1\n", 1),
        (
            "[[call]]\npath = 'Legs.procedures.double'\nargument = 'x'\nfrom = 0.1\n",
            1,
        ),
    ] {
        let (status, outcome) = play(
            &format!("{}{wrong}", assertion("value = 'truth.events'\nabove = 0")),
            &[],
        );
        assert_eq!((status, outcome), (expected, Value::Null), "{wrong}");
    }
}

#[test]
fn cycles_take_as_long_as_the_file_says() {
    // Data every 10 ms: 4 events when the first cycle ends, and those that came meanwhile are one.
    let scenario = |durations: &str| {
        let what = "value = 'Legs.main_outputs.clock'\nabove = -1\nbefore = 1.0";
        format!("{durations}\n{}", assertion(what))
    };
    for (durations, first) in [("", 0.01), ("durations = { Legs = '35ms' }", 0.045)] {
        let (status, outcome) = play(&scenario(durations), &[]);
        assert_eq!(status, 0, "{outcome:#}");
        let verdict = &outcome["runs"][0]["assertions"][0];
        assert_eq!(verdict["at"].as_f64(), Some(first), "{outcome:#}");
    }
    for wrong in [
        "durations = { Leg = '35ms' }",
        "durations = { Legs = 35 }",
        "durations = { Ear = '35ms' }",
    ] {
        assert_eq!(play(&scenario(wrong), &[]), (1, Value::Null), "{wrong}");
    }
}

#[test]
fn an_additional_output_is_computed_for_who_asserts_something_of_it() {
    let asserted = |value: &str| {
        let what = format!("value = 'Legs.additional_outputs.{value}'\nabove = -1");
        let (status, outcome) = play(&assertion(&what), &[]);
        let seen = outcome["runs"][0]["assertions"][0]["seen"].clone();
        (status, seen)
    };
    assert_eq!(asserted("debug.raw").0, 0);
    let (status, seen) = asserted("debug.rwa");
    assert_eq!(status, 1);
    let seen = seen.as_str().expect("it is told what is not there");
    assert!(
        seen.starts_with("`Legs` has no additional output"),
        "{seen}"
    );
}

#[test]
fn every_seed_is_a_run_and_enough_of_them_must_pass() {
    let scenario = |passes: f64| {
        format!(
            "passes = {passes}\nworld = {{ step = 1.0 }}\nrandom = {{ step = 1.0 }}\n{}",
            assertion("value = 'truth.step'\nbelow = 1")
        )
    };
    let (status, outcome) = play(&scenario(1.0), &["--repeat", "20", "--seed", "5"]);
    let runs = outcome["runs"].as_array().expect("there are runs").clone();
    let seeds: Vec<_> = runs
        .iter()
        .map(|run| run["seed"].as_u64().unwrap_or_default())
        .collect();
    assert_eq!(seeds, (5..25).collect::<Vec<_>>());
    let passes = runs.iter().filter(|run| run["passed"] == true).count();
    assert!(
        (4..17).contains(&passes),
        "half of the numbers lie below the middle: {passes}"
    );
    assert_eq!(
        (status, outcome["passes"].as_u64()),
        (1, Some(passes as u64))
    );
    assert_eq!(
        play(&scenario(0.1), &["--repeat", "20", "--seed", "5"]).0,
        0
    );
    let again = play(&scenario(1.0), &["--repeat", "20", "--seed", "5"]).1;
    assert_eq!(
        again["passes"], outcome["passes"],
        "the same seeds, the same runs"
    );
}

#[test]
fn a_scenario_names_its_recordings_itself() {
    let scenario = assertion("value = 'truth.events'\nabove = 0");
    assert_eq!(play(&scenario, &["--record", "tape"]), (2, Value::Null));
    let (status, outcome) = play(&scenario, &["--record", "on"]);
    let recordings = &outcome["runs"][0]["recordings"];
    assert_eq!((status, recordings.as_array().map(Vec::len)), (0, Some(1)));
}

pub(crate) const TWO_ROBOTS: &str = "parameters = { gain = 6 }
world = { step = 1.0 }
[[robot]]
parameters = { gain = 7 }
[[robot]]
parameters = { gain = 7 }
crashes_at = 500
place = 1.0
random = { place = 1.0 }
[[event]]
at = 0.3
robot = 2
jump = 1000
[[assertion]]
what = 'the first lives to the end'
value = 'truth.events'
equals = 100
at_end = true
[[assertion]]
what = 'the event happens to the second'
robot = 2
value = 'truth.events'
above = 1000
before = 0.4
[[assertion]]
what = 'where the second stands is drawn'
robot = 2
value = 'truth.entry.place'
is_not = 1.0
[[assertion]]
what = 'the second does not live to the end'
robot = 2
value = 'truth.events'
below = 1050
";

#[test]
fn several_robots_live_in_one_world_and_one_that_crashes_leaves_the_others() {
    let played = |threads: &str| {
        let (status, mut outcome) = play(TWO_ROBOTS, &["--digests", "--threads", threads]);
        assert_eq!(status, 1);
        let mut run = outcome["runs"][0].take();
        let assertions = run["assertions"].as_array().expect("there are some");
        assert!(
            assertions.iter().all(|one| one["passed"] == true),
            "{run:#}"
        );
        assert_eq!(assertions.len(), 4);
        let stopped = run["stopped"].as_str().unwrap_or_default();
        assert!(
            stopped.starts_with("robot 2: ") && stopped.contains("crashes as scripted"),
            "{run:#}"
        );
        let recordings = run["recordings"].as_array().expect("it was recorded");
        let second = recordings[1].as_str().unwrap_or_default();
        assert!(second.ends_with("scenario-seed-1-robot-2.mcap"), "{second}");
        (run["digests"].take(), run["assertions"].take())
    };
    let one = played("1");
    assert_eq!(one.0.as_array().map(Vec::len), Some(2));
    assert_eq!(played("2"), one);
}

#[test]
fn a_robot_or_a_world_that_ends_before_the_scenario_does_not_pass() {
    let leaves = "[[event]]\nat = 0.3\nleave = true\n";
    let leaves_at = "[[robot]]\nleaves_at = 300\n";
    let second_leaves = format!("[[robot]]\n{leaves_at}");
    for (ends, rest, expected) in [
        ("1.0", "", None),
        // A node is told, the hardware knows, and there are no more events.
        ("1.0", leaves, Some("it ended by itself at 0.310 s")),
        ("1.0", leaves_at, Some("it ended by itself at 0.290 s")),
        ("2.0", "", Some("its world ended at 1.000 s")),
        (
            "1.0",
            &second_leaves,
            Some("robot 2: it ended by itself at 0.290 s"),
        ),
    ] {
        let scenario = assertion("value = 'truth.events'\nbelow = 1000") + rest;
        let (status, outcome) = play_until(ends, &scenario, &["--record", "off"]);
        let run = &outcome["runs"][0];
        assert_eq!(run["assertions"][0]["passed"], true, "{outcome:#}");
        assert_eq!(run["stopped"].as_str(), expected, "{outcome:#}");
        assert_eq!(status == 0, expected.is_none(), "{outcome:#}");
    }
}

#[test]
fn hardware_that_panics_at_an_event_is_told_with_what_was_seen_until_then() {
    let explodes = "[[event]]\nat = 0.5\nexplode = true\n";
    let scenario = assertion("value = 'truth.events'\nbelow = 51") + explodes;
    let (status, outcome) = play(&scenario, &["--record", "off"]);
    assert_eq!((status, &outcome["passed"]), (1, &false.into()));
    let run = &outcome["runs"][0];
    let stopped = run["stopped"].as_str().unwrap_or_default();
    assert!(stopped.starts_with("at 0.500 s: "), "{outcome:#}");
    assert!(stopped.contains("explodes as scripted"), "{outcome:#}");
    assert_eq!(run["assertions"][0]["passed"], true, "{outcome:#}");
}

#[test]
fn what_was_seen_is_told_where_the_disk_takes_no_recording_of_it() {
    let scenario = assertion("value = 'truth.events'\nbelow = 50");
    let file = tempfile::NamedTempFile::new().expect("a temporary file");
    let below_file = file.path().join("run");
    let below_file = below_file.to_str().expect("its name is text");
    let place = ["--run-folder", below_file];
    let (status, outcome) = play(&scenario, &[&place[..], &["--repeat", "2"]].concat());
    let runs = outcome["runs"].as_array().map(Vec::as_slice);
    assert_eq!((status, runs.map(<[_]>::len)), (1, Some(2)), "{outcome:#}");
    for run in runs.unwrap_or_default() {
        let verdict = &run["assertions"][0];
        assert_eq!(
            (&verdict["passed"], &verdict["seen"]),
            (&false.into(), &50.into())
        );
        assert_eq!(run["recordings"], Value::Null, "{outcome:#}");
    }
    // Who asks for recordings gets them, or hears why not before anything is played.
    let (status, outcome) = play(&scenario, &[&place[..], &["--record", "on"]].concat());
    assert_eq!((status, outcome), (1, Value::Null));
}

#[test]
fn what_a_robot_says_while_it_is_created_is_its_own() {
    let it = assertion("value = 'truth.events'\nabove = 0\nat_end = true");
    let (_folder, mut all) = written(&format!("ends = 0.1\n{it}[[robot]]\n[[robot]]\n"));
    all.extend(["--record", "off"].map(OsString::from));
    let mut sinks = Vec::new();
    let create = |hardware: &Arc<ScriptedHardware>, start: Start<Parameters>| {
        sinks.push(Sink::new(start.clock.clone()));
        tracing::warn!(target: "created", robot = sinks.len(), "is there");
        Ok(robot(hardware, &Setting::default()))
    };
    let status = launch::run(TARGET, all, &mut Vec::new(), create, launch::nobody);
    assert_eq!(status, 0);
    let heard = sinks.iter().map(|sink| {
        let said = std::iter::from_fn(|| sink.take()).filter(|said| said.module == "created");
        let robots = said.map(|said| said.fields["robot"].as_u64());
        robots.flatten().collect::<Vec<_>>()
    });
    assert_eq!(heard.collect::<Vec<_>>(), [[1], [2]]);
}

#[test]
fn a_path_that_never_leads_to_a_value_is_refused_before_anything_is_played() {
    let value = |path: &str, rest: &str| {
        assertion(&format!(
            "value = 'Legs.main_outputs.{path}'\n{rest}\nfrom = 0.1"
        ))
    };
    for condition in [
        "is_not = 'Up'",
        "equals = 'Left'",
        "is_there = false",
        "below = 1.0",
    ] {
        for path in ["phase.Walk.sied", "phase.Wakl.side", "raw.x"] {
            let wrong = value(path, condition);
            assert_eq!(play(&wrong, &[]), (1, Value::Null), "{wrong}");
        }
    }
    // A variant that is not there now may come.
    let (status, outcome) = play(&value("phase.Walk.side", "is_not = 'Left'"), &[]);
    assert_eq!(status, 0, "{outcome:#}");
}
