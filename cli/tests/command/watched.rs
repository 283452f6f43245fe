//! `run --watch`: one program after the other, beside hulkgen.

use std::io::{BufRead as _, BufReader, Read};
use std::os::unix::process::{CommandExt as _, ExitStatusExt as _};
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::thread;
use std::time::Duration;

use crate::robot::Robot;
use crate::{fake_cargo, fake_program};

/// Builds the program that a line of lib.rs names; slowly, where another says so, or not at all.
const BUILDS: &str = r##"
grep -q BROKEN nodes/src/lib.rs && { echo 'error: broken' >&2; exit 101; }
name=$(sed -n 's/^\/\/ program //p' nodes/src/lib.rs)
{ echo '#!/bin/sh'; echo "name='$name'"; cat program.sh; } > robot.new
chmod +x robot.new
mv robot.new robot.sh
grep -q SLOW nodes/src/lib.rs && { echo building >&2; sleep 600; }
echo '{"reason":"compiler-artifact","target":{"name":"real"},"executable":"'"$PWD"'/robot.sh"}'"##;

/// Ends in order when it is asked to, and answers Ctrl-C a little later.
const ROBOT: &str = r#"
trap 'sleep 0.3; echo "$name asked"; exit 0' TERM
trap 'sleep 0.3; echo "$name interrupted"; exit 130' INT
echo "$name started"
while true; do sleep 0.05; done"#;

/// A `hulkgen run --watch` and what is said meanwhile.
struct Watched {
    robot: Robot,
    child: Child,
    said: Receiver<String>,
    noted: Receiver<String>,
}

impl Watched {
    fn start(program: &str) -> Self {
        let robot = Robot::tiny();
        let cargo = fake_cargo(&robot, BUILDS);
        fake_program(&robot, "exit 9");
        robot.write("program.sh", program);
        write_lib(&robot, "// program one\n");
        let mut child = robot
            .command("run real --watch")
            .env("CARGO", cargo)
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .process_group(0)
            .spawn()
            .expect("hulkgen was built");
        Self {
            said: lines(child.stdout.take().expect("it is piped")),
            noted: lines(child.stderr.take().expect("it is piped")),
            robot,
            child,
        }
    }

    fn save(&self, text: &str) {
        write_lib(&self.robot, text);
    }

    #[track_caller]
    fn expect_said(&self, line: &str) {
        assert_eq!(next(&self.said).as_deref(), Some(line));
    }

    /// Of what hulkgen notes, the next line with this part.
    #[track_caller]
    fn expect_note(&self, part: &str) {
        let mut before = Vec::new();
        while let Some(line) = next(&self.noted) {
            if line.contains(part) {
                return;
            }
            before.push(line);
        }
        panic!("no `{part}` in {before:#?}");
    }

    fn send(&self, signal: &str, to: &str) {
        let sent = Command::new("kill").args([signal, "--", to]).status();
        assert!(sent.expect("there is a kill").success());
    }

    /// As a terminal sends it.
    fn interrupt(&self) {
        self.send("-INT", &format!("-{}", self.child.id()));
    }

    /// What was said until everybody is gone, and the status or the signal that ended hulkgen.
    fn end(mut self) -> (Vec<String>, Option<i32>) {
        let status = self.child.wait().expect("it ends");
        // Nobody writes any more whom hulkgen has waited for.
        let said = self.said.try_iter().collect();
        (said, status.code().or(status.signal()))
    }
}

impl Drop for Watched {
    fn drop(&mut self) {
        let group = format!("-{}", self.child.id());
        let _ = Command::new("kill")
            .args(["-KILL", "--", &group])
            .stderr(Stdio::null())
            .status();
        let _ = self.child.wait();
    }
}

fn write_lib(robot: &Robot, more: &str) {
    let lib = robot.read("nodes/src/lib.rs");
    let own = lib.lines().filter(|line| !line.starts_with("// "));
    let own: Vec<_> = own.collect();
    robot.write("nodes/src/lib.rs", &format!("{}\n{more}", own.join("\n")));
}

fn lines(from: impl Read + Send + 'static) -> Receiver<String> {
    let (sender, receiver) = channel();
    thread::spawn(move || {
        for line in BufReader::new(from).lines().map_while(Result::ok) {
            if sender.send(line).is_err() {
                return;
            }
        }
    });
    receiver
}

fn next(lines: &Receiver<String>) -> Option<String> {
    lines.recv_timeout(Duration::from_secs(60)).ok()
}

#[test]
fn what_was_saved_and_compiles_is_started_in_place_of_what_runs() {
    let watched = Watched::start(ROBOT);
    watched.expect_said("one started");
    watched.save("// program two\n");
    watched.expect_said("one asked");
    watched.expect_said("two started");
    watched.save("// program two\n// BROKEN\n");
    watched.expect_note("error: broken");
    watched.expect_note("the robot goes on as it was built before");
    watched.save("// program two\n// A comment is no other program.\n");
    watched.expect_note("the program is as it was");
    watched.save("// program three\n");
    watched.expect_said("two asked");
    watched.expect_said("three started");
    watched.interrupt();
    watched.expect_said("three interrupted");
    assert_eq!(watched.end(), (vec![], Some(130)));
}

#[test]
fn a_manifest_with_a_mistake_keeps_what_runs() {
    let watched = Watched::start(ROBOT);
    watched.expect_said("one started");
    watched
        .robot
        .edit("hulk.toml", "\"nodes::counter\"", "\"nodes::conter\"");
    watched.expect_note("error[unknown-node]");
    watched.expect_note("the robot goes on as it was built before");
    watched
        .robot
        .edit("hulk.toml", "\"nodes::conter\"", "\"nodes::counter\"");
    watched.expect_note("the program is as it was");
    watched.interrupt();
    watched.expect_said("one interrupted");
    assert_eq!(watched.end(), (vec![], Some(130)));
}

#[test]
fn a_robot_that_ended_by_itself_is_started_by_the_next_change() {
    let watched = Watched::start("echo \"$name started\"; exit 3");
    watched.expect_said("one started");
    watched.expect_note("the robot ended with 3: the next change starts it");
    watched.robot.write("parameters/default.toml", "step = 2\n");
    watched.expect_said("one started");
    watched.expect_note("the robot ended with 3");
    watched.interrupt();
    assert_eq!(watched.end(), (vec![], Some(130)));
}

#[test]
fn the_robot_answers_first_whatever_hulkgen_does_when_it_is_ended() {
    for (signal, answer, status) in [("-INT", "one interrupted", 130), ("-TERM", "one asked", 15)] {
        for builds in [false, true] {
            let watched = Watched::start(ROBOT);
            watched.expect_said("one started");
            if builds {
                watched.save("// program one\n// SLOW\n");
                watched.expect_note("building");
            }
            match signal {
                "-INT" => watched.interrupt(),
                _ => watched.send(signal, &watched.child.id().to_string()),
            }
            watched.expect_said(answer);
            assert_eq!(watched.end(), (vec![], Some(status)), "{signal} {builds}");
        }
    }
}

#[test]
fn a_file_that_can_be_recorded_once_is_wrong_usage() {
    let ended = Robot::tiny()
        .run("run --watch --record game.mcap")
        .expect(2);
    assert!(ended.stderr.contains("`game.mcap`"), "{}", ended.stderr);
    assert!(ended.stderr.contains("`--record on`"), "{}", ended.stderr);
}
