//! Runs `msgpack_oracle.py`: an implementation of MessagePack that shares no code with ours.

use std::path::Path;
use std::process::Command as Process;

use crate::wire::{sample_command, sample_state};
use framework::testing::skip;
use lola::{command, state};

const NAME: &str = "python_reads_our_messages_as_nao_toml_says";

#[test]
fn python_reads_our_messages_as_nao_toml_says() {
    let folder = tempfile::tempdir().unwrap();
    let manifest = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut bytes = Vec::new();
    state::encode(&sample_state(), &mut bytes).unwrap();
    std::fs::write(folder.path().join("state"), &bytes).unwrap();
    command::encode(&sample_command(), &mut bytes);
    std::fs::write(folder.path().join("command"), &bytes).unwrap();

    let output = Process::new("python3")
        .arg(manifest.join("tests/msgpack_oracle.py"))
        .arg(manifest.join("../kinematics/nao.toml"))
        .args([folder.path().join("state"), folder.path().join("command")])
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
}
