//! Maps outputs, parameters and procedures of a running robot to keys of Zenoh, as `[[bridge]]` of its manifest says: the
//! robot's own graph tells them, so that no manifest is needed.
//!
//! ```text
//! robot <--docs/protocol.md--> Robot --Bridge--> publishers  --Zenoh--> other machines, ROS 2 by rmw_zenoh
//!                                    <--wishes-- subscribers, queryables: parameters, calls, cycles of other machines
//! ```
//! Invariant: neither side waits for the other. Who is away is waited for, and what comes meanwhile is refused.

mod asks;
mod bridge;
mod cdr;
mod edges;
mod feed;
mod forms;
mod keys;
mod layout;
mod options;
#[cfg(test)]
mod random;
mod ros2;
mod trouble;

use std::process::ExitCode;
use std::thread::sleep;
use std::time::Duration;

use bridge::Bridge;
use client::Robot;
use keys::Keys;
use options::Options;
use trouble::Trouble;

/// What goes wrong is told to people.
pub(crate) type Result<T> = std::result::Result<T, String>;

/// Between attempts to reach the robot.
const PAUSE: Duration = Duration::from_millis(500);

fn main() -> ExitCode {
    let result = options::read().and_then(|options| match options {
        Some(options) => run(&options),
        None => {
            println!("{}", options::HELP);
            Ok(())
        }
    });
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("error: {message}");
            ExitCode::FAILURE
        }
    }
}

/// For ever: robots come and go. Messages are written once.
fn run(options: &Options) -> Result<()> {
    if let Some(folder) = &options.messages {
        let mut robot = Robot::connect(&options.host, options.token.as_deref())?;
        return ros2::export::export(&mut robot, folder);
    }
    let mut keys = Keys::open(options)?;
    let mut said = String::new();
    loop {
        let started = match Robot::connect(&options.host, options.token.as_deref()) {
            Ok(robot) => Bridge::start(robot, &mut keys),
            Err(error) => Err(Trouble::Away(error.into())),
        };
        let mut bridge = match started {
            Ok(bridge) => bridge,
            Err(Trouble::Refused(message)) => return Err(message),
            Err(Trouble::Away(message)) => {
                // Once, until something else is wrong.
                if said != message {
                    eprintln!("warning: {message}");
                    said = message;
                }
                keys.refuse_wishes("the bridge has no robot");
                sleep(PAUSE);
                continue;
            }
        };
        eprintln!("{}", bridge.greeting());
        said = loop {
            if let Err(message) = bridge.turn() {
                break message;
            }
        };
        eprintln!("warning: {said}");
        bridge.end(&said);
        sleep(PAUSE);
    }
}
