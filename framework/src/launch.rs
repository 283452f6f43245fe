//! From the command line of a generated binary to a running robot, and to its exit status.
//!
//! ```text
//! options -> layers (default, location) -> hardware -> layers (identities) -> robot -> threads -> report
//! ```
//! Exit status: 0 done; 1 the robot failed; 2 wrong usage; 130 Ctrl-C.

mod check;
mod ending;
mod options;
mod output;
mod record;
mod replay;
mod scenario;
mod serving;
mod signals;
mod size;
mod status;
mod tool;

use std::ffi::OsString;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, SystemTime, UNIX_EPOCH};

use crate::data::ParameterData;

use crate::clock::Clock;
use crate::driver::Threads;
use crate::error::{Error, Result};
use crate::hardware::{Hardware, HardwareContext};
use crate::link::Link;
use crate::parameters::{Layers, Parameters};
use crate::recorded::Recording;
use crate::replay::Replayable;
use crate::report::{RobotReport, flush, keep_from_robot, tell};
use crate::robot::{Robot, Start};
use crate::stop::Stop;
use crate::timing::{self, Timing};
use crate::world;
use ending::{Ended, Ending};
use options::{Command, Format, Options};
use serde::Deserialize;
pub use serving::{Listening, Serve, Served, nobody};
use signals::Signals;
use status::Supervisor;

/// What the manifest says about a binary; a constant of the generated crate.
#[derive(Clone, Copy, Debug)]
pub struct Target {
    /// The robot's name.
    pub robot: &'static str,
    /// The target's name.
    pub name: &'static str,
    /// Directory of the parameters, relative to the workspace root, where `hulkgen run` starts the binary.
    pub parameters: &'static str,
    /// The default location of its parameters.
    pub location: Option<&'static str>,
    /// Names of the identities that choose layers, in order.
    pub identities: &'static [&'static str],
    /// The data-flow graph, as `hulkgen graph --format json` prints it; empty where the binary does not have it.
    pub graph: &'static str,
    /// Bytes of chunks that a recording keeps.
    pub recording_budget: u64,
    /// The text of the manifest, for recordings.
    pub manifest: &'static str,
    /// The text of `DATAFLOW.md`, for recordings.
    pub dataflow: &'static str,
    /// Instances that can be replayed.
    pub replayables: &'static [Replayable],
}

const DONE: u8 = 0;
const FAILED: u8 = 1;
const WRONG_USAGE: u8 = 2;
const INTERRUPTED: u8 = 130;

/// Runs a robot with the process's arguments until it is told to stop.
pub fn main<H, P>(
    target: Target,
    create: impl FnMut(&Arc<H>, Start<P>) -> Result<Robot<P>>,
    serve: Serve,
) -> ExitCode
where
    H: Hardware + 'static,
    P: ParameterData,
{
    let arguments = std::env::args_os().skip(1);
    let opened = parsed(&target, arguments, &mut std::io::stdout())
        .and_then(|options| output::of_process(&options).map(|output| (options, output)));
    let status = match opened {
        Ok((options, mut output)) => launched(&target, &options, &mut *output, create, serve),
        Err(status) => status,
    };
    ExitCode::from(status)
}

/// As [`main`], with arguments and standard output of the caller's; gives the exit status.
pub fn run<H, P>(
    target: Target,
    arguments: impl IntoIterator<Item = OsString>,
    output: &mut dyn Write,
    create: impl FnMut(&Arc<H>, Start<P>) -> Result<Robot<P>>,
    serve: Serve,
) -> u8
where
    H: Hardware + 'static,
    P: ParameterData,
{
    match parsed(&target, arguments, output) {
        Ok(options) => launched(&target, &options, output, create, serve),
        Err(status) => status,
    }
}

/// The options; else the exit status.
fn parsed(
    target: &Target,
    arguments: impl IntoIterator<Item = OsString>,
    output: &mut dyn Write,
) -> Result<Options, u8> {
    match options::parse(arguments) {
        Ok(Command::Run(options)) => Ok(*options),
        Ok(Command::Help) => Err(status_of(write!(output, "{}", options::help(target)))),
        Err(error) => {
            tell(format_args!("error: {error}\n\n{}", options::help(target)));
            Err(WRONG_USAGE)
        }
    }
}

/// Does what the options say; gives the exit status.
fn launched<H, P>(
    target: &Target,
    options: &Options,
    output: &mut dyn Write,
    mut create: impl FnMut(&Arc<H>, Start<P>) -> Result<Robot<P>>,
    serve: Serve,
) -> u8
where
    H: Hardware + 'static,
    P: ParameterData,
{
    // A tool's own command line is the tool's.
    let is_asked = options.tool.is_none() && options.hardware.iter().any(|it| it == "--help");
    if is_asked && !H::options().is_empty() {
        return status_of(write!(output, "{}", H::options()));
    }
    if options.check_parameters {
        return check::parameters::<H, P>(target, options, output);
    }
    if options.is_replay {
        return replay::run::<P>(target, options, output, serve);
    }
    let signals = Signals::new();
    let stop = Stop::new();
    let result = signals.and_then(|signals| {
        let supervisor = Supervisor::start(signals.clone(), stop.clone())?;
        let result = match &options.scenario {
            Some(file) => scenario::run(target, options, file, &stop, output, &mut create, serve)
                .map(Ended::With),
            None if options.tool.is_some() => {
                tool::run(target, options, &stop, output, &mut create).map(Ended::With)
            }
            None => start_and_run(
                target,
                options,
                &stop,
                &supervisor,
                output,
                &mut create,
                serve,
            ),
        };
        stop.request();
        // The robot's own error comes first: the supervisor's may be its consequence.
        let joined = supervisor.join();
        let result = result.and_then(|ended| joined.map(|()| ended));
        // What fails while the user interrupts is mostly the interruption.
        if result.as_ref().is_err_and(Error::is_stopped) {
            if signals.interrupted() {
                return Ok(INTERRUPTED);
            }
            // Of scenarios and tools, what they were to do is not done.
            if signals.any() && options.scenario.is_none() && options.tool.is_none() {
                return Ok(DONE);
            }
        }
        result.map(|ended| ended.status(signals.interrupted()))
    });
    let status = result.unwrap_or_else(|error| {
        tell(format_args!("error: {error}"));
        FAILED
    });
    flush();
    status
}

fn start_and_run<H, P>(
    target: &Target,
    options: &Options,
    stop: &Stop,
    supervisor: &Supervisor,
    output: &mut dyn Write,
    create: &mut impl FnMut(&Arc<H>, Start<P>) -> Result<Robot<P>>,
    serve: Serve,
) -> Result<Ended>
where
    H: Hardware + 'static,
    P: ParameterData,
{
    timing::set(match options.format {
        Format::Json => Timing::Complete,
        Format::Text => Timing::Sampled,
    });
    keep_from_robot()?;
    // Dropped behind the hardware.
    let ending = Ending::new();
    let clock = Clock::wall();
    let listening = open(options.listening(target))?;
    // The identities that choose layers come from the hardware, whose own table therefore comes first.
    let mut layers = layers(target, options)?;
    let hardware = connect::<H>(target, options, &layers.load()?, &clock, stop)?;
    // Whatever ends a run from here on, the hardware has its time for its end.
    let of_hardware = |error: &Error| ending.of_hardware(Some(error));
    let mut start = |start| create(&hardware, start);
    layers.identities = known_identities(target, hardware.identities());
    let robot = create_robot(target, layers, &clock, stop, &mut start);
    let mut robot = robot.inspect_err(of_hardware)?;
    let identities = hardware.identities();
    let recording = record::start(
        target,
        options,
        &robot,
        hardware.is_simulated(),
        &identities,
    );
    let mut recording = recording.inspect_err(of_hardware)?;

    tell(format_args!(
        "robot {} on target {}; Ctrl-C stops it",
        target.robot, target.name
    ));
    supervisor.watch(&robot, options.duration, recording.as_ref());
    let started = clock.now();
    let is_real_time = options.is_real_time || !hardware.is_simulated();
    let threads = Threads::new(&clock, hardware.as_ref(), stop).real_time(is_real_time);
    // Dropped with everything that its clients hold when the robot has ended.
    let served = match listening {
        Some(listening) => {
            let mut link = robot.link(stop, threads.rearming());
            link.procedures = world::procedures(&hardware);
            link.recorded = (recording.as_ref()).map_or_else(Vec::new, Recording::shared_counts);
            let started = start_server(link, listening, serve);
            started.inspect_err(|error| {
                drop(recording.take().map(ending::end));
                of_hardware(error);
            })?
        }
        None => None,
    };
    let page = served.as_ref().map(|served| page(served.as_ref()));
    let recording = Mutex::new(recording);
    let give_up = || give_up(&recording);
    let threads = threads.giving_up(&give_up);
    let result = threads.run_observed(&mut robot.instances, |instance| {
        lock(&recording).as_mut()?.observer(instance)
    });
    let mut report = RobotReport::new(target.name, clock.now() - started, &robot);
    let recording = lock(&recording).take();
    let written = write_report(&mut report, recording, page, options.format, output);
    ending.of_hardware(result.as_ref().err());
    // Why the robot failed matters more than a reader who left.
    result?;
    written.map_err(|error| Error::from(error).context("cannot write the report"))?;
    let recorded = report.recording.as_ref();
    let is_outstanding = recorded.is_some_and(|recorded| recorded.ended.is_outstanding);
    Ok(if is_outstanding {
        Ended::WithoutItsDisk
    } else {
        Ended::With(DONE)
    })
}

/// With the layers of the hardware's identities.
fn create_robot<P: ParameterData>(
    target: &Target,
    layers: Layers,
    clock: &Clock,
    stop: &Stop,
    create: &mut dyn FnMut(Start<P>) -> Result<Robot<P>>,
) -> Result<Robot<P>> {
    let loaded = layers.load()?;
    check_hardware(target, &loaded)?;
    let robot = create(Start {
        clock: clock.clone(),
        stop: stop.clone(),
        parameters: loaded.deserialize()?,
    })?;
    robot.parameters.came_from(layers, loaded)?;
    Ok(robot)
}

/// With how the recording ended, whose disk may take long: people read the rest before.
fn write_report(
    report: &mut RobotReport,
    recording: Option<Recording>,
    page: Option<String>,
    format: Format,
    output: &mut dyn Write,
) -> std::io::Result<()> {
    if format == Format::Text {
        tell(format_args!("{}", report.to_string().trim_end()));
    }
    report.recording = recording.map(ending::end);
    match format {
        Format::Json => {
            let mut json = report.to_json();
            json["page"] = page.into();
            flush();
            writeln!(output, "{json}")
        }
        Format::Text => {
            if let Some(recorded) = &report.recording {
                tell(format_args!("{}", recorded.to_string().trim_end()));
            }
            Ok(())
        }
    }
}

/// Ends the process in place of threads that do not end: what they have is lost, but not what is recorded.
fn give_up(recording: &Mutex<Option<Recording>>) {
    if let Some(recording) = lock(recording).take() {
        tell(format_args!("{}", ending::end(recording)));
    }
    ending::exit();
}

fn lock(recording: &Mutex<Option<Recording>>) -> MutexGuard<'_, Option<Recording>> {
    recording.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Before hardware moves, and before files of a run that would not begin.
fn open(listening: Option<Listening>) -> Result<Option<Listening>> {
    let opened = listening.map(Listening::opened).transpose();
    opened.map_err(|error| error.context("cannot serve clients"))
}

pub(crate) fn start_server(
    link: Link,
    listening: Listening,
    serve: Serve,
) -> Result<Option<Box<dyn Served>>> {
    let served = serve(link, listening).map_err(|error| error.context("cannot serve clients"))?;
    if let Some(served) = &served {
        tell(format_args!("page: {}", page(served.as_ref())));
    }
    Ok(served)
}

/// What to open in a browser.
fn page(served: &dyn Served) -> String {
    format!("http://{}/", served.address())
}

fn connect<H: Hardware>(
    target: &Target,
    options: &Options,
    parameters: &Parameters,
    clock: &Clock,
    stop: &Stop,
) -> Result<Arc<H>> {
    let hardware = H::new(HardwareContext {
        options: options.hardware.clone(),
        table: hardware_table(target, parameters)?,
        run_folder: options.run_folder.clone(),
        clock: clock.clone(),
        stop: stop.clone(),
    });
    let hardware = hardware.map_err(|error| of_hardware(target, parameters, error));
    Ok(Arc::new(hardware?))
}

/// What the hardware says, with its name and the place that it could not know.
fn of_hardware(target: &Target, parameters: &Parameters, error: Error) -> Error {
    let error = parameters.locate(target.name, error);
    error.context(format!("hardware of `{}`", target.name))
}

/// What the parameters have for the hardware of this target.
fn hardware_table(target: &Target, parameters: &Parameters) -> Result<toml::Table> {
    check_hardware(target, parameters)?;
    parameters.hardware(target.name)
}

/// Whether the targets for whose hardware they have something are the robot's.
fn check_hardware(target: &Target, parameters: &Parameters) -> Result<()> {
    #[derive(Deserialize)]
    struct Manifest {
        target: Vec<Named>,
    }
    #[derive(Deserialize)]
    struct Named {
        name: String,
    }
    // Programs without a manifest have none to compare with.
    let Ok(manifest) = toml::from_str::<Manifest>(target.manifest) else {
        return Ok(());
    };
    let names = manifest.target.iter().map(|target| target.name.as_str());
    parameters.check_targets(&names.collect::<Vec<_>>())
}

fn layers(target: &Target, options: &Options) -> Result<Layers> {
    Ok(Layers {
        directory: options
            .parameters
            .clone()
            .unwrap_or_else(|| target.parameters.into()),
        location: options
            .location
            .clone()
            .or_else(|| target.location.map(str::to_owned)),
        identities: Vec::new(),
        environment: Layers::environment_of(std::env::vars_os())?,
        above: Vec::new(),
        settings: options.settings.clone(),
    })
}

/// In the manifest's order; what the hardware reports beyond it chooses nothing.
fn known_identities(target: &Target, reported: Vec<(String, String)>) -> Vec<(String, String)> {
    let of_name = |name: &&str| {
        reported
            .iter()
            .find(|(reported, _)| reported == name)
            .cloned()
    };
    target.identities.iter().filter_map(of_name).collect()
}

/// One that no other run has.
fn run_folder(runs: &Path) -> PathBuf {
    let since_epoch = SystemTime::now()
        .duration_since(UNIX_EPOCH)
        .unwrap_or(Duration::ZERO);
    runs.join(format!("{}-{}", since_epoch.as_secs(), std::process::id()))
}

fn status_of(written: std::io::Result<()>) -> u8 {
    if written.is_ok() { DONE } else { FAILED }
}
