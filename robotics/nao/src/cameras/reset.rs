//! The lines that switch the cameras off and on: two pins of a port expander on the head's bus.
//!
//! Register 1 of the expander at 0x41 has the levels of its pins, register 3 which of them are inputs. Pin 2 lets the top
//! camera run, pin 3 the bottom one.

use std::fs::{File, OpenOptions};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use std::time::Duration;

use framework::{Error, Result, Stop};
use types::camera::CameraPosition;

use crate::kernel::{read_register, write_register};

const EXPANDER: u8 = 0x41;
const LEVELS: u8 = 0x01;
const INPUTS: u8 = 0x03;
/// Both cameras run.
const ALL: u8 = 0x0c;
/// Pins 2 and 3 are outputs, all others inputs.
const ONLY_CAMERAS_ARE_OUTPUTS: u8 = 0xf3;

/// How often the device is looked for.
const GLANCE: Duration = Duration::from_millis(50);
/// How long it may take to go: 1 s.
const GLANCES_UNTIL_GONE: u32 = 20;
/// How long it may take to come back: 2 s.
const GLANCES_UNTIL_BACK: u32 = 40;

/// The lines of both cameras.
pub(super) struct ResetLines {
    /// One camera at a time: both lines are in one register.
    bus: Mutex<PathBuf>,
}

impl ResetLines {
    pub(super) fn new(bus: PathBuf) -> Self {
        Self {
            bus: Mutex::new(bus),
        }
    }

    /// Switches a camera off, and on again once its device has gone; returns when that is back or does not come back in time.
    ///
    /// # Errors
    /// `Stopped` soon after a stop; names the bus that cannot be used.
    pub(super) fn reset(&self, position: CameraPosition, device: &Path, stop: &Stop) -> Result<()> {
        let path = self.bus.lock().unwrap_or_else(PoisonError::into_inner);
        let told = |error: std::io::Error| {
            Error::from(error).context(format!("cannot use the bus {}", path.display()))
        };
        let open = OpenOptions::new().read(true).write(true).open(&*path);
        let bus = open.map_err(told)?;
        let inputs = read_register(&bus, EXPANDER, INPUTS).map_err(told)?;
        if inputs & ALL != 0 {
            set(&bus, LEVELS, 0).map_err(told)?;
            set(&bus, INPUTS, ONLY_CAMERAS_ARE_OUTPUTS).map_err(told)?;
        }
        set(&bus, LEVELS, levels_without(position)).map_err(told)?;
        let gone = wait_until(device, false, GLANCES_UNTIL_GONE, stop);
        // Also before a stop: a camera that stays off is missing at the next start.
        set(&bus, LEVELS, ALL).map_err(told)?;
        gone?;
        wait_until(device, true, GLANCES_UNTIL_BACK, stop)
    }
}

fn set(bus: &File, register: u8, value: u8) -> std::io::Result<()> {
    write_register(bus, EXPANDER, register, value)
}

/// The levels that let the other camera run alone.
fn levels_without(position: CameraPosition) -> u8 {
    match position {
        CameraPosition::Top => 0x08,
        CameraPosition::Bottom => 0x04,
    }
}

fn wait_until(device: &Path, is_there: bool, glances: u32, stop: &Stop) -> Result<()> {
    for _ in 0..glances {
        if device.exists() == is_there {
            break;
        }
        stop.wait(GLANCE)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_camera_is_switched_off_alone() {
        let off = |position| levels_without(position) ^ ALL;
        assert_eq!(off(CameraPosition::Top), 1 << 2);
        assert_eq!(off(CameraPosition::Bottom), 1 << 3);
    }

    #[test]
    fn waiting_for_a_device_ends_with_a_stop() {
        let stop = Stop::new();
        stop.request();
        let waited = wait_until(Path::new("/dev/no-such-camera"), true, 1000, &stop);
        assert!(waited.unwrap_err().is_stopped());
        assert!(GLANCE < Duration::from_millis(100));
        assert!(wait_until(Path::new("/dev/null"), true, 1, &stop).is_ok());
    }
}
