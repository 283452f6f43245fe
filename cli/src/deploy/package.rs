//! What is sent to robots: a folder with the program and all that it reads, laid out as the robot's own workspace.

use std::fmt;
use std::fs::{self, Permissions};
use std::os::unix::fs::PermissionsExt as _;
use std::process::{Command, Stdio};

use camino::{Utf8Path, Utf8PathBuf};
use tempfile::TempDir;

use super::program::{Machine, machine};
use super::script::quoted;
use crate::outcome::Refusal;

/// Lists the digests of all other files.
pub(super) const SUMS: &str = "SUMS";

/// The script that the unit starts.
const START: &str = "start";
/// The folder of recordings.
const RUNS: &str = "runs";

/// What lies beside the program, its parameters and its files on the robot.
pub(crate) const BESIDE: &[&str] = &[SUMS, RUNS, START];

/// What a version is made of.
#[derive(Debug)]
pub(crate) struct Contents<'a> {
    /// Of the workspace, absolute.
    pub(crate) root: &'a Utf8Path,
    pub(crate) program: &'a Utf8Path,
    /// How the program is called on the robot.
    pub(crate) name: &'a str,
    /// Parameters and other files, relative to the root.
    pub(crate) files: Vec<&'a str>,
    pub(crate) unit: Option<&'a str>,
}

/// A version that lies ready, and is removed when this is dropped.
#[derive(Debug)]
pub(crate) struct Package {
    folder: TempDir,
    pub(crate) version: String,
    pub(crate) kibibytes: u64,
    pub(crate) machine: &'static Machine,
    name: String,
    /// As recordings of the robot tell it; empty where there is no commit.
    revision: String,
}

impl Package {
    /// Collects everything but what differs from robot to robot.
    ///
    /// # Errors
    /// The program is none, or a file cannot be copied.
    pub(crate) fn collect(contents: &Contents<'_>) -> Result<Self, Refusal> {
        let program = contents.program;
        if !program.is_file() {
            return Err(Refusal::bad(format!("there is no program `{program}`"))
                .help("build it, or name the file with `--program`"));
        }
        let machine = machine(program)?;
        let folder = tempfile::Builder::new().prefix("hulkgen-deploy-").tempdir();
        let folder = folder.map_err(|error| cannot("make a temporary folder", &error))?;
        let into = text(&folder)?;
        let mut all = contents.files.clone();
        all.extend(contents.unit);
        // Times are kept, so that rsync sends what has changed. `-R`: with their folders; `-L`: what links lead to.
        let mut copy = Command::new("rsync");
        copy.args(["-aRL", "--"]).args(&all).arg(format!("{into}/"));
        run(copy.current_dir(contents.root))?;
        let mut copy = Command::new("rsync");
        copy.args(["-aL", "--chmod=a+x", "--"])
            .arg(program)
            .arg(into.join(contents.name));
        run(&mut copy)?;
        let revision = Revision::of(contents.root);
        let package = Self {
            version: version(revision.as_ref())?,
            revision: revision.map_or_else(String::new, |it| it.to_string()),
            kibibytes: kibibytes(&into)?,
            machine,
            name: contents.name.to_owned(),
            folder,
        };
        if let Some(unit) = contents.unit {
            let name = Utf8Path::new(unit).file_name().unwrap_or(unit);
            fs::rename(into.join(unit), into.join(name))
                .map_err(|error| cannot("move the unit file", &error))?;
        }
        Ok(package)
    }

    /// The package as one robot gets it: with its `start` and its digests.
    pub(crate) fn for_robot(&self, options: &[String]) -> Result<ForRobot, Refusal> {
        let folder = tempfile::Builder::new().prefix("hulkgen-deploy-").tempdir();
        let folder = folder.map_err(|error| cannot("make a temporary folder", &error))?;
        let into = text(&folder)?;
        let mut copy = Command::new("cp");
        // Linked, not copied: nothing of it is written again.
        copy.args(["-al", "--"])
            .arg(text(&self.folder)?.join("."))
            .arg(&into);
        run(&mut copy)?;
        let start = start(&self.name, &self.revision, options);
        fs::write(into.join(START), start).map_err(|error| cannot("write `start`", &error))?;
        let executable = Permissions::from_mode(0o755);
        fs::set_permissions(into.join(START), executable)
            .map_err(|error| cannot("write `start`", &error))?;
        let sums = format!(
            "find . -type f ! -name {SUMS} -print0 | sort -z | xargs -0 sha256sum > {SUMS}"
        );
        run(Command::new("sh").args(["-c", &sums]).current_dir(&into))?;
        Ok(ForRobot { folder })
    }
}

/// What one robot gets; removed when this is dropped.
#[derive(Debug)]
pub(crate) struct ForRobot {
    folder: TempDir,
}

impl ForRobot {
    /// Where it lies.
    pub(crate) fn folder(&self) -> Result<Utf8PathBuf, Refusal> {
        text(&self.folder)
    }
}

/// The script that the unit starts. It goes into its own version, wherever `current` leads meanwhile.
fn start(program: &str, revision: &str, options: &[String]) -> String {
    let words = |words: &[String]| -> String {
        let words = words.iter().map(|it| format!(" {}", quoted(it)));
        words.collect()
    };
    // What `start` is given is the program's: behind `--` it would be the hardware's.
    let own = options.iter().position(|it| it == "--");
    let (own, hardware) = options.split_at(own.unwrap_or(options.len()));
    let (own, hardware) = (words(own), words(hardware));
    format!(
        "#!/bin/sh\n# Written by `hulkgen deploy`.\ncd \"$(dirname \"$(readlink -f \"$0\")\")\" || exit 1\n\
         export HULKGEN_REVISION={}\nexec ./{}{own} \"$@\"{hardware}\n",
        quoted(revision),
        quoted(program)
    )
}

/// The commit that is checked out.
#[derive(Debug)]
struct Revision {
    commit: String,
    short: String,
    is_changed: bool,
}

impl Revision {
    /// `None`: there is no commit, or no git.
    fn of(root: &Utf8Path) -> Option<Self> {
        let git =
            |arguments: &[&str]| run(Command::new("git").args(arguments).current_dir(root)).ok();
        Some(Self {
            commit: git(&["rev-parse", "HEAD"])?,
            short: git(&["rev-parse", "--short", "HEAD"])?,
            is_changed: git(&["status", "--porcelain"]).is_none_or(|changes| !changes.is_empty()),
        })
    }
}

impl fmt::Display for Revision {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let changed = if self.is_changed { " with changes" } else { "" };
        write!(formatter, "{}{changed}", self.commit)
    }
}

/// When it was made and of which commit: names that are sorted by time.
fn version(revision: Option<&Revision>) -> Result<String, Refusal> {
    let date = run(Command::new("date").args(["-u", "+%Y%m%d-%H%M%S"]))?;
    let Some(revision) = revision else {
        return Ok(date);
    };
    let changed = if revision.is_changed { "-changed" } else { "" };
    Ok(format!("{date}-{}{changed}", revision.short))
}

fn kibibytes(folder: &Utf8Path) -> Result<u64, Refusal> {
    let said = run(Command::new("du").args(["-sk", folder.as_str()]))?;
    let number = said
        .split_whitespace()
        .next()
        .and_then(|it| it.parse().ok());
    number.ok_or_else(|| Refusal::bad(format!("`du` says `{said}`")))
}

fn run(command: &mut Command) -> Result<String, Refusal> {
    let name = command.get_program().to_string_lossy().into_owned();
    let output = command.stdin(Stdio::null()).output();
    let output = output.map_err(|error| {
        Refusal::bad(format!("cannot start `{name}`: {error}")).help(format!("install {name}"))
    })?;
    if output.status.success() {
        return Ok(String::from_utf8_lossy(&output.stdout).trim().to_owned());
    }
    let said = String::from_utf8_lossy(&output.stderr);
    Err(Refusal::bad(format!("`{name}` failed: {}", said.trim())))
}

fn text(folder: &TempDir) -> Result<Utf8PathBuf, Refusal> {
    Utf8PathBuf::try_from(folder.path().to_owned())
        .map_err(|error| Refusal::bad(format!("the temporary folder's name is no UTF-8: {error}")))
}

fn cannot(deed: &str, error: &std::io::Error) -> Refusal {
    Refusal::bad(format!("cannot {deed}: {error}"))
}

#[cfg(test)]
mod tests {
    use super::start;

    #[test]
    fn options_are_words_whatever_is_in_them() {
        let options = ["--set".to_owned(), "name=it's $HOME".to_owned()];
        let start = start("nao", "0a1b with changes", &options);
        assert!(
            start.ends_with(
                "\nexport HULKGEN_REVISION='0a1b with changes'\nexec ./'nao' '--set' 'name=it'\\''s $HOME' \"$@\"\n"
            ),
            "{start}"
        );
    }

    #[test]
    fn what_start_is_given_is_no_option_of_the_hardware() {
        let options = ["--location", "lab", "--", "--no-sound"].map(str::to_owned);
        let start = start("nao", "", &options);
        let expected = "\nexec ./'nao' '--location' 'lab' \"$@\" '--' '--no-sound'\n";
        assert!(start.ends_with(expected), "{start}");
    }
}
