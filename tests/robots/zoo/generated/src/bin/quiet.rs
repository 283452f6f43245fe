//! The robot `zoo` on target `quiet`.
//!
//! Written by `hulkgen generate` from hulk.toml and the nodes it names. Do not edit.

use std::process::ExitCode;

use framework::Target;
use framework::launch;
use hulkgen_communication::serve;
use zoo_hardware::Hardware;
use zoo_runtime::recording;
use zoo_runtime::runtime;

const TARGET: Target = Target {
    robot: "zoo",
    name: "quiet",
    parameters: "parameters",
    location: Some("quiet"),
    identities: &["body"],
    graph: include_str!("../../graph.json"),
    recording_budget: 2147483648,
    manifest: include_str!("../../../hulk.toml"),
    dataflow: include_str!("../../DATAFLOW.md"),
    replayables: recording::INSTANCES,
};

fn main() -> ExitCode {
    launch::main::<Hardware, _>(TARGET, runtime::create, serve)
}
