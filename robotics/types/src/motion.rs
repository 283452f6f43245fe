//! Owns what behaviour and clients want body and head to do, which motion has the body, and when it can be left.

use framework::{Clear, Reflect};
use nalgebra::Point2;
use serde::{Deserialize, Serialize};

/// What the robot shall do with itself.
#[derive(Clear, Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
pub struct MotionCommand {
    /// With arms and legs.
    pub body: BodyMotion,
    /// With the head.
    pub head: HeadMotion,
    /// Where to, of a body that walks.
    pub step: Step,
}

/// A motion of arms and legs.
#[derive(Clear, Clone, Copy, Debug, Default, Deserialize, Eq, PartialEq, Reflect, Serialize)]
pub enum BodyMotion {
    /// Limp at once, wherever the body is: nobody who falls waits for anything.
    #[default]
    Unstiff,
    /// Down to the ground, then limp; a limp body stays as it is.
    SitDown,
    /// Ready to play, knees bent.
    Stand,
    /// Tall and still, as a penalised robot must.
    Penalized,
    /// Step by step, as [`MotionCommand::step`] says.
    Walk,
    /// Pose by pose, as the parameter files say.
    Scripted(Script),
}

/// A motion whose poses stand in the parameter files.
#[derive(Clear, Clone, Copy, Debug, Default, Deserialize, Eq, PartialEq, Reflect, Serialize)]
pub enum Script {
    /// From lying on the face.
    #[default]
    StandUpFront,
    /// From lying on the back.
    StandUpBack,
    /// Protects a robot that falls on its face.
    FallForward,
    /// Protects a robot that falls on its back.
    FallBackward,
    /// Protects a robot that falls on an arm.
    FallSideways,
    /// With the left foot, straight ahead.
    KickLeft,
    /// With the right foot, straight ahead.
    KickRight,
    /// Stops a ball that rolls at the feet.
    Catch,
}

impl Script {
    /// Every one of them.
    pub const ALL: [Self; 8] = [
        Self::StandUpFront,
        Self::StandUpBack,
        Self::FallForward,
        Self::FallBackward,
        Self::FallSideways,
        Self::KickLeft,
        Self::KickRight,
        Self::Catch,
    ];

    /// Whether it brings a robot that lies back to its feet.
    pub const fn stands_up(self) -> bool {
        matches!(self, Self::StandUpFront | Self::StandUpBack)
    }

    /// Whether it protects a robot that falls: it begins at once, wherever the body is.
    pub const fn protects(self) -> bool {
        matches!(
            self,
            Self::FallForward | Self::FallBackward | Self::FallSideways
        )
    }
}

/// How far the swing foot comes to stand from where it would stand beside the support foot; the body goes as far.
#[derive(Clear, Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Step {
    /// In m.
    pub forward: f32,
    /// In m; only the foot on that side goes aside, which is every second step.
    pub left: f32,
    /// In rad, positive to the left: of the body, in every step.
    pub turn: f32,
}

impl Step {
    /// Both feet side by side.
    pub const ZERO: Self = Self {
        forward: 0.0,
        left: 0.0,
        turn: 0.0,
    };
}

/// A motion of the head.
#[derive(Clear, Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
pub enum HeadMotion {
    /// With the body, as that one's pose says.
    #[default]
    WithBody,
    /// Straight ahead.
    Ahead,
    /// Wherever something could be.
    LookAround,
    /// At a point on the floor of the ground frame, m.
    LookAt(Point2<f32>),
}

/// Which motion has the body.
#[derive(Clear, Clone, Copy, Debug, Default, Deserialize, Eq, PartialEq, Reflect, Serialize)]
pub struct MotionSelection {
    /// The motion that is carried out, or that the body is on its way to.
    pub current: BodyMotion,
    /// Whether the body is on its way from where it was to where `current` begins.
    pub is_dispatching: bool,
}

impl MotionSelection {
    /// Whether this motion has the body, which is no longer on its way to it.
    pub fn is_at(&self, motion: BodyMotion) -> bool {
        self.current == motion && !self.is_dispatching
    }

    /// Whether the head goes where it is wanted, also while the body is on its way: in upright motions, unless it is wanted with the body.
    pub fn is_head_free(&self, wanted: HeadMotion) -> bool {
        let is_upright = matches!(
            self.current,
            BodyMotion::Stand | BodyMotion::Penalized | BodyMotion::Walk
        );
        is_upright && wanted != HeadMotion::WithBody
    }
}

/// Whether a motion can be left for another one, one value for each motion that has a say in it.
///
/// Poses that are only held can always be left.
#[derive(Clear, Clone, Copy, Debug, Default, Deserialize, Eq, PartialEq, Reflect, Serialize)]
pub struct SafeExits {
    /// Sitting down: only once the body is limp, on the way another motion would make it fall.
    pub sit_down: bool,
    /// Dispatching: only in the pose where a motion begins.
    pub dispatch: bool,
    /// Walking: only with both feet side by side.
    pub walk: bool,
    /// Scripted motions: only at their end.
    pub script: bool,
}

/// What a client asks the body to do.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, PartialEq, Reflect, Serialize)]
pub enum MotionRequest {
    /// What the behaviour says.
    #[default]
    Release,
    /// Ready to play.
    Stand,
    /// Down to the ground, then limp.
    SitDown,
    /// Once with the left foot, straight ahead.
    KickLeft,
    /// Once with the right foot, straight ahead.
    KickRight,
}

/// What a client wants of the body as long as its wish holds.
#[derive(Clear, Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
pub struct ClientWish {
    /// With arms and legs.
    pub body: BodyMotion,
    /// Where to, of a body that walks.
    pub step: Step,
}
