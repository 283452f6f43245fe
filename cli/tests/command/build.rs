//! What rustc is told of the target's processor, by whichever command builds the program.

use crate::robot::{Ended, Robot};
use crate::{fake_cargo, make_executable};

/// It knows of one feature beyond any processor.
const RUSTC: &str = r#"#!/bin/sh
case "$*" in
*host-tuple*) echo a-b-c ;;
*wide*) echo 'target_feature="wide"' ;;
esac
"#;

fn built(variables: &[(&str, &str)]) -> Ended {
    built_by("build", variables)
}

fn built_by(command: &str, variables: &[(&str, &str)]) -> Ended {
    let robot = Robot::tiny();
    let name = "name = \"real\"\n";
    robot.edit("hulk.toml", name, &format!("{name}cpu = \"small\"\n"));
    robot.write("rustc.sh", RUSTC);
    make_executable(&robot.path("rustc.sh"));
    let cargo = fake_cargo(
        &robot,
        r#"echo "told: $CARGO_ENCODED_RUSTFLAGS" | tr '\037' '|' >&2; exit 101"#,
    );
    let mut command = robot.command(&format!("{command} real"));
    command
        .env_remove("RUSTFLAGS")
        .env_remove("CARGO_ENCODED_RUSTFLAGS")
        .env_remove("CARGO_BUILD_RUSTFLAGS")
        .env("CARGO", cargo)
        .env("RUSTC", robot.path("rustc.sh"))
        .envs(variables.iter().copied());
    Ended::of(&mut command).expect(1)
}

const VARIABLES: [&str; 4] = [
    "CARGO_ENCODED_RUSTFLAGS",
    "RUSTFLAGS",
    "CARGO_TARGET_A_B_C_RUSTFLAGS",
    "CARGO_BUILD_RUSTFLAGS",
];

#[test]
fn the_processor_stands_behind_whatever_flags_cargo_would_take() {
    let told = |variables: &[(&str, &str)], expected: &str| {
        let said = built(variables).stderr;
        assert!(said.contains(&format!("told: {expected}\n")), "{said}");
    };
    told(&[], "-Ctarget-cpu=small");
    for variable in VARIABLES {
        told(
            &[(variable, "-Cdebuginfo=0")],
            "-Cdebuginfo=0|-Ctarget-cpu=small",
        );
    }
}

#[test]
fn flags_of_every_variable_are_refused_if_the_processor_cannot_keep_them() {
    for variable in VARIABLES {
        let said = built(&[(variable, "-Ctarget-feature=+wide")]).stderr;
        let message = format!("{variable} lets the program use wide, which `small` lacks");
        assert!(said.contains(&message), "{said}");
        assert!(!said.contains("told:"), "nothing is built: {said}");
    }
}

#[test]
fn run_builds_the_same_program() {
    for variables in [&[][..], &[("RUSTFLAGS", "-Cdebuginfo=0")]] {
        let [built, run] = ["build", "run"].map(|command| built_by(command, variables).stderr);
        assert!(built.contains("-Ctarget-cpu=small\n"), "{built}");
        assert_eq!(run, built);
    }
    let said = built_by("run", &[("RUSTFLAGS", "-Ctarget-feature=+wide")]).stderr;
    assert!(said.contains("which `small` lacks"), "{said}");
}
