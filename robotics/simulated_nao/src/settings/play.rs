//! How long the parts of a played game take.

use framework::{Error, Result};
use serde::Deserialize;

/// A referee plays a game in place of `schedule`; every key may be left out. Times in s; what is left out is as in the
/// RoboCup SPL rules 2025.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq)]
#[serde(default, deny_unknown_fields)]
pub struct PlaySettings {
    /// Before Ready: robots get up.
    pub initial: f64,
    /// To walk to the own places.
    pub ready: f64,
    /// In Set until the whistle.
    pub set: f64,
    /// A half.
    pub half: f64,
    /// How many halves are played, one or two.
    pub halves: u8,
    /// Between them.
    pub pause: f64,
    /// So much later than the whistle the referee's computer says what it means.
    pub delay: f64,
    /// Until the ball is free after a kick-off.
    pub kick_off: f64,
    /// Until the ball is free after everything else.
    pub free_kick: f64,
    /// A removal; each earlier one of the team adds 10 s.
    pub removal: f64,
    /// How long a robot may lie.
    pub fallen: f64,
    /// Whether robots are removed at all.
    pub penalties: bool,
}

impl Default for PlaySettings {
    fn default() -> Self {
        Self {
            initial: 5.0,
            ready: 45.0,
            set: 5.0,
            half: 600.0,
            halves: 2,
            pause: 600.0,
            delay: 15.0,
            kick_off: 10.0,
            free_kick: 30.0,
            removal: 45.0,
            fallen: 20.0,
            penalties: true,
        }
    }
}

impl PlaySettings {
    /// Refuses times that cannot be.
    pub(super) fn check(&self) -> Result<()> {
        for (key, time) in [
            ("initial", self.initial),
            ("ready", self.ready),
            ("set", self.set),
            ("half", self.half),
            ("pause", self.pause),
            ("delay", self.delay),
            ("kick_off", self.kick_off),
            ("free_kick", self.free_kick),
            ("removal", self.removal),
            ("fallen", self.fallen),
        ] {
            if !(0.0..=3600.0).contains(&time) {
                return Err(Error::new(format!(
                    "hardware.simulated.game.play.{key}: {time} is not from 0 to 3600 s"
                )));
            }
        }
        if !(1..=2).contains(&self.halves) {
            return Err(Error::new(format!(
                "hardware.simulated.game.play.halves: a game has 1 or 2, not {}",
                self.halves
            )));
        }
        Ok(())
    }
}
