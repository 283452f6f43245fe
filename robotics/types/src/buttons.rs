//! Owns what people ask with the robot's buttons.

use framework::{Clear, Reflect};
use serde::{Deserialize, Serialize};

use crate::feet::Feet;

/// What the buttons say, bouncing removed.
#[derive(Clear, Clone, Copy, Debug, Default, Deserialize, Eq, PartialEq, Reflect, Serialize)]
pub struct Buttons {
    /// In the one cycle in which a press of the chest button begins.
    pub is_chest_pressed: bool,
    /// While all three plates of the head have been held long enough.
    pub is_head_held: bool,
    /// While something pushes against the front of a foot.
    pub bumpers: Feet<bool>,
}
