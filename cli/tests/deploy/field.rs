//! Robots for `deploy`: a real sshd on this machine, a folder as each robot's disk, and a robot's workspace that is sent there.

use std::fs::{self, Permissions};
use std::io::{Read, Write};
use std::net::{Shutdown, TcpListener, TcpStream};
use std::os::unix::fs::PermissionsExt as _;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::thread;
use std::time::{Duration, Instant};

use tempfile::TempDir;

/// What is looked for, and which package has it.
const PROGRAMS: &[(&str, &str)] = &[
    ("sshd", "openssh-server"),
    ("ssh", "openssh-client"),
    ("ssh-keygen", "openssh-client"),
    ("rsync", "rsync"),
];

/// A robot's program: says that it likes its parameters unless a file says otherwise, and is large enough to be cut.
const PROGRAM: &str = r#"
static PADDING: &[u8] = include_bytes!("padding");
fn main() {
    let parameters = std::fs::read_to_string("parameters/default.toml").expect("the parameters are there");
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let revision = std::env::var("HULKGEN_REVISION");
    println!("{arguments:?} {revision:?} {} {parameters}", PADDING.iter().map(|byte| u64::from(*byte)).sum::<u64>());
    std::process::exit(i32::from(parameters.contains("wrong")));
}
"#;

/// Stands in for the robot's: a version may be refused, end at once, or be started again and again.
const SYSTEMCTL: &str = r#"#!/bin/sh
here=FOLDER/disk/current/motions
case "$1" in
  is-active)
    echo "sudo: unable to resolve host robot" >&2
    # It was started again as often as it may be.
    if [ -e $here/mortal ]; then touch FOLDER/limited; echo failed; exit 3; fi; echo active; exit 0 ;;
  reset-failed) rm -f FOLDER/limited; exit 0 ;;
  show) echo "NRestarts=$(if [ -e $here/restless ]; then date +%s%N; else echo 0; fi)"; exit 0 ;;
esac
echo "$* $(readlink FOLDER/disk/current)" >> FOLDER/systemctl.log
if [ "$1" = restart ]; then
  if [ -e FOLDER/limited ]; then echo "start request repeated too quickly" >&2; exit 1; fi
  [ ! -e $here/broken ]
fi
"#;

pub(crate) struct Field {
    folder: TempDir,
    sshd: Child,
    port: u16,
}

/// A program of this name, also where a user's PATH has no folder of the system.
fn found(name: &str) -> Option<PathBuf> {
    let path = std::env::var_os("PATH").unwrap_or_default();
    let folders = std::env::split_paths(&path).chain(["/usr/sbin".into(), "/sbin".into()]);
    folders
        .map(|folder| folder.join(name))
        .find(|file| file.is_file())
}

impl Field {
    /// `None`: said what to install.
    pub(crate) fn open(test: &str) -> Option<Self> {
        let missing = PROGRAMS.iter().find(|(name, _)| found(name).is_none());
        if let Some((_, package)) = missing {
            crate::skipped::skip(test, &format!("install {package}"));
            return None;
        }
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = folder.path();
        for key in ["host_key", "key"] {
            let made = Command::new("ssh-keygen")
                .args(["-q", "-t", "ed25519", "-N", "", "-f"])
                .arg(path.join(key))
                .status();
            assert!(made.expect("ssh-keygen starts").success());
        }
        let port = free_port();
        write(
            path,
            "sshd_config",
            &format!(
                "Port {port}\nListenAddress 127.0.0.1\nHostKey {0}/host_key\nAuthorizedKeysFile {0}/key.pub\nStrictModes no\n\
             SetEnv PATH={0}/bin:/usr/local/bin:/usr/bin:/bin\nPidFile none\nUsePAM no\nPasswordAuthentication no\nPermitRootLogin yes\nMaxStartups 100\n",
                path.display()
            ),
        );
        // sshd wants it where it runs as root, and nobody makes it where no system service was started.
        let _ = fs::create_dir_all("/run/sshd");
        let sshd = Command::new(found("sshd").expect("it was found above"))
            .args(["-D", "-e", "-f"])
            .arg(path.join("sshd_config"))
            .stderr(fs::File::create(path.join("sshd.log")).expect("the folder is ours"))
            .spawn()
            .expect("sshd starts");
        let field = Self { folder, sshd, port };
        field.write_ssh_config(port);
        field.write_workspace();
        field.wait_for_sshd();
        Some(field)
    }

    fn wait_for_sshd(&self) {
        let end = Instant::now() + Duration::from_secs(60);
        while TcpStream::connect(("127.0.0.1", self.port)).is_err() {
            let log = fs::read_to_string(self.path("sshd.log")).unwrap_or_default();
            assert!(Instant::now() < end, "sshd does not listen: {log}");
            thread::sleep(Duration::from_millis(20));
        }
    }

    pub(crate) fn path(&self, below: &str) -> PathBuf {
        self.folder.path().join(below)
    }

    /// All robots are this machine, reached at this port.
    fn write_ssh_config(&self, port: u16) {
        let folder = self.folder.path().display();
        let config = format!(
            "Host *\n  HostName 127.0.0.1\n  Port {port}\n  IdentityFile {folder}/key\n  IdentitiesOnly yes\n  \
             StrictHostKeyChecking accept-new\n  UserKnownHostsFile {folder}/known_hosts_{port}\n"
        );
        write(self.folder.path(), "ssh_config", &config);
    }

    /// From now on ssh's configuration names another port; gives the robots' own.
    pub(crate) fn ignore_port(&self) -> u16 {
        self.write_ssh_config(free_port());
        self.port
    }

    /// Who may be there.
    pub(crate) fn user(&self) -> String {
        let said = Command::new("id").arg("-un").output().expect("id starts");
        String::from_utf8_lossy(&said.stdout).trim().to_owned()
    }

    fn write_workspace(&self) {
        let robot = self.path("robot");
        write(&robot, "parameters/default.toml", "speed = 1\n");
        write(&robot, "motions/wave.toml", "wave\n");
        write(&robot, "system/lamp.service", "[Service]\nExecStart=lamp\n");
        self.write_manifest(&self.path("disk"), true);
        let systemctl = SYSTEMCTL.replace("FOLDER", &self.folder.path().display().to_string());
        let journalctl = "#!/bin/sh\necho \"journal of $*\"\n";
        for (name, text) in [
            ("systemctl", systemctl.as_str()),
            ("journalctl", journalctl),
            // Seconds of a robot.
            ("bin/sleep", "#!/bin/sh\nexec /bin/sleep 0.02\n"),
        ] {
            write(self.folder.path(), name, text);
            fs::set_permissions(self.path(name), Permissions::from_mode(0o755))
                .expect("it is ours");
        }
        // Nothing that a packer makes smaller.
        let mut state = 7_u64;
        let padding: Vec<u8> = std::iter::repeat_with(|| {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1);
            (state >> 56) as u8
        })
        .take(3 << 20)
        .collect();
        fs::write(self.path("padding"), padding).expect("the folder is ours");
        write(self.folder.path(), "lamp.rs", PROGRAM);
        let built = Command::new("rustc")
            .args(["-C", "debuginfo=0", "--edition", "2024", "-o"])
            .arg(self.path("lamp"))
            .arg(self.path("lamp.rs"))
            .status();
        assert!(built.expect("rustc starts").success());
    }

    /// Robots `a` and `b` share a disk; `has_unit`: they start what they get.
    pub(crate) fn write_manifest(&self, disk: &Path, has_unit: bool) {
        let folder = self.folder.path().display();
        let unit = if has_unit {
            "unit = \"system/lamp.service\"\n"
        } else {
            ""
        };
        let manifest = format!(
            "[robot]\nname = \"lamp\"\n\n[[cycler]]\nname = \"Control\"\nkind = \"real-time\"\nsetup_nodes = [\"n::a\"]\n\n\
             [[target]]\nname = \"lamp\"\nhardware = \"n::Hardware\"\n\n[target.deploy]\nfolder = \"{}\"\n\
             hosts = {{ a = \"robot-a\", b = \"robot-b\" }}\nfiles = [\"motions\"]\n{unit}\
             systemctl = \"{folder}/systemctl\"\njournalctl = \"{folder}/journalctl\"\n\
             wlan = \"echo joined {{name}} >> {folder}/wlan.log\"\n",
            disk.display()
        );
        write(&self.path("robot"), "hulk.toml", &manifest);
    }

    pub(crate) fn write(&self, below: &str, text: &str) {
        write(self.folder.path(), below, text);
    }

    pub(crate) fn read(&self, below: &str) -> String {
        fs::read_to_string(self.path(below)).unwrap_or_default()
    }

    /// Which version is the running one.
    pub(crate) fn current(&self) -> Option<String> {
        let link = fs::read_link(self.path("disk/current")).ok()?;
        Some(link.to_str().expect("it is UTF-8").to_owned())
    }

    /// How it ended, what it answered, and what it said.
    pub(crate) fn hulkgen(&self, arguments: &str) -> (i32, String, String) {
        ended(self.command(arguments))
    }

    /// As [`Self::hulkgen`], called in another folder of the field.
    pub(crate) fn hulkgen_in(&self, folder: &str, arguments: &str) -> (i32, String, String) {
        let mut command = self.command(arguments);
        command.current_dir(self.path(folder));
        ended(command)
    }

    /// As [`Self::hulkgen`], with the folder in which cargo was told to build.
    pub(crate) fn hulkgen_built_in(&self, arguments: &str, folder: &Path) -> (i32, String, String) {
        let mut command = self.command(arguments);
        command.env("CARGO_TARGET_DIR", folder);
        ended(command)
    }

    /// In the robot's folder.
    fn command(&self, arguments: &str) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_hulkgen"));
        command
            .env_remove("CARGO_TARGET_DIR")
            .args(arguments.split_whitespace())
            .arg("--ssh-config")
            .arg(self.path("ssh_config"))
            .current_dir(self.path("robot"))
            .stdin(Stdio::null());
        command
    }

    /// Deploys the program.
    pub(crate) fn deploy(&self, arguments: &str) -> (i32, String, String) {
        let program = self.path("lamp");
        self.hulkgen(&format!(
            "deploy {arguments} --program {}",
            program.display()
        ))
    }

    /// From now on a connection ends after so many bytes towards the robot; gives how many were cut.
    pub(crate) fn cut_connections_after(&self, bytes: u64) -> Arc<AtomicU64> {
        let listener = TcpListener::bind("127.0.0.1:0").expect("a free port");
        let port = listener.local_addr().expect("it is bound").port();
        self.write_ssh_config(port);
        let (robot, cut) = (self.port, Arc::new(AtomicU64::new(0)));
        let counted = Arc::clone(&cut);
        thread::spawn(move || {
            for client in listener.incoming().map_while(Result::ok) {
                let counted = Arc::clone(&counted);
                thread::spawn(move || forward(client, robot, bytes, &counted));
            }
        });
        cut
    }

    /// Connections live as long as they like again.
    pub(crate) fn mend_connections(&self) {
        self.write_ssh_config(self.port);
    }
}

impl Drop for Field {
    fn drop(&mut self) {
        let _ = self.sshd.kill();
        let _ = self.sshd.wait();
    }
}

/// How it ended, what it answered, and what it said.
fn ended(mut command: Command) -> (i32, String, String) {
    let output = command.output().expect("hulkgen starts");
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    (
        output.status.code().unwrap_or(-1),
        text(&output.stdout),
        text(&output.stderr),
    )
}

fn forward(mut client: TcpStream, port: u16, limit: u64, cut: &AtomicU64) {
    let Ok(mut robot) = TcpStream::connect(("127.0.0.1", port)) else {
        return;
    };
    let (Ok(mut back), Ok(mut answers)) = (client.try_clone(), robot.try_clone()) else {
        return;
    };
    thread::spawn(move || {
        let _ = std::io::copy(&mut answers, &mut back);
        let _ = back.shutdown(Shutdown::Both);
    });
    let (mut sent, mut buffer) = (0, [0; 4096]);
    while let Ok(count) = client.read(&mut buffer) {
        sent += count as u64;
        if count == 0 || robot.write_all(&buffer[..count]).is_err() {
            break;
        }
        if sent > limit {
            cut.fetch_add(1, Ordering::Relaxed);
            break;
        }
    }
    let _ = robot.shutdown(Shutdown::Both);
    let _ = client.shutdown(Shutdown::Both);
}

fn free_port() -> u16 {
    let listener = TcpListener::bind("127.0.0.1:0").expect("a free port");
    listener.local_addr().expect("it is bound").port()
}

fn write(folder: &Path, below: &str, text: &str) {
    let path = folder.join(below);
    fs::create_dir_all(path.parent().expect("it is below a folder")).expect("the folder is ours");
    fs::write(path, text).expect("the folder is ours");
}
