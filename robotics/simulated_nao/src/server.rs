//! Serves LoLA, the NAO's low level interface, on a Unix stream socket.
//!
//! One client at a time gets the state every 12 ms and sends commands whenever it likes. The next
//! one is served when the one before has gone. A client that does not read is dropped, as LoLA does.

mod command;

use std::collections::VecDeque;
use std::io::{ErrorKind, Read, Write};
use std::os::unix::fs::FileTypeExt;
use std::os::unix::net::{UnixListener, UnixStream};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use framework::{Error, Result};
use kinematics::limits;
use lola::Command;
use types::joints::JointName;
use types::motor_commands::MotorCommands;

use self::command::CommandStream;

/// The server; its socket is removed with it.
#[derive(Debug)]
pub(crate) struct LolaServer {
    listener: UnixListener,
    path: PathBuf,
    client: Option<UnixStream>,
    received: CommandStream,
    command: Command,
    /// The newest commands for motors, each with its number; for tests.
    commands: VecDeque<(u64, MotorCommands)>,
    /// How many wanted a joint beyond its limits.
    harmful: u64,
    /// How often a client was dropped.
    dropped: u64,
    /// Whether it is told on stderr what clients do.
    reports: bool,
    /// States that were sent since the last command came.
    unanswered: u32,
    /// States that were sent to any client.
    sent: u64,
}

/// What went to and fro, with all clients together.
#[derive(Clone, Copy, Debug, Default, Eq, PartialEq)]
pub struct Exchange {
    /// States that were sent.
    pub states: u64,
    /// Commands that were understood.
    pub commands: u64,
    /// How often something came that is no command.
    pub rejected: u64,
}

/// More than this between two states is no robot's program: 80 commands.
const FLOOD: usize = 64 * 1024;
/// So many states without any command are a stall: half a second.
const STALL: u32 = 42;

/// So many commands are remembered: 6 s of a robot that sends every 12 ms.
const REMEMBERED: usize = 512;

impl LolaServer {
    /// Listens at `path`. A socket that nobody serves any more is replaced.
    ///
    /// # Errors
    /// Where somebody serves that socket already, or it cannot be made; names the path.
    pub(crate) fn new(path: PathBuf, commands: MotorCommands) -> Result<Self> {
        let listener = listen(&path).map_err(|error| {
            Error::from(error).context(format!("cannot serve LoLA at {}", path.display()))
        })?;
        let command = Command {
            motors: commands,
            ..Command::default()
        };
        Ok(Self {
            listener,
            path,
            client: None,
            received: CommandStream::default(),
            command,
            commands: VecDeque::new(),
            harmful: 0,
            dropped: 0,
            reports: false,
            unanswered: 0,
            sent: 0,
        })
    }

    /// Waits until there is a client.
    ///
    /// # Errors
    /// Where none comes in time.
    pub(crate) fn wait_for_client(&mut self, patience: Duration) -> Result<()> {
        let begun = Instant::now();
        self.accept();
        while self.client.is_none() {
            if begun.elapsed() > patience {
                let path = self.path.display();
                return Err(Error::new(format!("nobody connects to LoLA at {path}")));
            }
            std::thread::sleep(Duration::from_micros(200));
            self.accept();
        }
        Ok(())
    }

    /// From now on tells on stderr who comes, goes, stalls or floods.
    pub(crate) fn report(&mut self) {
        self.reports = true;
    }

    /// How often a client was dropped because it did not read or flooded.
    pub(crate) fn dropped(&self) -> u64 {
        self.dropped
    }

    /// Where it listens.
    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    /// How often something came that is no command.
    pub(crate) fn rejected(&self) -> u64 {
        self.received.rejected()
    }

    /// What clients have asked for, as far as it was received.
    pub(crate) fn command(&self) -> &Command {
        &self.command
    }

    /// What went to and fro.
    pub(crate) fn exchange(&self) -> Exchange {
        Exchange {
            states: self.sent,
            commands: self.commands.back().map_or(0, |(last, _)| last + 1),
            rejected: self.received.rejected(),
        }
    }

    /// Everything that clients have asked for until now: the newest value of each key. Who stops asking leaves the motors with
    /// what they were told last; what a NAO does then is not documented.
    pub(crate) fn receive(&mut self) -> MotorCommands {
        self.accept();
        let mut bytes = [0; 4096];
        let mut taken = 0;
        while let Some(client) = &mut self.client {
            match client.read(&mut bytes) {
                Ok(count) if count > 0 && taken < FLOOD => {
                    taken += count;
                    self.received.push(&bytes[..count]);
                }
                Ok(count) if count > 0 => self.drop_for("sends more than any robot does"),
                Err(error) if error.kind() == ErrorKind::WouldBlock => break,
                Err(error) if error.kind() == ErrorKind::Interrupted => {}
                Ok(_) | Err(_) => {
                    self.tell("has gone");
                    self.drop_client();
                }
            }
            while self.received.next(&mut self.command) {
                if self.unanswered >= STALL {
                    self.tell("sends commands again");
                }
                self.unanswered = 0;
                self.remember();
            }
        }
        self.command.motors
    }

    /// The newest commands that came, oldest first, numbered from 0.
    pub(crate) fn commands(&self) -> Vec<(u64, MotorCommands)> {
        self.commands.iter().copied().collect()
    }

    /// How many commands have wanted a joint beyond its limits.
    pub(crate) fn harmful(&self) -> u64 {
        self.harmful
    }

    fn remember(&mut self) {
        self.harmful += u64::from(is_harmful(&self.command.motors));
        let number = self.commands.back().map_or(0, |(last, _)| last + 1);
        if self.commands.len() == REMEMBERED {
            self.commands.pop_front();
        }
        self.commands.push_back((number, self.command.motors));
    }

    /// Sends one state to the client; whether there is one.
    pub(crate) fn send(&mut self, state: &[u8]) -> bool {
        self.accept();
        let Some(client) = &mut self.client else {
            return false;
        };
        // A state that fits only in part would put every later one out of step.
        let sent = matches!(client.write(state), Ok(count) if count == state.len());
        if sent {
            self.sent += 1;
        } else {
            self.drop_for("does not read its states");
        }
        self.unanswered = self.unanswered.saturating_add(1);
        if self.unanswered == STALL {
            self.tell(
                "has sent no command for half a second; the motors keep what they were told last",
            );
        }
        sent
    }

    fn drop_for(&mut self, reason: &str) {
        self.dropped += 1;
        self.tell(&format!("{reason}; it has to connect again"));
        self.drop_client();
    }

    fn tell(&self, what: &str) {
        if self.reports {
            eprintln!("the program at {} {what}", self.path.display());
        }
    }

    fn accept(&mut self) {
        if self.client.is_none()
            && let Ok((client, _)) = self.listener.accept()
            && client.set_nonblocking(true).is_ok()
        {
            self.client = Some(client);
            self.unanswered = 0;
            self.tell("has connected");
        }
    }

    fn drop_client(&mut self) {
        self.client = None;
        self.received.clear();
    }
}

impl Drop for LolaServer {
    fn drop(&mut self) {
        // Somebody may have removed it already; nothing is left to do then.
        let _ = std::fs::remove_file(&self.path);
    }
}

/// Whether it wants a joint beyond its limits, or nowhere; 32 bits round by less than 1e-6 rad.
fn is_harmful(commands: &MotorCommands) -> bool {
    let beyond = |(joint, angle): (JointName, &f32)| (angle - limits::clamp(joint, *angle)).abs();
    !commands.positions.iter().map(beyond).all(|by| by < 1e-6)
}

/// A socket at a path that nobody serves; what a dead server left is replaced.
pub(crate) fn listen(path: &Path) -> std::io::Result<UnixListener> {
    let listener = match UnixListener::bind(path) {
        Err(error) if error.kind() == ErrorKind::AddrInUse => {
            let refusal = |reason: &str| Err(std::io::Error::new(ErrorKind::AddrInUse, reason));
            if !std::fs::symlink_metadata(path)?.file_type().is_socket() {
                return refusal("there is a file that is no socket; name another path");
            }
            if UnixStream::connect(path).is_ok() {
                return refusal("the socket is in use; stop the other robot or name another path");
            }
            // Left over by a robot that did not stop in order.
            std::fs::remove_file(path)?;
            UnixListener::bind(path)?
        }
        other => other?,
    };
    listener.set_nonblocking(true)?;
    Ok(listener)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn serve(folder: &tempfile::TempDir) -> LolaServer {
        LolaServer::new(folder.path().join("lola"), MotorCommands::default()).unwrap()
    }

    #[test]
    fn a_file_that_is_no_socket_is_kept() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("precious");
        std::fs::write(&path, "precious").unwrap();
        let error = LolaServer::new(path.clone(), MotorCommands::default()).unwrap_err();
        assert!(error.to_string().contains("no socket"), "{error}");
        assert_eq!(std::fs::read_to_string(path).unwrap(), "precious");
    }

    #[test]
    fn commands_beyond_the_limits_of_a_joint_are_harmful() {
        let mut commands =
            MotorCommands::holding(crate::posture::sitting().map(|angle| angle as f32), 0.5);
        assert!(!is_harmful(&commands));
        for angle in [2.2, -0.2, f32::NAN] {
            commands.positions.left_knee_pitch = angle;
            assert!(is_harmful(&commands), "{angle}");
        }
    }

    #[test]
    fn a_socket_in_use_is_named() {
        let folder = tempfile::tempdir().unwrap();
        let first = serve(&folder);
        let error = LolaServer::new(first.path().into(), MotorCommands::default()).unwrap_err();
        let message = error.to_string();
        assert!(
            message.contains(&first.path().display().to_string()),
            "{message}"
        );
        assert!(message.contains("in use"), "{message}");
    }

    #[test]
    fn a_socket_that_a_dead_server_left_is_replaced() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("lola");
        drop(UnixListener::bind(&path).unwrap());
        assert!(path.exists());
        assert!(LolaServer::new(path, MotorCommands::default()).is_ok());
    }

    #[test]
    fn the_second_client_is_served_when_the_first_has_gone() {
        let folder = tempfile::tempdir().unwrap();
        let mut server = serve(&folder);
        assert!(!server.send(b"nobody"));
        let mut first = UnixStream::connect(server.path()).unwrap();
        let mut second = UnixStream::connect(server.path()).unwrap();
        assert!(server.send(b"one"));
        let mut bytes = [0; 3];
        first.read_exact(&mut bytes).unwrap();
        assert_eq!(&bytes, b"one");
        drop(first);
        server.receive();
        assert!(server.send(b"two"));
        second.read_exact(&mut bytes).unwrap();
        assert_eq!(&bytes, b"two");
    }

    #[test]
    fn a_client_that_never_reads_is_dropped() {
        let folder = tempfile::tempdir().unwrap();
        let mut server = serve(&folder);
        let _deaf = UnixStream::connect(server.path()).unwrap();
        let sent = (0..10_000).take_while(|_| server.send(&[0; 896])).count();
        assert!(sent > 0 && sent < 10_000, "{sent}");
    }
}
