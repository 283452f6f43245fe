//! What may stand on the command line of `recording`: types for clap, no behaviour.

use camino::Utf8PathBuf;
use clap::{Args, Subcommand, ValueEnum};

use super::{Reached, TextOrJson};

/// Look into recordings: what they are, their values, files that break off
///
/// Needs neither the robot nor its types: a recording tells how its values are laid out. `pull` alone asks the manifest; `list` looks where the robot is.
#[derive(Args, Clone, Debug)]
#[command(after_help = "\
Exit status: 0 answered, 1 the file cannot be read or written, 2 wrong usage, or it has no such values.

Examples:
  hulkgen recording list
  hulkgen recording info runs/1700000000-42/recording.mcap
  hulkgen recording cat recording.mcap Control.main_outputs.ball --from 2s --to 3s
  hulkgen recording recover cut.mcap
  hulkgen recording pull nao22 --newest
  hulkgen recording export recording.mcap Control.main_outputs.ball --as csv --into ball.csv")]
pub struct Recording {
    #[command(subcommand)]
    pub command: RecordingCommand,
}

#[derive(Clone, Debug, Subcommand)]
pub enum RecordingCommand {
    /// Print what a recording is: run, state, instances, sizes, largest states
    Info {
        /// The recording
        file: Utf8PathBuf,
        /// Form of the answer
        #[arg(long, value_enum, default_value = "text")]
        format: TextOrJson,
    },
    /// Print the recordings below a folder
    List {
        /// Where runs are [default: the robot's `runs`]
        folder: Option<Utf8PathBuf>,
        /// Form of the answer
        #[arg(long, value_enum, default_value = "text")]
        format: TextOrJson,
    },
    /// Print values, one JSON object a line, in the order of the file
    Cat {
        /// The recording
        file: Utf8PathBuf,
        #[command(flatten)]
        selection: Selection,
        /// Form of the answer: with `text` one path, cycle and value a line
        #[arg(long, value_enum, default_value = "json")]
        format: TextOrJson,
    },
    /// Make a whole file out of one that breaks off, up to its last whole chunk
    Recover {
        /// The recording
        file: Utf8PathBuf,
        /// The new file, which must not exist [default: FILE.recovered.mcap]
        #[arg(long, value_name = "FILE")]
        into: Option<Utf8PathBuf>,
        /// Form of the answer
        #[arg(long, value_enum, default_value = "text")]
        format: TextOrJson,
    },
    /// Fetch the runs of a robot by ssh; what is here already is not fetched again, nothing is removed there
    Pull(Pull),
    /// Write values into files of other kinds
    Export {
        /// The recording
        file: Utf8PathBuf,
        #[command(flatten)]
        selection: Selection,
        /// What is written
        #[arg(long = "as", value_enum, value_name = "KIND")]
        kind: ExportKind,
        /// The file, or for images the folder, which must not exist
        #[arg(long, value_name = "PATH")]
        into: Utf8PathBuf,
        /// Form of the answer
        #[arg(long, value_enum, default_value = "text")]
        format: TextOrJson,
    },
}

/// Whose runs, and where to.
#[derive(Args, Clone, Debug)]
pub struct Pull {
    /// A robot of `[target.deploy]`, or a destination for ssh
    #[arg(value_name = "HOST")]
    pub host: String,
    /// The folder they come into [default: the robot's `runs/HOST`]
    #[arg(long, value_name = "FOLDER")]
    pub into: Option<Utf8PathBuf>,
    /// Only the run that was written last
    #[arg(long)]
    pub newest: bool,
    #[command(flatten)]
    pub reached: Reached,
    /// Form of the answer
    #[arg(long, value_enum, default_value = "text")]
    pub format: TextOrJson,
}

/// Which values.
#[derive(Args, Clone, Debug)]
pub struct Selection {
    /// INSTANCE.main_outputs.NAME, INSTANCE.states.NODE, `parameters`, or parts of them [default: all outputs]
    #[arg(value_name = "PATH")]
    pub paths: Vec<String>,
    /// Only cycles of these numbers, for example `100..200`
    #[arg(long, value_name = "FROM..TO", value_parser = cycles)]
    pub cycles: Option<(u64, u64)>,
    /// Only from this time of the run on, for example `1500ms`
    #[arg(long, value_name = "DURATION")]
    pub from: Option<schema::Duration>,
    /// Only before this time of the run
    #[arg(long, value_name = "DURATION")]
    pub to: Option<schema::Duration>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum ExportKind {
    /// A table of one output: a row for each cycle
    Csv,
    /// An object a line
    Json,
    /// A file for each image of one output
    Png,
}

/// Two numbers with `..` between them; either may be left out.
fn cycles(text: &str) -> Result<(u64, u64), String> {
    let (from, to) = text
        .split_once("..")
        .ok_or("two numbers with `..` between them, for example `100..200`")?;
    let number = |text: &str, otherwise| match text {
        "" => Ok(otherwise),
        text => text.parse::<u64>().map_err(|error| error.to_string()),
    };
    Ok((number(from, 0)?, number(to, u64::MAX)?))
}
