//! Owns the shape of the body around its bones: balls in the torso frame.

use kinematics::feet::{LEFT_SOLE, SOLE_BELOW_ANKLE, sole_outline};
use kinematics::links::LinkName;
use nalgebra::{Isometry3, Point3, Vector3};
use types::feet::Side;
use types::robot_kinematics::RobotKinematics;

use super::LimbProjectorParameters;

/// How many balls a bone carries.
const BALLS: usize = 5;
/// Corners of a sole, below and at the top of the foot's shell; no part has more balls.
pub(super) const FOOT_CORNERS: usize = 2 * LEFT_SOLE.len();

/// A limb as a cloud of balls.
pub(super) struct Part {
    balls: [Point3<f32>; FOOT_CORNERS],
    count: usize,
    /// Of each ball, m.
    pub(super) radius: f32,
}

impl Part {
    /// Centres in the torso frame, m.
    pub(super) fn balls(&self) -> &[Point3<f32>] {
        &self.balls[..self.count]
    }

    fn bone(from: Point3<f32>, to: Point3<f32>, radius: f32) -> Self {
        let mut balls = [Point3::origin(); FOOT_CORNERS];
        for (index, ball) in balls.iter_mut().take(BALLS).enumerate() {
            *ball = from + (to - from) * (index as f32 / (BALLS - 1) as f32);
        }
        Self {
            balls,
            count: BALLS,
            radius,
        }
    }

    fn foot(sole_to_torso: &Isometry3<f32>, side: Side, height: f32) -> Self {
        let mut balls = [Point3::origin(); FOOT_CORNERS];
        for (corner, below) in sole_outline(side).into_iter().enumerate() {
            balls[2 * corner] = sole_to_torso * below;
            balls[2 * corner + 1] = sole_to_torso * (below + Vector3::z() * height);
        }
        Self {
            balls,
            count: FOOT_CORNERS,
            radius: 0.0,
        }
    }
}

/// All parts that a camera can see.
pub(super) fn parts(
    kinematics: &RobotKinematics,
    parameters: &LimbProjectorParameters,
) -> impl Iterator<Item = Part> {
    let legs = [Side::Left, Side::Right].map(|side| leg(kinematics, parameters, side));
    let arms = [Side::Left, Side::Right].map(|side| arm(kinematics, parameters, side));
    let legs = legs.into_iter().flatten();
    legs.chain(arms.into_iter().flatten())
        .chain([chest(parameters)])
}

fn leg(
    kinematics: &RobotKinematics,
    parameters: &LimbProjectorParameters,
    side: Side,
) -> [Part; 3] {
    let hip = match side {
        Side::Left => LinkName::LeftPelvis,
        Side::Right => LinkName::RightPelvis,
    };
    let knee = origin(kinematics.knees_to_torso.on(side));
    let sole = kinematics.soles_to_torso.on(side);
    let ankle = sole * Point3::new(0.0, 0.0, SOLE_BELOW_ANKLE as f32);
    [
        Part::bone(joint(hip), knee, parameters.thigh_radius),
        Part::bone(knee, ankle, parameters.shin_radius),
        Part::foot(sole, side, parameters.foot_height),
    ]
}

fn arm(
    kinematics: &RobotKinematics,
    parameters: &LimbProjectorParameters,
    side: Side,
) -> [Part; 2] {
    let (shoulder, elbow, hand) = match side {
        Side::Left => (
            LinkName::LeftShoulder,
            &kinematics.elbows_to_torso.left,
            &kinematics.hands_to_torso.left,
        ),
        Side::Right => (
            LinkName::RightShoulder,
            &kinematics.elbows_to_torso.right,
            &kinematics.hands_to_torso.right,
        ),
    };
    let elbow = origin(elbow);
    let fingers = hand * Point3::new(parameters.finger_length, 0.0, 0.0);
    [
        Part::bone(joint(shoulder), elbow, parameters.arm_radius),
        Part::bone(elbow, fingers, parameters.arm_radius),
    ]
}

/// Only the edge that the cameras see; no ball around it, it is too near to them.
fn chest(parameters: &LimbProjectorParameters) -> Part {
    let LimbProjectorParameters {
        chest_depth,
        chest_half_width,
        chest_height,
        ..
    } = *parameters;
    let from = Point3::new(chest_depth, chest_half_width, chest_height);
    let to = Point3::new(chest_depth, -chest_half_width, chest_height);
    Part::bone(from, to, 0.0)
}

/// Where the joint is that carries a link of the torso, in the torso frame, m.
fn joint(link: LinkName) -> Point3<f32> {
    Point3::from(link.origin().map(|component| component as f32))
}

fn origin(pose: &Isometry3<f32>) -> Point3<f32> {
    pose * Point3::from(Vector3::zeros())
}
