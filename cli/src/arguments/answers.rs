//! What may stand on the command line of commands that answer questions: types for clap, no behaviour.

use clap::{Args, ValueEnum};
use clap_complete::Shell;

use super::{Reached, TextOrJson};

/// Explain a diagnostic, a node, an output, a parameter, an order, or a failure
///
/// Nodes are named by path or module, outputs by name, also behind their cycler or instance. Additional outputs and
/// procedures are named likewise, parameters by their path, cycler instances in place of `$cycler_instance`.
#[derive(Args, Clone, Debug)]
#[command(
    override_usage = "hulkgen explain [OPTIONS] <CODE|NODE|OUTPUT|PARAMETER|PROCEDURE>
       hulkgen explain [OPTIONS] order <NODE> <NODE>
       hulkgen explain [OPTIONS] --if-fails <NODE>",
    after_help = "\
Exit status: 0 explained, 1 the robot has errors, 2 there is nothing of this name.

Examples:
  hulkgen explain unknown-output
  hulkgen explain vision::ball_detection
  hulkgen explain ball                      # or Control.ball
  hulkgen explain ball_filter.gate          # who reads it, which files give it a value
  hulkgen explain order odometry ball_filter
  hulkgen explain --if-fails camera_matrices"
)]
pub struct Explain {
    /// What to explain; or `order` and two nodes
    #[arg(
        value_name = "SUBJECT",
        num_args = 1..=3,
        required_unless_present = "if_fails",
        conflicts_with = "if_fails"
    )]
    pub subject: Vec<String>,
    /// What becomes absent, default, held or stopped when this node fails
    #[arg(long, value_name = "NODE")]
    pub if_fails: Option<String>,
    /// Form of the answer
    #[arg(long, value_enum, default_value = "text")]
    pub format: TextOrJson,
}

/// Show what changed in the graph since a git revision
///
/// The revision's files are read out of git; nothing is checked out. Where one of the two robots has errors, only what
/// hulk.toml says is compared.
///
/// The JSON has `before` and `after` (hash and errors of each robot), a list of what was `added`, `removed` and `changed`
/// for each of `targets`, `cyclers`, `nodes`, `fields`, `parameters`, `bridges` and `edges`, the nodes that moved in
/// `order`, and `robot`, `target_order` and `cycler_order`: null, or what it was `before` and is `after`.
#[derive(Args, Clone, Debug)]
#[command(after_help = "\
Exit status: 0 compared, whatever changed; 2 the revision cannot be read.

Examples:
  hulkgen diff                              # what is not committed
  hulkgen diff main --format json | jq '.edges.added'")]
pub struct Diff {
    /// A commit, branch or tag
    #[arg(value_name = "REV", default_value = "HEAD")]
    pub revision: String,
    /// Form of the answer
    #[arg(long, value_enum, default_value = "text")]
    pub format: TextOrJson,
}

/// Print a stage between manifest and generated crate
#[derive(Args, Clone, Debug)]
#[command(after_help = "\
Exit status: 0 printed, 1 this stage or one before it has errors.

Examples:
  hulkgen show schedule                     # in which order nodes run, and why
  hulkgen show model --format json          # every decision behind the generated crate")]
pub struct Show {
    /// The stage
    #[arg(value_enum)]
    pub stage: Stage,
    /// Form of the answer; the JSON of a stage may change with every version
    #[arg(long, value_enum, default_value = "text")]
    pub format: TextOrJson,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Stage {
    /// What hulk.toml says
    Manifest,
    /// What each node asks for and gives, as written
    Nodes,
    /// Every name bound to what it means
    Robot,
    /// The order of nodes, and why
    Schedule,
    /// What each generated file will say
    Model,
}

/// Look whether this machine and this robot are ready; with --host, whether a robot behind ssh is
///
/// What is granted to threads is that of a robot that runs meanwhile.
#[derive(Args, Clone, Debug)]
#[command(after_help = "\
Exit status: 0 nothing is bad, 1 something is.

Examples:
  hulkgen doctor
  hulkgen doctor --host nao22 --format json | jq '.checks[] | select(.state != \"ok\")'")]
pub struct Doctor {
    /// Look at this robot of `[target.deploy]`, or destination for ssh, in place of this machine
    #[arg(long, value_name = "HOST")]
    pub host: Option<String>,
    #[command(flatten)]
    pub reached: Reached,
    /// Form of the answer
    #[arg(long, value_enum, default_value = "text")]
    pub format: TextOrJson,
}

/// Print a script that completes hulkgen's words in a shell
#[derive(Args, Clone, Debug)]
#[command(after_help = "\
Exit status: 0.

Examples:
  hulkgen completions bash > ~/.local/share/bash-completion/completions/hulkgen
  hulkgen completions fish > ~/.config/fish/completions/hulkgen.fish")]
pub struct Completions {
    #[arg(value_enum)]
    pub shell: Shell,
}

/// Print the manual page of hulkgen, or of one of its commands
#[derive(Args, Clone, Debug)]
#[command(after_help = "\
Exit status: 0 printed, 2 there is no such command.

Examples:
  hulkgen man | man -l -
  hulkgen man explain > hulkgen-explain.1")]
pub struct Man {
    /// The command [default: hulkgen itself]
    pub command: Option<String>,
}
