//! The ball: a soft sphere that the carpet slows down.

use framework::math;
use nalgebra::{Point3, Vector3};
use rapier3d_f64::prelude::{
    ColliderBuilder, PhysicsWorld, RigidBodyBuilder, RigidBodyHandle, Vector,
};

use super::super::{Ball, STEP};
use super::convert::{to_vector, vector};
use super::shape::COMBINATION;
use crate::field::BALL_RADIUS;

/// Mass, kg (RoboCup SPL rules 2025).
pub(crate) const MASS: f64 = 0.044;
/// How fast carpet slows a rolling ball, m/s²: the middle of the 0.3 to 0.5 that teams assume.
pub const ROLLING_DECELERATION: f64 = 0.4;
/// Of foam on carpet, against sliding (simulator of B-Human's robots has 0.3; an estimate).
const FRICTION: f64 = 0.5;
/// Share of its speed with which it bounces off something hard (an estimate).
const RESTITUTION: f64 = 0.5;
/// Up to this height above the floor, m, it rolls.
const TOUCHING: f64 = 0.003;

/// The ball in the engine.
pub(super) struct RollingBall(RigidBodyHandle);

impl RollingBall {
    /// A ball at rest on the floor.
    pub(super) fn insert(world: &mut PhysicsWorld, [x, y]: [f64; 2]) -> Self {
        let radius = f64::from(BALL_RADIUS);
        let body = RigidBodyBuilder::dynamic()
            .translation(Vector::new(x, y, radius))
            .ccd_enabled(true);
        let sphere = ColliderBuilder::ball(radius)
            .mass(MASS)
            .friction(FRICTION)
            .friction_combine_rule(COMBINATION)
            .restitution(RESTITUTION)
            .restitution_combine_rule(COMBINATION);
        Self(world.insert(body, sphere).0)
    }

    /// Takes from the ball what one step of rolling on carpet takes, sliding aside.
    pub(super) fn resist_rolling(&self, world: &mut PhysicsWorld) {
        let ball = &mut world.bodies[self.0];
        if ball.translation().z > f64::from(BALL_RADIUS) + TOUCHING {
            return;
        }
        let (velocity, spin) = (ball.linvel(), ball.angvel());
        let speed = math::hypot(velocity.x, velocity.y);
        let rim_speed = spin.length() * f64::from(BALL_RADIUS);
        let fastest = speed.max(rim_speed);
        if fastest == 0.0 {
            return;
        }
        let left = (1.0 - ROLLING_DECELERATION * STEP.as_secs_f64() / fastest).max(0.0);
        ball.set_linvel(
            Vector::new(velocity.x * left, velocity.y * left, velocity.z),
            false,
        );
        ball.set_angvel(spin * left, false);
    }

    pub(super) fn place(
        &self,
        world: &mut PhysicsWorld,
        position: &Point3<f64>,
        velocity: &Vector3<f64>,
    ) {
        let ball = &mut world.bodies[self.0];
        ball.set_translation(to_vector(&position.coords), true);
        ball.set_linvel(to_vector(velocity), true);
        // It rolls from the beginning on.
        let spin = Vector3::z().cross(velocity) / f64::from(BALL_RADIUS);
        ball.set_angvel(to_vector(&spin), true);
    }

    pub(super) fn read(&self, world: &PhysicsWorld) -> Ball {
        let ball = &world.bodies[self.0];
        Ball {
            position: vector(ball.translation()).into(),
            velocity: vector(ball.linvel()),
        }
    }
}
