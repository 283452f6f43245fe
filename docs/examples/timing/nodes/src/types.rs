//! What nodes exchange.

use framework::Reflect;
use serde::{Deserialize, Serialize};

/// What one cycle of perception found out.
#[derive(Clone, Copy, Debug, Default, PartialEq, Deserialize, Reflect, Serialize)]
pub enum Measurement {
    /// Nothing was found.
    #[default]
    Nothing,
    /// So many metres forward since the measurement before.
    Moved(f32),
    /// The camera sees the robot there, metres from the start.
    Seen(f32),
    /// A team mate says that it is there, metres from the start.
    Told(f32),
}

/// What a cycle of Localization was given, by cycler in the order of the manifest, and what it made of it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Deserialize, Reflect, Serialize)]
pub struct Sets {
    /// When that cycle began (t0), seconds of the run.
    pub at: f64,
    /// Given for good: nothing before them can come any more.
    pub persistent: [Span; 3],
    /// Given again until they are persistent.
    pub transient: [Span; 3],
    /// What follows from both: where the robot is at t0, metres from the start.
    pub position: f32,
}

/// Entries of one cycler.
#[derive(Clone, Copy, Debug, Default, PartialEq, Deserialize, Reflect, Serialize)]
pub struct Span {
    /// How many.
    pub count: u32,
    /// When the first was captured, seconds of the run.
    pub first: f64,
    /// When the last was captured, seconds of the run.
    pub last: f64,
}
