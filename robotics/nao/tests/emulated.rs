//! The program that was built for the robot, on an emulator of the robot's processor.
//!
//! `.ci/cross` builds it, `HULKGEN_NAO` names it; `HULKGEN_NAO_AVX2` names the same for a newer processor.
//! Where `HULKGEN_NAO_RECORDING` names a file, the run is recorded there; `.ci/cross` verifies it on this machine.

use std::os::unix::process::ExitStatusExt;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitStatus};
use std::time::{Duration, Instant};

use framework::testing::skip;
use simulated_nao::Simulator;
use simulated_nao::settings::{PhysicsChoice, Settings};

const EMULATOR: &str = "qemu-x86_64";
/// QEMU's model that is nearest to the robot's Silvermont: it has all that one has, and no AVX either.
const ROBOTS_PROCESSOR: &str = "Denverton";
/// Everything that QEMU can emulate.
const NEWEST_PROCESSOR: &str = "max";
/// SIGILL, as signal(7) numbers it.
const ILLEGAL_INSTRUCTION: i32 = 4;
/// States that have to be answered: ten seconds of the body's 12 ms.
const ANSWERS: u64 = 840;
/// How long the program runs: an emulator needs many times longer than a processor.
const PATIENCE: Duration = Duration::from_secs(400);

/// The program that a variable names, or what to do so that it can run.
fn program(variable: &str) -> Result<PathBuf, String> {
    if Command::new(EMULATOR).arg("--version").output().is_err() {
        return Err(format!("install {EMULATOR} (Debian: qemu-user)"));
    }
    std::env::var_os(variable)
        .map(PathBuf::from)
        .ok_or_else(|| format!("run .ci/cross, which builds what {variable} names"))
}

fn start(processor: &str, program: &Path, options: &[&str]) -> Child {
    Command::new(EMULATOR)
        .args(["-cpu", processor])
        .arg(program)
        .args(options)
        .current_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join("../.."))
        .spawn()
        .unwrap()
}

/// The robot's body in a folder, which turns no faster than the program answers.
fn body(folder: &Path) -> Simulator {
    let mut settings = Settings {
        socket: Some(folder.join("lola")),
        physics: PhysicsChoice::Kinematic,
        ..Settings::default()
    };
    settings.camera_rate = 1;
    Simulator::paced(&settings, ANSWERS).unwrap()
}

/// The program with the body of that folder, on the robot's processor.
fn start_with_body(program: &Path, folder: &Path, recording: &str) -> Child {
    let (socket, runs) = (folder.join("lola"), folder.join("runs"));
    let options = [
        "--for",
        "100s",
        "--headless",
        "--listen",
        "off",
        "--run-folder",
        runs.to_str().unwrap(),
        "--record",
        recording,
        // Otherwise a robot that only stands records nothing of Control.
        "--set",
        "recording_switch.states=[\"Unstiff\", \"Initial\"]",
        "--",
        "--simulator",
        socket.to_str().unwrap(),
    ];
    start(ROBOTS_PROCESSOR, program, &options)
}

fn wait(child: &mut Child, patience: Duration) -> ExitStatus {
    let begun = Instant::now();
    loop {
        if let Some(status) = child.try_wait().unwrap() {
            return status;
        }
        if begun.elapsed() > patience {
            child.kill().unwrap();
            panic!("it does not end");
        }
        std::thread::sleep(Duration::from_millis(100));
    }
}

#[test]
fn the_robots_program_stands_up_on_the_robots_processor() {
    let name = "the_robots_program_stands_up_on_the_robots_processor";
    let program = match program("HULKGEN_NAO") {
        Ok(program) => program,
        Err(what) => return skip(name, &what),
    };
    let folder = tempfile::tempdir().unwrap();
    let simulator = body(folder.path());
    let recording = std::env::var("HULKGEN_NAO_RECORDING").unwrap_or("off".to_owned());
    let mut child = start_with_body(&program, folder.path(), &recording);
    let status = wait(&mut child, PATIENCE);
    let exchange = simulator.exchange();
    println!("{exchange:?}");
    assert!(status.success(), "{status}");
    assert_eq!(exchange.rejected, 0);
    assert!(exchange.commands >= ANSWERS, "{exchange:?}");
    let truth = simulator.ground_truth();
    assert_eq!(truth.harmful_commands, 0);
    // The program has ended and let the robot down, but its joints are where it held them: standing.
    let standing = simulated_nao::posture::standing().map(|angle| angle as f32);
    for (joint, angle) in truth.positions.iter() {
        let away = (angle - standing[joint]).abs();
        let is_leg = format!("{joint:?}").contains("Knee") || format!("{joint:?}").contains("Hip");
        assert!(
            !is_leg || away < 0.1,
            "{joint:?} is {angle}, {away} away from standing"
        );
    }
}

/// The emulator is as strict as the processor, else the test above would show nothing.
#[test]
fn a_program_for_a_newer_processor_ends_there_by_an_illegal_instruction() {
    let name = "a_program_for_a_newer_processor_ends_there_by_an_illegal_instruction";
    let program = match program("HULKGEN_NAO_AVX2") {
        Ok(program) => program,
        Err(what) => return skip(name, &what),
    };
    // A whole program: where there is AVX2, it reads its parameters.
    let mut child = start(NEWEST_PROCESSOR, &program, &["--check-parameters"]);
    let status = wait(&mut child, PATIENCE);
    assert!(status.success(), "{status}");

    let folder = tempfile::tempdir().unwrap();
    let simulator = body(folder.path());
    let mut child = start_with_body(&program, folder.path(), "off");
    let status = wait(&mut child, PATIENCE);
    assert_eq!(status.signal(), Some(ILLEGAL_INSTRUCTION), "{status}");
    assert_eq!(simulator.exchange().commands, 0);
}
