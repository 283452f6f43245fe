//! The robot `sprinkler` on target `bed`.
//!
//! Written by `hulkgen generate` from hulk.toml and the nodes it names. Do not edit.

use std::process::ExitCode;

use framework::Target;
use framework::launch;
use hulkgen_communication::serve;
use sprinkler_garden::Hardware;
use sprinkler_runtime::recording;
use sprinkler_runtime::runtime;

const TARGET: Target = Target {
    robot: "sprinkler",
    name: "bed",
    parameters: "parameters",
    location: None,
    identities: &[],
    graph: include_str!("../../graph.json"),
    recording_budget: 2147483648,
    manifest: include_str!("../../../hulk.toml"),
    dataflow: include_str!("../../DATAFLOW.md"),
    replayables: recording::INSTANCES,
};

fn main() -> ExitCode {
    launch::main::<Hardware, _>(TARGET, runtime::create, serve)
}
