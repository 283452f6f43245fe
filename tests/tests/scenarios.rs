//! The NAO's scenarios: all of them can be read and ask for what there is; some are played here, the rest by whoever has the time:
//! `hulkgen simulate robotics/scenarios/*.toml --repeat 10`.

use std::ffi::OsString;
use std::path::{Path, PathBuf};

use framework::launch::{self, Target};
use framework::scenario::Scenario;
use framework::testing;
use nao_runtime::runtime;
use serde_json::Value;
use simulated_nao::Hardware;
use support::nao::Nao;
use support::root;
use types::ball::Ball;
use types::obstacles::Obstacle;

const TARGET: Target = Target {
    parameters: "robotics/parameters",
    location: Some("simulated"),
    identities: &["body", "head"],
    ..testing::TARGET
};

fn files() -> Vec<PathBuf> {
    let folder = root().join("robotics/scenarios");
    let entries = std::fs::read_dir(&folder).expect("the robot has scenarios");
    let mut files: Vec<_> = entries
        .map(|entry| entry.expect("it can be listed").path())
        .collect();
    files.sort();
    files
}

/// As the robot's program plays it: what it prints.
fn play(name: &str, seeds: usize) -> Value {
    let scenario = root().join(format!("robotics/scenarios/{name}.toml"));
    play_file(&scenario, &["--repeat", &seeds.to_string()])
}

fn play_file(scenario: &Path, options: &[&str]) -> Value {
    let mut output = Vec::new();
    let runs = tempfile::tempdir().expect("a temporary folder");
    let mut arguments: Vec<OsString> = vec![
        "--parameters".into(),
        root().join("robotics/parameters").into_os_string(),
        "--scenario".into(),
        scenario.into(),
        "--run-folder".into(),
        runs.path().into(),
        "--format".into(),
        "json".into(),
    ];
    let last = ["--", "--free-ports"];
    arguments.extend(options.iter().chain(&last).map(OsString::from));
    let status = launch::run(
        TARGET,
        arguments,
        &mut output,
        runtime::create::<Hardware>,
        launch::nobody,
    );
    let outcome: Value = serde_json::from_slice(&output).expect("it was played");
    assert_eq!(status == 0, outcome["passed"] == true);
    outcome
}

/// Where a robot that has seen a ball says where it lies.
const BALLS: [&str; 2] = [
    "Control.main_outputs.ball.",
    "Control.additional_outputs.ball_filter.persistent_ball.",
];

/// Where one that has seen others says where they stand, behind the number of one.
const OBSTACLES: &str = "Control.main_outputs.obstacles.";

#[test]
fn every_scenario_asserts_what_there_is() {
    let files = files();
    assert!(files.len() >= 20, "{} scenarios", files.len());
    let other = r#"{ position = [0.5, 0.0], team = "opponent", number = 2 }"#;
    let others = format!("[{other}, {other}, {other}]");
    let settings = [("hardware.simulated.robots", others.as_str())];
    let mut nao = Nao::new(&["--no-cameras", "--no-sound"], &settings);
    nao.run(0.1, |_, _| {});
    let truth = framework::Hardware::truth(&*nao.hardware);
    let ball = serde_json::to_value(Ball::default()).expect("it is JSON");
    let obstacles = vec![Obstacle::default(); 3];
    let obstacles = serde_json::to_value(obstacles).expect("they are JSON");
    for file in files {
        let scenario = Scenario::load(&file).expect("it can be read");
        assert!(!scenario.about.is_empty(), "{}", file.display());
        for assertion in &scenario.assertions {
            let compared = assertion.apart_from.iter().chain(&assertion.only_while);
            for truth_of in compared {
                let path = truth_of.trim_start_matches("truth.").replace('.', "/");
                let found = truth.pointer(&format!("/{path}"));
                assert!(found.is_some(), "{}: no `{truth_of}`", file.display());
            }
            let value = &assertion.value;
            // Only where a game is played, as `simulated_nao`'s own scenarios show.
            let of_games = ["truth.game.", "Control.main_outputs.game_controller_state."];
            let is_of_games = of_games.iter().any(|start| value.starts_with(start));
            if is_of_games && scenario.world["game"].get("play").is_some() {
                continue;
            }
            let has = |of: &Value, path: &str| {
                let path = format!("/{}", path.replace('.', "/"));
                of.pointer(&path).is_some()
            };
            let found = match value.split_once('.') {
                Some(("truth", path)) => has(&truth, path),
                // Neither is known to anybody who has not seen one.
                _ => match (
                    BALLS.iter().find_map(|start| value.strip_prefix(start)),
                    value.strip_prefix(OBSTACLES),
                ) {
                    (Some(path), _) => has(&ball, path),
                    (_, Some(path)) => has(&obstacles, path),
                    _ => nao.robot.read(value).is_ok(),
                },
            };
            assert!(found, "{}: there is no `{value}`", file.display());
        }
    }
}

#[test]
fn some_are_played() {
    for (name, seeds) in [
        ("sit_limp", 1),
        ("walk_a_curve", 2),
        ("push_from_the_left", 2),
        ("stand_up_from_the_back", 1),
        ("kick_right", 1),
        ("goal", 1),
        ("catch", 1),
        ("penalised_by_the_referee", 1),
        ("roles_as_the_referee_says", 1),
        ("keeper_is_out", 1),
        ("message_budget", 1),
        ("second_half", 1),
        ("robots_are_known", 1),
        ("removed_while_it_gets_up", 1),
    ] {
        let outcome = play(name, seeds);
        assert_eq!(outcome["passed"], true, "{outcome:#}");
        let runs = outcome["runs"].as_array().expect("there are runs");
        assert_eq!(runs.len(), seeds, "{name}");
        assert!(runs.iter().all(|run| run["failures"] == 0), "{outcome:#}");
    }
}

/// Two runs with the same seed see the same to the last bit.
#[test]
fn the_same_seed_gives_the_same() {
    let seen = || {
        let outcome = play("sit_limp", 1);
        outcome["runs"][0]["assertions"].clone()
    };
    assert_eq!(seen(), seen());
}

/// A world of three robots, each with its own program and its cameras.
const THREE: &str = "ends = 1.5
[world]
robots = []
[[robot]]
team = 'own'
number = 1
pose = [-1.0, 0.5, 0.0]
parameters = { ball_filter.gate = 2.5 }
[[robot]]
team = 'own'
number = 2
pose = [-1.0, -0.5, 0.0]
random = { pose = [0.1, 0.1, 0.5] }
[[robot]]
team = 'opponent'
number = 1
pose = [1.0, 0.0, 3.14]
[[event]]
at = 1.0
robot = 3
push = [-1.0, 0.0, 0.0]
[[assertion]]
what = 'the first is where it was put'
value = 'truth.x'
above = -1.1
below = -0.9
[[assertion]]
what = 'the third is pushed'
robot = 3
value = 'truth.tilt'
above = 0.05
from = 1.0
before = 1.5
[[assertion]]
what = 'it knows who it is'
robot = 3
value = 'Control.main_outputs.game_controller_state'
is_not = 0
at_end = true
";

#[test]
fn the_number_of_threads_changes_no_bit() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = folder.path().join("three.toml");
    std::fs::write(&file, THREE).expect("it can be written");
    let played = |options: &[&str]| {
        let outcome = play_file(&file, options);
        let run = outcome["runs"][0].clone();
        assert_eq!(run["failures"], 0, "{outcome:#}");
        assert!(run["stopped"].is_null(), "{outcome:#}");
        (run["digests"].clone(), run["assertions"].clone())
    };
    let (digests, assertions) = played(&["--digests", "--threads", "1"]);
    let list = digests.as_array().expect("each robot has one");
    assert_eq!(list.len(), 3);
    assert_ne!(list[0], list[1], "they are different robots");
    let passed: Vec<_> = assertions.as_array().into_iter().flatten().collect();
    assert!(
        passed[..2].iter().all(|one| one["passed"] == true),
        "{assertions:#}"
    );
    for threads in ["2", "4"] {
        let again = played(&["--digests", "--threads", threads]);
        assert_eq!(again.0, digests, "{threads} threads");
        assert_eq!(again.1, assertions, "{threads} threads");
    }
    let other_seed = played(&["--digests", "--threads", "2", "--seed", "2"]);
    assert_ne!(other_seed.0[1], digests[1], "another seed is another world");
}
