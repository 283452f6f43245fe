//! What may stand on the command line of the scaffold: types for clap, no behaviour.

use camino::Utf8PathBuf;
use clap::{Args, ValueEnum};

use super::TextOrJson;

/// Begin a robot: a workspace that generates, builds, tests and runs at once
///
/// Works everywhere, compiles nothing, needs no network. On an error nothing is left.
#[derive(Args, Clone, Debug)]
#[command(after_help = "\
Exit status: 0 written, 1 a file cannot be read or written, 2 the folder is not empty, no name for the
             robot, or no framework.

Examples:
  hulkgen new my_robot
  hulkgen new team/nao --template nao
  hulkgen new my_robot --framework ../hulkgen     # written relative to the robot
  hulkgen new my_robot --framework 0.1")]
pub struct New {
    /// The robot's folder: new, or empty
    pub path: Utf8PathBuf,
    /// What the robot begins with
    #[arg(long, value_enum, default_value = "blank")]
    pub template: Template,
    /// A checkout of hulkgen, or a version of the registry [default: the checkout that hulkgen was built from]
    #[arg(long, value_name = "PATH|VERSION")]
    pub framework: Option<String>,
    /// Name of the robot in snake_case; that of the template `nao` is always `nao` [default: that of the folder]
    #[arg(long, value_name = "NAME")]
    pub name: Option<String>,
    /// Form of the answer
    #[arg(long, value_enum, default_value = "text")]
    pub format: TextOrJson,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Template {
    /// Two cyclers on a simulated vehicle, a handful of short nodes
    Blank,
    /// The NAO of the checkout, for a team to own
    Nao,
}

/// Add a node: its file with a test, its `mod` line, its place in hulk.toml, the generated crate
///
/// Modules on the way that do not exist are made. On an error nothing is changed.
#[derive(Args, Clone, Debug)]
#[command(after_help = "\
Exit status: 0 added, 1 the robot has errors or would have some, 2 no such crate or cycler, or no usable name.

Examples:
  hulkgen add-node control::fall_detector --cycler Control
  hulkgen add-node vision::lines::line_detection --cycler Vision
  hulkgen add-node control::button_receiver --cycler Control --setup")]
pub struct AddNode {
    /// Crate and module; the module is new
    #[arg(value_name = "CRATE::MODULE")]
    pub node: String,
    /// The cycler that runs it
    #[arg(long, value_name = "NAME")]
    pub cycler: String,
    /// It waits for the data of the cycle: a setup node
    #[arg(long)]
    pub setup: bool,
    /// Form of the answer
    #[arg(long, value_enum, default_value = "text")]
    pub format: TextOrJson,
}

/// Add a cycler with the setup node that will wait for its data
///
/// On an error nothing is changed.
#[derive(Args, Clone, Debug)]
#[command(after_help = "\
Exit status: 0 added, 1 the robot has errors or would have some, 2 no such crate, or no usable name.

Examples:
  hulkgen add-cycler Hearing --kind perception --setup-node audio::sound_receiver
  hulkgen add-cycler Radar --kind perception --instances Left,Right --setup-node radar::echo_receiver")]
pub struct AddCycler {
    /// UpperCamelCase
    pub name: String,
    /// How its cycles are handed on
    #[arg(long, value_enum)]
    pub kind: CyclerKind,
    /// Its first node, which is new, too
    #[arg(long, value_name = "CRATE::MODULE")]
    pub setup_node: String,
    /// Suffixes of its instances [default: one instance named like the cycler]
    #[arg(long, value_name = "SUFFIX", value_delimiter = ',')]
    pub instances: Vec<String>,
    /// Form of the answer
    #[arg(long, value_enum, default_value = "text")]
    pub format: TextOrJson,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum CyclerKind {
    /// Its cycles are announced and consumed in order
    Perception,
    /// Consumes them, at the pace of the body
    RealTime,
}

/// Remove a node from hulk.toml, and parameter values that nobody else reads
///
/// Its file stays unless --delete is given. On an error, such as a node that reads it, nothing is changed.
#[derive(Args, Clone, Debug)]
#[command(after_help = "\
Exit status: 0 removed, 1 the robot has errors or would have some, 2 no such node or cycler.

Examples:
  hulkgen remove-node control::led_status
  hulkgen remove-node control::led_status --delete     # its file and its `mod` line, too
  hulkgen remove-node shared::counter --cycler Vision")]
pub struct RemoveNode {
    /// The node as hulk.toml writes it
    #[arg(value_name = "CRATE::MODULE")]
    pub node: String,
    /// Only from this cycler [default: from all]
    #[arg(long, value_name = "NAME")]
    pub cycler: Option<String>,
    /// Delete its file and its `mod` line; other code may still use them
    #[arg(long)]
    pub delete: bool,
    /// Form of the answer
    #[arg(long, value_enum, default_value = "text")]
    pub format: TextOrJson,
}

/// Rename a main output: its field, what its node's code says of it, and every path that reads it
///
/// Fields of readers keep their names. Scenarios and captured tests of the node follow; code is followed as far as that is
/// possible without compiling. What else names the output, or may be it or something else, is listed. On an error nothing
/// is changed.
#[derive(Args, Clone, Debug)]
#[command(after_help = "\
Exit status: 0 renamed, 1 the robot has errors or would have some, 2 no such output, or no usable name.

Example:
  hulkgen rename-output Control.ball ball_estimate")]
pub struct RenameOutput {
    /// Cycler and output
    #[arg(value_name = "CYCLER.OUTPUT")]
    pub output: String,
    /// The new name
    pub new: String,
    /// Form of the answer
    #[arg(long, value_enum, default_value = "text")]
    pub format: TextOrJson,
}

/// Merge a generated file for git, without conflict marks
///
/// Git calls it as README.md of a new robot tells. Where both sides changed the same lines, ours stays and git stops, so
/// that the crate is written anew once its nodes are merged.
#[derive(Args, Clone, Debug)]
#[command(after_help = "\
Exit status: 0 merged, 1 in conflict: to be written anew.

Example:
  git config merge.hulkgen.driver \"hulkgen merge-driver %O %A %B\"")]
pub struct MergeDriver {
    /// Git's %O: the file that both sides began with
    pub base: Utf8PathBuf,
    /// Git's %A: our file, which becomes the answer
    pub ours: Utf8PathBuf,
    /// Git's %B: their file
    pub theirs: Utf8PathBuf,
}
