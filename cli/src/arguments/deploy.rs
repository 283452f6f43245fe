//! What may stand on the command line of commands that go to robots by ssh: types for clap, no behaviour.

use camino::Utf8PathBuf;
use clap::Args;

use super::TextOrJson;

/// Which robots of which target, and how they are reached.
#[derive(Args, Clone, Debug)]
pub struct Reached {
    /// The target whose `[target.deploy]` says how [default: the first that has one]
    #[arg(long, value_name = "NAME")]
    pub target: Option<String>,
    /// Configuration of ssh [default: the manifest's `ssh_config`, else the user's own]
    #[arg(long, value_name = "FILE")]
    pub ssh_config: Option<Utf8PathBuf>,
}

/// Put the program of a target with parameters and files onto robots, and start it there
///
/// Robots are those of `hosts` in `[target.deploy]`, or destinations of ssh; all are served at once. A robot keeps running
/// its version until the new one has arrived whole, starts there and accepts its parameters; then it is switched in one
/// step. A version that does not start is replaced by the one before.
#[derive(Args, Clone, Debug)]
#[command(after_help = "\
Exit status: 0 all robots have it, and joined the network of `--wlan`; 1 some did not: these run what they ran before, unless the
answer says otherwise; 2 wrong usage.

Examples:
  hulkgen deploy nao22 nao23 --location hall_3
  hulkgen deploy nao22 nao23 --set nao22:player.number=1 --set nao23:player.number=2
  hulkgen deploy nao@10.1.24.22 --program target/x86_64-unknown-linux-gnu/nao/nao
  hulkgen deploy nao22 --rollback")]
pub struct Deploy {
    /// Robots
    #[arg(value_name = "HOST", required = true)]
    pub hosts: Vec<String>,
    /// The program [default: where cargo puts that of the target]
    #[arg(long, value_name = "FILE", conflicts_with = "rollback")]
    pub program: Option<Utf8PathBuf>,
    /// Layer of parameters [default: the target's]
    #[arg(long, value_name = "NAME", conflicts_with = "rollback")]
    pub location: Option<String>,
    /// Start it with this parameter, on one robot or on all; may be repeated
    #[arg(long, value_name = "[HOST:]PATH=VALUE", conflicts_with = "rollback")]
    pub set: Vec<String>,
    /// A further option that the program is started with, for example `--option=--peer=nao23.local:4857`; may be repeated
    ///
    /// Options of the unit file stand behind these: of what may be given once, such as `--listen`, the unit's counts.
    #[arg(
        long,
        value_name = "OPTION",
        conflicts_with = "rollback",
        allow_hyphen_values = true
    )]
    pub option: Vec<String>,
    /// Join this wireless network afterwards, by the manifest's `wlan`
    #[arg(long, value_name = "NETWORK")]
    pub wlan: Option<String>,
    /// Replace files that were changed on the robot, for example by `hulkgen param store`
    #[arg(long, conflicts_with = "rollback")]
    pub discard_changes: bool,
    /// Go back to the version that ran before
    #[arg(long)]
    pub rollback: bool,
    #[command(flatten)]
    pub reached: Reached,
    /// Form of the answer
    #[arg(long, value_enum, default_value = "text")]
    pub format: TextOrJson,
}

/// Show the robots of `[target.deploy]`: whether they answer, what they run, how much space they have
#[derive(Args, Clone, Debug)]
#[command(after_help = "\
Exit status: 0 all answered, 1 some did not; 2 wrong usage.

Examples:
  hulkgen robots
  hulkgen robots --format json | jq '.robots[] | select(.version == null)'")]
pub struct Robots {
    /// Only these [default: all]
    #[arg(value_name = "HOST")]
    pub hosts: Vec<String>,
    #[command(flatten)]
    pub reached: Reached,
    /// Form of the answer
    #[arg(long, value_enum, default_value = "text")]
    pub format: TextOrJson,
}

/// Print what a robot's system keeps of the program's output, also of runs that have ended
///
/// `hulkgen log` asks the running program instead.
#[derive(Args, Clone, Debug)]
#[command(after_help = "\
Exit status: 0 printed, 1 the robot does not answer; 2 wrong usage, 130 Ctrl-C.

Examples:
  hulkgen logs nao22
  hulkgen logs nao22 --lines 1000 | grep -i watchdog
  hulkgen logs nao22 --follow")]
pub struct Logs {
    /// A robot
    #[arg(value_name = "HOST")]
    pub host: String,
    /// So many of the last lines
    #[arg(long, value_name = "NUMBER", default_value = "200")]
    pub lines: u32,
    /// Go on until Ctrl-C
    #[arg(long)]
    pub follow: bool,
    #[command(flatten)]
    pub reached: Reached,
}
