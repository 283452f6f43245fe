//! The files of a git revision, read by git itself; nothing is checked out.

use std::ffi::OsStr;
use std::io::{self, BufRead, BufReader, Read, Write as _};
use std::process::{Command, Stdio};
use std::thread;

use camino::{Utf8Path, Utf8PathBuf};

use super::members::relative;
use super::memory::Memory;

/// A revision that cannot be read.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum RevisionError {
    #[error("cannot start git: {reason}")]
    NoGit { reason: String },
    /// What git says.
    #[error("git cannot read `{revision}`: {reason}")]
    Unreadable { revision: String, reason: String },
}

/// Endings of files that say something about a robot.
const ENDINGS: [&str; 2] = ["rs", "toml"];

/// A file of the revision.
struct Entry {
    /// Relative to the workspace root.
    path: Utf8PathBuf,
    /// The name of its text in git.
    object: String,
}

/// What the revision holds around `root`, a folder of the repository; paths are relative to `root`.
pub(super) fn load(root: &Utf8Path, revision: &str) -> Result<Memory, RevisionError> {
    let git = Git { root, revision };
    let commit = git.ask(["rev-parse", "--verify", "--end-of-options"], &|| {
        format!("{revision}^{{commit}}")
    })?;
    let prefix = git.ask(["rev-parse", "--show-prefix"], &String::new)?;
    let listing = git.ask(["ls-tree", "-r", "-z", "--full-tree"], &|| {
        commit.trim().to_owned()
    })?;
    let prefix = Utf8Path::new(prefix.trim_end_matches(['\n', '/']));
    let entries: Vec<Entry> = listing
        .split('\0')
        .filter_map(|line| entry(line, prefix))
        .collect();
    let texts = git.texts(&entries)?;
    let files = entries.into_iter().map(|entry| entry.path).zip(texts);
    // A file that is no UTF-8 cannot be read at all, as on disk.
    let files = files.filter_map(|(path, text)| Some((path, String::from_utf8(text).ok()?)));
    Ok(Memory::new(files).at(root))
}

/// A line of `git ls-tree`: mode, type, object, a tab, path. Links and submodules are no files.
fn entry(line: &str, prefix: &Utf8Path) -> Option<Entry> {
    let (head, path) = line.split_once('\t')?;
    let mut head = head.split(' ');
    let (mode, _, object) = (head.next()?, head.next()?, head.next()?);
    let path = Utf8Path::new(path);
    let is_ours = path.extension().is_some_and(|it| ENDINGS.contains(&it));
    (mode.starts_with("100") && is_ours).then(|| Entry {
        path: relative(prefix, path),
        object: object.to_owned(),
    })
}

struct Git<'a> {
    root: &'a Utf8Path,
    revision: &'a str,
}

impl Git<'_> {
    /// What git answers to these words and a last one, which may be empty.
    fn ask<const N: usize>(
        &self,
        words: [&str; N],
        last: &dyn Fn() -> String,
    ) -> Result<String, RevisionError> {
        let last = last();
        let mut command = self.command(words);
        if !last.is_empty() {
            command.arg(last);
        }
        let output = command.output().map_err(|error| no_git(&error))?;
        if !output.status.success() {
            let said = String::from_utf8_lossy(&output.stderr);
            return Err(self.unreadable(said.trim().trim_start_matches("fatal: ")));
        }
        String::from_utf8(output.stdout).map_err(|_| self.unreadable("a path is no UTF-8"))
    }

    /// The texts of these files, in their order.
    fn texts(&self, entries: &[Entry]) -> Result<Vec<Vec<u8>>, RevisionError> {
        let mut child = self
            .command(["cat-file", "--batch"])
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .map_err(|error| no_git(&error))?;
        let mut stdin = child.stdin.take().expect("it was asked for above");
        let mut stdout = BufReader::new(child.stdout.take().expect("it was asked for above"));
        // Git answers while it is being asked: both at once, or both wait for each other.
        let texts = thread::scope(|scope| {
            scope.spawn(move || {
                // If git goes away, what it did not say is missed below.
                let _ = (entries.iter()).try_for_each(|entry| writeln!(stdin, "{}", entry.object));
            });
            let texts = entries.iter().map(|_| text(&mut stdout));
            texts.collect::<io::Result<Vec<_>>>()
        });
        // It has nothing more to say.
        let _ = child.wait();
        texts.map_err(|error| self.unreadable(&error.to_string()))
    }

    fn command<S: AsRef<OsStr>>(&self, words: impl IntoIterator<Item = S>) -> Command {
        let mut command = Command::new("git");
        command
            .args(words)
            .current_dir(self.root)
            .stdin(Stdio::null());
        command
    }

    fn unreadable(&self, reason: &str) -> RevisionError {
        RevisionError::Unreadable {
            revision: self.revision.to_owned(),
            reason: reason.to_owned(),
        }
    }
}

/// One answer of `git cat-file --batch`: a line that ends with the length, the text, a line break.
fn text(stdout: &mut impl BufRead) -> io::Result<Vec<u8>> {
    let mut head = String::new();
    stdout.read_line(&mut head)?;
    let length = head.trim_end().rsplit(' ').next();
    let length: u64 = length
        .and_then(|length| length.parse().ok())
        .ok_or_else(|| io::Error::other(format!("unexpected answer `{}`", head.trim_end())))?;
    let mut text = Vec::new();
    stdout.take(length + 1).read_to_end(&mut text)?;
    text.pop();
    Ok(text)
}

fn no_git(error: &io::Error) -> RevisionError {
    RevisionError::NoGit {
        reason: error.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::{entry, text};

    #[test]
    fn a_path_is_told_from_the_robot_not_from_the_repository() {
        let line = |path: &str| format!("100644 blob 4b825dc\t{path}");
        let found = |path: &str| entry(&line(path), "robots/nao".into()).map(|entry| entry.path);
        assert_eq!(found("robots/nao/hulk.toml"), Some("hulk.toml".into()));
        assert_eq!(found("Cargo.toml"), Some("../../Cargo.toml".into()));
        assert_eq!(found("robots/nao/notes.md"), None);
        let link = entry("120000 blob 4b825dc\ta.rs", "".into());
        assert!(link.is_none());
    }

    #[test]
    fn texts_come_one_after_the_other_with_their_length() {
        let mut stdout = "4b82 blob 3\na\nb\n5c01 blob 0\n\n".as_bytes();
        assert_eq!(text(&mut stdout).expect("the first"), b"a\nb");
        assert_eq!(text(&mut stdout).expect("the second"), b"");
        assert!(text(&mut "4b82 missing\n".as_bytes()).is_err());
    }
}
