//! Owns `Side` and `Feet`, one value for each foot.

use framework::{Clear, Reflect};
use serde::{Deserialize, Serialize};

/// Left or right, as the robot sees itself.
#[derive(Clear, Clone, Copy, Debug, Default, Deserialize, Eq, PartialEq, Reflect, Serialize)]
pub enum Side {
    /// The robot's left.
    #[default]
    Left,
    /// The robot's right.
    Right,
}

/// One value for each foot.
#[derive(Clear, Clone, Copy, Debug, Default, Deserialize, Eq, PartialEq, Reflect, Serialize)]
pub struct Feet<T> {
    /// Of the left foot.
    pub left: T,
    /// Of the right foot.
    pub right: T,
}

impl<T> Feet<T> {
    /// The value of one side.
    pub fn on(&self, side: Side) -> &T {
        match side {
            Side::Left => &self.left,
            Side::Right => &self.right,
        }
    }

    /// Both values changed by `change`.
    pub fn map<U>(self, mut change: impl FnMut(T) -> U) -> Feet<U> {
        Feet {
            left: change(self.left),
            right: change(self.right),
        }
    }
}
