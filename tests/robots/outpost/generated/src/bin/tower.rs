//! The robot `outpost` on target `tower`.
//!
//! Written by `hulkgen generate` from hulk.toml and the nodes it names. Do not edit.

use std::process::ExitCode;

use framework::Target;
use framework::launch;
use hulkgen_communication::serve;
use outpost_hardware::Hardware;
use outpost_runtime::recording;
use outpost_runtime::runtime;

const TARGET: Target = Target {
    robot: "outpost",
    name: "tower",
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
