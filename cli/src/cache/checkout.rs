//! Copies of other revisions of a repository, to be built: nothing in the repository knows of them.

use std::fs;
use std::process::{Command, Stdio};

use camino::{Utf8Path, Utf8PathBuf};

use super::user_folder;
use crate::outcome::Refusal;

/// A revision whose files lie in the user's cache folder.
#[derive(Clone, Debug)]
pub struct Checkout {
    /// Of all that belongs to the revision.
    folder: Utf8PathBuf,
    /// Of the robot in it.
    pub root: Utf8PathBuf,
}

/// The revision of the repository around `root`; what was copied before is taken as it is.
///
/// # Errors
/// If git does not know it, or there is no place for it.
pub fn of(root: &Utf8Path, revision: &str) -> Result<Checkout, Refusal> {
    let commit = format!("{revision}^{{commit}}");
    let commit = git(
        root,
        &["rev-parse", "--verify", "--end-of-options", &commit],
        None,
    )?;
    let prefix = git(root, &["rev-parse", "--show-prefix"], None)?;
    let caches = user_folder().ok_or_else(|| {
        Refusal::bad("there is no cache folder for another revision").help("set XDG_CACHE_HOME")
    })?;
    let folder = caches.join("revisions").join(&commit);
    let files = folder.join("files");
    let whole = folder.join("whole");
    if !whole.is_file() {
        fs::create_dir_all(&files).map_err(|error| impossible(&files, &error))?;
        // An index of its own: that of the repository stays as it is.
        let index = folder.join("index");
        git(root, &["read-tree", &commit], Some(&index))?;
        let top = git(root, &["rev-parse", "--show-toplevel"], None)?;
        let prefix = format!("--prefix={files}/");
        git(
            Utf8Path::new(&top),
            &["checkout-index", "--all", "--force", &prefix],
            Some(&index),
        )?;
        fs::write(&whole, &commit).map_err(|error| impossible(&whole, &error))?;
    }
    Ok(Checkout {
        root: files.join(prefix.trim_end_matches('/')),
        folder,
    })
}

impl Checkout {
    /// Where a program of the revision is kept.
    pub fn program(&self, target: &str, profile: &str) -> Utf8PathBuf {
        self.folder.join(format!("{target}-{profile}"))
    }

    /// Keeps a program that was built of it.
    ///
    /// # Errors
    /// If there is no room.
    pub fn keep(&self, executable: &Utf8Path, kept: &Utf8Path) -> Result<(), Refusal> {
        // Whole or not at all: another process may look for it.
        let half = kept.with_extension("half");
        fs::copy(executable, &half)
            .and_then(|_| fs::rename(&half, kept))
            .map_err(|error| impossible(kept, &error))
    }
}

fn impossible(path: &Utf8Path, error: &std::io::Error) -> Refusal {
    Refusal::bad(format!("cannot write {path}: {error}"))
}

/// What git answers, without the end of the line.
fn git(root: &Utf8Path, words: &[&str], index: Option<&Utf8Path>) -> Result<String, Refusal> {
    let mut command = Command::new("git");
    command.args(words).current_dir(root).stdin(Stdio::null());
    command.env("GIT_TERMINAL_PROMPT", "0");
    if let Some(index) = index {
        command.env("GIT_INDEX_FILE", index);
    }
    let output = command
        .output()
        .map_err(|error| Refusal::bad(format!("cannot start git: {error}")).help("install git"))?;
    if !output.status.success() {
        let said = String::from_utf8_lossy(&output.stderr);
        let said = said.trim().trim_start_matches("fatal: ");
        return Err(Refusal::wrong_usage(format!("git says: {said}"))
            .help("name a commit, branch or tag of this repository"));
    }
    let text = String::from_utf8_lossy(&output.stdout);
    Ok(text.trim_end_matches('\n').to_owned())
}
