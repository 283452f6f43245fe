//! What may stand on the command line: types for clap, no behaviour.

mod answers;
mod deploy;
mod recording;
mod replay;
mod running;
mod scaffold;
mod simulate;
mod vision;

use std::ffi::OsString;

use camino::Utf8PathBuf;
use clap::{Args, Parser, Subcommand, ValueEnum};

pub use answers::{Completions, Diff, Doctor, Explain, Man, Show, Stage};
pub use deploy::{Deploy, Logs, Reached, Robots};
pub use recording::{ExportKind, Pull, Recording, RecordingCommand, Selection};
pub use replay::{Capture, Replay};
pub use running::{Call, Log, LogLevel, Param, ParamCommand, Running, Top, Topic, TopicCommand};
pub use scaffold::{
    AddCycler, AddNode, CyclerKind, MergeDriver, New, RemoveNode, RenameOutput, Template,
};

pub use simulate::Simulate;
pub use vision::Vision;

/// Heading of the options of every command.
const GLOBAL: &str = "Global options";

/// From a manifest and plain Rust nodes to the program that runs the robot.
#[derive(Clone, Debug, Parser)]
#[command(
    name = "hulkgen",
    version,
    after_help = "\
Exit status: 0 done and good, 1 the answer is bad, 2 wrong usage, 3 drift (generate --check only),
             101 a bug in hulkgen, 130 Ctrl-C.
Data goes to stdout, everything else to stderr.

Begin with:
  hulkgen new my_robot          # write a robot that runs
  hulkgen run                   # in the robot's folder: generate, build, run until Ctrl-C
  hulkgen doctor                # what this machine lacks
  hulkgen run --help            # examples and exit status of a command",
    arg_required_else_help = true
)]
pub struct Arguments {
    #[command(flatten)]
    pub global: Global,
    #[command(subcommand)]
    pub command: Command,
}

/// Options of every command.
#[derive(Args, Clone, Debug)]
pub struct Global {
    /// The robot's hulk.toml, or its folder [default: upwards from the current folder]
    #[arg(long, global = true, value_name = "PATH", help_heading = GLOBAL)]
    pub manifest: Option<Utf8PathBuf>,
    /// Colours: `auto` means on a terminal, unless NO_COLOR is set
    #[arg(
        long,
        global = true,
        value_enum,
        value_name = "WHEN",
        default_value = "auto",
        help_heading = GLOBAL
    )]
    pub color: Color,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Color {
    Auto,
    Always,
    Never,
}

#[derive(Clone, Debug, Subcommand)]
pub enum Command {
    Generate(Generate),
    Check(Check),
    Explain(Explain),
    Graph(Graph),
    Diff(Diff),
    Show(Show),
    Run(Run),
    Build(BuildTarget),
    Simulate(Simulate),
    Vision(Vision),
    Topic(Topic),
    Param(Param),
    Call(Call),
    Log(Log),
    Top(Top),
    Replay(Replay),
    Recording(Recording),
    Capture(Capture),
    Deploy(Deploy),
    Robots(Robots),
    Logs(Logs),
    New(New),
    AddNode(AddNode),
    AddCycler(AddCycler),
    RemoveNode(RemoveNode),
    RenameOutput(RenameOutput),
    MergeDriver(MergeDriver),
    Doctor(Doctor),
    Completions(Completions),
    Man(Man),
    /// Print the JSON schema of hulk.toml, for editors
    #[command(after_help = "\
Exit status: 0.

Example:
  hulkgen schema > .hulk/hulk.schema.json")]
    Schema,
}

/// Write the generated crate: unchanged files stay untouched, orphans are removed
///
/// With --only it is a second crate beside the robot's: a library without targets, for a test, a simulator or a tool that
/// brings the hardware. What its cyclers read of the others comes from stubs, which count as never written until they are
/// fed. The whole robot must be free of errors, and its own crate is not touched.
#[derive(Args, Clone, Debug)]
#[command(after_help = "\
Exit status: 0 written or nothing to do, 1 errors in the manifest or a node (nothing was written)
             or in a parameter file, 2 there is no such cycler, 3 with --check if something would be written.

Examples:
  hulkgen generate
  hulkgen generate --check           # in CI: print the diff, write nothing
  hulkgen generate --watch           # again whenever a file is saved, until Ctrl-C
  hulkgen generate --only Control    # a second crate, in generated-control")]
pub struct Generate {
    /// Write a crate of these cyclers alone, for example `Control,Vision`, with stubs for what they read of the others
    #[arg(long, value_name = "CYCLERS", value_delimiter = ',')]
    pub only: Vec<String>,
    /// Folder of that crate, relative to the robot's [default: the generated one's and the names, `generated-control`]
    #[arg(long, value_name = "FOLDER", requires = "only")]
    pub output: Option<Utf8PathBuf>,
    /// Write nothing; print the diff and end with 3 if there is one
    #[arg(long)]
    pub check: bool,
    /// Do it again whenever a file of the workspace changes, until Ctrl-C
    #[arg(long)]
    pub watch: bool,
    /// Look at everything again, also where nothing has changed since an earlier run; keep nothing for later ones
    #[arg(long)]
    pub no_cache: bool,
    /// Form of the answer: with `json` the names of the files that differ
    #[arg(long, value_enum, default_value = "text")]
    pub format: TextOrJson,
}

/// Report every diagnostic of manifest, nodes and parameter files, without compiling
#[derive(Args, Clone, Debug)]
#[command(after_help = "\
Exit status: 0 no errors, 1 errors, or warnings with --deny-warnings.

Examples:
  hulkgen check
  hulkgen check --watch                   # again whenever a file is saved, until Ctrl-C
  hulkgen check --cargo                   # and what rustc and the robot's program find, where they come from
  hulkgen check --format json | jq '.diagnostics[].code'
  hulkgen check --format rustc-json       # for editors: rust-analyzer.check.overrideCommand")]
pub struct Check {
    /// Compile as well: writes the generated crate, adds what rustc finds, and reads parameters of types that serde alone
    /// understands with the robot's program
    #[arg(long)]
    pub cargo: bool,
    /// Let warnings be errors
    #[arg(long)]
    pub deny_warnings: bool,
    /// Do it again whenever a file of the workspace changes, until Ctrl-C
    #[arg(long)]
    pub watch: bool,
    /// Look at everything again, also where nothing has changed since an earlier run; keep nothing for later ones
    #[arg(long)]
    pub no_cache: bool,
    /// Form of the answer
    #[arg(long, value_enum, default_value = "text")]
    pub format: CheckFormat,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum CheckFormat {
    /// For people
    Text,
    /// For programs
    Json,
    /// For editors that read cargo's messages
    RustcJson,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum TextOrJson {
    Text,
    Json,
}

/// Draw who writes what and who reads it
#[derive(Args, Clone, Debug)]
#[command(after_help = "\
Exit status: 0 drawn, 1 the robot has errors, 2 there is no such cycler.

Examples:
  hulkgen graph --format svg > robot.svg
  hulkgen graph --format html > robot.html       # zoom, search, highlight; needs no server
  hulkgen graph --cycler Control --format dot | dot -Tpdf > control.pdf")]
pub struct Graph {
    /// Only this cycler and what it exchanges with others
    #[arg(long, value_name = "NAME")]
    pub cycler: Option<String>,
    /// Language of the picture
    #[arg(long, value_enum, default_value = "mermaid")]
    pub format: GraphFormat,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum GraphFormat {
    /// A picture for browsers and viewers
    Svg,
    /// For Graphviz
    Dot,
    /// For Markdown
    Mermaid,
    /// For programs
    Json,
    /// One self-contained page around the picture
    Html,
}

/// Generate, build and run a target
///
/// Runs in the robot's folder until Ctrl-C, or as long as --for says. With --format json the report
/// at the end goes to stdout. With --watch the robot runs on while what was saved is built, is then stopped in order and
/// started anew; it goes on where nothing could be built. Parameter files are read by the running robot.
#[derive(Args, Clone, Debug)]
#[command(after_help = "\
Exit status: that of the robot's program: 0 ended in order, 1 failed, 130 ended by Ctrl-C;
             before it starts: 1 errors in the robot or a failed build, 2 wrong usage or no such target.
             With --watch 130 alone, or 2.

Examples:
  hulkgen run
  hulkgen run simulated --for 10s --headless --format json
  hulkgen run --watch                      # anew whenever a file is saved that changes the program
  hulkgen run simulated -- --no-ball       # options of the hardware")]
pub struct Run {
    /// The target [default: the first of hulk.toml]
    pub target: Option<String>,
    /// End after this time, for example `10s`, `500ms` or `2m`
    #[arg(long = "for", value_name = "DURATION")]
    pub duration: Option<schema::Duration>,
    /// Open no window
    #[arg(long)]
    pub headless: bool,
    /// Form of the report at the end
    #[arg(long, value_enum)]
    pub format: Option<TextOrJson>,
    /// Folder of the parameter files [default: that of hulk.toml]
    #[arg(long, value_name = "FOLDER")]
    pub parameters: Option<Utf8PathBuf>,
    /// Location whose parameters apply [default: that of the target]
    #[arg(long, value_name = "NAME")]
    pub location: Option<String>,
    /// Set a parameter, for example `ball_filter.gate=2.5`; may be repeated
    #[arg(long, value_name = "PATH=VALUE")]
    pub set: Vec<String>,
    /// Folder for what the run writes
    #[arg(long, value_name = "FOLDER")]
    pub run_folder: Option<Utf8PathBuf>,
    /// Record into this file, which must not be there; `on`: into the run folder; `off` [default: `on` if simulated]
    #[arg(long, value_name = "FILE|on|off")]
    pub record: Option<Utf8PathBuf>,
    /// Record an output in a channel of its own, as JSON; may be repeated, for example `Control.main_outputs.ball`
    #[arg(long, value_name = "PATH")]
    pub record_output: Vec<String>,
    /// What the recording keeps, for example `512MiB` or `2GB` [default: the manifest's `recording_budget`]
    #[arg(long, value_name = "SIZE")]
    pub recording_budget: Option<schema::Size>,
    /// Build and start anew whenever a file changes, until Ctrl-C
    #[arg(long)]
    pub watch: bool,
    #[command(flatten)]
    pub build: Build,
    /// Options of the hardware
    #[arg(last = true, value_name = "OPTIONS")]
    pub options: Vec<OsString>,
}

impl Run {
    /// The file to record into, if it is one and no switch.
    pub(crate) fn record_file(&self) -> Option<&Utf8PathBuf> {
        self.record
            .as_ref()
            .filter(|file| !matches!(file.as_str(), "on" | "off"))
    }
}

/// Build the program of a target for its machine, and tell whether it would start there
///
/// A target with a `triple` is built with zig and cargo-zigbuild, which pip brings once, pinned and checked by digest, into the
/// user's cache folder. The program is stripped. It is refused if it asks for a newer glibc than the triple names, for a
/// library that the robot need not have, or for another processor.
#[derive(Args, Clone, Debug)]
#[command(after_help = "\
Exit status: 0 built; 1 an error was found, or the program would not start there; 2 wrong usage.

Examples:
  hulkgen build nao
  hulkgen build nao --profile release --format json")]
pub struct BuildTarget {
    /// The target [default: the first of hulk.toml]
    pub target: Option<String>,
    /// Form of the answer
    #[arg(long, value_enum, default_value = "text")]
    pub format: TextOrJson,
    #[command(flatten)]
    pub build: Build,
}

/// How the robot's program is built.
#[derive(Args, Clone, Debug)]
pub struct Build {
    /// cargo's profile [default: the target's, else `release`, or `dev` where hulkgen itself is a debug build]
    #[arg(long, value_name = "NAME")]
    pub profile: Option<String>,
    /// Folder for what cargo builds [default: cargo's]
    #[arg(long, value_name = "FOLDER")]
    pub target_dir: Option<Utf8PathBuf>,
}

#[cfg(test)]
mod tests {
    use clap::{CommandFactory as _, Parser as _};

    use super::{Arguments, Command};

    #[test]
    fn the_command_line_is_well_formed() {
        Arguments::command().debug_assert();
    }

    #[test]
    fn what_follows_two_hyphens_belongs_to_the_hardware() {
        let words = ["hulkgen", "run", "--", "--for", "nothing"];
        let parsed = Arguments::try_parse_from(words).expect("it is right usage");
        let Command::Run(run) = parsed.command else {
            panic!("it is `run`")
        };
        assert_eq!((run.target, run.duration), (None, None));
        assert_eq!(run.options, ["--for", "nothing"]);
    }
}
