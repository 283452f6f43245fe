//! What goes wrong around the robot, in an order that the seed decides.

use std::net::SocketAddr;
use std::thread::sleep;
use std::time::{Duration, Instant};

use protocol::Ask;
use serde_json::json;

use crate::Result;
use crate::clients::connect;
use crate::programs::{Robot, Simulator};

/// The output whose reader fails: no loudspeaker plays an infinite pitch.
const TONE: &str = "Control.main_outputs.tone";

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Deed {
    /// A node fails in every cycle for a while.
    FailingNode,
    /// Nothing more can be written for a while.
    FullDisk,
    /// The body, the cameras and the microphones are gone for a while.
    KilledSimulator,
    /// Nothing happens.
    Rest,
}

const ALL: [Deed; 4] = [
    Deed::FailingNode,
    Deed::FullDisk,
    Deed::KilledSimulator,
    Deed::Rest,
];

/// How often each was done.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Done {
    pub(crate) failing_nodes: u64,
    pub(crate) full_disks: u64,
    pub(crate) killed_simulators: u64,
    /// The time that the robot had a body.
    pub(crate) with_body: Duration,
}

/// What comes next.
pub(crate) struct Deeds {
    random: fastrand::Rng,
    simulator: Simulator,
    address: SocketAddr,
    /// Of this round: each comes once.
    left: Vec<Deed>,
    done: Done,
    body_since: Instant,
}

impl Deeds {
    pub(crate) fn new(seed: u64, simulator: Simulator, address: SocketAddr) -> Self {
        Self {
            random: fastrand::Rng::with_seed(seed),
            simulator,
            address,
            left: Vec::new(),
            done: Done::default(),
            body_since: Instant::now(),
        }
    }

    pub(crate) fn done(&self) -> Done {
        self.done
    }

    /// Lets something go wrong, and everything be well for a moment afterwards; never beyond `end`.
    pub(crate) fn next(&mut self, robot: &Robot, end: Instant) -> Result<()> {
        if self.left.is_empty() {
            self.left = ALL.to_vec();
            self.random.shuffle(&mut self.left);
        }
        let deed = self.left.pop().unwrap_or(Deed::Rest);
        let until = |most: Duration| most.min(end.saturating_duration_since(Instant::now()));
        let trouble = Duration::from_millis(self.random.u64(300..2000));
        let peace = Duration::from_millis(self.random.u64(500..2000));
        match deed {
            Deed::FailingNode => {
                // The robot takes it back as soon as this client is gone.
                let mut client = connect(self.address)?;
                let value = json!({ "frequency": 1e39, "duration": 1.0, "volume": 0.1 });
                let path = TONE.to_owned();
                client.ask(Ask::Inject { path, value })?;
                self.done.failing_nodes += 1;
                sleep(until(trouble));
            }
            Deed::FullDisk => {
                robot.fill_disk(true)?;
                self.done.full_disks += 1;
                sleep(until(trouble));
                robot.fill_disk(false)?;
            }
            Deed::KilledSimulator => {
                self.done.with_body += self.body_since.elapsed();
                self.simulator.kill();
                self.done.killed_simulators += 1;
                sleep(until(trouble));
                self.simulator.restart()?;
                self.body_since = Instant::now();
            }
            Deed::Rest => sleep(until(trouble)),
        }
        sleep(until(peace));
        Ok(())
    }

    /// Whatever happened, the robot ends with a disk.
    pub(crate) fn mend(&mut self, robot: &Robot) {
        self.done.with_body += self.body_since.elapsed();
        // Where it fails, the report tells what was not written.
        let _ = robot.fill_disk(false);
    }
}
