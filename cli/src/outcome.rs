//! How a command ends, and which exit status says so.
//!
//! | Status | Meaning |
//! |---|---|
//! | 0 | done, and the answer is good |
//! | 1 | the answer is bad: diagnostics, a failed build or run |
//! | 2 | wrong usage |
//! | 3 | drift: `generate --check` only |
//! | 101 | a bug in hulkgen |
//! | 130 | ended by Ctrl-C |

use std::panic::PanicHookInfo;
use std::process::ExitCode;

use crate::interrupt;

/// How a command ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// Done, and the answer is good.
    Good,
    /// The answer is bad; what is bad was printed.
    Bad,
    /// The arguments do not fit the robot.
    WrongUsage,
    /// The generated crate is not what would be written now.
    Drift,
    /// By Ctrl-C, after the program that hulkgen had started ended for it, too.
    Interrupted,
}

/// Why a command could not be done, for a person.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Refusal {
    pub outcome: Outcome,
    /// A lower-case fragment without full stop.
    pub message: String,
    /// What to do instead.
    pub help: Option<String>,
}

impl Refusal {
    /// Something in the world is not as it must be.
    pub fn bad(message: impl Into<String>) -> Self {
        Self {
            outcome: Outcome::Bad,
            message: message.into(),
            help: None,
        }
    }

    /// The arguments name what the robot does not have.
    pub fn wrong_usage(message: impl Into<String>) -> Self {
        Self {
            outcome: Outcome::WrongUsage,
            message: message.into(),
            help: None,
        }
    }

    /// Says what to do instead.
    #[must_use]
    pub fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }
}

impl From<Outcome> for ExitCode {
    fn from(outcome: Outcome) -> Self {
        match outcome {
            Outcome::Good => Self::SUCCESS,
            Outcome::Bad => Self::from(1),
            Outcome::WrongUsage => Self::from(2),
            Outcome::Drift => Self::from(3),
            Outcome::Interrupted => Self::from(interrupt::STATUS),
        }
    }
}

/// From now on a panic says that it is a bug and what to report. The exit status is then 101.
pub fn report_bugs() {
    std::panic::set_hook(Box::new(|panic| {
        use std::io::Write as _;
        // A closed stderr must not panic within the panic.
        let _ = std::io::stderr().write_all(bug_report(panic).as_bytes());
    }));
}

fn bug_report(panic: &PanicHookInfo<'_>) -> String {
    let message = panic.payload_as_str().unwrap_or("(no message)");
    let place = panic
        .location()
        .map(ToString::to_string)
        .unwrap_or_default();
    let arguments: Vec<String> = std::env::args_os()
        .skip(1)
        .map(|argument| format!("{}", argument.display()))
        .collect();
    let (version, repository) = (env!("CARGO_PKG_VERSION"), env!("CARGO_PKG_REPOSITORY"));
    let system = format!("{} {}", std::env::consts::OS, std::env::consts::ARCH);
    format!(
        "\nthis is a bug in hulkgen: {message}\n\n\
         Please report it at {repository}/issues with hulk.toml, the node files it names, and these lines:\n  \
         at       {place}\n  command  hulkgen {}\n  version  {version} on {system}\n",
        arguments.join(" ")
    )
}
