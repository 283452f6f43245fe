//! Owns sound: what the microphones heard, what it says about whistles, and what is to be played.

use framework::{Clear, Reflect, Timestamp};
use serde::{Deserialize, Serialize};

/// How many microphones the head has.
pub const MICROPHONE_COUNT: usize = 4;

/// What all microphones heard during a short time.
#[derive(Clear, Clone, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
pub struct AudioBlock {
    /// Samples per second and channel, in Hz.
    pub sample_rate: u32,
    /// The samples of each microphone, oldest first, from -1 to 1; front left, front right, rear left,
    /// rear right.
    pub channels: [Vec<f32>; MICROPHONE_COUNT],
}

/// What one block of sound says about a whistle.
#[derive(Clear, Clone, Copy, Debug, Default, Deserialize, Eq, PartialEq, Reflect, Serialize)]
pub struct WhistleEvidence {
    /// Whether each microphone alone heard one.
    pub is_heard: [bool; MICROPHONE_COUNT],
}

/// The whistle of the referee, from all evidence so far.
#[derive(Clear, Clone, Copy, Debug, Default, Deserialize, Eq, PartialEq, Reflect, Serialize)]
pub struct Whistle {
    /// Whether it can be heard now.
    pub is_heard: bool,
    /// When the last whistle began; `None` before the first.
    pub last_began_at: Option<Timestamp>,
}

/// A tone for the loudspeakers.
#[derive(Clear, Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Tone {
    /// In Hz.
    pub frequency: f32,
    /// In s.
    pub duration: f32,
    /// Amplitude from 0 to 1.
    pub volume: f32,
}
