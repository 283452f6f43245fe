//! Ctrl-C while the robot's program runs, and while hulkgen writes.

use std::io::{BufRead as _, BufReader, Write as _};
use std::os::unix::process::{CommandExt as _, ExitStatusExt as _};
use std::process::{Command, Stdio};
use std::thread;
use std::time::{Duration, Instant};

use crate::robot::Robot;
use crate::{SAYS_BUILT, fake_cargo, fake_program};

/// What a program has answered Ctrl-C when hulkgen ends, and hulkgen's exit status; a terminal sends it to both.
fn answered(arguments: &str, answer: &str) -> (Option<String>, Option<i32>) {
    let robot = Robot::tiny();
    let cargo = fake_cargo(&robot, SAYS_BUILT);
    // What comes after hulkgen has ended comes after the prompt.
    let program = format!(
        "trap 'sleep 0.3; echo {answer} >> answers; exit {answer}' INT\necho started\nwhile true; do sleep 0.05; done"
    );
    fake_program(&robot, &program);
    for file in ["a.toml", "b.toml", "a.png"] {
        robot.write(file, "");
    }
    let mut child = robot
        .command(arguments)
        .env("CARGO", cargo)
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .process_group(0)
        .spawn()
        .expect("hulkgen was built");
    let mut line = String::new();
    let mut stdout = BufReader::new(child.stdout.take().expect("it is piped"));
    stdout
        .read_line(&mut line)
        .expect("the program says something");
    assert_eq!(line, "started\n");
    let group = format!("-{}", child.id());
    let sent = Command::new("kill").args(["-INT", "--", &group]).status();
    assert!(sent.expect("there is a kill").success());
    let status = child.wait().expect("it ends").code();
    let answers = std::fs::read_to_string(robot.path("answers")).ok();
    (answers, status)
}

#[test]
fn it_reaches_the_program_and_its_status_is_ours() {
    let expected = (Some("130\n".to_owned()), Some(130));
    assert_eq!(answered("run real", "130"), expected);
}

#[test]
fn a_program_that_hulkgen_waits_for_answers_first_and_is_the_last_one() {
    for command in [
        "simulate --target real a.toml b.toml",
        "vision --target real --camera-pose 0.5,0.3 --instance Control a.png",
    ] {
        // It may as well have been through when the signal came.
        for answer in ["130", "0"] {
            let expected = (Some(format!("{answer}\n")), Some(130));
            assert_eq!(answered(command, answer), expected, "{command}");
        }
    }
}

const ADD: &str = "add-node nodes::legs::walker --cycler Control";

/// The tree where `ADD` was sent a signal, and how hulkgen ended: its status, or the signal itself.
///
/// It is sent so long after the start, or, where nothing is said, as soon as there is one file more.
fn interrupted(signal: &str, after: Option<Duration>) -> (Robot, Option<i32>) {
    let robot = Robot::tiny();
    let count = || robot.files().len();
    let before = count();
    let mut child = robot
        .command(ADD)
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .expect("hulkgen was built");
    // It is there already when it has to be quick. hulkgen may have ended, but nobody has asked it how.
    let mut sender = Command::new("sh")
        .args(["-c", &format!("read go; kill -{signal} {}", child.id())])
        .stdin(Stdio::piped())
        .spawn()
        .expect("there is a shell");
    match after {
        Some(after) => thread::sleep(after),
        None => {
            let start = Instant::now();
            while count() == before {
                assert!(
                    start.elapsed() < Duration::from_secs(60),
                    "it writes nothing"
                );
            }
        }
    }
    let mut go = sender.stdin.take().expect("it is piped");
    go.write_all(b"go\n").expect("it waits");
    assert!(sender.wait().expect("it ends").success());
    let status = child.wait().expect("it ends");
    (robot, status.code().or(status.signal()))
}

#[test]
fn a_signal_leaves_all_of_a_change_or_nothing_of_it() {
    let robot = Robot::tiny();
    let old = robot.files();
    let start = Instant::now();
    robot.run(ADD).expect(0);
    let (new, whole) = (robot.files(), start.elapsed());
    let mut wholly_new = 0;
    for trial in 0..40_u32 {
        let (signal, expected) = [("INT", 130), ("TERM", 15)][trial as usize % 2];
        // Half of them as soon as it writes, the others at any time of its life, and a little after.
        let after = (trial >= 20).then(|| whole * (trial - 19) / 18);
        let (robot, status) = interrupted(signal, after);
        let now = robot.files();
        let told: Vec<_> = now.keys().collect();
        assert!(now == old || now == new, "{signal}: {told:#?}");
        match status {
            Some(0) => assert!(now == new, "{signal} came behind the end"),
            // Before it listens to signals it has written nothing.
            Some(2) if signal == "INT" => assert!(now == old),
            status => assert_eq!(status, Some(expected), "{signal} after {after:?}"),
        }
        wholly_new += u32::from(now == new && status != Some(0));
    }
    // Else none of them came while it wrote.
    assert!(wholly_new > 0, "no signal came in time");
}
