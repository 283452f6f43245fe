//! The machine that runs a lookout of the outpost (tests/robots/outpost): looks out some times, and feeds the robot with the
//! ships that it sees.
//!
//! `lookout ENDPOINT KEY TIMES`, for example `lookout tcp/127.0.0.1:7447 outpost/north 100`. Ends with 0 if the robot took
//! everything.

use std::error::Error;
use std::process::ExitCode;
use std::thread::sleep;
use std::time::{Duration, SystemTime};

use hulkgen_zenoh::{Counts, Robot};
use serde::Serialize;

/// The cycler's main outputs.
#[derive(Serialize)]
struct Outputs {
    ship: Ship,
}

/// As the robot's nodes have it.
#[derive(Serialize)]
struct Ship {
    number: u64,
    /// m.
    distance: f32,
}

/// A picture of the sea.
struct Picture {
    taken: SystemTime,
    number: u64,
}

impl Picture {
    /// Waits for the next one.
    fn take(number: u64) -> Self {
        let taken = SystemTime::now();
        // It takes a while to get here.
        sleep(Duration::from_millis(5));
        Self { taken, number }
    }

    /// What takes so long that it has a machine of its own. Every fifth picture is too dark.
    fn ship(&self) -> Option<Ship> {
        sleep(Duration::from_millis(15));
        (self.number % 5 != 4).then_some(Ship {
            number: self.number,
            distance: 120.5,
        })
    }
}

fn main() -> ExitCode {
    match run() {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn run() -> Result<bool, Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [endpoint, key, times] = arguments.as_slice() else {
        return Err("expected ENDPOINT KEY TIMES".into());
    };
    let times: u64 = times.parse()?;
    let robot = Robot::connect(endpoint, "")?;
    let mut lookout = robot.feeder(key)?;
    while !lookout.is_heard() {
        sleep(Duration::from_millis(50));
    }
    for number in 0..times {
        let picture = Picture::take(number);
        let cycle = lookout.announce(picture.taken)?;
        // Where an error left this function the cycle would be abandoned as well.
        match picture.ship() {
            Some(ship) => cycle.complete(&Outputs { ship })?,
            None => cycle.abandon(),
        }
        for refusal in lookout.refusals() {
            eprintln!("warning: {refusal}");
        }
    }
    lookout.settle(Duration::from_secs(10));
    let Counts {
        accepted,
        refused,
        unanswered,
        awaited,
    } = lookout.counts();
    println!("{accepted} accepted, {refused} refused, {unanswered} unanswered");
    Ok(refused + unanswered + awaited == 0)
}
