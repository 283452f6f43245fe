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

    /// In Playing: where a robot that does not play the ball stands, with its face to the ball.
    pub(super) fn of_role(
        &self,
        role: Role,
        ball: Point2<f32>,
        keeper: &KeeperParameters,
    ) -> Isometry2<f32> {
        let goal = self.own_goal();
        let to_ball = (ball - goal)
            .try_normalize(f32::EPSILON)
            .unwrap_or_else(Vector2::x);
        let to_left = Vector2::new(-to_ball.y, to_ball.x);
        // Not behind the ball's back: who defends stays on the goal's side of it.
        let ring = self
            .defender_ring
            .min(self.defender_share * (ball - goal).norm());
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
                let side = if ball.y > 0.0 { -1.0 } else { 1.0 };
                ball + Vector2::new(-self.supporter_behind, side * self.supporter_aside)
            }
            Role::Sweeper => goal + to_ball * ring.min(self.sweeper_ring),
            Role::DefenderLeft => goal + to_ball * ring + to_left * self.defender_aside,
            Role::DefenderRight => goal + to_ball * ring - to_left * self.defender_aside,
        };
        self.facing(self.on_the_field(place), ball)
    }

    /// Pushed away from a ball that is the other team's.
    pub(super) fn at_a_distance(&self, pose: &Isometry2<f32>, ball: Point2<f32>) -> Isometry2<f32> {
        let place = Point2::from(pose.translation.vector);
        if (place - ball).norm() >= self.distance_to_free_kick {
            return *pose;
        }
        let away = (place - ball)
            .try_normalize(f32::EPSILON)
            .unwrap_or_else(|| -Vector2::x());
        self.facing(ball + away * self.distance_to_free_kick, ball)
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

/// The same direction, from -π to π.
pub(super) fn wrapped(angle: f32) -> f32 {
    math::atan2(math::sin(angle), math::cos(angle))
}

#[cfg(test)]
mod tests {
    use std::f32::consts::PI;

    use framework::testing::ParameterFile;
    use types::field_markings::FieldMarkings;

    use super::*;
    use crate::behavior::tests::parameters;

    const ROLES: [Role; 5] = [
        Role::Striker,
        Role::Keeper,
        Role::Supporter,
        Role::DefenderLeft,
        Role::DefenderRight,
    ];

    #[test]
    fn places_before_a_kick_off_are_legal_and_nobody_stands_in_the_way() {
        let parameters = parameters();
        for (kicking_team, least) in [(KickingTeam::Own, 0.2), (KickingTeam::Opponent, 0.75)] {
            let places = ROLES.map(|role| {
                let places = &parameters.places;
                let pose =
                    places.before_kick(role, kicking_team, SetPlay::None, &parameters.keeper);
                pose.translation.vector
            });
            for (index, place) in places.iter().enumerate() {
                assert!(place.x < -0.1 && place.norm() > least + 0.1, "{place}");
                assert!(place.x > -4.5 && place.y.abs() < 3.0, "{place}");
                let others = places.iter().skip(index + 1);
                assert!(others.into_iter().all(|other| (place - other).norm() > 0.5));
            }
        }
    }

    #[test]
    fn at_a_penalty_kick_of_the_others_only_the_keeper_is_in_the_penalty_area_on_its_line() {
        let parameters = parameters();
        for role in ROLES {
            let pose = parameters.places.before_kick(
                role,
                KickingTeam::Opponent,
                SetPlay::PenaltyKick,
                &parameters.keeper,
            );
            let place = pose.translation.vector;
            let is_inside = place.x < -2.85 && place.y.abs() < 2.0;
            assert_eq!(is_inside, role == Role::Keeper, "{role:?}");
            // The rules want a foot of it on the line.
            assert!(!is_inside || place.x == -4.5, "{place}");
        }
    }

    #[test]
    fn roles_stand_between_ball_and_goal_and_look_at_the_ball() {
        let parameters = parameters();
        for ball in [[0.0, 0.0], [-3.0, 1.5], [4.0, -2.5], [-4.4, 0.1]] {
            let ball = Point2::from(ball);
            for role in ROLES {
                let pose = parameters.places.of_role(role, ball, &parameters.keeper);
                let place = Point2::from(pose.translation.vector);
                assert!(
                    place.x.abs() <= 4.5 && place.y.abs() <= 3.0,
                    "{role:?}: {place}"
                );
                let ahead = pose.rotation * Vector2::x();
                if (ball - place).norm() > 0.1 {
                    assert!(ahead.dot(&(ball - place)) > 0.0, "{role:?}");
                }
                if role == Role::Keeper {
                    assert!(place.y.abs() <= 0.75 && place.x < -3.8, "{place}");
                }
            }
        }
    }

    #[test]
    fn a_free_kick_of_the_others_is_given_room() {
        let places = parameters().places;
        for (place, is_moved) in [([0.5, 0.0], true), ([-2.0, 0.0], false)] {
            let pose = Isometry2::translation(place[0], place[1]);
            let moved = places.at_a_distance(&pose, Point2::new(0.2, 0.3));
            assert_eq!(moved != pose, is_moved);
            let distance = (moved.translation.vector - Vector2::new(0.2, 0.3)).norm();
            assert!(distance > 0.75, "{distance}");
        }
    }

    #[test]
    fn the_aim_is_the_easiest_direction_into_the_goal() {
        let parameters = parameters();
        let places = parameters.places;
        let aim =
            |x: f32, y: f32, easy: f32| places.aim(Point2::new(x, y), easy, &parameters.attack);
        // Straight ahead gets there.
        assert!((aim(3.0, 0.3, 0.0)).abs() < 1e-6);
        // Whoever heads elsewhere aims at what is in from the nearer post.
        let left = math::atan2(0.55_f32, 1.5);
        for easy in [0.5, FRAC_PI_2, 3.0] {
            assert!((aim(3.0, 0.0, easy) - left).abs() < 1e-5);
        }
        assert!((aim(3.0, 0.0, -2.0) + left).abs() < 1e-5);
        // From beside the goal it goes back to where it can be seen from.
        for (x, y) in [(4.48, 2.0), (4.6, -1.0)] {
            let aim = aim(x, y, 0.0);
            assert!(math::cos(aim) < 0.0 && math::sin(aim) * y < 0.0, "{aim}");
        }
        assert!(aim(-4.0, 0.0, PI).abs() < 0.1);
    }

    #[test]
    fn a_ball_on_the_own_goal_line_goes_past_the_post_and_keeps_its_side() {
        let parameters = parameters();
        let aim = |x: f32, y: f32, easy: f32| {
            let places = parameters.places;
            places.aim(Point2::new(x, y), easy, &parameters.attack)
        };
        for (y, easy, is_left) in [
            (0.2, 0.0, true),
            (-0.2, 0.0, false),
            (0.7, -1.0, true),
            // In the middle where the robot has turned to.
            (0.01, -1.2, false),
            (-0.01, -1.2, false),
            (-0.01, 1.2, true),
        ] {
            let aim = aim(-4.45, y, easy);
            assert_eq!(aim > 0.0, is_left, "{y} {easy}: {aim}");
            // So far that it does not roll into the post.
            assert!((1.2..1.3).contains(&aim.abs()), "{aim}");
        }
        // Beside the goal from where there is room beside the net, and further away as everywhere.
        for y in [0.86_f32, 0.95, 1.02, -0.9] {
            let behind = y - parameters.attack.behind * math::sin(aim(-4.4, y, 0.0));
            assert!((behind.abs() - 1.05).abs() < 0.01, "{y}: {behind}");
        }
        assert!(aim(-4.4, 1.5, 0.0).abs() < 0.5);
    }

    #[test]
    fn the_measures_are_those_of_the_field_by_which_the_robot_finds_its_place() {
        let file = ParameterFile::new(include_str!("../../../parameters/default.toml"));
        let field: FieldMarkings = file.get("field_dimensions.markings");
        let places = parameters().places;
        for (place, marking) in [
            (places.goal_line, field.length / 2.0),
            (places.touch_line, field.width / 2.0),
            (places.penalty_area_length, field.penalty_area_length),
            (places.penalty_area_side, field.penalty_area_width / 2.0),
            (places.penalty_mark, field.penalty_mark_distance),
        ] {
            assert_eq!(place, marking);
        }
    }

    #[test]
    fn measures_that_leave_no_room_leave_a_place() {
        let parameters = parameters();
        let mut places = parameters.places;
        places.margin = places.touch_line + 0.5;
        places.before_goal = places.goal_line + 0.5;
        places.beside_goal = places.post + 0.5;
        let ball = Point2::new(-3.7, 0.5);
        for role in ROLES {
            let pose = places.of_role(role, ball, &parameters.keeper);
            assert!(pose.translation.y.abs() <= places.touch_line, "{role:?}");
        }
        assert_eq!(places.out_of_goals(ball), Point2::new(0.0, 0.5));
    }

    #[test]
    fn goals_are_not_walked_into() {
        let places = parameters().places;
        for (x, y, expected) in [
            (-4.7, 0.3, -4.5),
            (-4.7, 0.6, -4.4),
            (4.6, -0.75, 4.4),
            (-4.3, 0.0, -4.3),
            (-4.7, 1.2, -4.7),
        ] {
            let moved = places.out_of_goals(Point2::new(x, y));
            assert_eq!(moved, Point2::new(expected, y));
        }
    }

    #[test]
    fn no_way_leads_through_a_goal_or_off_the_carpet() {
        let places = parameters().places;
        for (x, y, is_closed) in [
            (4.6, 0.7, true),
            (-4.9, -0.8, true),
            (-4.9, 1.1, false),
            (4.4, 0.7, false),
            (0.0, 3.3, false),
            (0.0, -3.7, true),
            (5.1, 2.0, true),
        ] {
            assert_eq!(places.is_closed(Point2::new(x, y)), is_closed, "{x} {y}");
        }
        let out = places.way_out_of_goal(Point2::new(-4.8, 0.7)).unwrap();
        assert!(out.x > -4.3 && out.y < 0.5, "{out}");
        assert_eq!(places.way_out_of_goal(Point2::new(-4.8, 0.9)), None);
        assert_eq!(places.way_out_of_goal(Point2::new(-4.5, 0.0)), None);
    }
}
