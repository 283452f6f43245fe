//! Where runs lie, seen from anywhere.

use std::path::Path;

use crate::robot::{Ended, Robot, hulkgen};
use crate::{SAYS_BUILT, fake_cargo, fake_program};

/// What the program is given by `hulkgen run` in this folder.
fn given(robot: &Robot, folder: &Path) -> String {
    let cargo = fake_cargo(robot, SAYS_BUILT);
    fake_program(robot, "echo \"$@\"");
    let mut command = robot.command("run real --headless -- --scene ball --manifest");
    command.current_dir(folder).env("CARGO", cargo);
    Ended::of(&mut command).expect(0).stdout
}

#[test]
fn a_run_tells_paths_that_lead_there_from_the_current_folder() {
    let robot = Robot::tiny();
    let root = robot.folder().canonicalize().expect("it is there");
    let own = "--headless -- --scene ball --manifest\n";
    assert_eq!(given(&robot, &root), own);
    let below = given(&robot, &robot.path("nodes/src"));
    assert_eq!(below, format!("--runs {}/runs {own}", root.display()));
}

#[test]
fn recordings_are_those_of_the_robot_wherever_one_looks_from() {
    let robot = Robot::tiny();
    let root = robot.folder().canonicalize().expect("it is there");
    robot.write("runs/1-2/recording.mcap", "none");
    let own = "runs/1-2/recording.mcap ";
    let listed = |command: &mut std::process::Command| Ended::of(command).expect(0).stdout;
    let at_root = listed(&mut robot.command("recording list"));
    assert!(at_root.starts_with(own), "{at_root}");
    let whole = format!("{}/{own}", root.display());
    let below = listed(
        robot
            .command("recording list")
            .current_dir(robot.path("nodes")),
    );
    assert!(below.starts_with(&whole), "{below}");
    let named = listed(hulkgen("recording list --manifest").arg(robot.path("hulk.toml")));
    assert!(named.starts_with(&whole), "{named}");

    let elsewhere = tempfile::tempdir().expect("there is room");
    let runs = elsewhere.path().join("runs");
    std::fs::create_dir(&runs).expect("it is new");
    std::fs::write(runs.join("a.mcap"), "none").expect("there is room");
    let nowhere = listed(hulkgen("recording list").current_dir(elsewhere.path()));
    assert!(nowhere.starts_with("runs/a.mcap "), "{nowhere}");
}
