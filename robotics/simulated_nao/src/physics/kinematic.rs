//! Physics without forces: joints turn as fast as they may, and the feet stay where they stand.
//!
//! The robot never falls: the lower sole always stands flat on the floor, and it stays in its place
//! until the other sole becomes the lower one. Stepping therefore walks.

use std::time::Duration;

use kinematics::feet::{FORCE_SENSITIVE_RESISTORS, LEFT_SOLE};
use kinematics::inertial::GRAVITY;
use kinematics::links::{LINKS, TORSO};
use kinematics::{Poses, forward_kinematics, limits};
use nalgebra::{Isometry3, Point3};
use types::feet::{Feet, Side};
use types::joints::Joints;
use types::motor_commands::MotorCommands;

use super::{Body, Physics, heading, planar};

/// How deep, in m, the raised sole may reach into the floor before it becomes the standing one.
const DEEPEST: f64 = 1e-4;
/// Up to this height, in m, a sole touches the floor.
const TOUCHING: f64 = 0.003;

/// Joints follow at their greatest speed times their stiffness; limp joints keep their angle.
#[derive(Debug)]
pub struct Kinematic {
    body: Body,
    standing_on: Side,
}

impl Kinematic {
    /// A robot with these joint angles whose ground frame lies at x, y (m) and heading (rad).
    pub fn new(joints: Joints<f64>, [x, y, heading]: [f64; 3]) -> Self {
        let poses = forward_kinematics(&joints);
        let somewhere = stand(joints, &poses, Side::Left, &Isometry3::identity());
        let to_field = planar(x, y, heading) * somewhere.ground_to_field().inverse();
        let sole = to_field * somewhere.soles_to_field.left;
        Self {
            body: stand(joints, &poses, Side::Left, &flat(&sole)),
            standing_on: Side::Left,
        }
    }

    /// The body with its joints turned, still standing on what it stood on if it can.
    fn settle(&mut self, joints: Joints<f64>) {
        let poses = forward_kinematics(&joints);
        let stay = stand(
            joints,
            &poses,
            self.standing_on,
            self.body.soles_to_field.on(self.standing_on),
        );
        let raised = other(self.standing_on);
        if lowest(&stay, raised) < -DEEPEST {
            // It touches the floor already, or is about to: it stays where it was.
            let place = flat(self.body.soles_to_field.on(raised));
            let change = stand(joints, &poses, raised, &place);
            if lowest(&change, self.standing_on) > lowest(&stay, raised) {
                self.standing_on = raised;
                self.body = change;
                return;
            }
        }
        self.body = stay;
    }
}

impl Physics for Kinematic {
    fn advance(&mut self, duration: Duration, commands: &MotorCommands) -> &Body {
        let joints = Joints::from_fn(|joint| {
            let stiffness = f64::from(commands.stiffnesses[joint]).clamp(0.0, 1.0);
            let target = f64::from(limits::clamp(joint, commands.positions[joint]));
            let reach = limits::of(joint).velocity * stiffness * duration.as_secs_f64();
            let angle = self.body.joints[joint];
            angle + (target - angle).clamp(-reach, reach)
        });
        self.settle(joints);
        &self.body
    }

    fn body(&self) -> &Body {
        &self.body
    }
}

/// The body with one sole at a pose on the floor.
fn stand(
    joints: Joints<f64>,
    poses: &Poses<f64>,
    side: Side,
    sole_to_field: &Isometry3<f64>,
) -> Body {
    let torso_to_field = sole_to_field * poses.sole(side).inverse();
    let mut body = Body {
        joints,
        torso_to_field,
        soles_to_field: Feet {
            left: torso_to_field * poses.sole(Side::Left),
            right: torso_to_field * poses.sole(Side::Right),
        },
        center_of_mass: torso_to_field * poses.center_of_mass(),
        contact_forces: Feet {
            left: [0.0; 4],
            right: [0.0; 4],
        },
    };
    body.contact_forces = contact_forces(&body);
    body
}

/// The pose on the floor below a sole.
fn flat(sole: &Isometry3<f64>) -> Isometry3<f64> {
    planar(sole.translation.x, sole.translation.y, heading(sole))
}

fn other(side: Side) -> Side {
    match side {
        Side::Left => Side::Right,
        Side::Right => Side::Left,
    }
}

/// Height of the lowest point of a sole.
fn lowest(body: &Body, side: Side) -> f64 {
    let mirror = match side {
        Side::Left => 1.0,
        Side::Right => -1.0,
    };
    let outline =
        LEFT_SOLE.map(|[x, y]| body.soles_to_field.on(side) * Point3::new(x, mirror * y, 0.0));
    outline
        .iter()
        .map(|corner| corner.z)
        .fold(f64::INFINITY, f64::min)
}

/// The weight, shared between the soles and their resistors by where the centre of mass is.
fn contact_forces(body: &Body) -> Feet<[f64; 4]> {
    let weight = LINKS.iter().map(|link| link.mass.mass).sum::<f64>() + TORSO.mass;
    let touching = |side| (lowest(body, side) < TOUCHING).then_some(weight * GRAVITY);
    let on_left = match (touching(Side::Left), touching(Side::Right)) {
        (Some(_), None) => 1.0,
        (None, Some(_)) => 0.0,
        _ => {
            let Feet { left, right } = body.soles_to_field;
            let across = (left.translation.vector - right.translation.vector).xy();
            let from_right = (body.center_of_mass.coords - right.translation.vector).xy();
            (from_right.dot(&across) / across.norm_squared()).clamp(0.0, 1.0)
        }
    };
    let total = weight * GRAVITY;
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
    use nalgebra::Vector3;

    use super::*;
    use crate::posture;

    const TICK: Duration = Duration::from_millis(12);

    fn commands(positions: Joints<f64>, stiffness: f32) -> MotorCommands {
        MotorCommands {
            positions: positions.map(|angle| angle as f32),
            stiffnesses: Joints::filled(stiffness),
        }
    }

    #[test]
    fn joints_reach_their_targets_no_faster_than_they_can() {
        let mut physics = Kinematic::new(posture::sitting(), [0.0; 3]);
        let target = posture::standing();
        for _ in 0..200 {
            let before = physics.body().joints;
            let after = physics.advance(TICK, &commands(target, 0.7)).joints;
            for (joint, angle) in after.iter() {
                let speed = (angle - before[joint]).abs() / TICK.as_secs_f64();
                assert!(
                    speed <= limits::of(joint).velocity * 0.7 + 1e-9,
                    "{joint:?}: {speed}"
                );
            }
        }
        for (joint, angle) in physics.body().joints.iter() {
            assert!((angle - target[joint]).abs() < 1e-6, "{joint:?}");
        }
    }

    #[test]
    fn limp_joints_stay() {
        let mut physics = Kinematic::new(posture::sitting(), [0.0; 3]);
        physics.advance(TICK, &commands(posture::standing(), 0.0));
        assert_eq!(physics.body().joints, posture::sitting());
    }

    #[test]
    fn both_soles_of_a_standing_robot_are_on_the_floor() {
        let physics = Kinematic::new(posture::standing(), [1.0, -0.5, 2.0]);
        let body = physics.body();
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
            let forces = Kinematic::new(joints, [0.0; 3]).body().contact_forces;
            let sum: f64 = forces.left.iter().chain(&forces.right).sum();
            assert!((sum / GRAVITY - 5.35975).abs() < 1e-3, "{sum}");
        }
    }

    #[test]
    fn lifting_a_leg_moves_the_weight_to_the_other() {
        let mut physics = Kinematic::new(posture::standing(), [0.0; 3]);
        let mut joints = posture::standing();
        joints.left_knee_pitch += 0.4;
        joints.left_hip_pitch -= 0.2;
        joints.left_ankle_pitch -= 0.2;
        let before = physics.body().soles_to_field.right;
        for _ in 0..50 {
            physics.advance(TICK, &commands(joints, 1.0));
        }
        let body = physics.body();
        assert!(body.soles_to_field.left.translation.z > 0.003);
        assert_eq!(body.contact_forces.left, [0.0; 4]);
        let moved = body.soles_to_field.right.translation.vector - before.translation.vector;
        assert!(moved.norm() < 1e-3, "the standing foot slid by {moved}");
    }
}
