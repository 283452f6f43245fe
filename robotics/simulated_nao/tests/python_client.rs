//! Lets a client from PyPI talk to the simulated LoLA.

use std::path::Path;
use std::process::Command;

use framework::Clock;
use framework::testing::skip;
use simulated_nao::Simulator;
use simulated_nao::settings::{PhysicsChoice, Settings};

const NAME: &str = "a_python_client_reads_states_and_moves_joints";

#[test]
fn a_python_client_reads_states_and_moves_joints() {
    // Joints go exactly where they are sent.
    let settings = Settings {
        physics: PhysicsChoice::Kinematic,
        ..Settings::default()
    };
    let simulator = Simulator::start(&settings, Clock::wall()).unwrap();
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/python_client.py");
    let output = Command::new("python3")
        .arg(script)
        .arg(simulator.socket())
        .output();
    let output = match output {
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => {
            return skip(NAME, "install python3");
        }
        output => output.expect("python3 is installed, so it can be started"),
    };
    if output.status.code() == Some(77) {
        return skip(NAME, "pip install msgpack");
    }
    let complaint = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{complaint}");
    assert!((simulator.ground_truth().positions.head_yaw - 0.5).abs() < 1e-4);
}
