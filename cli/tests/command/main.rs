//! The built `hulkgen`: what it prints where, and how it ends.

mod build;
mod cache;
mod interrupt;
mod robot;
mod runs;
mod together;
mod watched;

use std::process::Stdio;

use clap::CommandFactory as _;
use hulkgen::arguments::Arguments;
use robot::{Ended, Robot, hulkgen};
use serde_json::Value;

fn json(text: &str) -> Value {
    serde_json::from_str(text).unwrap_or_else(|error| panic!("{error} in:\n{text}"))
}

#[test]
fn the_help_of_every_command_has_exit_status_and_example() {
    Ended::of(&mut hulkgen("--help")).expect(0);
    Ended::of(&mut hulkgen("--version")).expect(0);
    let arguments = Arguments::command();
    let commands = arguments.get_subcommands().map(clap::Command::get_name);
    let commands: Vec<&str> = commands.collect();
    assert!(commands.len() >= 17, "{commands:?}");
    for command in commands {
        let help = Ended::of(&mut hulkgen(&format!("{command} --help")))
            .expect(0)
            .stdout;
        for part in [
            "Exit status:",
            "Example",
            &format!("hulkgen {command}"),
            "--manifest",
        ] {
            assert!(
                help.contains(part),
                "`{part}` is missing in the help of {command}:\n{help}"
            );
        }
        assert!(
            help.lines().next().is_some_and(|line| line.len() > 10),
            "{command} says nothing"
        );
    }
}

#[test]
fn wrong_usage_ends_with_2() {
    let robot = Robot::tiny();
    for arguments in [
        "",
        "fly",
        "graph --format png",
        "graph --cycler Vision",
        "show everything",
        "explain nothing_of_this_name",
        "run moon",
        "run --for soon",
        "run --for 0s",
        "check --manifest nodes/Cargo.toml",
    ] {
        let ended = robot.run(arguments).expect(2);
        assert!(
            ended.stdout.is_empty(),
            "`{arguments}` printed data:\n{}",
            ended.stdout
        );
        assert!(!ended.stderr.is_empty(), "`{arguments}` says nothing");
    }
}

#[test]
fn an_unknown_target_lists_the_targets() {
    let stderr = Robot::tiny().run("run simulatd").expect(2).stderr;
    assert!(stderr.contains("did you mean `simulated`?"), "{stderr}");
    assert!(stderr.contains("`real` and `simulated`"), "{stderr}");
}

#[test]
fn a_good_robot_is_summed_up() {
    let ended = Robot::tiny().run("check").expect(0);
    let summary = "robot tiny: 1 cycler, 1 instance, 2 nodes, 2 edges, all checked\n";
    assert!(ended.stdout.ends_with(summary), "{}", ended.stdout);
    assert_eq!(ended.stderr, "");
}

#[test]
fn what_is_left_to_rustc_is_no_edge_if_all_edges_are_checked() {
    let robot = Robot::tiny();
    robot.edit(
        "nodes/src/lib.rs",
        "pub mod counter;",
        "#[cfg(feature = \"no\")]\npub mod counter;",
    );
    let ended = robot.run("check").expect(0);
    let summary = ", 2 edges, all checked, 1 other question left to rustc\n";
    assert!(ended.stdout.ends_with(summary), "{}", ended.stdout);
}

#[test]
fn a_broken_manifest_ends_with_1_and_writes_nothing() {
    let robot = Robot::tiny();
    robot.edit("hulk.toml", "\"nodes::counter\"", "\"nodes::conter\"");
    let generate = robot.run("generate").expect(1);
    assert!(
        generate.stderr.contains("error[unknown-node]"),
        "{}",
        generate.stderr
    );
    assert!(!robot.path("generated").exists());
    let check = robot.run("check").expect(1);
    assert!(check.stdout.contains("hulk.toml:8"), "{}", check.stdout);
    assert!(check.stdout.contains("\n1 error\n"), "{}", check.stdout);
    for command in ["graph", "show robot", "explain ticks", "run"] {
        let ended = robot.run(command).expect(1);
        assert!(ended.stdout.is_empty(), "{command} printed data");
        assert!(
            ended.stderr.contains("error[unknown-node]"),
            "{command}: {}",
            ended.stderr
        );
    }
}

#[test]
fn json_of_check_has_places_from_1() {
    let robot = Robot::tiny();
    assert_eq!(
        json(&robot.run("check --format json").expect(0).stdout),
        serde_json::json!({ "version": 1, "diagnostics": [] })
    );
    robot.edit(
        "nodes/src/counter.rs",
        "Input<u64, \"ticks\">",
        "Input<u64, \"tick\">",
    );
    let ended = robot.run("check --format json").expect(1);
    let answer = json(&ended.stdout);
    let diagnostic = &answer["diagnostics"][0];
    assert_eq!(diagnostic["code"], "unknown-output");
    assert_eq!(diagnostic["severity"], "error");
    assert_eq!(diagnostic["spans"][0]["file"], "nodes/src/counter.rs");
    assert_eq!(diagnostic["spans"][0]["line"], 14);
    assert_eq!(ended.stderr, "");
}

#[test]
fn warnings_are_errors_only_when_denied() {
    let robot = Robot::tiny();
    robot.edit(
        "nodes/src/counter.rs",
        "    last: PreviousInput<u64, \"count\">,\n",
        "",
    );
    let check = robot.run("check").expect(0);
    assert!(
        check.stdout.contains("1 warning\nrobot tiny:"),
        "{}",
        check.stdout
    );
    robot.run("check --deny-warnings").expect(1);
    robot.run("generate").expect(0);
}

#[test]
fn generate_writes_once_and_check_mode_finds_drift() {
    let robot = Robot::tiny();
    let before = robot.run("generate --check").expect(3);
    assert!(!robot.path("generated").exists());
    assert!(
        before.stdout.contains("generated/src/lib.rs"),
        "{}",
        before.stdout
    );

    let first = robot.run("generate").expect(0);
    assert!(
        first.stderr.contains("generated/src/lib.rs"),
        "{}",
        first.stderr
    );
    assert_eq!(first.stdout, "");
    let library = std::fs::metadata(robot.path("generated/src/lib.rs")).expect("it was written");
    robot.run("generate --check").expect(0);
    robot.run("generate").expect(0);
    let again = std::fs::metadata(robot.path("generated/src/lib.rs")).expect("it is there");
    assert_eq!(library.modified().ok(), again.modified().ok());

    let text = robot.read("generated/src/lib.rs");
    robot.write("generated/src/lib.rs", &format!("// mine\n{text}"));
    robot.write("generated/src/mine.rs", "");
    let drift = robot.run("generate --check").expect(3);
    assert!(drift.stdout.contains("-// mine"), "{}", drift.stdout);
    assert!(
        drift.stdout.contains("generated/src/mine.rs"),
        "{}",
        drift.stdout
    );
    assert!(
        drift.stderr.contains("hulkgen generate"),
        "{}",
        drift.stderr
    );
    robot.run("generate").expect(0);
    assert_eq!(robot.read("generated/src/lib.rs"), text);
    assert!(!robot.path("generated/src/mine.rs").exists());
}

#[test]
fn generate_never_removes_what_others_wrote() {
    for (folder, file) in [
        ("parameters", "parameters/default.toml"),
        ("nodes", "nodes/src/clock.rs"),
        ("nodes/src", "nodes/src/clock.rs"),
        ("notes", "notes/today.md"),
    ] {
        let robot = Robot::tiny();
        robot.write("notes/today.md", "the ball is red\n");
        let name = "name = \"tiny\"\n";
        robot.edit(
            "hulk.toml",
            name,
            &format!("{name}generated = \"{folder}\"\n"),
        );
        let before = robot.read(file);
        let stderr = robot.run("generate").expect(1).stderr;
        let message = format!("`{folder}` cannot be the generated folder");
        assert!(stderr.contains(&message), "{stderr}");
        robot.run("generate --check").expect(1);
        assert_eq!(robot.read(file), before, "{folder}");
    }
}

#[test]
fn errors_in_parameter_files_keep_nothing_from_being_generated_but_no_robot_runs_with_them() {
    let robot = Robot::tiny();
    robot.write("parameters/default.toml", "stepp = 1\n");
    let check = robot.run("check").expect(1).stdout;
    assert!(check.contains("parameters/default.toml:1"), "{check}");
    robot.run("run").expect(1);
    assert!(!robot.path("generated").exists());
    robot.run("generate").expect(1);
    assert!(robot.path("generated/src/lib.rs").exists());
}

#[test]
fn the_schema_is_kept_where_the_manifest_names_it() {
    let robot = Robot::tiny();
    robot.run("generate").expect(0);
    assert!(!robot.path(".hulk").exists());
    let manifest = robot.read("hulk.toml");
    robot.write(
        "hulk.toml",
        &format!("#:schema .hulk/hulk.schema.json\n{manifest}"),
    );
    robot.run("generate --check").expect(3);
    robot.run("generate").expect(0);
    let schema = Ended::of(&mut hulkgen("schema")).expect(0).stdout;
    assert_eq!(robot.read(".hulk/hulk.schema.json"), schema);
}

#[test]
fn json_of_generate_names_what_differs() {
    let robot = Robot::tiny();
    let written = json(&robot.run("generate --format json").expect(0).stdout);
    let added = written["added"].as_array().expect("it is a list");
    assert!(added.contains(&"generated/Cargo.toml".into()), "{written}");
    robot.write("generated/src/lib.rs", "");
    robot.write("generated/mine", "");
    let ended = robot.run("generate --check --format json").expect(3);
    assert_eq!(
        json(&ended.stdout),
        serde_json::json!({
            "version": 1,
            "added": [],
            "changed": ["generated/src/lib.rs"],
            "orphaned": ["generated/mine"],
        })
    );
}

#[test]
fn merge_conflicts_in_generated_files_do_not_matter() {
    let robot = Robot::tiny();
    robot.run("generate").expect(0);
    let conflict = "<<<<<<< ours\n=======\n>>>>>>> theirs\n";
    robot.write("generated/Cargo.toml", conflict);
    robot.write("generated/src/lib.rs", conflict);
    robot.run("check").expect(0);
    robot.run("generate").expect(0);
    robot.run("generate --check").expect(0);
}

#[test]
fn a_command_works_below_the_root_and_from_elsewhere() {
    let robot = Robot::tiny();
    let below = Ended::of(robot.command("check").current_dir(robot.path("nodes/src"))).expect(0);
    for manifest in [robot.path("hulk.toml"), robot.folder().to_owned()] {
        let elsewhere = Ended::of(hulkgen("check --manifest").arg(manifest)).expect(0);
        assert_eq!(elsewhere.stdout, below.stdout);
    }
    let nowhere = Ended::of(hulkgen("check").current_dir("/")).expect(1);
    assert!(
        nowhere.stderr.contains("no `hulk.toml`"),
        "{}",
        nowhere.stderr
    );
}

#[test]
fn the_graph_is_printed_in_every_format() {
    let robot = Robot::tiny();
    let graph = json(&robot.run("graph --format json").expect(0).stdout);
    assert_eq!(graph["edges"][0]["from"]["node"], "nodes::clock");
    assert_eq!(graph["edges"][1]["kind"], "previous");
    for (format, start) in [
        ("svg", "<svg"),
        ("dot", "digraph"),
        ("mermaid", "flowchart"),
        ("html", "<!DOCTYPE html>"),
    ] {
        let ended = robot
            .run(&format!("graph --cycler Control --format {format}"))
            .expect(0);
        assert!(
            ended.stdout.starts_with(start),
            "{format}: {}",
            ended.stdout
        );
        assert_eq!(ended.stderr, "");
    }
}

#[test]
fn every_stage_can_be_shown() {
    let robot = Robot::tiny();
    for (stage, part) in [
        ("manifest", "target simulated: nodes::Hardware"),
        ("nodes", "    ticks: Input<u64, \"ticks\">"),
        ("robot", "      last: PreviousInput<u64, \"count\">"),
        ("schedule", "after nodes::clock: ticks (Input \"ticks\")"),
        ("model", "package tiny_runtime in generated"),
    ] {
        let text = robot.run(&format!("show {stage}")).expect(0).stdout;
        assert!(
            text.contains(part),
            "`{part}` is missing in {stage}:\n{text}"
        );
    }
}

#[test]
fn codes_nodes_and_outputs_are_explained() {
    let code = Ended::of(&mut hulkgen("explain unknown-output")).expect(0);
    assert!(
        code.stdout.starts_with("unknown-output (error)"),
        "{}",
        code.stdout
    );
    let robot = Robot::tiny();
    let node = robot.run("explain counter").expect(0).stdout;
    assert!(
        node.contains("reads ticks (input) of nodes::clock"),
        "{node}"
    );
    let output = json(
        &robot
            .run("explain Control.ticks --format json")
            .expect(0)
            .stdout,
    );
    assert_eq!(output["outputs"][0]["node"], "nodes::clock");
}

#[test]
fn the_schema_is_json() {
    let schema = json(&Ended::of(&mut hulkgen("schema")).expect(0).stdout);
    assert!(schema["properties"]["robot"].is_object());
}

#[test]
fn colour_only_where_it_is_asked_for() {
    let robot = Robot::tiny();
    robot.edit("hulk.toml", "\"nodes::counter\"", "\"nodes::conter\"");
    assert!(!robot.run("check").expect(1).stdout.contains('\x1b'));
    assert!(
        robot
            .run("check --color always")
            .expect(1)
            .stdout
            .contains('\x1b')
    );
    assert!(
        robot
            .run("generate --color always")
            .expect(1)
            .stderr
            .contains('\x1b')
    );
}

#[test]
fn where_no_node_is_yet_the_crates_are_named_that_one_may_stand_in() {
    let robot = Robot::tiny();
    let manifest = robot.read("hulk.toml");
    let (head, rest) = manifest.split_once("[[cycler]]").expect("it has one");
    let (_, targets) = rest.split_once("[[target]]").expect("it has two");
    robot.write("hulk.toml", &format!("{head}[[target]]{targets}"));
    robot.write("parameters/default.toml", "");
    let ended = robot.run("add-cycler Control --kind real-time --setup-node thinking::clock");
    let said = ended.expect(2).stderr;
    assert!(said.contains("the workspace has `nodes`\n"), "{said}");
}

#[test]
fn a_reader_that_goes_away_is_no_bug() {
    let robot = Robot::tiny();
    let mut child = robot
        .command("graph --format html")
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("hulkgen was built");
    drop(child.stdout.take());
    let ended = child.wait_with_output().expect("it ends");
    assert_eq!(ended.status.code(), Some(0));
    assert!(ended.stderr.is_empty());
}

/// A cargo that says it built `robot.sh`, or fails.
fn fake_cargo(robot: &Robot, script: &str) -> std::path::PathBuf {
    robot.write("cargo.sh", &format!("#!/bin/sh\n{script}\n"));
    let path = robot.path("cargo.sh");
    make_executable(&path);
    path
}

fn fake_program(robot: &Robot, script: &str) {
    robot.write("robot.sh", &format!("#!/bin/sh\n{script}\n"));
    make_executable(&robot.path("robot.sh"));
}

fn make_executable(path: &std::path::Path) {
    use std::os::unix::fs::PermissionsExt as _;
    let mode = std::fs::Permissions::from_mode(0o755);
    std::fs::set_permissions(path, mode).expect("it is our file");
}

const SAYS_BUILT: &str = r#"echo "$@" >&2
echo '{"reason":"compiler-artifact","target":{"name":"real"},"executable":"'"$PWD"'/robot.sh"}'"#;

#[test]
fn run_generates_builds_and_becomes_the_program() {
    let robot = Robot::tiny();
    let cargo = fake_cargo(&robot, SAYS_BUILT);
    fake_program(&robot, "echo \"$@\"; exit 7");
    let mut command = robot.command("run real --for 2s --format json -- --scene ball");
    let ended = Ended::of(command.env("CARGO", cargo)).expect(7);
    assert!(robot.path("generated/src/bin/real.rs").exists());
    let build = "--package tiny_runtime --no-default-features --bin real --features target-real";
    assert!(ended.stderr.contains(build), "{}", ended.stderr);
    let options = ended.stdout.trim_end();
    assert_eq!(options, "--for 2s --format json -- --scene ball");
}

#[test]
fn run_builds_for_this_machine_with_the_profile_of_the_target() {
    let robot = Robot::tiny();
    let cargo = fake_cargo(&robot, SAYS_BUILT);
    fake_program(&robot, "true");
    let name = "name = \"real\"\n";
    robot.edit("hulk.toml", name, &format!("{name}profile = \"nao\"\n"));
    for (arguments, profile) in [
        ("run real", "--profile nao"),
        ("run real --profile dev", "--profile dev"),
    ] {
        let ended = Ended::of(robot.command(arguments).env("CARGO", &cargo)).expect(0);
        assert!(ended.stderr.contains(profile), "{}", ended.stderr);
    }
    robot.edit("hulk.toml", name, &format!("{name}triple = \"a-b-c\"\n"));
    let ended = Ended::of(robot.command("run real").env("CARGO", &cargo)).expect(1);
    let message = "target `real` is for `a-b-c`: `run` builds for this machine only";
    assert!(ended.stderr.contains(message), "{}", ended.stderr);
}

#[test]
fn a_failed_build_ends_with_1() {
    let robot = Robot::tiny();
    let cargo = fake_cargo(&robot, "echo 'error: could not compile' >&2; exit 101");
    let ended = Ended::of(robot.command("run").env("CARGO", cargo)).expect(1);
    assert!(
        ended.stderr.contains("could not compile"),
        "{}",
        ended.stderr
    );
    let ended = Ended::of(robot.command("run").env("CARGO", "/no/cargo")).expect(1);
    assert!(
        ended.stderr.contains("cannot start `/no/cargo`"),
        "{}",
        ended.stderr
    );
}
