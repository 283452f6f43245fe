//! What may stand behind `hulkgen simulate`.

use std::ffi::OsString;

use camino::Utf8PathBuf;
use clap::Args;

use super::{Build, TextOrJson};

/// Play scenarios: a simulated robot in lockstep, judged by what the file asserts
///
/// A scenario is a TOML file: what the world is, what happens to it and when, what a client asks, and what has to be so.
/// One that says `passes = 0.8` passes if it does with 80 % of the seeds. With --format json each scenario is one line.
#[derive(Args, Clone, Debug)]
#[command(after_help = "\
Exit status: 0 every scenario passed, 1 one did not or the robot cannot be built, 2 wrong usage, 130 Ctrl-C.

Examples:
  hulkgen simulate robotics/scenarios/stand.toml
  hulkgen simulate robotics/scenarios/*.toml --repeat 10 --format json
  hulkgen simulate robotics/scenarios/two_against_two.toml --listen 127.0.0.1:4857    # to watch it
  hulkgen simulate robotics/scenarios/walk.toml -- --imperfect 3    # options of the hardware")]
pub struct Simulate {
    /// Files of scenarios
    #[arg(required = true, value_name = "SCENARIO")]
    pub scenarios: Vec<Utf8PathBuf>,
    /// What random numbers are drawn from
    #[arg(long, value_name = "NUMBER", default_value = "1")]
    pub seed: u64,
    /// Play each with so many seeds, counted on from --seed
    #[arg(long, value_name = "COUNT", default_value = "1", value_parser = clap::value_parser!(u64).range(1..))]
    pub repeat: u64,
    /// Let several robots live on so many threads [default: as many as the machine has]; changes nothing but the time it takes
    #[arg(long, value_name = "COUNT", value_parser = clap::value_parser!(u64).range(1..))]
    pub threads: Option<u64>,
    /// Tell a digest of all that each robot wrote
    #[arg(long)]
    pub digests: bool,
    /// Open no window
    #[arg(long)]
    pub headless: bool,
    /// The target [default: the first of hulk.toml]
    #[arg(long, value_name = "NAME")]
    pub target: Option<String>,
    /// Form of the answer
    #[arg(long, value_enum, default_value = "text")]
    pub format: TextOrJson,
    /// Set a parameter, for example `ball_filter.gate=2.5`; may be repeated
    #[arg(long, value_name = "PATH=VALUE")]
    pub set: Vec<String>,
    /// Serve each robot while it plays, in real time: the first at this address, the next at the ports behind it
    #[arg(long, value_name = "ADDRESS")]
    pub listen: Option<String>,
    #[command(flatten)]
    pub build: Build,
    /// Options of the hardware
    #[arg(last = true, value_name = "OPTIONS")]
    pub options: Vec<OsString>,
}
