//! `generate --only`: a second crate beside the robot's, which is not touched.

use std::fs;
use std::time::SystemTime;

use crate::json;
use crate::robot::Robot;

/// The robot with its own crate.
fn generated() -> Robot {
    let robot = Robot::new("perception_and_real_time");
    robot.run("generate").expect(0);
    robot
}

/// Every file of the robot's own crate with its text and the time of its last change.
fn own_crate(robot: &Robot) -> Vec<(String, String, SystemTime)> {
    let mut files = Vec::new();
    let mut folders = vec![robot.path("generated")];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).expect("it is a folder") {
            let path = entry.expect("it was just listed").path();
            if path.is_dir() {
                folders.push(path);
                continue;
            }
            let text = fs::read_to_string(&path).expect("it is text");
            let changed = fs::metadata(&path).and_then(|about| about.modified());
            let changed = changed.expect("times are kept here");
            files.push((path.display().to_string(), text, changed));
        }
    }
    files.sort();
    files
}

#[test]
fn a_second_crate_is_written_and_the_first_left_alone() {
    let robot = generated();
    let before = own_crate(&robot);
    let first = robot.run("generate --only Control").expect(0);
    assert!(
        first.stderr.contains("+ generated-control/src/runtime.rs"),
        "{first:?}"
    );
    for line in [
        "\"generated-control\"  to `members` of [workspace]",
        "perception_and_real_time_control_runtime = { path = \"generated-control\" }",
    ] {
        assert!(first.stderr.contains(line), "{}", first.stderr);
    }
    assert_eq!(own_crate(&robot), before);
    robot.run("generate --check").expect(0);

    let members = "members = [\"generated\", ";
    robot.edit(
        "Cargo.toml",
        members,
        &format!("{members}\"generated-*\", "),
    );
    let second = robot.run("generate --only Control").expect(0);
    assert!(
        second.stderr.contains("`generated-control` is current"),
        "{second:?}"
    );
    assert!(!second.stderr.contains("members"), "{}", second.stderr);
    let check = robot
        .run("generate --check --only Control --format json")
        .expect(0);
    assert_eq!(json(&check.stdout)["added"], serde_json::json!([]));
}

#[test]
fn a_partial_crate_goes_stale_by_itself_and_says_which_command_repairs_it() {
    let robot = generated();
    let options = "--only Vision --output partial";
    robot.run(&format!("generate {options}")).expect(0);
    let test = robot.read("partial/tests/drift.rs");
    assert!(
        test.contains("&[\"--only\", \"Vision\", \"--output\", \"partial\"]"),
        "{test}"
    );
    robot.edit("hulk.toml", "deadline = \"33ms\"", "deadline = \"34ms\"");
    robot.run("generate").expect(0);
    robot.run("generate --check").expect(0);
    let stale = robot.run(&format!("generate --check {options}")).expect(3);
    let command = format!("run `hulkgen generate {options}`");
    assert!(stale.stderr.contains(&command), "{}", stale.stderr);
    robot.run(&format!("generate {options}")).expect(0);
    robot.run(&format!("generate --check {options}")).expect(0);
}

#[test]
fn what_is_no_cycler_is_wrong_usage_and_nothing_is_written() {
    let robot = generated();
    for (only, message, help) in [
        (
            "Contro",
            "there is no cycler `Contro`",
            "did you mean `Control`?",
        ),
        (
            "Vision,Motion",
            "there is no cycler `Motion`",
            "the robot has `Control` and `Vision`",
        ),
        (
            "VisionTop",
            "there is no cycler `VisionTop`",
            "it is an instance of `Vision`",
        ),
        (
            ",",
            "there is no cycler ``",
            "the robot has `Control` and `Vision`",
        ),
    ] {
        let ended = robot.run(&format!("generate --only {only}")).expect(2);
        assert!(ended.stderr.contains(message), "{}", ended.stderr);
        assert!(ended.stderr.contains(help), "{}", ended.stderr);
    }
    let entries = fs::read_dir(robot.folder()).expect("it is a folder");
    let names = entries.map(|entry| entry.expect("it was just listed").file_name());
    let names: Vec<String> = names.map(|name| name.display().to_string()).collect();
    assert!(
        names.iter().all(|name| !name.starts_with("generated-")),
        "{names:?}"
    );
}

#[test]
fn a_folder_that_is_somebody_elses_is_refused() {
    let robot = generated();
    let node = robot.read("nodes/src/camera.rs");
    let before = own_crate(&robot);
    for folder in [
        "generated",
        "generated/control",
        "nodes",
        "nodes/src",
        "parameters",
        "../out",
        ".",
    ] {
        let ended = robot
            .run(&format!("generate --only Control --output {folder}"))
            .expect(2);
        assert!(
            ended.stderr.contains("name another folder"),
            "{folder}: {}",
            ended.stderr
        );
    }
    assert_eq!(
        (robot.read("nodes/src/camera.rs"), own_crate(&robot)),
        (node, before)
    );
    robot.run("generate --output elsewhere").expect(2);
    // Not in the workspace, but not hulkgen's either.
    robot.write("notes/mine.txt", "mine");
    let ended = robot
        .run("generate --only Control --output notes")
        .expect(1);
    assert!(
        ended.stderr.contains("hulkgen did not write"),
        "{}",
        ended.stderr
    );
    assert_eq!(robot.read("notes/mine.txt"), "mine");
}

#[test]
fn a_partial_crate_may_be_missing_or_full_of_conflict_marks() {
    let robot = generated();
    let members = "members = [\"generated\", ";
    robot.edit(
        "Cargo.toml",
        members,
        &format!("{members}\"generated-control\", "),
    );
    robot.run("check").expect(0);
    robot.run("generate --only Control").expect(0);
    let package = robot.read("generated-control/Cargo.toml");
    let conflict = format!("<<<<<<< ours\n{package}=======\n>>>>>>> theirs\n");
    robot.write("generated-control/Cargo.toml", &conflict);
    robot.run("check").expect(0);
    robot.run("generate --only Control").expect(0);
    assert_eq!(robot.read("generated-control/Cargo.toml"), package);
}
