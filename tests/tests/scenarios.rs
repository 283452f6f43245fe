//! The NAO's scenarios: all of them can be read and ask for what there is; some are played here, the rest by whoever has the time:
//! `hulkgen simulate robotics/scenarios/*.toml --repeat 10`.

use std::path::PathBuf;

use framework::launch::{self, Target};
use framework::scenario::Scenario;
use framework::testing;
use nao_runtime::runtime;
use serde_json::Value;
use simulated_nao::Hardware;
use support::nao::Nao;
use support::root;

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
    let mut output = Vec::new();
    let scenario = root().join(format!("robotics/scenarios/{name}.toml"));
    let arguments = [
        "--parameters".into(),
        root().join("robotics/parameters").into_os_string(),
        "--scenario".into(),
        scenario.into_os_string(),
        "--repeat".into(),
        seeds.to_string().into(),
        "--format".into(),
        "json".into(),
        "--".into(),
        "--free-ports".into(),
    ];
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

#[test]
fn every_scenario_asserts_what_there_is() {
    let files = files();
    assert!(files.len() >= 20, "{} scenarios", files.len());
    let mut nao = Nao::new(&["--no-cameras", "--no-sound"], &[]);
    nao.run(0.1, |_, _| {});
    let truth = framework::Hardware::truth(&*nao.hardware);
    for file in files {
        let scenario = Scenario::load(&file).expect("it can be read");
        assert!(!scenario.about.is_empty(), "{}", file.display());
        for assertion in &scenario.assertions {
            let value = &assertion.value;
            let found = match value.strip_prefix("truth.") {
                Some(path) => truth
                    .pointer(&format!("/{}", path.replace('.', "/")))
                    .is_some(),
                None => nao.robot.read(value).is_ok(),
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
