//! The robot `rover` on target `base`.
//!
//! Written by `hulkgen generate` from hulk.toml and the nodes it names. Do not edit.

use std::process::ExitCode;

use framework::Target;
use framework::launch;
use hulkgen_communication::serve;
use rover_base::Hardware;
use rover_runtime::recording;
use rover_runtime::runtime;

const TARGET: Target = Target {
    robot: "rover",
    name: "base",
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
