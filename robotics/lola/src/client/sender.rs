//! Owns the writing half of a connection, which must never wait for the reading half.

use std::io::Write;
use std::net::Shutdown;
use std::os::unix::net::UnixStream;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use framework::{Error, Result};
use types::leds::{Color, Leds};
use types::motor_commands::MotorCommands;

use super::counts::Counters;
use crate::command::{self, Command};

/// A server that does not take 786 bytes for so long has gone.
const PATIENCE: Duration = Duration::from_millis(50);

#[derive(Debug, Default)]
pub(super) struct Sender {
    outgoing: Mutex<Outgoing>,
    /// A write failed: the reading half must connect anew.
    broken: AtomicBool,
}

#[derive(Debug, Default)]
struct Outgoing {
    stream: Option<UnixStream>,
    bytes: Vec<u8>,
}

impl Sender {
    pub(super) fn open(&self, stream: &UnixStream) -> std::io::Result<()> {
        let stream = stream.try_clone()?;
        stream.set_write_timeout(Some(PATIENCE))?;
        self.lock().stream = Some(stream);
        self.broken.store(false, Ordering::Release);
        Ok(())
    }

    pub(super) fn close(&self) {
        self.lock().stream = None;
    }

    pub(super) fn is_broken(&self) -> bool {
        self.broken.load(Ordering::Acquire)
    }

    pub(super) fn send(
        &self,
        motors: &MotorCommands,
        leds: &Leds,
        counters: &Counters,
    ) -> Result<()> {
        if !is_finite(motors, leds) {
            return Err(Error::new(
                "a command holds a value that is infinite or no number",
            ));
        }
        let outgoing = &mut *self.lock();
        let command = Command {
            motors: *motors,
            leds: *leds,
            sonars: [true, true],
        };
        command::encode(&command, &mut outgoing.bytes);
        if outgoing.write() {
            counters.count_command();
        } else {
            counters.count_lost_command();
            if outgoing.stream.take().is_some() {
                self.broken.store(true, Ordering::Release);
            }
        }
        Ok(())
    }

    fn lock(&self) -> MutexGuard<'_, Outgoing> {
        // Nothing in here is left half-changed by a panic.
        self.outgoing.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Outgoing {
    /// One write takes the whole command, or the server would have to find its place again.
    fn write(&mut self) -> bool {
        let Some(stream) = &mut self.stream else {
            return false;
        };
        let whole = matches!(stream.write(&self.bytes), Ok(bytes) if bytes == self.bytes.len());
        if !whole {
            // Wakes the reading half; a connection that is gone already needs no shutting down.
            let _ = stream.shutdown(Shutdown::Both);
        }
        whole
    }
}

fn is_finite(motors: &MotorCommands, leds: &Leds) -> bool {
    let joints = motors
        .positions
        .each_ref()
        .into_iter()
        .chain(motors.stiffnesses.each_ref());
    let blues = leds
        .left_ear
        .iter()
        .chain(&leds.right_ear)
        .chain(&leds.skull);
    let mut colors = leds.left_eye.iter().chain(&leds.right_eye).chain([
        &leds.chest,
        &leds.left_foot,
        &leds.right_foot,
    ]);
    joints.chain(blues).all(|value| value.is_finite())
        && colors.all(|Color { red, green, blue }| {
            red.is_finite() && green.is_finite() && blue.is_finite()
        })
}
