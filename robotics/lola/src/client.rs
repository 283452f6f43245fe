//! Owns the robot's end of LoLA's socket: one state in, one command out, every 12 ms.

use std::io::{ErrorKind, Read};
use std::os::unix::net::UnixStream;
use std::path::PathBuf;
use std::sync::{Mutex, MutexGuard, PoisonError, TryLockError};
use std::time::{Duration, Instant};

use framework::timing::blocking;
use framework::{Clock, NoEvent, Result, Stop, Timestamp};
use rustix::event::{PollFd, PollFlags, Timespec, poll};
use types::leds::Leds;
use types::motor_commands::MotorCommands;
use types::sensor_data::SensorData;

use crate::state::{self, STATE_BYTES};

mod counts;
mod sender;

use self::counts::Counters;
pub use self::counts::Counts;
use self::sender::Sender;

/// How long one read may block: a stop is noticed after at most this time.
const PATIENCE: Duration = Duration::from_millis(50);

/// LoLA sends every 12 ms; after so much silence the caller hears about it.
const SILENCE: Duration = Duration::from_secs(1);

/// Between attempts to connect.
const BACK_OFF: Duration = Duration::from_secs(1);

/// After so many rejected states in a row the stream is taken to have lost its place.
const REJECTED_IN_A_ROW: u32 = 3;

/// A connection to LoLA that mends itself. Reading and writing may happen on two threads.
#[derive(Debug)]
pub struct Client {
    path: PathBuf,
    clock: Clock,
    stop: Stop,
    receiver: Mutex<Receiver>,
    sender: Sender,
    counters: Counters,
}

#[derive(Debug)]
struct Receiver {
    stream: Option<UnixStream>,
    next_attempt: Instant,
    bytes: [u8; STATE_BYTES],
    received: usize,
    rejected_in_a_row: u32,
}

impl Client {
    /// A client of the server at `path`; connects as soon as somebody reads.
    ///
    /// A server that is not there is no error: reading tries again every second.
    pub fn connect(path: impl Into<PathBuf>, clock: Clock, stop: Stop) -> Self {
        Self {
            path: path.into(),
            clock,
            stop,
            receiver: Mutex::new(Receiver {
                stream: None,
                next_attempt: Instant::now(),
                bytes: [0; STATE_BYTES],
                received: 0,
                rejected_in_a_row: 0,
            }),
            sender: Sender::default(),
            counters: Counters::default(),
        }
    }

    /// Waits for the next state and says when it arrived.
    ///
    /// # Errors
    /// `Stopped` within 100 ms of a stop. `NoEvent` where the server is not there, closed the
    /// connection, was silent for a second, or sent what is no state: ask again.
    pub fn read_state(&self) -> Result<(Timestamp, SensorData)> {
        let mut receiver = self.lock();
        let begun = Instant::now();
        self.ensure_connected(&mut receiver)?;
        while receiver.received < STATE_BYTES {
            self.stop.check()?;
            self.receive(&mut receiver)?;
            if receiver.received < STATE_BYTES && begun.elapsed() > SILENCE {
                return Err(NoEvent("LoLA is silent".to_owned()).into());
            }
        }
        let arrived = self.clock.now();
        receiver.received = 0;
        match state::decode(&receiver.bytes) {
            Ok(state) => {
                receiver.rejected_in_a_row = 0;
                self.counters.count_state();
                Ok((arrived, state))
            }
            Err(error) => {
                self.counters.count_rejected();
                receiver.rejected_in_a_row += 1;
                if receiver.rejected_in_a_row >= REJECTED_IN_A_ROW {
                    self.disconnect(&mut receiver);
                }
                Err(NoEvent(format!("LoLA sent no state: {error}")).into())
            }
        }
    }

    /// Takes the states that have arrived where nobody wants them, so that they do not pile up: waits for nothing, and leaves
    /// them to whoever reads meanwhile. They are not counted. Connects anew as reading does.
    ///
    /// It goes on behind a stop, for whoever lets the robot down after it.
    pub fn discard_states(&self) {
        let mut receiver = match self.receiver.try_lock() {
            Ok(receiver) => receiver,
            Err(TryLockError::Poisoned(poisoned)) => poisoned.into_inner(),
            Err(TryLockError::WouldBlock) => return,
        };
        if !self.is_connected(&mut receiver) {
            if receiver.next_attempt <= Instant::now() {
                // Tried again with a later call.
                let _ = self.connect_anew(&mut receiver);
            }
            return;
        }
        while receiver.stream.as_ref().is_some_and(has_something) {
            if self.receive(&mut receiver).is_err() {
                return;
            }
            receiver.received %= STATE_BYTES;
        }
    }

    /// Sends one command with a single write. Without connection it is dropped and counted, so that
    /// the next read is what notices a server that went away.
    ///
    /// # Errors
    /// Where an angle, a stiffness, or a colour is infinite or no number: the robot would not survive
    /// guessing.
    pub fn write_command(&self, motors: &MotorCommands, leds: &Leds) -> Result<()> {
        self.sender.send(motors, leds, &self.counters)
    }

    /// What has happened since the start.
    pub fn counts(&self) -> Counts {
        self.counters.counts()
    }

    fn ensure_connected(&self, receiver: &mut Receiver) -> Result<()> {
        if self.is_connected(receiver) {
            return Ok(());
        }
        let left = receiver
            .next_attempt
            .saturating_duration_since(Instant::now());
        blocking(|| self.stop.wait(left))?;
        self.connect_anew(receiver)
    }

    /// Gives a connection up over which nothing could be sent.
    fn is_connected(&self, receiver: &mut Receiver) -> bool {
        if receiver.stream.is_some() && self.sender.is_broken() {
            self.disconnect(receiver);
        }
        receiver.stream.is_some()
    }

    fn connect_anew(&self, receiver: &mut Receiver) -> Result<()> {
        receiver.next_attempt = Instant::now() + BACK_OFF;
        match self.open() {
            Ok(stream) => {
                receiver.stream = Some(stream);
                receiver.received = 0;
                receiver.rejected_in_a_row = 0;
                self.counters.count_connection();
                Ok(())
            }
            Err(error) => {
                let path = self.path.display();
                Err(NoEvent(format!("LoLA at {path} does not answer: {error}")).into())
            }
        }
    }

    fn open(&self) -> std::io::Result<UnixStream> {
        let stream = UnixStream::connect(&self.path)?;
        stream.set_read_timeout(Some(PATIENCE))?;
        self.sender.open(&stream)?;
        Ok(stream)
    }

    /// Takes what has arrived of the next state, waiting for at most [`PATIENCE`].
    fn receive(&self, receiver: &mut Receiver) -> Result<()> {
        let Some(stream) = &mut receiver.stream else {
            return Err(NoEvent("LoLA is not connected".to_owned()).into());
        };
        let rest = &mut receiver.bytes[receiver.received..];
        let reason = match blocking(|| stream.read(rest)) {
            Ok(0) => "it closed the connection".to_owned(),
            Ok(bytes) => {
                receiver.received += bytes;
                return Ok(());
            }
            Err(error) if is_timeout(error.kind()) => return Ok(()),
            Err(error) => error.to_string(),
        };
        self.disconnect(receiver);
        Err(NoEvent(format!("LoLA is gone: {reason}")).into())
    }

    fn disconnect(&self, receiver: &mut Receiver) {
        receiver.stream = None;
        receiver.received = 0;
        receiver.next_attempt = Instant::now() + BACK_OFF;
        self.sender.close();
    }

    fn lock(&self) -> MutexGuard<'_, Receiver> {
        // Nothing in here is left half-changed by a panic.
        self.receiver.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Whether reading would not wait.
fn has_something(stream: &UnixStream) -> bool {
    let mut polled = [PollFd::new(stream, PollFlags::IN)];
    // Where a signal interrupts it, there is a later call.
    poll(&mut polled, Some(&Timespec::default())).is_ok_and(|count| count > 0)
}

fn is_timeout(kind: ErrorKind) -> bool {
    matches!(
        kind,
        ErrorKind::WouldBlock | ErrorKind::TimedOut | ErrorKind::Interrupted
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn readers_look_for_a_stop_more_often_than_every_100_ms() {
        assert!(PATIENCE < Duration::from_millis(100));
    }
}
