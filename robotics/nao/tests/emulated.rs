//! The program that was built for the robot, on an emulator of the robot's processor.
//!
//! `.ci/cross` builds it, `HULKGEN_NAO` names it.
//! Where `HULKGEN_NAO_RECORDING` names a file, the run is recorded there; `.ci/cross` verifies it on this machine.

use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitStatus};
use std::time::{Duration, Instant};

use framework::testing::skip;
use simulated_nao::Simulator;
use simulated_nao::settings::{PhysicsChoice, Settings};

/// Denverton is QEMU's model that is nearest to the robot's Silvermont: it has all that one has, and no AVX either.
const EMULATOR: [&str; 3] = ["qemu-x86_64", "-cpu", "Denverton"];
/// States that have to be answered: ten seconds of the body's 12 ms.
const ANSWERS: u64 = 840;
/// How long the program runs: an emulator needs many times longer than a processor.
const PATIENCE: Duration = Duration::from_secs(400);

/// What is needed, or what to do so that it is there.
fn program() -> Result<PathBuf, &'static str> {
    let has_emulator = Command::new(EMULATOR[0]).arg("--version").output().is_ok();
    if !has_emulator {
        return Err("install qemu-x86_64 (Debian: qemu-user)");
    }
    std::env::var_os("HULKGEN_NAO")
        .map(PathBuf::from)
        .ok_or("build the robot's program with .ci/cross, name it in HULKGEN_NAO")
}

fn start(program: &Path, options: &[&str]) -> Child {
    Command::new(EMULATOR[0])
        .args(&EMULATOR[1..])
        .arg(program)
        .args(options)
        .current_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join("../.."))
        .spawn()
        .unwrap()
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
    let program = match program() {
        Ok(program) => program,
        Err(what) => return skip(name, what),
    };
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("lola");
    let mut settings = Settings {
        socket: Some(path.clone()),
        physics: PhysicsChoice::Kinematic,
        ..Settings::default()
    };
    settings.camera_rate = 1;
    let simulator = Simulator::paced(&settings, ANSWERS).unwrap();
    let recording = std::env::var("HULKGEN_NAO_RECORDING").unwrap_or("off".to_owned());
    let runs = folder.path().join("runs");
    let mut child = start(
        &program,
        &[
            "--for",
            "100s",
            "--headless",
            "--listen",
            "off",
            "--run-folder",
            runs.to_str().unwrap(),
            "--record",
            &recording,
            // Otherwise a robot that only stands records nothing of Control.
            "--set",
            "recording_switch.states=[\"Unstiff\", \"Initial\"]",
            "--",
            "--simulator",
            path.to_str().unwrap(),
        ],
    );
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
