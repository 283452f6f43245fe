//! The files of a git revision, read by git itself; nothing is checked out.

use std::collections::BTreeSet;
use std::io::{self, BufRead, BufReader, Read, Write as _};
use std::process::{Command, Stdio};
use std::thread;

use camino::{Utf8Path, Utf8PathBuf};

use super::links::Links;
use super::members::{normalized, relative};
use super::memory::Memory;

/// A revision that cannot be read.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum RevisionError {
    #[error("cannot start git: {reason}")]
    NoGit { reason: String },
    /// What git says.
    #[error("git cannot read `{revision}`: {reason}")]
    Unreadable {
        revision: String,
        reason: String,
        missing: Missing,
    },
}

/// What there would have to be first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Missing {
    Repository,
    Commits,
    /// The revision, or something of it.
    Revision,
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
    let commit = format!("{revision}^{{commit}}");
    let commit = git.ask(&["rev-parse", "--verify", "--end-of-options", &commit]);
    let commit = commit.map_err(|error| git.explained(error))?;
    let commit = git.text(&commit)?;
    let prefix = git.ask(&["rev-parse", "--show-prefix"])?;
    let prefix = git.text(&prefix)?.trim_end_matches(['\n', '/']);
    let listing = git.ask(&["ls-tree", "-r", "-z", "--full-tree", commit.trim()])?;
    let listed = Listed::new(&listing, Utf8Path::new(prefix));
    let targets = git.texts(&listed.links)?;
    let targets = targets
        .iter()
        .map(|target| String::from_utf8_lossy(target).into_owned().into());
    let paths = listed
        .links
        .iter()
        .map(|link| from_repository(prefix, &link.path));
    let links = Links::new(Utf8Path::new(prefix), paths.zip(targets).collect());
    let entries = listed.files(&links);
    let texts = git.texts(&entries)?;
    let files = entries.into_iter().map(|entry| entry.path).zip(texts);
    // A file that is no UTF-8 cannot be read at all, as on disk.
    let files = files.filter_map(|(path, text)| Some((path, String::from_utf8(text).ok()?)));
    Ok(Memory::new(files).at(root).with(links))
}

/// The path from the repository's root.
fn from_repository(prefix: &str, path: &Utf8Path) -> Utf8PathBuf {
    normalized(&Utf8Path::new(prefix).join(path))
}

/// What `git ls-tree -z` lists; a path that is no UTF-8 cannot be named by a robot. Submodules are no files.
#[derive(Default)]
struct Listed {
    files: Vec<Entry>,
    links: Vec<Entry>,
}

impl Listed {
    fn new(listing: &[u8], prefix: &Utf8Path) -> Self {
        let lines = listing.split(|byte| *byte == 0);
        let lines = lines.filter_map(|line| str::from_utf8(line).ok());
        let mut listed = Self::default();
        for (mode, entry) in lines.filter_map(|line| entry(line, prefix)) {
            match mode {
                "120000" => listed.links.push(entry),
                mode if mode.starts_with("100") => listed.files.push(entry),
                _ => {}
            }
        }
        listed
    }

    /// Those that say something about a robot by their own name or by that of a link.
    fn files(self, links: &Links) -> Vec<Entry> {
        let is_ours = |path: &Utf8Path| path.extension().is_some_and(|it| ENDINGS.contains(&it));
        let linked = self.links.iter().filter(|link| is_ours(&link.path));
        let linked: BTreeSet<_> = linked.filter_map(|link| links.follow(&link.path)).collect();
        let mut files = self.files;
        files.retain(|file| is_ours(&file.path) || linked.contains(&file.path));
        files
    }
}

/// A line of `git ls-tree`: mode, type, object, a tab, path.
fn entry<'l>(line: &'l str, prefix: &Utf8Path) -> Option<(&'l str, Entry)> {
    let (head, path) = line.split_once('\t')?;
    let mut head = head.split(' ');
    let (mode, _, object) = (head.next()?, head.next()?, head.next()?);
    let entry = Entry {
        path: relative(prefix, Utf8Path::new(path)),
        object: object.to_owned(),
    };
    Some((mode, entry))
}

struct Git<'a> {
    root: &'a Utf8Path,
    revision: &'a str,
}

impl Git<'_> {
    /// What git answers to these words.
    fn ask(&self, words: &[&str]) -> Result<Vec<u8>, RevisionError> {
        let output = self.command(words).output();
        let output = output.map_err(|error| no_git(&error))?;
        if !output.status.success() {
            let said = String::from_utf8_lossy(&output.stderr);
            return Err(self.unreadable(said.trim().trim_start_matches("fatal: ")));
        }
        Ok(output.stdout)
    }

    fn text<'b>(&self, answer: &'b [u8]) -> Result<&'b str, RevisionError> {
        str::from_utf8(answer).map_err(|_| self.unreadable("a path is no UTF-8"))
    }

    /// The texts of these files, in their order.
    fn texts(&self, entries: &[Entry]) -> Result<Vec<Vec<u8>>, RevisionError> {
        let mut command = self.command(&["cat-file", "--batch"]);
        let texts = ask_for_all(&mut command, entries).map_err(|error| no_git(&error))?;
        texts.map_err(|error| self.unreadable(&error.to_string()))
    }

    fn command(&self, words: &[&str]) -> Command {
        let mut command = Command::new("git");
        command
            .args(words)
            .current_dir(self.root)
            // A partial clone would fetch what it lacks, and ask for a password: git is to answer from what is here.
            .env("GIT_NO_LAZY_FETCH", "1")
            .env("GIT_TERMINAL_PROMPT", "0")
            .stdin(Stdio::null());
        command
    }

    fn unreadable(&self, reason: &str) -> RevisionError {
        RevisionError::Unreadable {
            revision: self.revision.to_owned(),
            reason: reason.to_owned(),
            missing: Missing::Revision,
        }
    }

    /// An error about the revision, with what is missing before that; git's own words are in the language of its user.
    fn explained(&self, mut error: RevisionError) -> RevisionError {
        if let RevisionError::Unreadable { missing, .. } = &mut error {
            let root = self.root.canonicalize_utf8();
            let root = root.unwrap_or_else(|_| self.root.to_owned());
            let mut above = root.ancestors();
            // Where there is one, git may refuse it, and says why.
            if !above.any(|folder| folder.join(".git").exists()) {
                *missing = Missing::Repository;
            } else if self.ask(&["rev-parse", "--git-dir"]).is_ok()
                && self.ask(&["rev-parse", "--verify", "HEAD"]).is_err()
            {
                *missing = Missing::Commits;
            }
        }
        error
    }
}

/// Asks for one object after the other; the outer error: the program cannot be started.
fn ask_for_all(command: &mut Command, entries: &[Entry]) -> io::Result<io::Result<Vec<Vec<u8>>>> {
    let mut child = command
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()?;
    let mut stdin = child.stdin.take().expect("it was asked for above");
    let mut stdout = BufReader::new(child.stdout.take().expect("it was asked for above"));
    // It answers while it is being asked: both at once, or both wait for each other.
    let texts = thread::scope(move |scope| {
        scope.spawn(move || {
            // If it goes away, what it did not say is missed below.
            let _ = (entries.iter()).try_for_each(|entry| writeln!(stdin, "{}", entry.object));
        });
        let texts = entries.iter().map(|_| text(&mut stdout));
        let texts = texts.collect::<io::Result<Vec<_>>>();
        // Nobody reads what comes after an error: it must not wait for that, nor the thread for it.
        drop(stdout);
        texts
    });
    // It has nothing more to say.
    let _ = child.wait();
    Ok(texts)
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
    use std::process::Command;

    use super::{Entry, Links, Listed, ask_for_all, text};

    #[test]
    fn a_path_is_told_from_the_robot_not_from_the_repository() {
        let line = |path: &str| format!("100644 blob 4b825dc\t{path}");
        let found = |path: &str| {
            let listed = Listed::new(line(path).as_bytes(), "robots/nao".into());
            let found = listed.files(&Links::default()).pop();
            found.map(|entry| entry.path)
        };
        assert_eq!(found("robots/nao/hulk.toml"), Some("hulk.toml".into()));
        assert_eq!(found("Cargo.toml"), Some("../../Cargo.toml".into()));
        assert_eq!(found("robots/nao/notes.md"), None);
        let link = Listed::new(b"120000 blob 4b825dc\ta.rs", "".into());
        assert_eq!((link.files.len(), link.links.len()), (0, 1));
    }

    #[test]
    fn texts_come_one_after_the_other_with_their_length() {
        let mut stdout = "4b82 blob 3\na\nb\n5c01 blob 0\n\n".as_bytes();
        assert_eq!(text(&mut stdout).expect("the first"), b"a\nb");
        assert_eq!(text(&mut stdout).expect("the second"), b"");
        assert!(text(&mut "4b82 missing\n".as_bytes()).is_err());
    }

    #[test]
    fn an_answer_that_cannot_be_read_is_an_error_and_no_hang() {
        // Far more than the pipes between two programs hold.
        let entries: Vec<Entry> = (0..100_000)
            .map(|number| Entry {
                path: "a.rs".into(),
                object: format!("object {number} without length of"),
            })
            .collect();
        let texts = ask_for_all(&mut Command::new("cat"), &entries).expect("it can be started");
        let error = texts.expect_err("it only says what it is asked");
        assert!(error.to_string().contains("unexpected answer"), "{error}");
    }

    #[test]
    fn a_path_that_is_no_utf_8_is_passed_over() {
        let listing = b"100644 blob 4b82\todd\xff.rs\x00100644 blob 5c01\ta.rs\0";
        let found = Listed::new(listing, "".into()).files.into_iter();
        assert_eq!(found.map(|entry| entry.path).collect::<Vec<_>>(), ["a.rs"]);
    }
}
