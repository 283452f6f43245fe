//! Where text goes: data to stdout, everything else to stderr, colour only where somebody sees it.

use std::io::{self, ErrorKind, IsTerminal as _, Write as _};

use crate::arguments::Color;
use crate::outcome::{Outcome, Refusal};

/// The two outputs of the process.
pub(super) struct Terminal {
    color: Color,
}

impl Terminal {
    pub(super) fn new(color: Color) -> Self {
        Self { color }
    }

    /// Prints the answer. A reader that went away (`| head`) has what it wanted.
    pub(super) fn data(&self, text: &str) -> Result<(), Refusal> {
        self.more_data(text).map(|_| ())
    }

    /// Prints a part of an answer that goes on and on; false: the reader went away and wants no more.
    pub(super) fn more_data(&self, text: &str) -> Result<bool, Refusal> {
        let mut stdout = io::stdout().lock();
        match stdout
            .write_all(text.as_bytes())
            .and_then(|()| stdout.flush())
        {
            Ok(()) => Ok(true),
            Err(error) if error.kind() == ErrorKind::BrokenPipe => Ok(false),
            Err(error) => Err(Refusal::bad(format!("cannot write to stdout: {error}"))),
        }
    }

    /// Whether somebody sees the answers as they come.
    pub(super) fn is_watched(&self) -> bool {
        io::stdout().is_terminal()
    }

    /// Prints what is not the answer. Nobody can be told if stderr is closed.
    pub(super) fn note(&self, text: &str) {
        let _ = io::stderr().lock().write_all(text.as_bytes());
    }

    /// Says why there is no answer.
    pub(super) fn refuse(&self, refusal: &Refusal) {
        let (red, reset) = if self.colors_notes() {
            ("\x1b[1;31m", "\x1b[0m")
        } else {
            ("", "")
        };
        self.note(&format!("{red}error{reset}: {}\n", refusal.message));
        if let Some(help) = &refusal.help {
            self.note(&format!("  help: {help}\n"));
        } else if refusal.outcome == Outcome::WrongUsage {
            self.note("\nFor more information, try '--help'.\n");
        }
    }

    pub(super) fn colors_data(&self) -> bool {
        self.colors(io::stdout().is_terminal())
    }

    pub(super) fn colors_notes(&self) -> bool {
        self.colors(io::stderr().is_terminal())
    }

    fn colors(&self, is_terminal: bool) -> bool {
        match self.color {
            Color::Always => true,
            Color::Never => false,
            // https://no-color.org: any value but the empty one.
            Color::Auto => {
                is_terminal && std::env::var_os("NO_COLOR").is_none_or(|it| it.is_empty())
            }
        }
    }
}
