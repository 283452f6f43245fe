//! Physics without forces: joints turn as fast as they may, and the feet stay where they stand.
//!
//! The robot never falls: the lower sole always stands flat on the floor, and it stays in its place
//! until the other sole becomes the lower one. Stepping therefore walks.

use kinematics::feet::FORCE_SENSITIVE_RESISTORS;
use kinematics::{forward_kinematics, limits};
use nalgebra::{Isometry3, Point3, Vector3};
use types::feet::{Feet, Side};
use types::joints::Joints;
use types::motor_commands::MotorCommands;

use super::body::{flat, weight};
use super::{Ball, Body, Disturbance, Physics, STEP, Situation, Start};
use crate::field::BALL_RADIUS;

/// How deep, in m, the raised sole may reach into the floor before it becomes the standing one.
const DEEPEST: f64 = 1e-4;
/// Up to this height, in m, a sole touches the floor.
const TOUCHING: f64 = 0.003;

/// Joints follow at their greatest speed times their stiffness; limp joints keep their angle.
#[derive(Debug)]
pub struct Kinematic {
    bodies: Vec<Body>,
    /// The sole on which each body stands.
    standing_on: Vec<Side>,
    bystanders: Vec<Isometry3<f64>>,
    ball: Option<Ball>,
}

impl Kinematic {
    /// The robots of a situation on the floor.
    pub fn new(situation: &Situation) -> Self {
        let bodies = situation.robots.iter().map(|start| {
            let mut body = Body::standing(start);
            body.contact_forces = contact_forces(&body);
            body
        });
        let bystanders = situation.bystanders.iter();
        Self {
            bodies: bodies.collect(),
            standing_on: vec![Side::Left; situation.robots.len()],
            bystanders: bystanders
                .map(|start| Body::standing(start).torso_to_field)
                .collect(),
            ball: situation.ball.map(|[x, y]| Ball {
                position: Point3::new(x, y, f64::from(BALL_RADIUS)),
                velocity: Vector3::zeros(),
            }),
        }
    }
}

impl Physics for Kinematic {
    fn step(&mut self, commands: &[MotorCommands]) {
        let seconds = STEP.as_secs_f64();
        let robots = self.bodies.iter_mut().zip(&mut self.standing_on);
        for ((body, standing_on), commands) in robots.zip(commands) {
            let joints = Joints::from_fn(|joint| {
                let stiffness = f64::from(commands.stiffnesses[joint]).clamp(0.0, 1.0);
                let target = f64::from(limits::clamp(joint, commands.positions[joint]));
                let reach = limits::of(joint).velocity * stiffness * seconds;
                let angle = body.joints[joint];
                angle + (target - angle).clamp(-reach, reach)
            });
            let before = body.torso_to_field.rotation;
            *body = settle(body, standing_on, joints);
            body.contact_forces = contact_forces(body);
            let turn = before.inverse() * body.torso_to_field.rotation;
            body.angular_velocity = turn.scaled_axis() / seconds;
        }
    }

    fn bodies(&self) -> &[Body] {
        &self.bodies
    }

    fn ball(&self) -> Option<Ball> {
        self.ball
    }

    fn bystanders(&self) -> &[Isometry3<f64>] {
        &self.bystanders
    }

    fn disturb(&mut self, disturbance: &Disturbance) {
        match *disturbance {
            Disturbance::Push { .. } => {}
            Disturbance::MoveBall { position, .. } => {
                if let Some(ball) = &mut self.ball {
                    ball.position = position;
                }
            }
            // Here everybody stands.
            Disturbance::Kidnap { robot, pose } | Disturbance::Hold { robot, pose } => {
                if let Some(body) = self.bodies.get_mut(robot) {
                    let joints = body.joints;
                    *body = Body::standing(&Start { joints, pose });
                    body.contact_forces = contact_forces(body);
                }
            }
        }
    }
}

/// The body with its joints turned, still standing on what it stood on if it can.
fn settle(body: &Body, standing_on: &mut Side, joints: Joints<f64>) -> Body {
    let poses = forward_kinematics(&joints);
    let sole = body.soles_to_field.on(*standing_on);
    let stay = Body::on_sole(joints, &poses, *standing_on, sole);
    let raised = other(*standing_on);
    if stay.lowest(raised) < -DEEPEST {
        // It touches the floor already, or is about to: it stays where it was.
        let place = flat(body.soles_to_field.on(raised));
        let change = Body::on_sole(joints, &poses, raised, &place);
        if change.lowest(*standing_on) > stay.lowest(raised) {
            *standing_on = raised;
            return change;
        }
    }
    stay
}

fn other(side: Side) -> Side {
    match side {
        Side::Left => Side::Right,
        Side::Right => Side::Left,
    }
}

/// The weight, shared between the soles and their resistors by where the centre of mass is.
fn contact_forces(body: &Body) -> Feet<[f64; 4]> {
    let touching = |side| body.lowest(side) < TOUCHING;
    let on_left = match (touching(Side::Left), touching(Side::Right)) {
        (true, false) => 1.0,
        (false, true) => 0.0,
        _ => {
            let Feet { left, right } = body.soles_to_field;
            let across = (left.translation.vector - right.translation.vector).xy();
            let from_right = (body.center_of_mass.coords - right.translation.vector).xy();
            (from_right.dot(&across) / across.norm_squared()).clamp(0.0, 1.0)
        }
    };
    let total = weight();
    let both = on_left > 0.0 && on_left < 1.0;
    Feet {
        left: resistors(body, Side::Left, both).map(|share| share * on_left * total),
        right: resistors(body, Side::Right, both).map(|share| share * (1.0 - on_left) * total),
    }
}

/// Shares of the four resistors of a sole; they sum to 1.
fn resistors(body: &Body, side: Side, both_carry: bool) -> [f64; 4] {
    let places = *FORCE_SENSITIVE_RESISTORS.on(side);
    let below = body
        .soles_to_field
        .on(side)
        .inverse_transform_point(&body.center_of_mass);
    let along = |place: f64, from: f64, to: f64| ((place - from) / (to - from)).clamp(0.0, 1.0);
    let front = along(below.x, places[2][0], places[0][0]);
    // Between two soles the weight comes down in the middle of each.
    let left = if both_carry {
        0.5
    } else {
        along(below.y, places[1][1], places[0][1])
    };
    [
        front * left,
        front * (1.0 - left),
        (1.0 - front) * left,
        (1.0 - front) * (1.0 - left),
    ]
}

#[cfg(test)]
mod tests {
    use kinematics::inertial::GRAVITY;

    use super::*;
    use crate::physics::heading;
    use crate::posture;

    fn robot(joints: Joints<f64>, pose: [f64; 3]) -> Kinematic {
        Kinematic::new(&Situation {
            robots: vec![Start { joints, pose }],
            ..Situation::default()
        })
    }

    fn commands(positions: Joints<f64>, stiffness: f32) -> MotorCommands {
        MotorCommands {
            positions: positions.map(|angle| angle as f32),
            stiffnesses: Joints::filled(stiffness),
        }
    }

    #[test]
    fn joints_reach_their_targets_no_faster_than_they_can() {
        let mut physics = robot(posture::sitting(), [0.0; 3]);
        let target = posture::standing();
        for _ in 0..800 {
            let before = physics.bodies[0].joints;
            physics.step(&[commands(target, 0.7)]);
            let after = physics.bodies[0].joints;
            for (joint, angle) in after.iter() {
                let speed = (angle - before[joint]).abs() / STEP.as_secs_f64();
                assert!(
                    speed <= limits::of(joint).velocity * 0.7 + 1e-9,
                    "{joint:?}: {speed}"
                );
            }
        }
        for (joint, angle) in physics.bodies[0].joints.iter() {
            assert!((angle - target[joint]).abs() < 1e-6, "{joint:?}");
        }
    }

    #[test]
    fn limp_joints_stay() {
        let mut physics = robot(posture::sitting(), [0.0; 3]);
        physics.step(&[commands(posture::standing(), 0.0)]);
        assert_eq!(physics.bodies[0].joints, posture::sitting());
    }

    #[test]
    fn both_soles_of_a_standing_robot_are_on_the_floor() {
        let physics = robot(posture::standing(), [1.0, -0.5, 2.0]);
        let body = physics.bodies[0];
        for sole in [body.soles_to_field.left, body.soles_to_field.right] {
            assert!(sole.translation.z.abs() < 1e-9);
            assert!((sole.rotation * Vector3::z()).z > 1.0 - 1e-9);
        }
        let ground = body.ground_to_field();
        assert!((ground.translation.vector - Vector3::new(1.0, -0.5, 0.0)).norm() < 1e-9);
        assert!((heading(&ground) - 2.0).abs() < 1e-9);
        // Published height of the torso above the soles in this pose: 0.30884 m, measured in the
        // torso's frame, which leans by 0.02967 rad.
        assert!((body.torso_to_field.translation.z - 0.3097).abs() < 1e-3);
    }

    #[test]
    fn the_resistors_carry_the_weight_of_the_robot() {
        for joints in [posture::standing(), posture::sitting()] {
            let forces = robot(joints, [0.0; 3]).bodies[0].contact_forces;
            let sum: f64 = forces.left.iter().chain(&forces.right).sum();
            assert!((sum / GRAVITY - 5.35975).abs() < 1e-3, "{sum}");
        }
    }

    #[test]
    fn lifting_a_leg_moves_the_weight_to_the_other() {
        let mut physics = robot(posture::standing(), [0.0; 3]);
        let mut joints = posture::standing();
        joints.left_knee_pitch += 0.4;
        joints.left_hip_pitch -= 0.2;
        joints.left_ankle_pitch -= 0.2;
        let before = physics.bodies[0].soles_to_field.right;
        for _ in 0..200 {
            physics.step(&[commands(joints, 1.0)]);
        }
        let body = physics.bodies[0];
        assert!(body.soles_to_field.left.translation.z > 0.003);
        assert_eq!(body.contact_forces.left, [0.0; 4]);
        let moved = body.soles_to_field.right.translation.vector - before.translation.vector;
        assert!(moved.norm() < 1e-3, "the standing foot slid by {moved}");
    }
}
