//! Owns which motions there are.

use framework::Reflect;
use serde::{Deserialize, Serialize};
use types::motion::Script;

use crate::motion::Motion;

/// One motion for every [`Script`].
#[derive(Clone, Debug, Deserialize, PartialEq, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Motions {
    /// From lying on the face.
    pub stand_up_front: Motion,
    /// From lying on the back.
    pub stand_up_back: Motion,
    /// While falling on the face.
    pub fall_forward: Motion,
    /// While falling on the back.
    pub fall_backward: Motion,
    /// While falling on an arm.
    pub fall_sideways: Motion,
    /// With the left foot, straight ahead.
    pub kick_left: Motion,
    /// With the right foot, straight ahead.
    pub kick_right: Motion,
    /// Stops a ball that rolls at the feet.
    pub catch: Motion,
}

impl Motions {
    /// The motion of this script.
    pub fn of(&self, script: Script) -> &Motion {
        match script {
            Script::StandUpFront => &self.stand_up_front,
            Script::StandUpBack => &self.stand_up_back,
            Script::FallForward => &self.fall_forward,
            Script::FallBackward => &self.fall_backward,
            Script::FallSideways => &self.fall_sideways,
            Script::KickLeft => &self.kick_left,
            Script::KickRight => &self.kick_right,
            Script::Catch => &self.catch,
        }
    }
}
