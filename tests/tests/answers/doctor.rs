//! `doctor`: each line is ok, or says what to do.

use std::fs::{self, Permissions};
use std::os::unix::fs::PermissionsExt as _;
use std::path::PathBuf;

use crate::robot::Robot;
use crate::{Ended, json};

/// A fixture robot that is ready, on a machine of scripts.
struct Patient {
    robot: Robot,
}

impl Patient {
    fn new() -> Self {
        let robot = Robot::new("perception_and_real_time");
        robot.run("generate").expect(0);
        robot.write("Cargo.lock", "version = 4\n");
        let patient = Self { robot };
        for name in ["cargo", "git", "python3"] {
            patient.program(name, &format!("echo {name} 9.9.9"));
        }
        let libraries = patient.robot.path("installed");
        let rustc = "case $1 in --print) echo $FOLDER/$4;; *) echo rustc 9.9.9;; esac";
        let rustc = rustc.replace("$FOLDER", &libraries.display().to_string());
        patient.program("rustc", &rustc);
        patient.program("df", "echo header; echo /dev/x 9 9 41943040 1% /");
        patient
    }

    fn programs(&self) -> PathBuf {
        self.robot.path(".programs")
    }

    fn program(&self, name: &str, script: &str) {
        let path = format!(".programs/{name}");
        self.robot.write(&path, &format!("#!/bin/sh\n{script}\n"));
        let executable = Permissions::from_mode(0o755);
        fs::set_permissions(self.robot.path(&path), executable).expect("the file is ours");
    }

    fn without(&self, name: &str) {
        fs::remove_file(self.programs().join(name)).expect("it was there");
    }

    fn ask(&self, arguments: &str) -> Ended {
        let mut command = self.robot.command(&format!("doctor {arguments}"));
        Ended::of(command.env("PATH", self.programs()))
    }

    /// The lines about one thing; the status must be that of the whole.
    #[track_caller]
    fn about(&self, about: &str, status: i32) -> String {
        let ended = self.ask("").expect(status);
        assert_eq!(ended.stderr, "");
        let mut lines = ended.stdout.lines().peekable();
        let mut found = String::new();
        while let Some(line) = lines.next() {
            let help = lines.next_if(|line| line.starts_with("         help: "));
            let (state, _) = line.split_at(9);
            assert!(
                ["ok       ", "warning  ", "bad      "].contains(&state),
                "{line}"
            );
            assert_eq!(help.is_none(), state.trim() == "ok", "{}", ended.stdout);
            if line[9..].starts_with(&format!("{about}: ")) {
                found += &format!("{line}\n");
                found.extend(help.map(|help| format!("{help}\n")));
            }
        }
        found
    }
}

#[test]
fn a_ready_robot_on_a_ready_machine_is_ok() {
    let patient = Patient::new();
    let folder = patient.robot.folder().canonicalize().expect("it exists");
    for (about, message) in [
        ("rustc", "rustc 9.9.9"),
        ("cargo", "cargo 9.9.9"),
        ("git", "git 9.9.9"),
        ("python3", "python3 9.9.9"),
        ("workspace", &*folder.display().to_string()),
        ("robot", "manifest, nodes and parameter files are right"),
        ("lock", "`Cargo.lock` is there"),
        ("generated", "`generated` is current"),
        ("disk", "40 GiB free"),
    ] {
        let line = format!("ok       {about}: {message}\n");
        assert_eq!(patient.about(about, 0), line);
    }
}

#[test]
fn a_machine_that_lacks_something_is_told_what_to_install() {
    let patient = Patient::new();
    patient.program("rustc", "echo rustc 1.70.0");
    let old = patient.about("rustc", 1);
    assert!(
        old.starts_with("bad      rustc: rustc 1.70.0 is older than 1."),
        "{old}"
    );
    assert!(old.ends_with("help: run `rustup update`\n"), "{old}");

    for (name, state, status, deed) in [
        ("git", "warning", 0, "install git: "),
        ("python3", "warning", 0, "install python3: "),
        ("df", "warning", 0, "look yourself"),
        ("cargo", "bad    ", 1, "install Rust from rustup.rs"),
        ("rustc", "bad    ", 1, "install Rust from rustup.rs"),
    ] {
        let patient = Patient::new();
        patient.without(name);
        let about = if name == "df" { "disk" } else { name };
        let lines = patient.about(about, status);
        assert!(
            lines.starts_with(&format!("{state}  {about}: cannot ")),
            "{lines}"
        );
        assert!(lines.contains(&format!("         help: {deed}")), "{lines}");
    }
}

#[test]
fn a_full_disk_is_bad() {
    let patient = Patient::new();
    patient.program("df", "echo header; echo /dev/x 9 9 100 99% /");
    let lines = patient.about("disk", 1);
    assert!(
        lines.starts_with("bad      disk: 0 GiB free\n         help: make room; "),
        "{lines}"
    );
}

#[test]
fn a_robot_without_a_lock_is_warned() {
    let patient = Patient::new();
    fs::remove_file(patient.robot.path("Cargo.lock")).expect("it was there");
    assert_eq!(
        patient.about("lock", 0),
        "warning  lock: `Cargo.lock` is missing: two builds may use different crates\n         \
         help: run `cargo generate-lockfile` and commit the file\n"
    );
}

#[test]
fn a_generated_crate_that_is_missing_or_stale_or_somebody_elses_is_bad() {
    let patient = Patient::new();
    let deed = "         help: run `hulkgen generate`\n";
    let library = patient.robot.read("generated/src/lib.rs");
    patient.robot.write("generated/src/lib.rs", "// mine\n");
    let stale = patient.about("generated", 1);
    let message = "bad      generated: `generated` is not what would be generated now\n";
    assert_eq!(stale, format!("{message}{deed}"));

    patient.robot.write("generated/src/lib.rs", &library);
    patient.robot.write("generated/orphan.rs", "");
    assert_eq!(patient.about("generated", 1), stale);

    fs::remove_dir_all(patient.robot.path("generated")).expect("it is ours");
    let missing = patient.about("generated", 1);
    assert_eq!(
        missing,
        format!("bad      generated: `generated` is missing\n{deed}")
    );

    patient.robot.write("generated/notes.txt", "by hand\n");
    let foreign = patient.about("generated", 1);
    assert!(
        foreign.contains("`generated` cannot be the generated folder"),
        "{foreign}"
    );
}

#[test]
fn a_robot_with_mistakes_is_bad_and_says_where_they_are_shown() {
    let patient = Patient::new();
    let name = "parameters = \"parameters\"";
    patient
        .robot
        .edit("hulk.toml", name, "parameters = \"settings\"");
    let deed = "         help: `hulkgen check` shows what and where\n";
    assert_eq!(
        patient.about("robot", 1),
        format!("bad      robot: 1 error\n{deed}")
    );
    // The mistake changes nothing in the generated crate but the folder's name.
    assert!(patient.about("generated", 1).starts_with("bad"));

    let patient = Patient::new();
    patient
        .robot
        .edit("hulk.toml", "\"nodes::camera\"", "\"nodes::kamera\"");
    assert_eq!(
        patient.about("robot", 1),
        format!("bad      robot: 1 error\n{deed}")
    );
    // What cannot be understood cannot be compared.
    assert_eq!(patient.about("generated", 1), "");

    let patient = Patient::new();
    let output = "    estimate: MainOutput<f32>,";
    let unread = format!("{output}\n    raw_count: MainOutput<u8>,");
    patient.robot.edit("nodes/src/filter.rs", output, &unread);
    assert!(
        patient.about("robot", 1).starts_with("ok"),
        "one output of a node may be unread"
    );
    patient.robot.edit(
        "nodes/src/detector.rs",
        "    estimate: LatestInput<f32, \"Control\", \"estimate\">,\n",
        "",
    );
    patient.robot.edit(
        "nodes/src/filter.rs",
        "    before: PreviousInput<f32, \"estimate\">,\n",
        "",
    );
    patient.robot.run("generate").expect(0);
    let unread = patient.about("robot", 0);
    assert_eq!(unread, format!("warning  robot: 1 warning\n{deed}"));
}

#[test]
fn a_target_of_another_machine_needs_its_libraries() {
    let patient = Patient::new();
    let hardware = "hardware = \"nodes::Hardware\"\n";
    let triple = "riscv64gc-unknown-linux-gnu";
    let target = format!("{hardware}triple = \"{triple}.2.28\"\n");
    patient.robot.edit("hulk.toml", hardware, &target);
    patient.robot.run("generate").expect(0);
    assert_eq!(
        patient.about("target", 0),
        format!(
            "warning  target: `bench`: {triple} is not installed\n         \
             help: run `rustup target add {triple}`\n"
        )
    );
    patient
        .robot
        .write(&format!("installed/{triple}/libstd.rlib"), "");
    let line = format!("ok       target: `bench`: {triple} is installed\n");
    assert_eq!(patient.about("target", 0), line);
}

#[test]
fn without_a_robot_the_machine_is_looked_at_all_the_same() {
    let patient = Patient::new();
    fs::remove_file(patient.robot.path("hulk.toml")).expect("it was there");
    let lines = patient.about("workspace", 1);
    assert!(
        lines.starts_with("bad      workspace: no `hulk.toml` in "),
        "{lines}"
    );
    assert!(lines.contains("--manifest PATH"), "{lines}");
    assert!(patient.about("rustc", 1).starts_with("ok"));
    assert!(patient.about("disk", 1).starts_with("ok"));
}

#[test]
fn programs_read_the_same_as_people() {
    let patient = Patient::new();
    patient.without("git");
    let text = patient.ask("").expect(0).stdout;
    let answer = json(&patient.ask("--format json").expect(0).stdout);
    assert_eq!(answer["version"], 1);
    let checks = answer["checks"].as_array().expect("a list");
    let lines = checks.iter().map(|check| {
        let word = |key: &str| check[key].as_str().unwrap_or_default();
        let help = check["help"].as_str();
        let help = help.map(|help| format!("         help: {help}\n"));
        let (state, about, message) = (word("state"), word("about"), word("message"));
        format!(
            "{state:7}  {about}: {message}\n{}",
            help.unwrap_or_default()
        )
    });
    assert_eq!(lines.collect::<String>(), text);
    assert!(checks.iter().any(|check| check["state"] == "warning"));
}
