//! Owns the numbers that the behaviour decides by.

use framework::Reflect;
use serde::{Deserialize, Serialize};

/// Everything that can be tuned about what the robot does.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct BehaviorParameters {
    /// How to get to a place.
    pub walk: WalkParameters,
    /// How to play the ball.
    pub attack: AttackParameters,
    /// How to look for the ball.
    pub search: SearchParameters,
    /// Where to stand.
    pub places: PlaceParameters,
    /// How to guard the goal.
    pub keeper: KeeperParameters,
    /// When to give up where the robot gets nowhere.
    pub recovery: RecoveryParameters,
}

/// How to get to a place.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct WalkParameters {
    /// The longest step ahead and back.
    #[reflect(unit = "m", range = 0.0..)]
    pub forward: f32,
    /// The longest step to a side.
    #[reflect(unit = "m", range = 0.0..)]
    pub left: f32,
    /// The greatest turn of a step.
    #[reflect(unit = "rad", range = 0.0..)]
    pub turn: f32,
    /// What lies further aside is turned to before anything else.
    #[reflect(unit = "rad", range = 0.0..)]
    pub ahead: f32,
    /// From here on the robot takes its last heading, and goes in all directions.
    #[reflect(unit = "m", range = 0.0..)]
    pub near: f32,
    /// Likewise, where it has to keep its eyes on the ball.
    #[reflect(unit = "m", range = 0.0..)]
    pub near_with_ball: f32,
    /// A place that is nearer has been reached.
    #[reflect(unit = "m", range = 0.0..)]
    pub arrived: f32,
    /// A heading that is less off has been reached.
    #[reflect(unit = "rad", range = 0.0..)]
    pub turned: f32,
    /// As far from its place, in multiples of `arrived` and `turned`, a robot that stands goes on.
    pub depart: f32,
    /// How far from the edge of an obstacle the middle of the robot passes.
    #[reflect(unit = "m", range = 0.0..)]
    pub clearance: f32,
    /// Likewise in Ready, where nobody is in a hurry.
    #[reflect(unit = "m", range = 0.0..)]
    pub clearance_in_ready: f32,
    /// Who has come so near to whom it would not pass nearer, and who stands in its place, stops.
    #[reflect(unit = "m", range = 0.0..)]
    pub beside_occupied: f32,
    /// Around how many obstacles after each other a way goes; behind them it is thought to be free. One more doubles the work.
    #[reflect(range = 0..=6)]
    pub detours: u32,
    /// As many radii a way point lies from the middle of what it leads around, so that the next way is free of it.
    #[reflect(range = 1.0..)]
    pub detour_radii: f32,
    /// As much longer counts a way through a point that another obstacle takes, or that is closed.
    #[reflect(unit = "m", range = 0.0..)]
    pub taken: f32,
}

/// How to play the ball.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct AttackParameters {
    /// How far behind the ball's centre the robot begins to dribble.
    #[reflect(unit = "m", range = 0.0..)]
    pub behind: f32,
    /// How far from the ball's centre the robot passes on its way to the other side of it.
    #[reflect(unit = "m", range = 0.0..)]
    pub clearance: f32,
    /// From here on the robot may begin to dribble.
    #[reflect(unit = "m", range = 0.0..)]
    pub reach: f32,
    /// So far from the line through ball and goal the robot may be that begins to dribble.
    #[reflect(unit = "m", range = 0.0..)]
    pub aside: f32,
    /// So far off the aim it may head.
    #[reflect(unit = "rad", range = 0.0..)]
    pub off_aim: f32,
    /// A robot that dribbles goes on until it is so many times further off.
    pub patience: f32,
    /// The step of a robot that pushes the ball.
    #[reflect(unit = "m", range = 0.0..)]
    pub push: f32,
    /// A ball on the own goal line is pushed along it, and so far into the field, past the post.
    #[reflect(unit = "rad", range = 0.0..)]
    pub along_line: f32,
    /// So far from the posts the aim stays.
    #[reflect(unit = "m", range = 0.0..)]
    pub post_margin: f32,
    /// A penalty kick goes past a keeper, so far from the middle of the goal.
    #[reflect(unit = "m", range = 0.0..)]
    pub corner: f32,
    /// And to the other side once the keeper stands so far on the one that was chosen.
    #[reflect(unit = "m", range = 0.0..)]
    pub corner_taken: f32,
    /// Whoever stands farther behind the goal line is no keeper.
    #[reflect(unit = "m", range = 0.0..)]
    pub keeper_behind_line: f32,
    /// A ball that lies farther from where the robot began to play it was shot, in a shoot-out.
    #[reflect(unit = "m", range = 0.0..)]
    pub shot: f32,
    /// If it is seen there for so long.
    #[reflect(unit = "s", range = 0.0..)]
    pub shot_for: f32,
    /// Who has kicked for so long and sees no ball has shot it.
    #[reflect(unit = "s", range = 0.0..)]
    pub kick_duration: f32,
    /// A goal that opens less is not aimed at.
    #[reflect(unit = "rad", range = 0.0..)]
    pub least_opening: f32,
    /// A ball on the own goal line that is nearer to the goal's middle is pushed to the side to which the robot has turned.
    #[reflect(unit = "m", range = 0.0..)]
    pub goal_middle: f32,
    /// Who faces less to one side, as the sine says, has not turned to it.
    #[reflect(range = 0.0..=1.0)]
    pub turned_aside: f32,
    /// A goal that is nearer is kicked at, another one is dribbled to.
    #[reflect(unit = "m", range = 0.0..)]
    pub kick_range: f32,
    /// How far ahead of the ground frame's origin the ball lies for a kick.
    #[reflect(unit = "m", range = 0.0..)]
    pub kick_ahead: f32,
    /// How far aside, for the foot on that side.
    #[reflect(unit = "m", range = 0.0..)]
    pub kick_aside: f32,
    /// How far off along the aim it may lie.
    #[reflect(unit = "m", range = 0.0..)]
    pub kick_ahead_tolerance: f32,
    /// How far off across the aim.
    #[reflect(unit = "m", range = 0.0..)]
    pub kick_aside_tolerance: f32,
    /// How far off the aim a kick may go.
    #[reflect(unit = "rad", range = 0.0..)]
    pub kick_tolerance: f32,
}

/// How to look for the ball.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct SearchParameters {
    /// So long only the head searches.
    #[reflect(unit = "s", range = 0.0..)]
    pub with_head: f32,
    /// So long the robot then turns on the spot.
    #[reflect(unit = "s", range = 0.0..)]
    pub turning: f32,
    /// So long it then walks to the place of its role, before it begins again.
    #[reflect(unit = "s", range = 0.0..)]
    pub walking: f32,
    /// The turn of a step.
    #[reflect(unit = "rad", range = 0.0..)]
    pub turn: f32,
}

/// Where to stand. The field's measures are those of the RoboCup SPL rules 2025.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct PlaceParameters {
    /// From the centre mark to a goal line.
    #[reflect(unit = "m", range = 0.0..)]
    pub goal_line: f32,
    /// From the centre mark to a touch line.
    #[reflect(unit = "m", range = 0.0..)]
    pub touch_line: f32,
    /// From the middle of the goal to a post.
    #[reflect(unit = "m", range = 0.0..)]
    pub post: f32,
    /// From a goal line to the front of the goal area.
    #[reflect(unit = "m", range = 0.0..)]
    pub goal_area_length: f32,
    /// From a goal line to the front of the penalty area.
    #[reflect(unit = "m", range = 0.0..)]
    pub penalty_area_length: f32,
    /// From the middle of the field to a side of the penalty area.
    #[reflect(unit = "m", range = 0.0..)]
    pub penalty_area_side: f32,
    /// From a goal line to the penalty mark.
    #[reflect(unit = "m", range = 0.0..)]
    pub penalty_mark: f32,
    /// From the centre mark, where the striker waits whose team kicks off.
    #[reflect(unit = "m", range = 0.0..)]
    pub kick_off: f32,
    /// From the centre mark, where it waits when the others kick off: outside of the circle.
    #[reflect(unit = "m", range = 0.0..)]
    pub other_kick_off: f32,
    /// So far from the goal defenders stand.
    #[reflect(unit = "m", range = 0.0..)]
    pub defender_ring: f32,
    /// So far beside the line from goal to ball.
    #[reflect(unit = "m", range = 0.0..)]
    pub defender_aside: f32,
    /// But no farther from the goal than this share of the ball's distance from it.
    #[reflect(range = 0.0..=1.0)]
    pub defender_share: f32,
    /// So far from the goal who stands in for the keeper stays.
    #[reflect(unit = "m", range = 0.0..)]
    pub sweeper_ring: f32,
    /// So far behind the ball the supporter stays.
    #[reflect(unit = "m", range = 0.0..)]
    pub supporter_behind: f32,
    /// And so far to the side of it on which more of the field is.
    #[reflect(unit = "m", range = 0.0..)]
    pub supporter_aside: f32,
    /// So far from the ball while it is the other team's: more than the rules' 0.75 m.
    #[reflect(unit = "m", range = 0.0..)]
    pub distance_to_free_kick: f32,
    /// While the ball is nearer to the own goal, the way between both is the keeper's: who waits for it stands aside.
    #[reflect(unit = "m", range = 0.0..)]
    pub keepers_way: f32,
    /// So far aside of that way, seen from the ball.
    #[reflect(unit = "rad", range = 0.0..)]
    pub beside_keeper: f32,
    /// After their kick-off so long, or until the ball has left the centre mark.
    #[reflect(unit = "s", range = 0.0..)]
    pub kick_off_duration: f32,
    /// What is farther from the centre mark has been kicked off.
    #[reflect(unit = "m", range = 0.0..)]
    pub kicked_off: f32,
    /// Of a post.
    #[reflect(unit = "m", range = 0.0..)]
    pub post_radius: f32,
    /// So far before a goal line the robot stays near the posts: behind it the net holds its feet.
    #[reflect(unit = "m", range = 0.0..)]
    pub before_goal: f32,
    /// So far beside a goal, and so far from a post between both, there is room for a robot.
    #[reflect(unit = "m", range = 0.0..)]
    pub beside_goal: f32,
    /// So far outside of the lines a way may lead: there the carpet ends.
    #[reflect(unit = "m", range = 0.0..)]
    pub off_the_field: f32,
    /// So far outside of a line that must not be crossed the robot stays.
    #[reflect(unit = "m", range = 0.0..)]
    pub margin: f32,
}

/// How to guard the goal.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct KeeperParameters {
    /// So far from the middle of the goal, towards the ball.
    #[reflect(unit = "m", range = 0.0..)]
    pub radius: f32,
    /// Never nearer to the goal line.
    #[reflect(unit = "m", range = 0.0..)]
    pub before_line: f32,
    /// A ball that is nearer to the goal's middle is played away.
    #[reflect(unit = "m", range = 0.0..)]
    pub clears: f32,
    /// Who has begun to does so up to so many times as far; as many times nearer it has to be that a striker leaves it alone.
    #[reflect(range = 1.0..)]
    pub patience: f32,
    /// A ball that comes faster is stepped into the way of.
    #[reflect(unit = "m/s", range = 0.0..)]
    pub fast: f32,
    /// If it gets there within this time.
    #[reflect(unit = "s", range = 0.0..)]
    pub soon: f32,
    /// A ball that passes nearer is hit anyway.
    #[reflect(unit = "m", range = 0.0..)]
    pub covered: f32,
    /// The robot catches a ball that needs longer to get there.
    #[reflect(unit = "s", range = 0.0..)]
    pub catch_after: f32,
    /// And no longer than this.
    #[reflect(unit = "s", range = 0.0..)]
    pub catch_before: f32,
    /// If it passes nearer.
    #[reflect(unit = "m", range = 0.0..)]
    pub catch_aside: f32,
    /// If it comes faster: a slower one comes to rest before.
    #[reflect(unit = "m/s", range = 0.0..)]
    pub catch_fast: f32,
    /// And stands so long before that: a walk ends with both feet side by side.
    #[reflect(unit = "s", range = 0.0..)]
    pub halt: f32,
}

/// When to give up where the robot gets nowhere.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct RecoveryParameters {
    /// So long a robot may walk or kick and get nowhere before it backs off.
    #[reflect(unit = "s", range = 0.0..)]
    pub after: f32,
    /// So long it then walks away at most. Who lay beside somebody and knows its place no sooner than that after it is up does not.
    #[reflect(unit = "s", range = 0.0..)]
    pub duration: f32,
    /// So long whoever has got away from somebody leaves a ball in the others' half to them.
    #[reflect(unit = "s", range = 0.0..)]
    pub gives_way: f32,
    /// Who has got farther has got somewhere.
    #[reflect(unit = "m", range = 0.0..)]
    pub distance: f32,
    /// Likewise, who has turned further, unless it walks away: whoever holds it turns it.
    #[reflect(unit = "rad", range = 0.0..)]
    pub turned: f32,
    /// What is nearer it walks away from; where nothing is, it walks back.
    #[reflect(unit = "m", range = 0.0..)]
    pub near: f32,
    /// A team mate that lies, by its own word no farther away, may be what is near.
    #[reflect(unit = "m", range = 0.0..)]
    pub mate: f32,
    /// Who made room for a mate does not come nearer than so much farther away.
    #[reflect(unit = "m", range = 0.0..)]
    pub room: f32,
    /// Who has not walked for longer waits; who dithers between both does not.
    #[reflect(unit = "s", range = 0.0..)]
    pub waits: f32,
}
