//! Owns inverse kinematics of the legs: from where the soles shall be to the angles of the joints, in closed form.
//!
//! The hip's first axis is tilted by 45° and both legs share its motor. A frame that is tilted with it makes the rest of a
//! leg an ordinary one: yaw, roll, pitch at one point, a knee, and two axes at one point in the ankle.

use nalgebra::{Isometry3, Point3, RealField, Translation3, UnitQuaternion, Vector3, convert};
use types::feet::{Feet, Side};
use types::joints::Joints;

use crate::feet::SOLE_BELOW_ANKLE;
use crate::links::LinkName;

/// From the hip to the knee, in m (NAO V6 URDF).
pub const THIGH: f64 = -LinkName::LeftTibia.origin()[2];

/// From the knee to the ankle, in m (NAO V6 URDF).
pub const TIBIA: f64 = -LinkName::LeftAnkle.origin()[2];

/// Angles of one leg below the shared motor, in rad.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LegAngles<T> {
    pub hip_roll: T,
    pub hip_pitch: T,
    pub knee_pitch: T,
    pub ankle_pitch: T,
    pub ankle_roll: T,
}

/// Angles of both legs, in rad.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LegsAngles<T> {
    pub hip_yaw_pitch: T,
    pub legs: Feet<LegAngles<T>>,
    /// Whether the ankle is where it was asked to be. Else the leg points there, stretched or as far bent as its bones
    /// allow, and the sole has the orientation that was asked for.
    pub is_reached: Feet<bool>,
}

/// The angles that bring both soles to these poses in the torso frame.
///
/// `left_share` says whose yaw the shared motor follows, from 0 (the right foot's) to 1 (the left foot's). Where the yaws of
/// the feet are no mirror images, soles stay where they were asked for and turn about themselves. Limits of joints are not
/// looked at: that is [`crate::limits::clamp`].
pub fn leg_angles<T: RealField + Copy>(
    soles_to_torso: &Feet<Isometry3<T>>,
    left_share: T,
) -> LegsAngles<T> {
    let left = foot_to_pelvis(Side::Left, &soles_to_torso.left);
    let right = foot_to_pelvis(Side::Right, &soles_to_torso.right);
    let wanted = (yaw(Side::Left, &left), yaw(Side::Right, &right));
    let hip_yaw_pitch = wanted.0 * left_share + wanted.1 * (T::one() - left_share);
    let (left, is_left_reached) = below_yaw(Side::Left, hip_yaw_pitch, &left);
    let (right, is_right_reached) = below_yaw(Side::Right, hip_yaw_pitch, &right);
    LegsAngles {
        hip_yaw_pitch,
        legs: Feet { left, right },
        is_reached: Feet {
            left: is_left_reached,
            right: is_right_reached,
        },
    }
}

impl<T: Copy> LegsAngles<T> {
    /// Puts the legs into a pose of the whole body.
    pub fn write_to(&self, joints: &mut Joints<T>) {
        let Feet { left, right } = self.legs;
        joints.hip_yaw_pitch = self.hip_yaw_pitch;
        joints.left_hip_roll = left.hip_roll;
        joints.left_hip_pitch = left.hip_pitch;
        joints.left_knee_pitch = left.knee_pitch;
        joints.left_ankle_pitch = left.ankle_pitch;
        joints.left_ankle_roll = left.ankle_roll;
        joints.right_hip_roll = right.hip_roll;
        joints.right_hip_pitch = right.hip_pitch;
        joints.right_knee_pitch = right.knee_pitch;
        joints.right_ankle_pitch = right.ankle_pitch;
        joints.right_ankle_roll = right.ankle_roll;
    }
}

/// 1 on the left, -1 on the right.
fn outward<T: RealField>(side: Side) -> T {
    match side {
        Side::Left => T::one(),
        Side::Right => -T::one(),
    }
}

fn about_x<T: RealField + Copy>(angle: T) -> UnitQuaternion<T> {
    UnitQuaternion::from_axis_angle(&Vector3::x_axis(), angle)
}

fn about_y<T: RealField + Copy>(angle: T) -> UnitQuaternion<T> {
    UnitQuaternion::from_axis_angle(&Vector3::y_axis(), angle)
}

fn about_z<T: RealField + Copy>(angle: T) -> UnitQuaternion<T> {
    UnitQuaternion::from_axis_angle(&Vector3::z_axis(), angle)
}

/// The frame after `AnkleRoll` in that of the hip, turned so that its z is the axis of the shared motor.
fn foot_to_pelvis<T: RealField + Copy>(side: Side, sole_to_torso: &Isometry3<T>) -> Isometry3<T> {
    let hip = Translation3::from(hip(side));
    let ankle_to_sole = Translation3::new(T::zero(), T::zero(), convert(SOLE_BELOW_ANKLE));
    about_x(-outward::<T>(side) * T::frac_pi_4()) * hip.inverse() * sole_to_torso * ankle_to_sole
}

/// Roll within a quarter turn, and pitch, between the z axis and a direction.
fn towards<T: RealField + Copy>(direction: Vector3<T>) -> (T, T) {
    let sign = if direction.z < T::zero() {
        -T::one()
    } else {
        T::one()
    };
    let roll = (sign * direction.y).atan2(sign * direction.z);
    let pitch = direction.x.atan2(sign * direction.y.hypot(direction.z));
    (roll, pitch)
}

/// The angle of the shared motor with which the axis of the ankle's roll can have the orientation of the foot.
fn yaw<T: RealField + Copy>(side: Side, foot: &Isometry3<T>) -> T {
    // The hip as the foot sees it: ankle roll and pitch are chosen so that the leg points there.
    let (roll, pitch) = towards(foot.inverse().translation.vector);
    let axis = foot.rotation * about_x(-roll) * about_y(pitch) * Vector3::y();
    -outward::<T>(side) * (-axis.x).atan2(axis.y)
}

/// The angles below the shared motor, and whether the ankle is in reach.
fn below_yaw<T: RealField + Copy>(
    side: Side,
    hip_yaw_pitch: T,
    foot: &Isometry3<T>,
) -> (LegAngles<T>, bool) {
    let outward = outward::<T>(side);
    let foot = about_z(outward * hip_yaw_pitch) * foot;
    let ankle = foot.translation.vector;
    let (roll, pitch) = towards(-ankle);
    let roll = -roll;
    let (thigh, tibia) = (convert::<f64, T>(THIGH), convert::<f64, T>(TIBIA));
    let length = ankle.norm();
    let (at_hip, is_hip_right) = opposite(tibia, thigh, length);
    let (at_ankle, is_ankle_right) = opposite(thigh, tibia, length);
    let level = about_y(-pitch) * about_x(-roll) * foot.rotation * Vector3::z();
    let angles = LegAngles {
        hip_roll: roll + outward * T::frac_pi_4(),
        hip_pitch: pitch - at_hip,
        knee_pitch: at_hip + at_ankle,
        ankle_pitch: level.x.atan2(level.z) - at_ankle,
        ankle_roll: (-level.y).clamp(-T::one(), T::one()).asin(),
    };
    (angles, is_hip_right && is_ankle_right)
}

/// The angle of a triangle that lies opposite of one side, and whether there is such a triangle.
fn opposite<T: RealField + Copy>(side: T, neighbour: T, other: T) -> (T, bool) {
    let two = T::one() + T::one();
    // The ankle in the hip: any angle is as good.
    let other = other.max(convert(1.0e-9));
    let cosine = (neighbour * neighbour + other * other - side * side) / (two * neighbour * other);
    // A stretched leg is one whose rounding asks for a little more.
    let is_one = cosine.abs() <= T::one() + convert(1.0e-6);
    (cosine.clamp(-T::one(), T::one()).acos(), is_one)
}

/// Where the hip is in the torso frame, in m.
pub fn hip<T: RealField + Copy>(side: Side) -> Point3<T> {
    let pelvis = match side {
        Side::Left => LinkName::LeftPelvis,
        Side::Right => LinkName::RightPelvis,
    };
    Point3::from(pelvis.origin().map(convert::<f64, T>))
}
