//! `replay` on the command line.

use camino::Utf8PathBuf;
use clap::Args;

use super::{Build, TextOrJson};

/// Generate, build, and run the cycles of a recording again
///
/// Without a question it is shown on the page, and to every other client, as if the robot ran: at any speed, backwards, from
/// any cycle. Each instance runs alone, each cycle from what was recorded of it, without hardware.
#[derive(Args, Clone, Debug)]
#[command(after_help = "\
Exit status: 0 every output has the same bits (or is within the tolerance, for a recording from a machine that computes other bits),
             or the two sides were compared; 1 an output differs from the recording, nothing was verified or compared, errors in
             the robot or a failed build; 2 wrong usage.

Examples:
  hulkgen replay runs/1700000000-42/recording.mcap               # on the page, until Ctrl-C
  hulkgen replay runs/1700000000-42/recording.mcap --verify
  hulkgen replay recording.mcap --node ball_filter               # only what this node needs, and its outputs
  hulkgen replay recording.mcap --set ball_filter.gate=0.3       # which outputs change, and where first
  hulkgen replay recording.mcap --set ball_filter.gate=0.3 --carry       # what that does over many cycles
  hulkgen replay recording.mcap --against main                   # what another revision computes otherwise")]
pub struct Replay {
    /// The recording
    pub file: Utf8PathBuf,
    /// Compare every output, bit for bit, and name the first that differs
    #[arg(long, conflicts_with_all = ["set", "against"])]
    pub verify: bool,
    /// Compare with what other parameters give, for example `ball_filter.gate=2.5`; may be repeated
    #[arg(long, value_name = "PATH=VALUE", conflicts_with = "against")]
    pub set: Vec<String>,
    /// Let cycles under the other parameters go on with the states that the cycle before left, in place of recorded ones
    #[arg(long, requires = "set")]
    pub carry: bool,
    /// Compare with what another git revision of the robot gives; it is built from a copy in the user's cache folder
    #[arg(long, value_name = "REV")]
    pub against: Option<String>,
    /// Run only what this node needs, and compare its outputs alone: its path, or the end of it
    #[arg(long, value_name = "NAME")]
    pub node: Option<String>,
    /// How much numbers may differ where the recording comes from a machine that computes other bits: relative, absolute
    /// below 1; 0 compares bits [default: 1e-6]
    #[arg(long, value_name = "NUMBER", requires = "verify", conflicts_with_all = ["set", "against"])]
    pub tolerance: Option<f64>,
    /// The target [default: the first of hulk.toml]
    #[arg(long)]
    pub target: Option<String>,
    /// Form of the answer
    #[arg(long, value_enum)]
    pub format: Option<TextOrJson>,
    #[command(flatten)]
    pub build: Build,
}

/// Make a cycle of a recording a test of a node, in the node's crate
///
/// The test calls the node with what it took in that cycle and compares its outputs, its state, its answer to a call and what
/// it told the hardware, bit for bit; all values stand in a data file beside it. Files that are there and say something else
/// stay, unless --replace is given.
#[derive(Args, Clone, Debug)]
#[command(after_help = "\
Exit status: 0 written, 1 the cycle or the node cannot be captured, errors in the robot or a failed build, 2 wrong usage,
             or a file is there that says something else.

Examples:
  hulkgen capture runs/1700000000-42/recording.mcap --at 731 --node ball_filter
  hulkgen capture recording.mcap --at 40 --node vision::ball_detection --instance VisionTop
  hulkgen capture recording.mcap --at 40 --node ball_filter --replace      # anew, for another hulkgen")]
pub struct Capture {
    /// The recording
    pub file: Utf8PathBuf,
    /// The cycle's number
    #[arg(long, value_name = "CYCLE")]
    pub at: u64,
    /// The node's path, or the end of it
    #[arg(long, value_name = "NAME")]
    pub node: String,
    /// The instance, where the node runs in several
    #[arg(long, value_name = "NAME")]
    pub instance: Option<String>,
    /// Write over the test and its values where they are there and say something else
    #[arg(long)]
    pub replace: bool,
    /// The target [default: the first of hulk.toml]
    #[arg(long)]
    pub target: Option<String>,
    /// Form of the answer
    #[arg(long, value_enum, default_value = "text")]
    pub format: TextOrJson,
    #[command(flatten)]
    pub build: Build,
}
