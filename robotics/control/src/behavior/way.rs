//! Owns the way around what stands on the floor: straight to the goal, else along tangents of circles.

use framework::math;
use nalgebra::{Isometry2, Point2, Vector2};

use super::parameters::WalkParameters;

/// No parameter makes a way go around more: each one doubles the work.
const MOST_DETOURS: u32 = 6;

/// What the middle of the robot must stay out of, in the ground frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Circle {
    /// In m.
    pub(super) middle: Point2<f32>,
    /// In m.
    pub(super) radius: f32,
}

/// Where a robot at the origin goes first on the shortest way that was found to a point of its ground frame, m.
///
/// A circle in which the robot or the point lies does not count, but the robot leaves one before it goes through its middle.
/// To turn by 1 rad counts as the way that is walked meanwhile: of two sides that are nearly as long the robot keeps the one that it has
/// turned to, also where the circle moves. No way leads through a point that is closed while there is another one.
pub(super) fn first_way_point(
    target: Point2<f32>,
    circles: impl Iterator<Item = Circle> + Clone,
    walk: &WalkParameters,
    is_closed: impl Fn(Point2<f32>) -> bool,
) -> Point2<f32> {
    let start = Start {
        place: Point2::origin(),
        turning: walk.forward / walk.turn.max(f32::EPSILON),
    };
    let floor = Floor {
        circles,
        is_closed,
        walk,
    };
    floor
        .detour(start, target, walk.detours.min(MOST_DETOURS))
        .0
}

/// What stands on the floor.
struct Floor<'a, Circles, IsClosed> {
    circles: Circles,
    is_closed: IsClosed,
    walk: &'a WalkParameters,
}

/// Where a way begins.
#[derive(Clone, Copy)]
struct Start {
    place: Point2<f32>,
    /// As how long counts turning away from x, m per rad.
    turning: f32,
}

impl<Circles, IsClosed> Floor<'_, Circles, IsClosed>
where
    Circles: Iterator<Item = Circle> + Clone,
    IsClosed: Fn(Point2<f32>) -> bool,
{
    /// The first point of the way and how long that is, m.
    fn detour(&self, start: Start, target: Point2<f32>, detours: u32) -> (Point2<f32>, f32) {
        let Start { place, turning } = start;
        let straight = (target, (target - place).norm());
        let blocking = self
            .circles
            .clone()
            .filter_map(|circle| Some((blocks(place, target, &circle)?, circle)))
            .min_by(|(one, _), (other, _)| one.total_cmp(other));
        let Some((_, circle)) = blocking.filter(|_| detours > 0) else {
            return straight;
        };
        let around = [1.0, -1.0].map(|side| {
            let way_point = beside(place, &circle, side, self.walk.detour_radii);
            let next = Start {
                place: way_point,
                turning: 0.0,
            };
            let (_, rest) = self.detour(next, target, detours - 1);
            let way = way_point - place;
            let turned = math::atan2(way.y, way.x).abs() * turning;
            let more = if self.is_taken(way_point) {
                self.walk.taken
            } else {
                0.0
            };
            (way_point, way.norm() + rest + more + turned)
        });
        let [left, right] = around;
        if left.1 <= right.1 { left } else { right }
    }

    /// Whether another obstacle takes a point, or it is closed.
    fn is_taken(&self, point: Point2<f32>) -> bool {
        self.circles
            .clone()
            .any(|circle| (point - circle.middle).norm() < circle.radius)
            || (self.is_closed)(point)
    }
}

/// How far along the way it comes nearest to the middle of a circle that is in the way, m.
fn blocks(start: Point2<f32>, target: Point2<f32>, circle: &Circle) -> Option<f32> {
    let (way, to_middle) = (target - start, circle.middle - start);
    let length = way.norm();
    if length <= f32::EPSILON || (target - circle.middle).norm() < circle.radius {
        return None;
    }
    let along = to_middle.dot(&way) / length;
    let across = way.perp(&to_middle).abs() / length;
    (along > 0.0 && along < length && across < circle.radius).then_some(along)
}

/// Where a way touches so many radii of the circle on one side (1: left of its middle), or goes past it from inside.
fn beside(start: Point2<f32>, circle: &Circle, side: f32, radii: f32) -> Point2<f32> {
    let to_middle = circle.middle - start;
    let distance = to_middle.norm();
    let radius = circle.radius * radii;
    let direction = match distance > f32::EPSILON {
        true => to_middle / distance,
        false => Vector2::x(),
    };
    let aside = math::asin(radius / distance.max(radius)) * side;
    let length = (distance * distance - radius * radius).max(0.0).sqrt();
    let turned: Vector2<f32> = Isometry2::rotation(aside) * direction;
    start + turned * length.max(radius / 2.0)
}

#[cfg(test)]
mod tests {
    use std::sync::LazyLock;

    use super::*;
    use crate::behavior::tests::parameters;

    static WALK: LazyLock<WalkParameters> = LazyLock::new(|| parameters().walk);

    fn way_point(target: [f32; 2], circles: &[[f32; 3]]) -> Point2<f32> {
        let circles = circles.iter().map(|&[x, y, radius]| Circle {
            middle: Point2::new(x, y),
            radius,
        });
        first_way_point(Point2::from(target), circles, &WALK, |_| false)
    }

    #[test]
    fn a_way_that_is_free_is_straight() {
        let target = Point2::new(3.0, 0.0);
        for circles in [
            vec![],
            vec![[1.5, 0.6, 0.5]],
            vec![[-1.0, 0.0, 0.5]],
            vec![[4.0, 0.0, 0.5]],
            // Who wants to get into a circle goes there.
            vec![[3.1, 0.0, 0.5]],
        ] {
            assert_eq!(way_point([3.0, 0.0], &circles), target, "{circles:?}");
        }
    }

    #[test]
    fn an_obstacle_is_passed_on_the_shorter_side() {
        for (y, is_left) in [(0.1, false), (-0.1, true)] {
            let around = way_point([3.0, 0.0], &[[1.5, y, 0.5]]);
            assert_eq!(around.y > 0.0, is_left, "{around}");
            assert!((around - Point2::new(1.5, y)).norm() > 0.5);
        }
        // Where a second one closes the shorter side, the other one is shorter.
        let around = way_point([3.0, 0.0], &[[1.5, 0.1, 0.5], [1.5, -0.8, 0.5]]);
        assert!(around.y > 0.0, "{around}");
    }

    #[test]
    fn of_two_sides_that_are_nearly_as_long_it_keeps_the_one_that_it_faces() {
        // The obstacle moves a little to and fro across the way; the robot has turned past it on one side.
        for facing in [0.5_f32, -0.5] {
            for moved in [-0.05_f32, 0.0, 0.05] {
                let turn = Isometry2::rotation(-facing);
                let target = turn * Point2::new(3.0, 0.0);
                let obstacle = turn * Point2::new(1.0, moved);
                let around = way_point([target.x, target.y], &[[obstacle.x, obstacle.y, 0.4]]);
                let around = turn.inverse() * around;
                assert!(around.y * facing > 0.0, "{facing} {moved}: {around}");
            }
        }
    }

    #[test]
    fn the_shorter_side_is_not_taken_where_it_is_closed() {
        let circle = Circle {
            middle: Point2::new(1.5, 0.1),
            radius: 0.5,
        };
        for (closed, is_left) in [(-1.0, true), (1.0, false)] {
            let is_closed = |place: Point2<f32>| place.y * closed > 0.0;
            let target = Point2::new(3.0, 0.0);
            let around = first_way_point(target, [circle].into_iter(), &WALK, is_closed);
            assert_eq!(around.y > 0.0, is_left, "{around}");
        }
    }

    #[test]
    fn who_stands_in_a_circle_does_not_go_through_its_middle() {
        let around = way_point([1.0, 0.0], &[[0.2, 0.02, 0.4]]);
        assert!(around.x.abs() < 0.1 && around.y < -0.1, "{around}");
        // And leaves it straight where the way leads out.
        let out = way_point([-1.0, 0.0], &[[0.2, 0.0, 0.4]]);
        assert_eq!(out, Point2::new(-1.0, 0.0));
    }

    #[test]
    fn whoever_walks_so_gets_there_without_touching_anything() {
        let circles = [
            [1.0, 0.0, 0.4],
            [1.6, 0.5, 0.4],
            [2.2, -0.3, 0.4],
            [0.4, 1.0, 0.3],
        ];
        let target = Point2::new(3.0, 0.2);
        let mut position = Vector2::new(0.0, 0.0);
        for _ in 0..400 {
            let seen = circles.map(|[x, y, radius]| [x - position.x, y - position.y, radius]);
            let there = target - position;
            let way_point = way_point([there.x, there.y], &seen);
            position += way_point.coords.cap_magnitude(0.02);
            for [x, y, radius] in circles {
                let distance = (position - Vector2::new(x, y)).norm();
                assert!(distance > radius - 0.03, "{position} in {x} {y}");
            }
        }
        assert!((target.coords - position).norm() < 0.03, "{position}");
    }
}
