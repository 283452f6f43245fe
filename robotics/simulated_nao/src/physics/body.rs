//! The state of one robot's body, and how it stands on the floor.

use framework::math;
use kinematics::feet::sole_outline;
use kinematics::inertial::GRAVITY;
use kinematics::links::{LINKS, TORSO};
use kinematics::{Poses, forward_kinematics};
use nalgebra::{Isometry3, Point3, Vector3};
use types::feet::{Feet, Side};
use types::joints::Joints;

/// How a robot begins.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Start {
    /// Angles in rad; hands from 0 to 1.
    pub joints: Joints<f64>,
    /// Of its ground frame in the field frame: x and y in m, heading in rad.
    pub pose: [f64; 3],
}

/// The state of a robot's body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Body {
    /// Angles in rad; hands from 0 to 1.
    pub joints: Joints<f64>,
    /// From the torso frame to the field frame.
    pub torso_to_field: Isometry3<f64>,
    /// From the sole frames to the field frame.
    pub soles_to_field: Feet<Isometry3<f64>>,
    /// Centre of mass in the field frame, m.
    pub center_of_mass: Point3<f64>,
    /// Forces on the resistors front left, front right, rear left, rear right, in N.
    pub contact_forces: Feet<[f64; 4]>,
    /// How fast the torso turns, in the torso frame, rad/s.
    pub angular_velocity: Vector3<f64>,
    /// What the accelerometer feels (gravity upwards while it rests), in the torso frame, m/s².
    pub proper_acceleration: Vector3<f64>,
}

impl Body {
    /// A body at rest and without weight on its soles whose torso is there.
    pub fn new(joints: Joints<f64>, torso_to_field: Isometry3<f64>) -> Self {
        Self::from_poses(joints, &forward_kinematics(&joints), torso_to_field)
    }

    /// As [`Body::new`], with the poses that the joints give.
    pub(super) fn from_poses(
        joints: Joints<f64>,
        poses: &Poses<f64>,
        torso_to_field: Isometry3<f64>,
    ) -> Self {
        let up = torso_to_field.rotation.inverse() * Vector3::z();
        Self {
            joints,
            torso_to_field,
            soles_to_field: Feet {
                left: torso_to_field * poses.sole(Side::Left),
                right: torso_to_field * poses.sole(Side::Right),
            },
            center_of_mass: torso_to_field * poses.center_of_mass(),
            contact_forces: Feet::default(),
            angular_velocity: Vector3::zeros(),
            proper_acceleration: up * GRAVITY,
        }
    }

    /// The body with one sole at a pose.
    pub(super) fn on_sole(
        joints: Joints<f64>,
        poses: &Poses<f64>,
        side: Side,
        sole_to_field: &Isometry3<f64>,
    ) -> Self {
        Self::from_poses(joints, poses, sole_to_field * poses.sole(side).inverse())
    }

    /// A robot whose lower sole stands flat on the floor.
    pub fn standing(start: &Start) -> Self {
        let Start { joints, pose } = start;
        let poses = forward_kinematics(joints);
        let on = |side| {
            let [x, y, heading] = *pose;
            let somewhere = Self::on_sole(*joints, &poses, side, &Isometry3::identity());
            let to_field = planar(x, y, heading) * somewhere.ground_to_field().inverse();
            let sole = to_field * somewhere.soles_to_field.on(side);
            Self::on_sole(*joints, &poses, side, &flat(&sole))
        };
        let left = on(Side::Left);
        if left.lowest(Side::Right) < 0.0 {
            let right = on(Side::Right);
            if right.lowest(Side::Left) > left.lowest(Side::Right) {
                return right;
            }
        }
        left
    }

    /// A robot that is held upright, whatever its legs do; the lower foot just touches the floor.
    pub(super) fn held(start: &Start) -> Self {
        let [x, y, heading] = start.pose;
        let poses = forward_kinematics(&start.joints);
        let upright = Self::from_poses(start.joints, &poses, Isometry3::identity());
        let lowest = upright.lowest(Side::Left).min(upright.lowest(Side::Right));
        let mut torso_to_field = planar(x, y, heading) * upright.ground_to_field().inverse();
        torso_to_field.translation.z -= lowest;
        Self::from_poses(start.joints, &poses, torso_to_field)
    }

    /// The ground frame in the field frame: on the floor midway between the soles, x along the
    /// heading of the torso.
    pub fn ground_to_field(&self) -> Isometry3<f64> {
        let Feet { left, right } = &self.soles_to_field;
        let middle = (left.translation.vector + right.translation.vector) / 2.0;
        planar(middle.x, middle.y, heading(&self.torso_to_field))
    }

    /// How far the torso leans, in rad.
    pub fn tilt(&self) -> f64 {
        let up = self.torso_to_field.rotation * Vector3::z();
        math::acos(up.z.clamp(-1.0, 1.0))
    }

    /// Height of the lowest point of a sole, m.
    pub(super) fn lowest(&self, side: Side) -> f64 {
        let outline = sole_outline::<f64>(side).map(|corner| self.soles_to_field.on(side) * corner);
        outline
            .iter()
            .map(|corner| corner.z)
            .fold(f64::INFINITY, f64::min)
    }
}

/// The weight of a robot in N.
pub fn weight() -> f64 {
    (LINKS.iter().map(|link| link.mass.mass).sum::<f64>() + TORSO.mass) * GRAVITY
}

/// The pose on the floor below a sole.
pub(super) fn flat(sole: &Isometry3<f64>) -> Isometry3<f64> {
    planar(sole.translation.x, sole.translation.y, heading(sole))
}

/// A pose on the floor.
pub(super) fn planar(x: f64, y: f64, heading: f64) -> Isometry3<f64> {
    Isometry3::new(Vector3::new(x, y, 0.0), Vector3::z() * heading)
}

/// The direction of a frame's x axis on the floor, in rad.
pub(crate) fn heading(pose: &Isometry3<f64>) -> f64 {
    let forward = pose.rotation * Vector3::x();
    math::atan2(forward.y, forward.x)
}
