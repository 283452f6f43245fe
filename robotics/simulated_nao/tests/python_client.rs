//! Lets a client from PyPI talk to the simulated LoLA.

use std::path::Path;
use std::process::Command;

use framework::Clock;
use framework::testing::skip;
use simulated_nao::Simulator;
use simulated_nao::settings::Settings;

const NAME: &str = "a_python_client_reads_states_and_moves_joints";

#[test]
fn a_python_client_reads_states_and_moves_joints() {
    let simulator = Simulator::start(&Settings::default(), Clock::wall()).unwrap();
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/python_client.py");
    let output = Command::new("python3")
        .arg(script)
        .arg(simulator.socket())
        .output();
    let missing = match &output {
        Ok(output) => output.status.code() == Some(77),
        Err(_) => true,
    };
    if missing {
        return skip(NAME, "pip install msgpack");
    }
    let output = output.expect("a missing python3 was handled above");
    let complaint = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{complaint}");
    assert!((simulator.ground_truth().positions.head_yaw - 0.5).abs() < 1e-4);
}
