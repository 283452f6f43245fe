//! What may stand on the command line of commands that ask a running robot: types for clap, no behaviour.

use camino::Utf8PathBuf;
use clap::{Args, Subcommand, ValueEnum};

use super::TextOrJson;

/// Which robot, and in which form it answers.
#[derive(Args, Clone, Debug)]
pub struct Running {
    /// Where the robot listens, for example `10.1.24.22` or `[::1]:4857` [default: this machine]
    #[arg(long, value_name = "ADDRESS")]
    pub host: Option<String>,
    /// The robot's token, where it asks for one before it lets anybody write [default: HULKGEN_TOKEN]
    #[arg(long, value_name = "TOKEN")]
    pub token: Option<String>,
    /// Form of the answer: with `json` one object a line
    #[arg(long, value_enum, default_value = "text")]
    pub format: TextOrJson,
}

/// Show outputs of a running robot: which there are, their values, how often they come
///
/// Paths name everything: `Control.main_outputs.ball`, and its parts: `Control.main_outputs.ball.position.x`.
#[derive(Args, Clone, Debug)]
#[command(after_help = "\
Exit status: 0 answered, 1 no robot answers, or it refuses; 2 wrong usage.

Examples:
  hulkgen topic list
  hulkgen topic echo Control.main_outputs.ball --rate 2
  hulkgen topic echo VisionTop.main_outputs.image --rate 1 --images pictures
  hulkgen topic hz VisionTop.main_outputs.balls --host 10.1.24.22")]
pub struct Topic {
    #[command(subcommand)]
    pub command: TopicCommand,
}

#[derive(Clone, Debug, Subcommand)]
pub enum TopicCommand {
    /// Print the paths of outputs with their types
    List {
        /// Below this path [default: the outputs of all instances]
        path: Option<String>,
        /// So many levels below it [default: outputs without their parts]
        #[arg(long, value_name = "LEVELS")]
        depth: Option<u8>,
        #[command(flatten)]
        running: Running,
    },
    /// Print a value again and again, until Ctrl-C
    Echo {
        /// An output, a part of one, or parameters
        path: String,
        /// At most so many times a second [default: every cycle]
        #[arg(long, value_name = "HZ", value_parser = rate)]
        rate: Option<f64>,
        /// End after so many values
        #[arg(long, value_name = "NUMBER")]
        count: Option<u64>,
        /// Write each value, an image, as a JPEG file into this folder, and print the file
        #[arg(long, value_name = "FOLDER")]
        images: Option<Utf8PathBuf>,
        #[command(flatten)]
        running: Running,
    },
    /// Print once a second how often a value comes, until Ctrl-C
    Hz {
        /// An output, or a part of one
        path: String,
        /// End after so many lines
        #[arg(long, value_name = "NUMBER")]
        count: Option<u64>,
        #[command(flatten)]
        running: Running,
    },
    /// Print what is known of a path: type, unit, range, parts
    Info {
        /// Any path
        path: String,
        #[command(flatten)]
        running: Running,
    },
}

/// Read and change parameters of a running robot
///
/// A change is gone at the next start unless it is stored into the file of a layer.
#[derive(Args, Clone, Debug)]
#[command(after_help = "\
Exit status: 0 done, 1 no robot answers, or it refuses: then nothing is changed; 2 wrong usage.

Examples:
  hulkgen param list ball_filter
  hulkgen param set ball_filter.gate=2.5 ball_filter.forget_after=3      # both or none
  hulkgen param store                                          # what is in no file, and where it can go
  hulkgen param store default")]
pub struct Param {
    #[command(subcommand)]
    pub command: ParamCommand,
}

#[derive(Clone, Debug, Subcommand)]
pub enum ParamCommand {
    /// Print the value of parameters
    Get {
        /// Without `parameters.` in front [default: all of them]
        path: Option<String>,
        #[command(flatten)]
        running: Running,
    },
    /// Change parameters, all of them at once or none
    Set {
        /// Values in JSON; what is none is a text: `ball_filter.gate=2.5 name=Max list=[1,2]`
        #[arg(value_name = "PATH=VALUE", required = true)]
        changes: Vec<String>,
        #[command(flatten)]
        running: Running,
    },
    /// Print every parameter with its value and where it comes from
    List {
        /// Below this path [default: all of them]
        path: Option<String>,
        #[command(flatten)]
        running: Running,
    },
    /// Write changes into the file of a layer; without one: print what is in no file, and the layers
    Store {
        /// Its name, as `hulkgen param store` prints it
        layer: Option<String>,
        /// Only these [default: everything that is in no file]
        #[arg(value_name = "PATH")]
        paths: Vec<String>,
        #[command(flatten)]
        running: Running,
    },
}

/// Call a procedure of a running robot; without one: print which there are
#[derive(Args, Clone, Debug)]
#[command(after_help = "\
Exit status: 0 answered, 1 no robot answers, or it refuses; 2 wrong usage.

Examples:
  hulkgen call
  hulkgen call Control.procedures.walk '{\"forward\": 0.05, \"left\": 0.0, \"turn\": 0.0}'")]
pub struct Call {
    /// INSTANCE.procedures.NAME
    pub path: Option<String>,
    /// In JSON [default: null]
    #[arg(value_name = "JSON")]
    pub argument: Option<String>,
    /// Seconds until the call counts as failed [default: 5]
    #[arg(long, value_name = "SECONDS", value_parser = rate)]
    pub timeout: Option<f64>,
    #[command(flatten)]
    pub running: Running,
}

/// Print what a running robot says, from its last minutes until Ctrl-C
#[derive(Args, Clone, Debug)]
#[command(after_help = "\
Exit status: 0 ended by --count, 1 no robot answers, or it went away; 2 wrong usage, 130 Ctrl-C.

Examples:
  hulkgen log --level warn
  hulkgen log --format json | jq 'select(.node == \"control::ball_filter\")'")]
pub struct Log {
    /// At least this severe
    #[arg(long, value_enum, default_value = "info")]
    pub level: LogLevel,
    /// End after so many messages
    #[arg(long, value_name = "NUMBER")]
    pub count: Option<u64>,
    #[command(flatten)]
    pub running: Running,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum LogLevel {
    Trace,
    Debug,
    Info,
    Warn,
    Error,
}

/// Show how long cycles and nodes of a running robot take, again and again, until Ctrl-C
#[derive(Args, Clone, Debug)]
#[command(after_help = "\
Exit status: 0 ended by --count, 1 no robot answers, or it went away; 2 wrong usage, 130 Ctrl-C.

Examples:
  hulkgen top
  hulkgen top --count 1 --format json | jq '.instances[].cycle.p99'
  hulkgen top --trace 5 > trace.json")]
pub struct Top {
    /// Seconds between two looks
    #[arg(long, value_name = "SECONDS", default_value = "1", value_parser = rate)]
    pub every: f64,
    /// End after so many looks
    #[arg(long, value_name = "NUMBER")]
    pub count: Option<u64>,
    /// Print the next seconds as a trace, for ui.perfetto.dev or chrome://tracing
    #[arg(long, value_name = "SECONDS", value_parser = rate, conflicts_with_all = ["every", "count"])]
    pub trace: Option<f64>,
    #[command(flatten)]
    pub running: Running,
}

/// A number that makes sense as a rate or a time: positive and finite.
fn rate(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(number) if number > 0.0 && number <= 1e6 => Ok(number),
        Ok(_) => Err("it must be above 0, and at most 1000000".to_owned()),
        Err(error) => Err(error.to_string()),
    }
}
