//! The programs that are let run.

use std::fs;
use std::io::{BufRead as _, BufReader};
use std::net::SocketAddr;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

use serde_json::Value;
use support::root;

use crate::Result;
use crate::clients::connect;

/// A busy machine may take so long to start something.
const PATIENCE: Duration = Duration::from_secs(60);

/// Less than two minutes take: old frames have to go, and to be counted.
const BUDGET: &str = "128MiB";

/// All of them are recorded, in whatever state the robot is.
const STATES: &str = r#"recording_switch.states=["Unstiff","Initial","Standby","Ready","Set","Playing","Penalized","Finished"]"#;

/// Where they lie.
pub(crate) struct Programs {
    folder: PathBuf,
}

impl Programs {
    /// Builds the robot's program and the simulator as this program was built, and beside it.
    pub(crate) fn built() -> Result<Self> {
        let own = std::env::current_exe().map_err(|error| error.to_string())?;
        let folder = own.parent().ok_or("this program lies nowhere")?.to_owned();
        let target = folder.parent().ok_or("this program lies nowhere")?;
        let mut cargo = Command::new(std::env::var_os("CARGO").unwrap_or("cargo".into()));
        // At once, with the features of the workspace's tests: what those have compiled is not compiled again.
        cargo
            .args(["build", "--quiet", "--locked"])
            .args(["--package", "nao_runtime", "--package", "simulated_nao"])
            .args(["--features", "nao_runtime/target-nao"])
            .args(["--bin", "nao", "--bin", "nao_simulator"])
            .arg("--target-dir")
            .arg(target)
            .current_dir(root());
        if !cfg!(debug_assertions) {
            cargo.arg("--release");
        }
        let status = cargo.status().map_err(|error| format!("cargo: {error}"))?;
        if !status.success() {
            return Err("robot and simulator cannot be built".to_owned());
        }
        Ok(Self { folder })
    }

    /// What the robot's program says when it runs a recording again.
    pub(crate) fn verify(&self, recording: &Path) -> Result<Value> {
        let mut robot = Command::new(self.folder.join("nao"));
        robot.arg("--replay").arg(recording);
        robot.args(["--verify", "--headless", "--format", "json"]);
        let output = robot.current_dir(root()).output();
        let output = output.map_err(|error| format!("the replay: {error}"))?;
        // Its status says that the recording is incomplete, as it has to be after a full disk.
        serde_json::from_slice(&output.stdout).map_err(|error| {
            let said = String::from_utf8_lossy(&output.stderr);
            format!("the replay: {error}: {said}")
        })
    }
}

/// The body and its senses; ends with its owner.
pub(crate) struct Simulator {
    command: Command,
    child: Child,
}

impl Simulator {
    pub(crate) fn start(programs: &Programs, folder: &Path, cameras: u64) -> Result<Self> {
        let mut command = Command::new(programs.folder.join("nao_simulator"));
        command.arg("--socket").arg(folder.join("lola"));
        command.args(["--camera-rate", &cameras.to_string(), "--free-ports"]);
        command.stdout(Stdio::null()).stderr(Stdio::null());
        let child = command
            .spawn()
            .map_err(|error| format!("nao_simulator: {error}"))?;
        Ok(Self { command, child })
    }

    /// As the system kills a process: nothing is tidied up.
    pub(crate) fn kill(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }

    pub(crate) fn restart(&mut self) -> Result<()> {
        self.child = self
            .command
            .spawn()
            .map_err(|error| format!("nao_simulator: {error}"))?;
        Ok(())
    }
}

impl Drop for Simulator {
    fn drop(&mut self) {
        self.kill();
    }
}

/// The robot's program.
pub(crate) struct Robot {
    child: Child,
    recording: PathBuf,
    report: PathBuf,
    log: Arc<Mutex<Vec<String>>>,
    reader: Option<JoinHandle<()>>,
}

impl Robot {
    /// Runs for so long; clients are answered when this returns.
    pub(crate) fn start(
        programs: &Programs,
        folder: &Path,
        address: SocketAddr,
        duration: Duration,
    ) -> Result<Self> {
        let (recording, report) = (folder.join("robot.mcap"), folder.join("report.json"));
        let output = fs::File::create(&report).map_err(|error| error.to_string())?;
        // A limit on files is a full disk, which must not be a signal that ends the program.
        let mut command = Command::new("sh");
        command.args(["-c", "trap '' XFSZ; exec \"$@\"", "sh"]);
        command.arg(programs.folder.join("nao")).arg("--headless");
        command.args(["--for", &format!("{}s", duration.as_secs())]);
        command.args(["--format", "json", "--listen", &address.to_string()]);
        command.arg("--run-folder").arg(folder.join("run"));
        command
            .arg("--record")
            .arg(&recording)
            .args(["--recording-budget", BUDGET])
            .args(["--set", STATES]);
        command
            .args(["--", "--free-ports", "--simulator"])
            .arg(folder.join("lola"));
        command
            .current_dir(root())
            .stdout(output)
            .stderr(Stdio::piped());
        let mut child = command.spawn().map_err(|error| format!("nao: {error}"))?;
        let log = Arc::new(Mutex::new(Vec::new()));
        let said = child.stderr.take().ok_or("the robot's words are piped")?;
        let reader = thread::spawn({
            let log = Arc::clone(&log);
            move || {
                for line in BufReader::new(said).lines().map_while(std::io::Result::ok) {
                    log.lock()
                        .unwrap_or_else(PoisonError::into_inner)
                        .push(line);
                }
            }
        });
        let mut robot = Self {
            child,
            recording,
            report,
            log,
            reader: Some(reader),
        };
        let begun = Instant::now();
        while connect(address).is_err() {
            let ended = robot.child.try_wait().map_err(|error| error.to_string())?;
            if ended.is_some() || begun.elapsed() > PATIENCE {
                return Err(format!(
                    "the robot does not answer:\n{}",
                    robot.log().join("\n")
                ));
            }
            thread::sleep(Duration::from_millis(100));
        }
        Ok(robot)
    }

    pub(crate) fn id(&self) -> u32 {
        self.child.id()
    }

    pub(crate) fn recording(&self) -> PathBuf {
        self.recording.clone()
    }

    /// What it said until now.
    pub(crate) fn log(&self) -> Vec<String> {
        self.log
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
            .clone()
    }

    /// From now on no file of the robot may grow, or every one may.
    pub(crate) fn fill_disk(&self, is_full: bool) -> Result<()> {
        let limit = if is_full {
            "--fsize=1:"
        } else {
            "--fsize=unlimited:"
        };
        let status = Command::new("prlimit")
            .args(["--pid", &self.id().to_string(), limit])
            .status()
            .map_err(|error| format!("prlimit (util-linux): {error}"))?;
        if status.success() {
            Ok(())
        } else {
            Err("prlimit refuses".to_owned())
        }
    }

    /// What it says at its end, which has to be an orderly one.
    pub(crate) fn report(&mut self) -> Result<Value> {
        let begun = Instant::now();
        let status = loop {
            if let Some(status) = self.child.try_wait().map_err(|error| error.to_string())? {
                break status;
            }
            if begun.elapsed() > PATIENCE {
                return Err("the robot does not end".to_owned());
            }
            thread::sleep(Duration::from_millis(100));
        };
        if let Some(reader) = self.reader.take() {
            let _ = reader.join();
        }
        if !status.success() {
            return Err(format!(
                "the robot ended with {status}:\n{}",
                self.log().join("\n")
            ));
        }
        let text = fs::read_to_string(&self.report).map_err(|error| error.to_string())?;
        serde_json::from_str(&text).map_err(|error| format!("the report: {error}"))
    }
}

impl Drop for Robot {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
