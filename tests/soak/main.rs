//! Lets the full robot run while everything around it goes wrong, and adds up what it says about itself.
//!
//! ```text
//! nao_simulator <--sockets--> nao <--clients: watcher, pictures, stalled, restless
//!       ^ killed, started       ^ parameters, failing nodes, a full disk; its report and its recording at the end
//! ```
//! What happens, and in which order, follows from the seed; when, and how many cycles that takes, from the machine.

mod clients;
mod deeds;
mod judge;
mod programs;
mod vitals;

use std::net::{SocketAddr, TcpListener};
use std::process::ExitCode;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::{Duration, Instant};

use lexopt::prelude::{Long, Short, ValueExt as _};

use clients::Told;
use deeds::Deeds;
use judge::Judge;
use programs::{Programs, Robot, Simulator};
use vitals::Vitals;

const HELP: &str = "\
Lets the full robot run while its simulator is killed, its disk is full, nodes fail, clients stall and parameters change.
Ends with 1 where a counter does not add up.

  --for SECONDS     how long [default: 120]
  --seed NUMBER     what is drawn from [default: 1]
  --cameras HZ      images of each camera in a second [default: 5]
  --rates           Control has to keep its rate, too: for a machine that has nothing else to do
  --help";

/// A run ends so much earlier than the robot: clients go, and the robot writes what it has.
const TAIL: Duration = Duration::from_secs(4);

/// What goes wrong, for people.
type Result<T> = std::result::Result<T, String>;

struct Options {
    duration: Duration,
    seed: u64,
    cameras: u64,
    rates: bool,
}

fn main() -> ExitCode {
    match options().and_then(|options| options.map_or(Ok(true), |options| soak(&options))) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(message) => {
            eprintln!("error: {message}");
            ExitCode::FAILURE
        }
    }
}

fn options() -> Result<Option<Options>> {
    let mut options = Options {
        duration: Duration::from_secs(120),
        seed: 1,
        cameras: 5,
        rates: false,
    };
    let mut arguments = lexopt::Parser::from_env();
    let wrong = |error: lexopt::Error| format!("{error}; see --help");
    while let Some(argument) = arguments.next().map_err(wrong)? {
        let number = |arguments: &mut lexopt::Parser| -> Result<u64> {
            let value = arguments.value().map_err(wrong)?;
            value.parse().map_err(wrong)
        };
        match argument {
            Long("for") => options.duration = Duration::from_secs(number(&mut arguments)?),
            Long("seed") => options.seed = number(&mut arguments)?,
            Long("cameras") => options.cameras = number(&mut arguments)?,
            Long("rates") => options.rates = true,
            Short('h') | Long("help") => {
                println!("{HELP}");
                return Ok(None);
            }
            other => return Err(wrong(other.unexpected())),
        }
    }
    if options.duration < TAIL * 5 {
        return Err(format!("--for: at least {} s", (TAIL * 5).as_secs()));
    }
    Ok(Some(options))
}

/// Whether everything added up.
fn soak(options: &Options) -> Result<bool> {
    let programs = Programs::built()?;
    let folder = tempfile::tempdir().map_err(|error| error.to_string())?;
    let simulator = Simulator::start(&programs, folder.path(), options.cameras)?;
    let listener = TcpListener::bind("127.0.0.1:0").and_then(|listener| listener.local_addr());
    let address: SocketAddr = listener.map_err(|error| error.to_string())?;
    let mut robot = Robot::start(&programs, folder.path(), address, options.duration)?;
    let begun = Instant::now();
    let end = begun + options.duration - TAIL;
    let over = AtomicBool::new(false);
    let (told, done, vitals) = thread::scope(|scope| {
        let clients = clients::start(scope, address, &over);
        let mut deeds = Deeds::new(options.seed, simulator, address);
        let mut vitals = Vitals::of(robot.id());
        let mut failure = Ok(());
        while Instant::now() < end && failure.is_ok() {
            failure = deeds.next(&robot, end);
            vitals.look();
        }
        deeds.mend(&robot);
        over.store(true, Ordering::Relaxed);
        let told: Vec<Result<Told>> = clients.into_iter().map(clients::join).collect();
        failure.map(|()| (told, deeds.done(), vitals))
    })?;
    let report = robot.report()?;
    let verified = programs.verify(&robot.recording());
    let mut judge = Judge::default();
    judge.clients(told);
    judge.deeds(&done, &report);
    judge.report(&report);
    judge.recording(&report, verified);
    judge.vitals(&vitals);
    judge.log(&robot.log());
    judge.rate(&report, &done, options.rates);
    println!("{}", judge.table(options.seed, begun.elapsed()));
    Ok(judge.is_good())
}
