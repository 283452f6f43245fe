//! What the framework asks of a robot's hardware, and what hardware is given.

use std::io::Write;
use std::path::{Path, PathBuf};

use serde::de::DeserializeOwned;

use crate::clock::Clock;
use crate::error::{Error, Result};
use crate::parameters;
use crate::stop::Stop;
use crate::time::Timestamp;
use crate::tool::Bench;

/// The platform, as far as the framework needs it; everything else are traits of the application.
///
/// When the robot stops, its safe state and [`Hardware::stop`] have 10 s together, and its `Drop` has 10 s at the very end:
/// what does not return by then is told, and the process ends with 1. The recording has its end before.
pub trait Hardware: Send + Sync {
    /// Connects to the platform.
    fn new(context: HardwareContext) -> Result<Self>
    where
        Self: Sized;

    /// Reads of its context what [`Hardware::new`] reads, the table and the options, and connects to nothing: for
    /// `--check-parameters`, so that a robot is not sent what it does not start with. By default nothing is looked at.
    ///
    /// # Errors
    /// As [`Hardware::new`] has them of the same context.
    fn check_parameters(_context: &HardwareContext) -> Result<()>
    where
        Self: Sized,
    {
        Ok(())
    }

    /// The identities that choose parameter layers, as (name, id): `("body", "3108…")`.
    fn identities(&self) -> Vec<(String, String)> {
        Vec::new()
    }

    /// The run ends: blocked calls return [`crate::Stopped`] within 100 ms. Called on the thread of the watchdog, which is none
    /// of an instance, behind [`Hardware::enter_safe_state`].
    fn stop(&self);

    /// Takes the actuators away from the nodes; the hardware's own thread brings the robot down (sit, release).
    ///
    /// Called at most once until [`Hardware::rearm`]: on the thread of the watchdog, or on that of the instance that restarts.
    /// No thread can change the safe state until it returns, so it waits for nothing.
    fn enter_safe_state(&self);

    /// Gives the actuators back to the nodes: an instance that had to restart has finished its first
    /// cycle, or somebody wants it.
    fn rearm(&self) {}

    /// Whether somebody has pressed the hardware's own button for it since the last call: a safe state of stop or watchdog
    /// then ends with [`Hardware::rearm`]. Asked many times a second.
    fn is_rearm_wanted(&self) -> bool {
        false
    }

    /// Whether nothing but this machine moves: threads then leave their scheduling to the system, unless `--real-time` is given.
    fn is_simulated(&self) -> bool {
        false
    }

    /// A simulated world: what is really the case now, by name, for the assertions of scenarios.
    fn truth(&self) -> serde_json::Value {
        serde_json::Value::Null
    }

    /// A simulated world: something happens to it, in the hardware's own words; see [`crate::scenario`].
    ///
    /// # Errors
    /// Says what was not understood.
    fn disturb(&self, _deed: &toml::Table) -> Result<()> {
        Err(Error::new("nothing can happen to this hardware"))
    }

    /// A simulated world: the hardware of a further robot in the same one, with a clock of its own. Called before time begins.
    ///
    /// # Errors
    /// Says why there is no room for it.
    fn join(&self, _context: HardwareContext) -> Result<Self>
    where
        Self: Sized,
    {
        Err(Error::new(
            "the world of this hardware has room for one robot",
        ))
    }

    /// A simulated world: parameters that follow from which of its robots this is, as path and value. They stand above all
    /// layers and below what a scenario says itself.
    fn settings(&self) -> Vec<(String, String)> {
        Vec::new()
    }

    /// A world with more than one robot: lets it go on once all of them have come as far as it, and says how far.
    /// `next_event` of none of them tells what is later; it says `None` in its place, until the world has gone on.
    ///
    /// # Errors
    /// Where the world has one robot, whose events are what lets it go on.
    fn advance(&self) -> Result<Timestamp> {
        Err(Error::new("the world of this hardware has one robot"))
    }

    /// Lockstep: advances the world until the data of one instance is ready, equal times in manifest order; `None` at the
    /// end of the world.
    ///
    /// The driver asks for the next event before it finishes cycles that end earlier: `Clock::now` may be behind the world,
    /// and what a read gives is the newest that was ready at `Clock::now`.
    fn next_event(&self) -> Result<Option<Event>> {
        Ok(None)
    }

    /// What its options behind `--` do, a line for each: what `-- --help` prints. Empty: it tells nothing, and `--help` is an
    /// option like any other.
    fn options() -> &'static str
    where
        Self: Sized,
    {
        ""
    }

    /// Names of the tools that this hardware offers beside running the robot.
    fn tools() -> &'static [&'static str]
    where
        Self: Sized,
    {
        &[]
    }

    /// One of [`Hardware::tools`], in place of running. Its own command line stands in `context.options`, what it answers goes
    /// to `output`; instances of the robot can be tried out on the `bench`.
    ///
    /// # Errors
    /// Says what was wrong with its input.
    fn tool(
        name: &str,
        _context: HardwareContext,
        _bench: &mut dyn Bench<Self>,
        _output: &mut dyn Write,
    ) -> Result<()>
    where
        Self: Sized,
    {
        Err(Error::new(format!("this hardware has no tool `{name}`")))
    }
}

/// The data of one instance is ready.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Event {
    /// Since when.
    pub at: Timestamp,
    /// Whose: the name of the instance.
    pub instance: &'static str,
}

/// What [`Hardware::new`] is given.
#[derive(Clone, Debug)]
pub struct HardwareContext {
    /// The command line after `--`.
    pub options: Vec<String>,
    /// The parameters' `[hardware.<target>]`.
    pub table: toml::Table,
    /// Where files of this run belong; not there until [`HardwareContext::create_run_folder`].
    pub run_folder: PathBuf,
    /// The one clock of the robot.
    pub clock: Clock,
    /// Ends the run.
    pub stop: Stop,
}

impl HardwareContext {
    /// The parameters' `[hardware.<target>]` as the hardware's own type.
    ///
    /// With `#[serde(deny_unknown_fields)]` a misspelt key is an error like every other; it names the key, and at the start
    /// of a run the file and line.
    pub fn parameters<T: DeserializeOwned>(&self) -> Result<T> {
        Ok(parameters::from_table(&self.table)?)
    }

    /// The folder for files of this run, created if it is not there.
    pub fn create_run_folder(&self) -> Result<&Path> {
        let folder = self.run_folder.as_path();
        std::fs::create_dir_all(folder).map_err(|error| {
            Error::from(error).context(format!("cannot create {}", folder.display()))
        })?;
        Ok(folder)
    }
}
