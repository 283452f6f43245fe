//! What scenarios may say, and what they are told where they say something else.

use std::collections::BTreeSet;

use framework::Reflect;
use serde::Serialize;

use super::*;
use crate::parameters::{Layers, Parameters};

const ASSERTION: &str = "[[assertion]]\nwhat = 'a'\nvalue = 'truth.a'\nbelow = 1\n";

fn message(text: &str) -> String {
    Scenario::parse(text)
        .expect_err("it has a mistake")
        .to_string()
}

#[test]
fn everything_that_can_be_said_is_read() {
    let text = format!(
        "about = 'x'\nends = 2\npasses = 0.9\nparameters = {{ a.b = [1, 2], 'c.d' = 'e' }}\n\
         world = {{ pose = [1.0, 2], lamp = {{ there = false }} }}\nrandom = {{ pose = [0.5, 0] }}\n\
         durations = {{ Eye = '100ms', Ear = '1s' }}\n\
         [[event]]\nat = 1.5\npush = [1]\n[[event]]\nat = 1\nwithin = 0\nkick = true\n\
         [[robot]]\ndurations = {{ Ear = '2s' }}\nplace = 3\n{ASSERTION}"
    );
    let scenario = Scenario::parse(&text).expect("it is right");
    assert_eq!(scenario.ends, Duration::from_secs(2));
    let durations = |text: &str| Durations::read(&toml::from_str(text).expect("it is TOML"));
    let own = durations("Eye = '0.1s'\nEar = '2s'").expect("they are durations");
    assert_eq!(scenario.durations_of(0), own);
    let entry: Vec<_> = scenario.robots[0].entry.keys().collect();
    assert_eq!(entry, ["place"], "the rest is the hardware's");
    let times: Vec<_> = scenario
        .events
        .iter()
        .map(|event| event.at.as_nanos() / 1_000_000)
        .collect();
    assert_eq!(times, [1000, 1500]);
    let given =
        toml::from_str("pose = [0, 0]\nlamp = { there = true, size = 3 }").expect("it is TOML");
    let one = scenario.world(given, 1).expect("everything is there");
    assert_eq!(one["lamp"].to_string(), "{ there = false, size = 3 }");
    let x = one["pose"][0].as_float().expect("it is a number");
    assert!((0.5..=1.5).contains(&x) && x != 1.0, "{x}");
    assert_eq!(one["pose"][1].as_integer(), Some(2));
    let given = || toml::from_str("lamp = {}").expect("it is TOML");
    let again = scenario.world(given(), 1).expect("everything is there");
    assert_eq!(again["pose"], one["pose"], "the same seed");
    let other = scenario.world(given(), 2).expect("everything is there");
    assert_ne!(other["pose"], one["pose"], "another seed");
}

#[test]
fn whole_numbers_stay_whole_where_they_are_moved_by_whole_numbers() {
    let text = format!("ends = 2\nworld = {{ seed = 9 }}\nrandom = {{ seed = 3 }}\n{ASSERTION}");
    let scenario = Scenario::parse(&text).expect("it is right");
    let drawn: BTreeSet<i64> = (0..100)
        .map(|seed| {
            let world = scenario.world(toml::Table::new(), seed);
            let world = world.expect("everything is there");
            world["seed"].as_integer().expect("it is whole")
        })
        .collect();
    assert_eq!(drawn, (6..=12).collect());
}

#[test]
fn a_seed_moves_events_that_may_be_moved_and_no_others() {
    let text = format!(
        "ends = 9\n[[event]]\nat = 4\nwithin = 2.0\npush = [1]\n[[event]]\nat = 5\nkick = true\n{ASSERTION}"
    );
    let scenario = Scenario::parse(&text).expect("it is right");
    let times = |seed: u64| {
        let events = scenario.events(seed);
        let (pushes, others): (Vec<_>, Vec<_>) = events
            .iter()
            .partition(|event| event.deed.contains_key("push"));
        assert_eq!(others[0].at, scenario.events[1].at);
        (pushes[0].at - Timestamp::ZERO).as_secs_f64()
    };
    let drawn: Vec<_> = (1..=20).map(times).collect();
    assert!(drawn.iter().all(|at| (2.0..=6.0).contains(at)), "{drawn:?}");
    assert!(drawn.iter().any(|at| *at < 3.0) && drawn.iter().any(|at| *at > 5.0));
    assert_eq!(drawn[4], times(5), "the same seed");
}

#[test]
fn mistakes_are_told_with_their_place() {
    for (text, expected) in [
        (
            format!("ends = 1\nbeginns = 2\n{ASSERTION}"),
            "line 2, column 1",
        ),
        (
            format!("ends = 1\nbeginns = 2\n{ASSERTION}"),
            "unknown field `beginns`, expected one of",
        ),
        ("ends = 1".to_owned(), "there is no `[[assertion]]`"),
        (
            format!("ends = 1\n{ASSERTION}while = 'plays'\n"),
            "`while = \"plays\"`: expected a truth",
        ),
        (
            format!("ends = -1\n{ASSERTION}"),
            "`ends = -1` is no number of seconds",
        ),
        (
            format!("ends = 1\npasses = 2\n{ASSERTION}"),
            "`passes = 2` is no share",
        ),
        (
            format!(
                "ends = 1\n[[call]]\npath = 'a.procedures.b'\nfrom = 0.0\nevery = 1e-9\n{ASSERTION}"
            ),
            "a call comes at most once in a millisecond",
        ),
        (
            format!("ends = 1\n[[event]]\npush = 1\n{ASSERTION}"),
            "an `[[event]]` needs `at = SECONDS`",
        ),
        (
            format!("ends = 1\n[[event]]\nat = 0.5\nwithin = 0.6\npush = 1\n{ASSERTION}"),
            "the event at 0.5 s may be moved by 0.6 s, beyond the start or the end",
        ),
        (
            format!("ends = 1\n[[event]]\nat = 0.5\nwithin = 'a'\n{ASSERTION}"),
            "of an `[[event]]` is no number of seconds",
        ),
        (
            format!("ends = 1\n[[event]]\nat = 1.5\npush = 1\n{ASSERTION}"),
            "the event at 1.5 s comes after the end",
        ),
        (
            format!("ends = 1\n[[event]]\nat = 0.5\nwithin = 0.1\nrobot = 1\n{ASSERTION}"),
            "the event at 0.5 s does not say what happens",
        ),
    ] {
        let message = message(&text);
        assert!(message.contains(expected), "{message}");
    }
}

#[test]
fn times_that_never_come_are_told() {
    let call =
        |times: &str| format!("ends = 1\n[[call]]\npath = 'a.procedures.b'\n{times}\n{ASSERTION}");
    let assertion = |times: &str| format!("ends = 1\n{ASSERTION}{times}\n");
    for (text, expected) in [
        (
            call("from = 0.5\nuntil = 0.1"),
            "call of `a.procedures.b`: `until = 0.1` comes before `from = 0.5`",
        ),
        (call("from = 1.5"), "`from = 1.5` comes after the end"),
        (
            call("from = 0.5\nuntil = 1.5"),
            "`until = 1.5` comes after the end",
        ),
        (
            assertion("from = 0.8\nuntil = 0.2"),
            "assertion `a`: `until = 0.2` comes before `from = 0.8`",
        ),
        (
            assertion("from = 0.8\nbefore = 0.2"),
            "assertion `a`: `before = 0.2` comes before `from = 0.8`",
        ),
        (
            assertion("from = 1.0"),
            "assertion `a`: `from = 1` is the end: say `at_end = true`",
        ),
        (
            assertion("until = 1.5"),
            "assertion `a`: `until = 1.5` comes after the end",
        ),
    ] {
        let message = message(&text);
        assert!(message.contains(expected), "{message}");
    }
}

#[test]
fn what_is_drawn_must_be_there() {
    let text = format!("ends = 1\nrandom = {{ pos = 1.0 }}\n{ASSERTION}");
    let scenario = Scenario::parse(&text).expect("it can be read");
    let error = scenario
        .world(toml::Table::new(), 1)
        .expect_err("there is no `pos`");
    assert!(error.to_string().contains("`pos`"), "{error}");
}

#[test]
fn parameters_are_a_layer_for_all_robots_and_one_for_each() {
    const DEFAULT: &str = "gait = { period = 0.5, height = 1 }\n'a.b' = 0\n";
    let text = format!(
        "ends = 2\n\
         parameters = {{ gait.period = 1, kick = {{ Turned = {{ angle = 1.0, strength = 2 }} }}, 'a.b' = 3 }}\n\
         [[robot]]\n\
         [[robot]]\n\
         parameters.kick.Straight = {{ by = 1, to = 2 }}\n\
         parameters.gait.height = 2\n{ASSERTION}"
    );
    let scenario = Scenario::parse(&text).expect("it is right");
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("default.toml"), DEFAULT).expect("it is written");
    let loaded = |robot: usize, settings: &[(&str, &str)]| {
        let own = |(path, value): &(&str, &str)| ((*path).to_owned(), (*value).to_owned());
        let layers = Layers {
            directory: folder.path().to_owned(),
            above: scenario.parameters_of(robot, Path::new("a.toml")),
            settings: settings.iter().map(own).collect(),
            ..Layers::default()
        };
        layers.load().expect("it is read")
    };
    let read = |loaded: &Parameters| loaded.deserialize::<Robot>().expect("all are there");
    let first = loaded(0, &[]);
    let expected = Robot {
        gait: Gait {
            period: 1.0,
            height: 1,
        },
        kick: Kick::Turned {
            angle: 1.0,
            strength: 2,
        },
        dotted: 3,
    };
    assert_eq!(read(&first), expected);
    let place = |loaded: &Parameters, path: &str| loaded.origin(path).map(ToString::to_string);
    assert_eq!(
        place(&first, "kick.Turned.angle").as_deref(),
        Some("a.toml:2")
    );
    let second = loaded(1, &[("gait.period", "7")]);
    let expected = Robot {
        gait: Gait {
            period: 7.0,
            height: 2,
        },
        kick: Kick::Straight { by: 1, to: 2 },
        ..expected
    };
    assert_eq!(read(&second), expected);
    assert_eq!(place(&second, "gait.height").as_deref(), Some("a.toml:6"));
}

#[derive(Clone, Debug, Deserialize, PartialEq, Reflect, Serialize)]
struct Robot {
    gait: Gait,
    kick: Kick,
    #[serde(rename = "a.b")]
    dotted: u32,
}

#[derive(Clone, Debug, Deserialize, PartialEq, Reflect, Serialize)]
struct Gait {
    period: f32,
    height: u32,
}

#[derive(Clone, Debug, Deserialize, PartialEq, Reflect, Serialize)]
enum Kick {
    Straight { by: u32, to: u32 },
    Turned { angle: f32, strength: u32 },
}
