//! One robot behind ssh.

use std::io::{BufRead, BufReader, Read as _, Write as _};
use std::process::{Child, Command, Stdio};
use std::thread;

use camino::{Utf8Path, Utf8PathBuf};

use super::destination::Destination;
use super::script::{as_a_word, quoted};
use crate::outcome::Refusal;

/// Seconds until a robot that does not answer counts as absent, and a connection without a byte as broken.
const CONNECT_SECONDS: u32 = 5;
const SILENCE_SECONDS: u32 = 20;

/// A robot and how it is reached.
#[derive(Clone, Debug)]
pub(crate) struct Remote {
    /// As its people call it.
    pub(crate) name: String,
    pub(crate) destination: Destination,
    pub(crate) ssh_config: Option<Utf8PathBuf>,
}

/// Why a robot did not do what it was asked.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Failed {
    /// Of the program there, 255 of ssh itself; `None`: ended by a signal.
    pub(crate) status: Option<i32>,
    /// What it said, one line.
    pub(crate) message: String,
}

impl Remote {
    /// What a script prints there.
    pub(crate) fn shell(&self, script: &str) -> Result<String, Failed> {
        let mut command = Command::new("ssh");
        // The script comes as input: whatever shell the user has there, sh reads it, and nothing is quoted twice.
        command
            .args(self.ssh_options())
            .args(["--", &self.destination.of_ssh(), "sh -s"]);
        command
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped());
        let mut child = command
            .spawn()
            .map_err(|error| Failed::at_start("ssh", &error))?;
        let mut stdin = child.stdin.take().expect("it was asked for above");
        // Read whole before any of it is done, and done although nobody hears of it any more: a connection that breaks
        // leaves no half deed. No command reads the rest of the script as its own input.
        let script = format!("main() {{\n{script}\n}}\ntrap '' HUP PIPE\nmain </dev/null\n");
        // Where nobody reads it, ssh says why.
        let writer = thread::spawn(move || drop(stdin.write_all(script.as_bytes())));
        let output = child.wait_with_output();
        let _ = writer.join();
        let output = output.map_err(|error| Failed::at_start("ssh", &error))?;
        if output.status.success() {
            return Ok(String::from_utf8_lossy(&output.stdout).into_owned());
        }
        Err(Failed::said(output.status.code(), &output.stderr))
    }

    /// Makes a folder there equal to one here; what equals a file of `like`, the whole path of a folder there, is not sent.
    pub(crate) fn send(
        &self,
        from: &Utf8Path,
        into: &str,
        like: Option<&str>,
        percent: impl FnMut(u8),
    ) -> Result<(), Failed> {
        let mut command = self.rsync();
        command.args(["-az", "--delete"]);
        if let Some(like) = like {
            // rsync 3.2.7 with Debian's mends of 2026 makes nothing new out of files that a way with `..` leads to.
            command.arg(format!("--copy-dest={like}"));
        }
        command.args([
            "--",
            &format!("{from}/"),
            &format!("{}:{into}/", self.destination.of_rsync()),
        ]);
        watch(command, percent)
    }

    /// Copies what is below a folder there and differs here; nothing is removed.
    pub(crate) fn fetch(
        &self,
        from: &str,
        into: &Utf8Path,
        percent: impl FnMut(u8),
    ) -> Result<(), Failed> {
        std::fs::create_dir_all(into).map_err(|error| Failed {
            status: None,
            message: format!("cannot make the folder `{into}`: {error}"),
        })?;
        let mut command = self.rsync();
        command.args([
            "-az",
            "--partial",
            // A ring is mostly holes: as long as all that was ever written, as large as its budget.
            "--sparse",
            "--",
            &format!("{}:{from}/", self.destination.of_rsync()),
            &format!("{into}/"),
        ]);
        watch(command, percent)
    }

    /// A command there whose output is this process's own.
    pub(crate) fn attached(&self, command: &str) -> Command {
        let mut ssh = Command::new("ssh");
        ssh.args(self.ssh_options())
            .args(["--", &self.destination.of_ssh(), command]);
        ssh.stdin(Stdio::null());
        ssh
    }

    /// What a person types to be there.
    pub(crate) fn as_typed(&self) -> String {
        format!("{} {}", self.ssh_as_typed(), self.destination.of_ssh())
    }

    /// What a person types to get files there into the folder here, each with its folders behind `/./`.
    pub(crate) fn fetching_as_typed(&self, files: impl Iterator<Item = String>) -> String {
        let rsh = match self.ssh_as_typed() {
            plain if plain == "ssh" => String::new(),
            ssh => format!(" -e {}", quoted(&ssh)),
        };
        let destination = self.destination.of_rsync();
        let files = files.map(|file| format!(" {}", as_a_word(&format!("{destination}:{file}"))));
        format!("rsync -aR{rsh}{} .", files.collect::<String>())
    }

    fn ssh_as_typed(&self) -> String {
        let words = self.way();
        let words = words.iter().map(|word| format!(" {}", as_a_word(word)));
        format!("ssh{}", words.collect::<String>())
    }

    fn rsync(&self) -> Command {
        let mut command = Command::new("rsync");
        let ssh: Vec<_> = self.ssh_options().iter().map(|word| quoted(word)).collect();
        command.arg(format!("--rsh=ssh {}", ssh.join(" ")));
        // `-s`: the robot's shell does not read names of folders.
        command.args(["-s", "--info=progress2", "--no-inc-recursive"]);
        command.arg(format!("--timeout={SILENCE_SECONDS}"));
        command
    }

    /// Options without which it is another robot.
    fn way(&self) -> Vec<String> {
        let mut options = Vec::new();
        if let Some(file) = &self.ssh_config {
            options.extend(["-F".to_owned(), file.to_string()]);
        }
        if let Some(port) = self.destination.port() {
            options.extend(["-p".to_owned(), port.to_string()]);
        }
        options
    }

    fn ssh_options(&self) -> Vec<String> {
        let mut options = self.way();
        let settings = [
            // Nobody is asked for a password: several robots would ask at once.
            "BatchMode=yes".to_owned(),
            format!("ConnectTimeout={CONNECT_SECONDS}"),
            format!("ServerAliveInterval={CONNECT_SECONDS}"),
        ];
        options.extend(
            settings
                .into_iter()
                .flat_map(|setting| ["-o".to_owned(), setting]),
        );
        options
    }
}

/// Waits for rsync and tells its percents.
fn watch(mut command: Command, percent: impl FnMut(u8)) -> Result<(), Failed> {
    command
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped());
    let mut child: Child = command
        .spawn()
        .map_err(|error| Failed::at_start("rsync", &error))?;
    let mut stderr = child.stderr.take().expect("it was asked for above");
    let said = thread::spawn(move || {
        let mut said = Vec::new();
        let _ = stderr.read_to_end(&mut said);
        said
    });
    let stdout = child.stdout.take().expect("it was asked for above");
    tell_percents(BufReader::new(stdout), percent);
    let status = child
        .wait()
        .map_err(|error| Failed::at_start("rsync", &error))?;
    let said = said.join().unwrap_or_default();
    if status.success() {
        return Ok(());
    }
    Err(Failed::said(status.code(), &said))
}

/// rsync writes `  1,234  45%  1.2MB/s` again and again, with nothing but a carriage return between.
fn tell_percents(stdout: impl BufRead, mut percent: impl FnMut(u8)) {
    let mut word = Vec::new();
    for byte in stdout.bytes().map_while(Result::ok) {
        match byte {
            b'0'..=b'9' => word.push(byte),
            b'%' => {
                let number = std::str::from_utf8(&word)
                    .ok()
                    .and_then(|it| it.parse().ok());
                number.into_iter().for_each(&mut percent);
                word.clear();
            }
            _ => word.clear(),
        }
    }
}

impl Failed {
    fn at_start(program: &str, error: &std::io::Error) -> Self {
        Self {
            status: None,
            message: format!("cannot start `{program}`: {error}"),
        }
    }

    /// The first line says what happened; rsync's last one sums up and says nothing.
    fn said(status: Option<i32>, stderr: &[u8]) -> Self {
        let text = String::from_utf8_lossy(stderr);
        let lines: Vec<&str> = (text.lines().map(str::trim))
            .filter(|line| !line.is_empty() && !line.starts_with("Warning: Permanently added"))
            .filter(|line| !line.starts_with("rsync error: ") || text.lines().count() == 1)
            .collect();
        let message = match lines.as_slice() {
            [] => "it said nothing".to_owned(),
            all => all[..all.len().min(4)].join("; "),
        };
        Self { status, message }
    }

    /// Whether it was never reached, or no longer.
    pub(crate) fn is_unreachable(&self) -> bool {
        // 255 of ssh; 10, 12 and 30 of rsync: nobody reads any more, the stream ended, or nothing came any more.
        matches!(self.status, Some(255 | 10 | 12 | 30))
    }

    /// Whether there was no space left.
    pub(crate) fn is_full(&self) -> bool {
        self.message.contains("No space left") || self.message.contains("quota exceeded")
    }
}

impl From<Failed> for Refusal {
    fn from(failed: Failed) -> Self {
        Self::bad(failed.message)
    }
}

#[cfg(test)]
mod tests {
    use super::{Destination, Failed, Remote, tell_percents};

    #[test]
    fn what_a_person_types_goes_the_way_that_hulkgen_goes() {
        let robot = |written: &str, ssh_config: Option<&str>| Remote {
            name: "a".to_owned(),
            destination: Destination::parse(written).expect("it is one"),
            ssh_config: ssh_config.map(Into::into),
        };
        let typed = |robot: &Remote| {
            let files = ["/r/./a.toml", "/r/./it's"].map(str::to_owned);
            (robot.as_typed(), robot.fetching_as_typed(files.into_iter()))
        };
        let plain = r"rsync -aR nao@robot:/r/./a.toml 'nao@robot:/r/./it'\''s' .";
        assert_eq!(
            typed(&robot("nao@robot", None)),
            ("ssh nao@robot".to_owned(), plain.to_owned())
        );
        let (ssh, rsync) = typed(&robot("ssh://[::1]:2222", Some("/team/ssh.config")));
        assert_eq!(ssh, "ssh -F /team/ssh.config -p 2222 ::1");
        let start = "rsync -aR -e 'ssh -F /team/ssh.config -p 2222' '[::1]:/r/./a.toml' ";
        assert!(rsync.starts_with(start), "{rsync}");
    }

    #[test]
    fn percents_of_rsync_are_told() {
        let mut told = Vec::new();
        let said =
            "\r         32,768   0%    0.00kB/s\r    1,234,567  45%   12.1MB/s\r 2,000 100% x\n";
        tell_percents(said.as_bytes(), |percent| told.push(percent));
        assert_eq!(told, [0, 45, 100]);
    }

    #[test]
    fn the_reason_is_what_was_said_first() {
        let said = "rsync: write failed: No space left on device (28)\nrsync error: error in file IO (code 11)\n";
        let failed = Failed::said(Some(11), said.as_bytes());
        assert_eq!(
            failed.message,
            "rsync: write failed: No space left on device (28)"
        );
        assert!(failed.is_full() && !failed.is_unreachable());
        assert!(Failed::said(Some(255), b"").is_unreachable());
    }
}
