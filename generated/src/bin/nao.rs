//! The robot `nao` on target `nao`.
//!
//! Written by `hulkgen generate` from hulk.toml and the nodes it names. Do not edit.

use std::process::ExitCode;

use framework::Target;
use framework::launch;
use hulkgen_communication::serve;
use nao::Hardware;
use nao_runtime::recording;
use nao_runtime::runtime;

const TARGET: Target = Target {
    robot: "nao",
    name: "nao",
    parameters: "robotics/parameters",
    location: Some("nao"),
    identities: &["body", "head"],
    graph: include_str!("../../graph.json"),
    recording_budget: 2147483648,
    manifest: include_str!("../../../hulk.toml"),
    dataflow: include_str!("../../DATAFLOW.md"),
    replayables: recording::INSTANCES,
};

fn main() -> ExitCode {
    launch::main::<Hardware, _>(TARGET, runtime::create, serve)
}
