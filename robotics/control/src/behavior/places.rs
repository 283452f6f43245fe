//! Owns where robots stand and where the ball shall go, in the field frame: the opponents' goal lies at positive x.

use std::f32::consts::FRAC_PI_2;

use framework::math;
use nalgebra::{Isometry2, Point2, Vector2};
use types::behavior::Role;
use types::game::{KickingTeam, SetPlay};

use super::parameters::{AttackParameters, KeeperParameters, PlaceParameters};
use super::way::Circle;

impl PlaceParameters {
    /// The middle of the own goal, m.
    pub(super) fn own_goal(&self) -> Point2<f32> {
        Point2::new(-self.goal_line, 0.0)
    }

    /// In Ready: where a robot waits for the kick-off or the penalty kick.
    pub(super) fn before_kick(
        &self,
        role: Role,
        kicking_team: KickingTeam,
        set_play: SetPlay,
        keeper: &KeeperParameters,
    ) -> Isometry2<f32> {
        let is_own = kicking_team == KickingTeam::Own;
        let is_penalty_kick = set_play == SetPlay::PenaltyKick;
        let defender = self.goal_line - self.defender_ring;
        let (x, y) = match role {
            // Its feet on both sides of the line.
            Role::Keeper if is_penalty_kick && !is_own => (-self.goal_line, 0.0),
            Role::Keeper => (keeper.before_line - self.goal_line, 0.0),
            Role::Striker if is_penalty_kick && is_own => {
                (self.goal_line - self.penalty_mark - self.kick_off, 0.0)
            }
            Role::Striker if is_own => (-self.kick_off, 0.0),
            Role::Striker => (-self.other_kick_off, 0.0),
            Role::Supporter => (-self.other_kick_off, self.other_kick_off),
            Role::DefenderLeft | Role::Sweeper => (-defender, self.defender_aside),
            Role::DefenderRight => (-defender, -self.defender_aside),
        };
        let pose = Isometry2::translation(x, y);
        match is_penalty_kick && !is_own && role != Role::Keeper {
            true => self.outside_own_penalty_area(&pose),
            false => pose,
        }
    }

    /// In Playing: where a robot that does not play the ball and is at `own` stands, with its face to the ball.
    pub(super) fn of_role(
        &self,
        role: Role,
        ball: Point2<f32>,
        own: Point2<f32>,
        keeper: &KeeperParameters,
    ) -> Isometry2<f32> {
        let goal = self.own_goal();
        let to_ball = (ball - goal)
            .try_normalize(f32::EPSILON)
            .unwrap_or_else(Vector2::x);
        let place = match role {
            Role::Keeper => {
                let place = goal + to_ball * keeper.radius;
                let nearest = keeper.before_line - self.goal_line;
                Point2::new(place.x.max(nearest), place.y.clamp(-self.post, self.post))
            }
            Role::Striker => {
                // Near the goal the keeper has that place.
                let distance = self.distance_to_free_kick;
                let is_near = (ball - goal).norm() < self.keepers_way;
                let aside = if is_near { self.beside_keeper } else { 0.0 };
                let away = Isometry2::rotation(aside.copysign(ball.y)) * -to_ball;
                ball + away * distance
            }
            Role::Supporter => {
                // Of a ball in the middle it stays on its side: seen to the left and right in turns it would send it to and fro.
                let is_in_the_middle = ball.y.abs() < 0.5 * self.supporter_aside;
                let side = match is_in_the_middle {
                    true => 1.0_f32.copysign(own.y),
                    false => -1.0_f32.copysign(ball.y),
                };
                let place =
                    ball + Vector2::new(-self.supporter_behind, side * self.supporter_aside);
                self.before_own_goal_area(place, side)
            }
            Role::Sweeper => goal + to_ball * self.ring(ball).min(self.sweeper_ring),
            Role::DefenderLeft => self.beside_way_to_goal(ball, 1.0),
            Role::DefenderRight => self.beside_way_to_goal(ball, -1.0),
        };
        self.facing(self.on_the_field(place), ball)
    }

    /// How far from the goal who defends stands, m: not behind the ball's back, but on the goal's side of it.
    fn ring(&self, ball: Point2<f32>) -> f32 {
        let share = self.defender_share * (ball - self.own_goal()).norm();
        self.defender_ring.min(share)
    }

    /// Of a defender, left (1) or right (-1) of the way from the ball to the goal.
    ///
    /// Where the ball lies more aside than ahead of the goal both stand as if it lay as far aside as ahead: else they, who keep
    /// out of the goal area, would be sent to one place. Nobody stands at the ball, which others play.
    fn beside_way_to_goal(&self, ball: Point2<f32>, side: f32) -> Point2<f32> {
        let from_goal = ball - self.own_goal();
        let ahead = Vector2::new(from_goal.x.max(from_goal.y.abs()), from_goal.y)
            .try_normalize(f32::EPSILON)
            .unwrap_or_else(Vector2::x);
        let to_left = Vector2::new(-ahead.y, ahead.x);
        let place =
            self.own_goal() + ahead * self.ring(ball) + to_left * (side * self.defender_aside);
        away_from(
            ball,
            self.before_own_goal_area(place, side),
            self.defender_aside,
        )
    }

    /// Where it lies in or beside the own goal area moved out to its front, and as far aside, out of the way of those who may
    /// be in there: the rules of 2025 let three in, which are the keeper, who plays the ball, and who stands in for the keeper.
    fn before_own_goal_area(&self, place: Point2<f32>, side: f32) -> Point2<f32> {
        let front = self.goal_area_length + self.margin - self.goal_line;
        let inside = (front - place.x).max(0.0);
        place + Vector2::new(inside, side * inside)
    }

    /// Pushed away from a ball that is the other team's.
    pub(super) fn at_a_distance(&self, pose: &Isometry2<f32>, ball: Point2<f32>) -> Isometry2<f32> {
        let place = Point2::from(pose.translation.vector);
        if (place - ball).norm() >= self.distance_to_free_kick {
            return *pose;
        }
        self.facing(away_from(ball, place, self.distance_to_free_kick), ball)
    }

    /// Beside the way of a ball that the keeper plays away: on the side of the touch line.
    pub(super) fn beside_clearing(
        &self,
        ball: Point2<f32>,
        keeper: &KeeperParameters,
    ) -> Isometry2<f32> {
        let from_goal = (ball - self.own_goal())
            .try_normalize(f32::EPSILON)
            .unwrap_or_else(Vector2::x);
        let aside = Isometry2::rotation(self.beside_keeper.copysign(ball.y)) * from_goal;
        let place = ball + aside * keeper.clears;
        self.facing(self.on_the_field(place), ball)
    }

    /// Moved to the front of the own penalty area where it lies inside.
    pub(super) fn outside_own_penalty_area(&self, pose: &Isometry2<f32>) -> Isometry2<f32> {
        let front = self.penalty_area_length + self.margin - self.goal_line;
        self.moved_out(pose, pose.translation.x < front, front)
    }

    /// Moved to the front of the opponents' penalty area where it lies inside.
    pub(super) fn outside_other_penalty_area(&self, pose: &Isometry2<f32>) -> Isometry2<f32> {
        let front = self.goal_line - self.penalty_area_length - self.margin;
        self.moved_out(pose, pose.translation.x > front, front)
    }

    fn moved_out(&self, pose: &Isometry2<f32>, is_behind: bool, front: f32) -> Isometry2<f32> {
        let is_beside = pose.translation.y.abs() > self.penalty_area_side + self.margin;
        let mut moved = *pose;
        if is_behind && !is_beside {
            moved.translation.x = front;
        }
        moved
    }

    /// The direction in which a ball gets into the opponents' goal; the nearest such direction to one that would be easy, rad.
    ///
    /// A ball on the own goal line is played along it and past the post: whoever got behind it would stand in the net.
    /// Beside the goal it is played from where there is room beside the net.
    pub(super) fn aim(&self, ball: Point2<f32>, easy: f32, attack: &AttackParameters) -> f32 {
        if ball.x - attack.behind >= self.before_goal - self.goal_line {
            return self.aim_at_goal(ball, easy, attack);
        }
        if ball.y.abs() < self.post + 2.0 * self.post_radius {
            // In the middle the side to which the robot has turned stays: the ball lies to its left and right in turns.
            let facing = math::sin(easy);
            let is_in_the_middle = ball.y.abs() < attack.goal_middle;
            let side = match is_in_the_middle && facing.abs() > attack.turned_aside {
                true => facing,
                false => ball.y,
            };
            return (FRAC_PI_2 - attack.along_line).copysign(side);
        }
        let side = 1.0_f32.copysign(ball.y);
        let room = (ball.y.abs() - self.post - self.beside_goal) / attack.behind;
        let most = math::asin(room.clamp(-1.0, 1.0));
        side * (side * self.aim_at_goal(ball, easy, attack)).min(most)
    }

    fn aim_at_goal(&self, ball: Point2<f32>, easy: f32, attack: &AttackParameters) -> f32 {
        let post = (self.post - attack.post_margin).max(0.0);
        let to = |y: f32| math::atan2(y - ball.y, self.goal_line - ball.x);
        let (right, left) = (to(-post), to(post));
        if ball.x < self.goal_line && left - right > attack.least_opening {
            // Both lie within a quarter of a turn of the direction to the goal, so nothing wraps.
            let middle = to(0.0);
            let off = wrapped(easy - middle);
            return (middle + off).clamp(right, left);
        }
        // Beside the goal: back to where it can be seen from.
        math::atan2(-ball.y, self.goal_line - self.penalty_mark - ball.x)
    }

    /// How far a ball is from the opponents' goal, m.
    pub(super) fn distance_to_goal(&self, ball: Point2<f32>) -> f32 {
        let beside = (ball.y.abs() - self.post).max(0.0);
        math::hypot(beside, self.goal_line - ball.x)
    }

    /// On the goal line where it lies in the middle of a goal, before it where it lies near the posts.
    pub(super) fn out_of_goals(&self, place: Point2<f32>) -> Point2<f32> {
        let has_room = place.y.abs() < self.post - self.beside_goal;
        let before = if has_room { 0.0 } else { self.before_goal };
        let most = (self.goal_line - before).max(0.0);
        match place.y.abs() < self.post + self.before_goal {
            true => Point2::new(place.x.clamp(-most, most), place.y),
            false => place,
        }
    }

    /// In the middle of its mouth, where it lies in a goal: no other way leads out.
    pub(super) fn way_out_of_goal(&self, place: Point2<f32>) -> Option<Point2<f32>> {
        let depth = place.x.abs() - self.goal_line;
        let is_inside = depth > self.before_goal && place.y.abs() < self.post;
        let room = (self.post - self.beside_goal).max(0.0);
        let mouth = self.goal_line - self.beside_goal;
        is_inside.then(|| Point2::new(mouth.copysign(place.x), place.y.clamp(-room, room)))
    }

    /// Where no way leads through: a goal, and what is far outside of the lines.
    pub(super) fn is_closed(&self, place: Point2<f32>) -> bool {
        let (x, y) = (place.x.abs(), place.y.abs());
        let is_in_goal = x > self.goal_line && y < self.post + 2.0 * self.post_radius;
        let far = self.off_the_field;
        is_in_goal || x > self.goal_line + far || y > self.touch_line + far
    }

    /// What the middle of a robot that passes so far from them stays out of: the posts.
    pub(super) fn posts(&self, clearance: f32) -> [Circle; 4] {
        let y = self.post + self.post_radius;
        [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]].map(|[goal, side]| Circle {
            middle: Point2::new(goal * self.goal_line, side * y),
            radius: self.post_radius + clearance,
        })
    }

    fn on_the_field(&self, place: Point2<f32>) -> Point2<f32> {
        let (x, y) = (self.goal_line, (self.touch_line - self.margin).max(0.0));
        Point2::new(place.x.clamp(-x, x), place.y.clamp(-y, y))
    }

    fn facing(&self, place: Point2<f32>, ball: Point2<f32>) -> Isometry2<f32> {
        let to_ball = ball - place;
        Isometry2::new(place.coords, math::atan2(to_ball.y, to_ball.x))
    }
}

/// The place, or where it is nearer to the ball than so many m, pushed away from it.
fn away_from(ball: Point2<f32>, place: Point2<f32>, least: f32) -> Point2<f32> {
    if (place - ball).norm() >= least {
        return place;
    }
    let away = (place - ball)
        .try_normalize(f32::EPSILON)
        .unwrap_or_else(|| -Vector2::x());
    ball + away * least
}

/// The same direction, from -π to π.
pub(super) fn wrapped(angle: f32) -> f32 {
    math::atan2(math::sin(angle), math::cos(angle))
}

#[cfg(test)]
mod tests;
