//! `completions`: a script that completes hulkgen's words in a shell.

use clap::CommandFactory as _;

use super::terminal::Terminal;
use crate::arguments::{Arguments, Completions};
use crate::outcome::{Outcome, Refusal};

pub(super) fn run(terminal: &Terminal, completions: &Completions) -> Result<Outcome, Refusal> {
    let mut script = Vec::new();
    clap_complete::generate(
        completions.shell,
        &mut Arguments::command(),
        "hulkgen",
        &mut script,
    );
    terminal.data(&String::from_utf8_lossy(&script))?;
    Ok(Outcome::Good)
}
