//! `merge-driver`: what git calls for a file of the generated crate that both sides changed.
//!
//! Git merges in memory and calls this before the nodes are merged, so what the file has to say cannot be known yet. What
//! merges without conflict is merged; else one side stays whole, so that cargo and people can read it, and git stops for
//! `hulkgen generate`.

use std::process::{Command, Stdio};

use camino::Utf8Path;

use super::Failure;
use super::generate;
use super::terminal::Terminal;
use crate::arguments::MergeDriver;
use crate::drift;
use crate::outcome::{Outcome, Refusal};
use crate::workspace::{Workspace, says_generated};

pub(super) fn run(terminal: &Terminal, merge: &MergeDriver) -> Result<Outcome, Failure> {
    let merged = Command::new("git")
        .args(["merge-file", "--stdout", "--quiet"])
        .args([&merge.ours, &merge.base, &merge.theirs])
        .stderr(Stdio::inherit())
        .output()
        .map_err(|error| {
            Refusal::bad(format!("cannot start git: {error}")).help("this command is called by git")
        })?;
    // The number of conflicts; more than 127 is a failure of git's own.
    let conflicts = merged.status.code().filter(|code| (0..=127).contains(code));
    let conflicts = conflicts.ok_or_else(|| Refusal::bad("git cannot merge these files"))?;
    let text = String::from_utf8(merged.stdout)
        .map_err(|_| Refusal::bad(format!("`{}` is no text", merge.ours)))?;
    let write = |text: &str| {
        drift::write_file(&merge.ours, text).map_err(|error| generate::refusal(&error))
    };
    if conflicts == 0 {
        write(&text)?;
        return Ok(Outcome::Good);
    }
    let ours = Workspace::at_root(Utf8Path::new("")).read(&merge.ours);
    let ours = ours.map_err(|error| Refusal::bad(error.to_string()))?;
    if !says_generated(&ours) {
        // Somebody else's file: git's own way.
        write(&text)?;
        return Ok(Outcome::Bad);
    }
    terminal.note(
        "generated files are not merged but written anew: merge the nodes and hulk.toml, then\n  \
         hulkgen generate && git add generated\n\
         the Cargo.toml of a partial robot's crate says which command writes that\n",
    );
    Ok(Outcome::Bad)
}
