//! Owns the colours of the robot's lights.
//!
//! Order of the lights as in the Aldebaran documentation of the NAO V6.

use framework::{Clear, Reflect};
use serde::{Deserialize, Serialize};

/// Colours of all lights.
#[derive(Clear, Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
pub struct Leds {
    /// Segments at 45°, 0°, 315°, 270°, 225°, 180°, 135°, 90°.
    pub left_eye: [Color; 8],
    /// Segments at 0°, 45°, 90°, 135°, 180°, 225°, 270°, 315°.
    pub right_eye: [Color; 8],
    /// Blue, 0 to 1, at 0°, 36°, …, 324°.
    pub left_ear: [f32; 10],
    /// Blue, 0 to 1, at 324°, 288°, …, 0°.
    pub right_ear: [f32; 10],
    /// Blue, 0 to 1, around the head from front left over the rear to front right.
    pub skull: [f32; 12],
    /// The button on the chest.
    pub chest: Color,
    /// The left foot.
    pub left_foot: Color,
    /// The right foot.
    pub right_foot: Color,
}

/// A colour with components from 0 (dark) to 1.
#[derive(Clear, Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Color {
    /// Red.
    pub red: f32,
    /// Green.
    pub green: f32,
    /// Blue.
    pub blue: f32,
}

/// The chest in every state of the game.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
#[expect(missing_docs, reason = "the states of the game say it")]
pub struct ChestColors {
    pub unstiff: Color,
    pub initial: Color,
    pub standby: Color,
    pub ready: Color,
    pub set: Color,
    pub playing: Color,
    pub penalized: Color,
    pub finished: Color,
}

impl Color {
    /// No light.
    pub const OFF: Self = Self::new(0.0, 0.0, 0.0);

    /// From components between 0 and 1.
    pub const fn new(red: f32, green: f32, blue: f32) -> Self {
        Self { red, green, blue }
    }
}
