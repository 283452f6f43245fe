//! The ankles of the support leg against the turning of the body.

use framework::Reflect;
use serde::{Deserialize, Serialize};

use crate::parameters::BalanceParameters;

/// Corrections of the support foot's ankle, in rad.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
pub struct Balance {
    pub pitch: f32,
    pub roll: f32,
    /// Low-passed, in rad/s, about x and y.
    filtered: [f32; 2],
}

impl Balance {
    /// Goes on by one cycle of so many seconds, with the body's angular velocity about x and y in rad/s.
    pub fn cycle(&mut self, velocity: [f32; 2], since_last: f32, parameters: &BalanceParameters) {
        for (filtered, velocity) in self.filtered.iter_mut().zip(velocity) {
            if velocity.is_finite() {
                *filtered += parameters.newest * (velocity - *filtered);
            }
        }
        let most = (parameters.greatest_speed * since_last).max(0.0);
        let towards = |from: f32, to: f32| from + (to - from).clamp(-most, most);
        let [about_x, about_y] = self.filtered;
        // A body that falls forward turns the toes down, which pushes it back.
        self.pitch = towards(self.pitch, parameters.pitch_gain * about_y);
        self.roll = towards(self.roll, parameters.roll_gain * about_x);
    }
}
