//! Shows a running robot in Foxglove: each output is a channel with its schema, images are pictures, parameters can be
//! changed.
//!
//! ```text
//! robot <--docs/protocol.md--> Robot --Bridge--> channels, parameters <--foxglove.sdk.v1--> Foxglove
//!                                    <--wishes--
//! ```
//! Invariant: the robot is asked for an output only while somebody looks at it.

mod bridge;
mod channels;
mod parameters;

use std::net::SocketAddr;
use std::process::ExitCode;
use std::thread;
use std::time::Duration;

use lexopt::prelude::{Long, Short, ValueExt as _};

use bridge::Bridge;
use client::Robot;

/// Between two looks whether a robot is back.
const PAUSE: Duration = Duration::from_millis(500);

const HELP: &str = "\
Shows a running robot in Foxglove: open ws://127.0.0.1:8765 there.

  --host ADDRESS     where the robot is [default: 127.0.0.1:4857]
  --token TOKEN      the robot's, to change parameters [default: HULKGEN_TOKEN of the environment]
  --listen ADDRESS   where Foxglove finds the bridge [default: 127.0.0.1:8765]
  --rate HZ          at most so many values of an output in a second [default: 30]
  --quality NUMBER   of images, 1 (small) to 100 (good) [default: 70]
  --help";

/// What the command line says.
pub(crate) struct Options {
    host: String,
    token: Option<String>,
    /// Where Foxglove finds the bridge.
    pub(crate) listen: SocketAddr,
    /// Values of an output in a second.
    pub(crate) rate: f64,
    /// Of JPEG files.
    pub(crate) quality: u8,
}

/// What went wrong, for people.
pub(crate) type Result<T> = std::result::Result<T, String>;

fn main() -> ExitCode {
    let result = read_options().and_then(|options| match options {
        Some(options) => run(&options),
        None => {
            println!("{HELP}");
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

/// Until it is ended: a robot that goes away may come back.
fn run(options: &Options) -> Result<()> {
    let robot = Robot::connect(&options.host, options.token.as_deref())?;
    let mut bridge = Bridge::start(robot, options)?;
    eprintln!(
        "{} is at ws://{}:{}",
        bridge.name(),
        options.listen.ip(),
        bridge.port()
    );
    loop {
        if let Err(message) = bridge.turn() {
            eprintln!("{message}; waiting for it to come back");
            let mut said = String::new();
            bridge.refuse_wishes();
            while let Err(message) = reconnect(&mut bridge, options) {
                // Once, until something else is wrong.
                if said != message {
                    eprintln!("warning: {message}");
                    said = message;
                }
                bridge.refuse_wishes();
                thread::sleep(PAUSE);
            }
            eprintln!("{} is back", bridge.name());
        }
    }
}

fn reconnect(bridge: &mut Bridge<'_>, options: &Options) -> Result<()> {
    bridge.go_on_with(Robot::connect(&options.host, options.token.as_deref())?)
}

/// `None`: somebody wants help.
fn read_options() -> Result<Option<Options>> {
    let mut options = Options {
        host: format!("127.0.0.1:{}", protocol::PORT),
        token: std::env::var("HULKGEN_TOKEN").ok(),
        listen: SocketAddr::from(([127, 0, 0, 1], 8765)),
        rate: 30.0,
        quality: 70,
    };
    let mut arguments = lexopt::Parser::from_env();
    let wrong = |error: lexopt::Error| format!("{error}; see --help");
    while let Some(argument) = arguments.next().map_err(wrong)? {
        match argument {
            Long("host") => {
                options.host = arguments
                    .value()
                    .and_then(|it| it.string())
                    .map_err(wrong)?
            }
            Long("token") => {
                options.token = Some(
                    arguments
                        .value()
                        .and_then(|it| it.string())
                        .map_err(wrong)?,
                )
            }
            Long("listen") => {
                options.listen = arguments.value().and_then(|it| it.parse()).map_err(wrong)?
            }
            Long("rate") => {
                options.rate = arguments.value().and_then(|it| it.parse()).map_err(wrong)?
            }
            Long("quality") => {
                options.quality = arguments.value().and_then(|it| it.parse()).map_err(wrong)?
            }
            Short('h') | Long("help") => return Ok(None),
            other => return Err(wrong(other.unexpected())),
        }
    }
    Ok(Some(options))
}
