//! What is heard and written down.

use framework::Reflect;
use serde::{Deserialize, Serialize};

/// A horn, and how long its echo took.
#[derive(Clone, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
pub struct Echo {
    /// Of the ship.
    pub number: u64,
    /// s.
    pub delay: f32,
}

/// A ship.
#[derive(Clone, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
pub struct Ship {
    /// Counts ships.
    pub number: u64,
    /// m.
    pub distance: f32,
}

/// A line of the book.
#[derive(Clone, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
pub struct Entry {
    /// When the ship was seen, in nanoseconds of the robot's clock.
    pub time: u64,
    /// The ship's.
    pub number: u64,
}
