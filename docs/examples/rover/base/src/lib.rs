//! The hardware of the target `base`: a rover on the floor, whose motors, encoders and lidar hang on a controller of their own.
//! The controller speaks lines of text over TCP; a bridge from a serial line to a socket is as good. `line.rs` has every line.
//!
//! Nodes do not know: they ask for the same traits as in the simulated room.

mod connection;
mod inbox;
mod line;

use std::sync::Arc;
use std::thread::JoinHandle;

use framework::{Clock, Error, HardwareContext, Result, Stop, Timestamp};
use rover_nodes::interfaces::{Encoders, Lidar, Motors};
use rover_nodes::types::{Rolled, Scan, Speeds};
use serde::Deserialize;

use connection::Connection;
pub use connection::Counts;

/// A rover behind a controller.
pub struct Hardware {
    clock: Clock,
    stop: Stop,
    connection: Arc<Connection>,
    thread: Option<JoinHandle<()>>,
}

/// `[hardware.base]` of the parameter files.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Settings {
    /// Of the controller: `ADDRESS:PORT`.
    address: String,
}

impl Hardware {
    /// What came since the start.
    pub fn counts(&self) -> Counts {
        self.connection.counts()
    }
}

impl framework::Hardware for Hardware {
    /// A controller that is not there is no error: it is looked for, again and again.
    fn new(context: HardwareContext) -> Result<Self> {
        let Settings { address } = context.parameters()?;
        let connection = Arc::new(Connection::new(address, context.clock.clone()));
        let of_thread = connection.clone();
        let thread = std::thread::Builder::new()
            .name("rover_base".to_owned())
            .spawn(move || of_thread.keep())?;
        Ok(Self {
            clock: context.clock,
            stop: context.stop,
            connection,
            thread: Some(thread),
        })
    }

    fn check_parameters(context: &HardwareContext) -> Result<()> {
        context.parameters::<Settings>().map(drop)
    }

    fn stop(&self) {
        self.stop.request();
    }

    fn enter_safe_state(&self) {
        self.connection.set_safe(true);
    }

    fn rearm(&self) {
        self.connection.set_safe(false);
    }
}

impl Drop for Hardware {
    fn drop(&mut self) {
        self.connection.end();
        if let Some(thread) = self.thread.take() {
            // It would have told of a panic itself.
            let _ = thread.join();
        }
    }
}

impl Lidar for Hardware {
    fn read_scan(&self, scan: &mut Scan) -> Result<Timestamp> {
        let (at, ranges) = self.connection.inbox.wait_for_scan(&self.stop)?;
        scan.ranges.extend(ranges);
        Ok(at)
    }
}

impl Encoders for Hardware {
    fn read_wheels(&self) -> Result<(Timestamp, Rolled)> {
        self.connection.inbox.wait_for_wheels(&self.stop)
    }
}

impl Motors for Hardware {
    fn write_speeds(&self, Speeds { forward, turn }: Speeds) -> Result<()> {
        if !forward.is_finite() || !turn.is_finite() {
            let now = self.clock.now().as_nanos();
            return Err(Error::new(format!(
                "{forward} m/s and {turn} rad/s at {now} ns are no speeds"
            )));
        }
        self.connection.command(&line::drive(forward, turn));
        Ok(())
    }
}
