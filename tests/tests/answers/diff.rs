//! `diff REV`: what changed in the graph of a robot since a commit.

use std::process::{Command, Stdio};

use serde_json::Value;
use support::skip;

use crate::robot::Robot;
use crate::{Ended, json};

/// A fixture robot in a repository of its own, committed once with the tag `first`.
struct Repository {
    robot: Robot,
}

impl Repository {
    /// None, and said so: there is no git.
    fn new(test: &str) -> Option<Self> {
        let mut git = Command::new("git");
        if git.arg("--version").stdin(Stdio::null()).output().is_err() {
            skip(test, "git");
            return None;
        }
        let robot = Robot::new("perception_and_real_time");
        robot.write("nodes/src/battery.rs", BATTERY);
        robot.edit(
            "nodes/src/lib.rs",
            "pub mod camera;",
            "pub mod battery;\npub mod camera;",
        );
        let nodes = "nodes = [\"nodes::filter\", \"nodes::pace\"]";
        robot.edit(
            "hulk.toml",
            nodes,
            "nodes = [\"nodes::filter\", \"nodes::pace\", \"nodes::battery\"]",
        );
        robot.write("parameters/default.toml", "[battery]\nempty = 10.5\n");
        robot.run("check").expect(0);
        let repository = Self { robot };
        repository.git("init --quiet --initial-branch main");
        repository.commit("first");
        Some(repository)
    }

    fn git(&self, arguments: &str) -> String {
        let mut git = Command::new("git");
        git.args(["-c", "user.name=Test", "-c", "user.email=test@example.org"])
            .args(arguments.split(' '))
            .current_dir(self.robot.folder())
            .env("GIT_CONFIG_GLOBAL", "/dev/null")
            .env("GIT_CONFIG_SYSTEM", "/dev/null");
        Ended::of(&mut git).expect(0).stdout
    }

    fn commit(&self, tag: &str) {
        self.git("add --all");
        self.git(&format!("commit --quiet --message {tag}"));
        self.git(&format!("tag {tag}"));
    }

    /// The text without its indentation, line by line, and the same answer as JSON.
    #[track_caller]
    fn diff(&self, revision: &str) -> (Vec<String>, Value) {
        let text = self.robot.run(&format!("diff {revision}")).expect(0).stdout;
        let lines = text.lines().map(|line| line.trim().to_owned()).collect();
        let answer = self.robot.run(&format!("diff {revision} --format json"));
        (lines, json(&answer.expect(0).stdout))
    }
}

const BATTERY: &str = r#"use framework::{MainOutput, Parameter, Result, context};
use serde::{Deserialize, Serialize};

#[derive(Deserialize, Serialize)]
pub struct Battery;

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    empty: Parameter<f32, "battery.empty">,
}

#[context]
pub struct MainOutputs {
    is_empty: MainOutput<bool>,
}

impl Battery {
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self)
    }

    pub fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs> {
        Ok(MainOutputs { is_empty: (*context.empty > 1.0).into() })
    }
}
"#;

const HORN: &str = r#"use framework::{Input, MainOutput, Result, context};
use serde::{Deserialize, Serialize};

#[derive(Deserialize, Serialize)]
pub struct Horn;

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    is_empty: Input<bool, "is_empty">,
}

#[context]
pub struct MainOutputs {
    is_loud: MainOutput<bool>,
}

impl Horn {
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self)
    }

    pub fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs> {
        Ok(MainOutputs { is_loud: (*context.is_empty).into() })
    }
}
"#;

/// Lines of the text, in this order.
#[track_caller]
fn says(lines: &[String], expected: &[&str]) {
    let mut rest = lines.iter();
    for part in expected {
        assert!(
            rest.any(|line| line == part),
            "`{part}` is missing in {lines:#?}"
        );
    }
}

fn names(changes: &Value) -> Vec<&str> {
    let items = changes.as_array().expect("a list").iter();
    items
        .map(|item| item["name"].as_str().expect("a name"))
        .collect()
}

/// A git that says whether it could wait for somebody.
#[cfg(unix)]
const GIT: &str = r#"#!/bin/sh
[ /dev/stdin -ef /dev/null ] || asks="reads what people type, "
[ "$GIT_TERMINAL_PROMPT" = 0 ] || asks="${asks}asks for passwords, "
[ "$GIT_NO_LAZY_FETCH" = 1 ] || asks="${asks}fetches, "
echo "fatal: ${asks:-asks nobody}" >&2
exit 128
"#;

#[cfg(unix)]
#[test]
fn git_waits_for_nobody() {
    use std::os::unix::fs::PermissionsExt;

    let robot = Robot::new("smallest");
    robot.write("bin/git", GIT);
    let folder = robot.folder().join("bin");
    let executable = std::fs::Permissions::from_mode(0o755);
    std::fs::set_permissions(folder.join("git"), executable).expect("the folder is ours");
    let path = std::env::var("PATH").unwrap_or_default();
    let mut diff = crate::hulkgen(robot.folder(), "diff");
    diff.env("PATH", format!("{}:{path}", folder.display()))
        .stdin(Stdio::piped());
    let said = Ended::of(&mut diff).expect(2).stderr;
    assert!(said.contains("cannot read `HEAD`: asks nobody"), "{said}");
}

#[test]
fn nothing_changed_is_said_in_a_sentence() {
    let Some(repository) = Repository::new("nothing_changed_is_said_in_a_sentence") else {
        return;
    };
    let (lines, answer) = repository.diff("HEAD");
    assert_eq!(lines, ["the graph is that of `HEAD`"]);
    assert_eq!(answer["before"], answer["after"]);
    assert_eq!(answer["before"]["errors"], 0);
    // A comment and the body of a node are none of the graph.
    repository.robot.edit(
        "nodes/src/battery.rs",
        "> 1.0",
        "> 2.0 /* A few lines\nmore. */",
    );
    let (lines, _) = repository.diff("first");
    assert_eq!(lines, ["the graph is that of `first`"]);
}

#[test]
fn a_new_node_brings_fields_and_edges() {
    let Some(repository) = Repository::new("a_new_node_brings_fields_and_edges") else {
        return;
    };
    let robot = &repository.robot;
    robot.write("nodes/src/horn.rs", HORN);
    robot.edit(
        "nodes/src/lib.rs",
        "pub mod filter;",
        "pub mod filter;\npub mod horn;",
    );
    robot.edit(
        "hulk.toml",
        "\"nodes::battery\"]",
        "\"nodes::battery\", \"nodes::horn\"]",
    );
    let (lines, answer) = repository.diff("first");
    assert_eq!(
        names(&answer["nodes"]["added"]),
        ["nodes::horn of Control"],
        "{answer:#}"
    );
    assert_eq!(names(&answer["edges"]["added"]).len(), 1, "{answer:#}");
    assert_eq!(answer["edges"]["added"][0]["from"]["output"], "is_empty");
    assert_eq!(answer["nodes"]["removed"], serde_json::json!([]));
    assert_ne!(answer["before"]["hash"], answer["after"]["hash"]);
    assert!(
        lines
            .iter()
            .any(|line| line.starts_with("+ nodes::horn of Control: node")),
        "{lines:#?}"
    );

    // Seen from the other side it is gone.
    repository.commit("second");
    repository.git("checkout --quiet first");
    let (lines, answer) = repository.diff("second");
    assert_eq!(
        names(&answer["nodes"]["removed"]),
        ["nodes::horn of Control"]
    );
    assert_eq!(names(&answer["edges"]["removed"]).len(), 1);
    assert!(
        lines
            .iter()
            .any(|line| line.starts_with("- nodes::horn of Control: node")),
        "{lines:#?}"
    );
}

#[test]
fn a_changed_type_shows_both() {
    let Some(repository) = Repository::new("a_changed_type_shows_both") else {
        return;
    };
    let robot = &repository.robot;
    robot.edit(
        "nodes/src/pace.rs",
        "raw: MainOutput<f32>",
        "raw: MainOutput<f64>",
    );
    robot.edit(
        "nodes/src/filter.rs",
        "HistoricInput<f32, \"raw\">",
        "HistoricInput<f64, \"raw\">",
    );
    let (lines, answer) = repository.diff("first");
    let changed = answer["fields"]["changed"].as_array().expect("a list");
    let types = changed.iter().map(|one| {
        let part = |side: &str, key: &str| one[side]["field"][key].as_str().unwrap_or_default();
        (
            part("before", "name"),
            part("before", "type"),
            part("after", "type"),
        )
    });
    let types: Vec<_> = types.collect();
    assert_eq!(types.len(), 2, "{answer:#}");
    assert!(
        types
            .iter()
            .all(|(_, before, after)| (*before, *after) == ("f32", "f64")),
        "{types:?}"
    );
    assert!(lines.contains(&"fields".to_owned()), "{lines:#?}");
    assert!(
        lines
            .iter()
            .any(|line| line.starts_with("~ ") && line.contains("f64")),
        "{lines:#?}"
    );
    assert!(
        lines
            .iter()
            .any(|line| line.starts_with("was ") && line.contains("f32")),
        "{lines:#?}"
    );
    assert_eq!(
        answer["edges"]["changed"],
        serde_json::json!([]),
        "{answer:#}"
    );
}

#[test]
fn a_parameter_that_is_renamed_is_one_more_and_one_less() {
    let Some(repository) = Repository::new("a_parameter_that_is_renamed_is_one_more_and_one_less")
    else {
        return;
    };
    let robot = &repository.robot;
    robot.edit(
        "nodes/src/battery.rs",
        "\"battery.empty\"",
        "\"battery.least\"",
    );
    robot.write("parameters/default.toml", "[battery]\nleast = 10.5\n");
    let (lines, answer) = repository.diff("first");
    assert_eq!(names(&answer["parameters"]["added"]), ["battery.least"]);
    assert_eq!(names(&answer["parameters"]["removed"]), ["battery.empty"]);
    says(&lines, &["parameters"]);
    assert!(
        lines
            .iter()
            .any(|line| line.starts_with("+ battery.least: f32")),
        "{lines:#?}"
    );
    // Its value is none of the graph.
    repository.commit("second");
    robot.write("parameters/default.toml", "[battery]\nleast = 11.5\n");
    assert_eq!(
        repository.diff("second").0,
        ["the graph is that of `second`"]
    );
}

#[test]
fn another_order_names_the_nodes_that_moved() {
    let Some(repository) = Repository::new("another_order_names_the_nodes_that_moved") else {
        return;
    };
    let nodes = "[\"nodes::filter\", \"nodes::pace\", \"nodes::battery\"]";
    let reordered = "[\"nodes::battery\", \"nodes::filter\", \"nodes::pace\"]";
    repository.robot.edit("hulk.toml", nodes, reordered);
    let (lines, answer) = repository.diff("first");
    says(
        &lines,
        &[
            "order",
            "~ nodes::battery of Control runs first, as 0, was 2",
        ],
    );
    let order = answer["order"].as_array().expect("a list");
    assert_eq!(order.len(), 1, "{answer:#}");
    assert_eq!(order[0]["node"], "nodes::battery");
    assert_eq!(
        (&order[0]["before"], &order[0]["after"]),
        (&2.into(), &0.into())
    );
    // The manifest's order of what edges order anyway changes nothing.
    repository.robot.edit(
        "hulk.toml",
        reordered,
        "[\"nodes::battery\", \"nodes::pace\", \"nodes::filter\"]",
    );
    repository.commit("second");
    repository.robot.edit(
        "hulk.toml",
        "\"nodes::pace\", \"nodes::filter\"",
        "\"nodes::filter\", \"nodes::pace\"",
    );
    assert_eq!(
        repository.diff("second").0,
        ["the graph is that of `second`"]
    );
}

#[test]
fn instances_and_targets_and_kinds_are_compared() {
    let Some(repository) = Repository::new("instances_and_targets_and_kinds_are_compared") else {
        return;
    };
    let robot = &repository.robot;
    robot.edit("hulk.toml", "[\"Top\", \"Bottom\"]", "[\"Top\"]");
    robot.edit("hulk.toml", "name = \"bench\"", "name = \"field\"");
    robot.edit(
        "nodes/src/detector.rs",
        "LatestInput<f32, \"Control\", \"estimate\">",
        "Input<f32, \"Control\", \"estimate\">",
    );
    let (_, answer) = repository.diff("first");
    assert_eq!(names(&answer["targets"]["added"]), ["field"]);
    assert_eq!(names(&answer["targets"]["removed"]), ["bench"]);
    assert_eq!(
        answer["cyclers"]["changed"][0]["before"]["name"], "Vision",
        "{answer:#}"
    );
    let field = &answer["fields"]["changed"][0];
    assert_eq!(
        (
            &field["before"]["field"]["kind"],
            &field["after"]["field"]["kind"]
        ),
        (&"LatestInput".into(), &"Input".into())
    );
    // The perception edge of the instance that is gone.
    assert_eq!(
        answer["edges"]["removed"][0]["from"]["instance"], "VisionBottom",
        "{answer:#}"
    );
}

#[test]
fn a_robot_with_mistakes_is_compared_as_far_as_it_goes() {
    let Some(repository) = Repository::new("a_robot_with_mistakes_is_compared_as_far_as_it_goes")
    else {
        return;
    };
    let robot = &repository.robot;
    robot.edit("hulk.toml", ", \"nodes::battery\"]", "]");
    robot.edit(
        "nodes/src/detector.rs",
        "Input<u8, \"brightness\">",
        "Input<u8, \"light\">",
    );
    let ended = robot.run("diff first --format json").expect(0);
    let note = "the robot of now has 1 error: only targets, cyclers and nodes are compared\n";
    assert_eq!(ended.stderr, note);
    let answer = json(&ended.stdout);
    assert_eq!(
        answer["after"],
        serde_json::json!({ "hash": null, "errors": 1 })
    );
    assert_eq!(
        names(&answer["nodes"]["removed"]),
        ["nodes::battery of Control"]
    );
    assert_eq!(answer["edges"]["removed"], serde_json::json!([]));
}

#[test]
fn what_cannot_be_compared_is_wrong_usage() {
    let Some(repository) = Repository::new("what_cannot_be_compared_is_wrong_usage") else {
        return;
    };
    let robot = &repository.robot;
    for (revision, part) in [
        ("nowhere", "git cannot read `nowhere`"),
        ("--output=x", "--output"),
        ("HEAD~9", "git cannot read `HEAD~9`"),
        ("HEAD:hulk.toml", "git cannot read `HEAD:hulk.toml`"),
    ] {
        for form in ["text", "json"] {
            let ended = robot
                .run(&format!("diff {revision} --format {form}"))
                .expect(2);
            assert_eq!(ended.stdout, "", "{revision}");
            assert!(ended.stderr.contains(part), "{revision}: {}", ended.stderr);
        }
    }
    let unknown = robot.run("diff nowhere").expect(2).stderr;
    assert!(
        unknown.contains("help: name a commit, branch or tag of this repository"),
        "{unknown}"
    );

    // A commit without a robot, and a folder without a repository.
    repository.git("checkout --quiet --orphan empty");
    repository.git("rm -r --quiet --cached .");
    repository.git("commit --quiet --allow-empty --message empty");
    let empty = robot.run("diff empty").expect(2).stderr;
    assert!(
        empty.contains("the hulk.toml of `empty` cannot be read, or there is none"),
        "{empty}"
    );
    std::fs::remove_dir_all(robot.path(".git")).expect("it is ours");
    let mut outside = robot.command("diff HEAD");
    outside.env(
        "GIT_CEILING_DIRECTORIES",
        robot.folder().parent().expect("it has one"),
    );
    let outside = Ended::of(&mut outside).expect(2).stderr;
    for part in ["git cannot read `HEAD`", "help: put the robot into git"] {
        assert!(outside.contains(part), "{part}: {outside}");
    }
    repository.git("init --quiet");
    let before = robot.run("diff").expect(2).stderr;
    assert!(
        before.contains("help: nothing is committed yet"),
        "{before}"
    );
}

#[test]
fn nothing_is_checked_out_and_nothing_is_written() {
    let Some(repository) = Repository::new("nothing_is_checked_out_and_nothing_is_written") else {
        return;
    };
    let robot = &repository.robot;
    robot.edit("nodes/src/battery.rs", "> 1.0", "> 3.0");
    let before = repository.git("status --porcelain");
    repository.diff("first");
    assert_eq!(repository.git("status --porcelain"), before);
    assert_eq!(before, " M nodes/src/battery.rs\n");
    assert!(robot.read("nodes/src/battery.rs").contains("> 3.0"));
}

#[test]
fn links_of_a_revision_are_followed_within_it() {
    use std::os::unix::fs::symlink;
    let Some(repository) = Repository::new("links_of_a_revision_are_followed_within_it") else {
        return;
    };
    let robot = &repository.robot;
    let elsewhere = tempfile::tempdir().expect("a temporary folder");
    let link = |target: &std::path::Path, file: &str| {
        std::fs::remove_file(robot.path(file)).expect("it is there");
        symlink(target, robot.path(file)).expect("the folder is ours");
    };
    let file = "nodes/src/battery.rs";
    let text = robot.read(file);
    robot.write("shared/nodes/battery.rs", &text);
    std::fs::write(elsewhere.path().join("battery.rs"), &text).expect("the folder is ours");
    symlink("shared/nodes", robot.path("linked")).expect("the folder is ours");
    link("../../linked/battery.rs".as_ref(), file);
    // Of a location, and of something that nobody asks for.
    robot.write("shared/lab/default.toml", "\n");
    symlink("../shared/lab", robot.path("parameters/lab")).expect("the folder is ours");
    symlink("../nothing", robot.path("parameters/logs")).expect("the folder is ours");
    repository.commit("linked");
    let (lines, _) = repository.diff("linked");
    assert_eq!(lines, ["the graph is that of `linked`"]);
    link(&elsewhere.path().join("battery.rs"), file);
    repository.commit("outside");
    robot.run("check").expect(0);
    let stderr = robot.run("diff outside").expect(2).stderr;
    for part in [
        "the robot of `outside` cannot be read",
        "`nodes/src/battery.rs` is a link to `",
        "which leads out of the repository",
    ] {
        assert!(stderr.contains(part), "{part}: {stderr}");
    }
}
