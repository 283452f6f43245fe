//! Ctrl-C while the robot's program runs.

use std::io::{BufRead as _, BufReader};
use std::os::unix::process::CommandExt as _;
use std::process::{Command, Stdio};

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
