//! Owns what a robot is for its team, and what it is doing for which reason.

use framework::{Clear, Reflect};
use nalgebra::{Isometry2, Point2};
use serde::{Deserialize, Serialize};

/// What a robot is for its team.
#[derive(Clear, Clone, Copy, Debug, Default, Deserialize, Eq, PartialEq, Reflect, Serialize)]
pub enum Role {
    /// Plays the ball.
    #[default]
    Striker,
    /// Guards the goal.
    Keeper,
    /// Waits beside the striker for a ball that it loses.
    Supporter,
    /// Stands between the ball and the left half of the own goal.
    DefenderLeft,
    /// Stands between the ball and the right half of the own goal.
    DefenderRight,
    /// Stands between ball and goal while the keeper is out.
    Sweeper,
}

/// What a robot is doing: every decision of the behaviour has its own name.
#[derive(Clear, Clone, Copy, Debug, Default, Deserialize, Eq, PartialEq, Reflect, Serialize)]
pub enum Activity {
    /// Sits, as nobody has woken it.
    #[default]
    SitLimp,
    /// Protects itself, as it falls.
    Protect,
    /// Lies and must not move, or cannot.
    Lie,
    /// Gets up.
    GetUp,
    /// Stands before the game, and in Standby.
    WaitForGame,
    /// Walks to its place for the kick-off.
    WalkToPlace,
    /// Has reached that, or does not know where it is.
    WaitInReady,
    /// Stands in Set until the whistle.
    WaitForWhistle,
    /// Stands still, as the referee has taken it out.
    ServePenalty,
    /// Stands after the game.
    AfterGame,
    /// Does what a client wants.
    FollowClient,
    /// Looks for the ball with its head.
    SearchWithHead,
    /// Looks for the ball by turning on the spot.
    SearchByTurning,
    /// Turns to where a team mate sees the ball.
    LookWhereTeamSees,
    /// Walks to a ball, but does not know where the goals are.
    WalkToBall,
    /// Walks to the place behind the ball from which the goal is in front.
    WalkBehindBall,
    /// Pushes the ball ahead while it walks.
    Dribble,
    /// Takes the last short steps before a kick.
    Align,
    /// Kicks.
    Kick,
    /// Stays away from a ball that is the other team's for now, or the own keeper's.
    KeepDistance,
    /// Stays outside of the penalty area while a penalty kick is taken.
    LeavePenaltyArea,
    /// Walks with the game at the place of its role.
    HoldPosition,
    /// Stands between ball and goal.
    GuardGoal,
    /// Steps into the way of a ball that rolls to the goal, or stands before it catches one.
    Block,
    /// Squats with its feet apart before a ball that comes to them.
    Catch,
    /// Walks away from where it got nowhere; in the others' half it stands then, and leaves the ball to them for a while.
    BackOff,
    /// Stands after its shot in a penalty shoot-out: it may not play the ball again.
    WatchShot,
}

impl Activity {
    /// Whether it is about playing the ball.
    pub const fn plays_ball(self) -> bool {
        matches!(
            self,
            Self::WalkBehindBall | Self::Dribble | Self::Align | Self::Kick
        )
    }
}

/// Where the behaviour wants to get, for those who want to see it; ground frame, m and rad.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
pub struct Plan {
    /// The pose that the robot walks to, if it walks.
    pub target: Option<Isometry2<f32>>,
    /// Where it goes first, around what stands in the way.
    pub way_point: Option<Point2<f32>>,
    /// The direction in which the ball shall go, rad.
    pub aim: Option<f32>,
}
