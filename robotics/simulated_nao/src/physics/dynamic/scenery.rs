//! What does not move: the carpet, and the goals with their nets.

use nalgebra::Point2;
use rapier3d_f64::prelude::{ColliderBuilder, PhysicsWorld, SharedShape, Vector};

use super::shape::COMBINATION;
use crate::field::{CROSSBAR_HEIGHT, GOAL_DEPTH, GOAL_POST_RADIUS, goal_posts};

/// Of painted metal (an estimate).
const POST_FRICTION: f64 = 0.5;
/// Of threads: what comes to a net stays there (an estimate).
const NET_FRICTION: f64 = 0.8;

/// Puts carpet and goals into a world; friction is a product of what a thing has and what it touches.
pub(super) fn insert(world: &mut PhysicsWorld, carpet_friction: f64) {
    let carpet = ColliderBuilder::new(SharedShape::halfspace(Vector::Z));
    world.insert_collider(finish(carpet, carpet_friction, 1.0), None);
    for goal in goal_posts().map(|post| post.cast::<f64>()).chunks_exact(2) {
        for part in frame(goal) {
            world.insert_collider(finish(part, POST_FRICTION, 1.0), None);
        }
        for panel in net(goal) {
            world.insert_collider(finish(panel, NET_FRICTION, 0.0), None);
        }
    }
}

/// Two posts and the crossbar.
fn frame(posts: &[Point2<f64>]) -> [ColliderBuilder; 3] {
    let height = f64::from(CROSSBAR_HEIGHT);
    let at = |post: usize, z: f64| Vector::new(posts[post].x, posts[post].y, z);
    let bar =
        |from, to| ColliderBuilder::capsule_from_endpoints(from, to, f64::from(GOAL_POST_RADIUS));
    [
        bar(at(0, 0.0), at(0, height)),
        bar(at(1, 0.0), at(1, height)),
        bar(at(0, height), at(1, height)),
    ]
}

/// Two sides, and the back in two triangles, from the frame to the ground behind it.
fn net(posts: &[Point2<f64>]) -> [ColliderBuilder; 4] {
    let top = |post: usize| Vector::new(posts[post].x, posts[post].y, f64::from(CROSSBAR_HEIGHT));
    let foot = |post: usize| Vector::new(posts[post].x, posts[post].y, 0.0);
    let outward = Vector::X * posts[0].x.signum() * f64::from(GOAL_DEPTH);
    let back = |post: usize| foot(post) + outward;
    [
        ColliderBuilder::triangle(top(0), foot(0), back(0)),
        ColliderBuilder::triangle(top(1), foot(1), back(1)),
        ColliderBuilder::triangle(top(0), back(0), back(1)),
        ColliderBuilder::triangle(top(0), back(1), top(1)),
    ]
}

fn finish(part: ColliderBuilder, friction: f64, restitution: f64) -> ColliderBuilder {
    part.friction(friction)
        .friction_combine_rule(COMBINATION)
        .restitution(restitution)
        .restitution_combine_rule(COMBINATION)
}
