//! The exported model in another engine.

use std::path::Path;
use std::process::Command;

use framework::testing::skip;
use simulated_nao::physics::{Start, mjcf};
use simulated_nao::posture;

const NAME: &str = "the_exported_robot_stands_in_mujoco";

#[test]
fn the_exported_robot_stands_in_mujoco() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("nao.xml");
    let start = Start {
        joints: posture::standing(),
        pose: [0.0; 3],
    };
    std::fs::write(&file, mjcf(&start)).unwrap();
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/mujoco_stands.py");
    let output = Command::new("python3").arg(script).arg(&file).output();
    let output = match output {
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => {
            return skip(NAME, "install python3");
        }
        output => output.expect("python3 is installed, so it can be started"),
    };
    if output.status.code() == Some(77) {
        return skip(NAME, "pip install mujoco");
    }
    let complaint = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{complaint}");
}
