//! When somebody presses the robot's buttons.

use framework::{Error, Result};
use serde::Deserialize;

/// One press.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct Press {
    /// When it begins, s since the start.
    pub at: f64,
    /// What is pressed.
    pub button: Button,
    /// How long, s.
    #[serde(default = "usual_duration")]
    pub lasts: f64,
}

/// What can be pressed.
#[derive(Clone, Copy, Debug, Deserialize, Eq, PartialEq)]
#[serde(rename_all = "snake_case")]
pub enum Button {
    /// The button on the chest.
    Chest,
    /// All three plates of the head.
    Head,
    /// Both bumpers of the left foot.
    LeftBumper,
    /// Both bumpers of the right foot.
    RightBumper,
}

impl Press {
    /// Wakes the limp robot, also where a busy machine starts its Control late.
    pub(super) fn usual() -> Vec<Self> {
        vec![Self {
            at: 0.5,
            button: Button::Chest,
            lasts: 2.0,
        }]
    }

    /// Whether the button is down so many seconds after the start.
    pub(crate) fn is_down(&self, seconds: f64) -> bool {
        (self.at..self.at + self.lasts).contains(&seconds)
    }

    pub(crate) fn check(&self) -> Result<()> {
        let is_possible = self.at.is_finite() && self.lasts.is_finite();
        if is_possible && self.at >= 0.0 && self.lasts > 0.0 {
            return Ok(());
        }
        let Self { at, button, lasts } = self;
        Err(Error::new(format!(
            "hardware.simulated.buttons: nobody can press {button:?} at {at} s for {lasts} s"
        )))
    }
}

fn usual_duration() -> f64 {
    0.2
}
