//! Between the engine's mathematics and everybody else's.

use nalgebra::{Isometry3, Quaternion, Translation3, UnitQuaternion, Vector3};
use rapier3d_f64::math::{Matrix, Pose, Rotation};
use rapier3d_f64::prelude::Vector;

pub(super) fn to_vector(vector: &Vector3<f64>) -> Vector {
    Vector::new(vector.x, vector.y, vector.z)
}

pub(super) fn vector(vector: Vector) -> Vector3<f64> {
    Vector3::new(vector.x, vector.y, vector.z)
}

pub(super) fn to_pose(pose: &Isometry3<f64>) -> Pose {
    let rotation = pose.rotation.quaternion();
    Pose::from_parts(
        to_vector(&pose.translation.vector),
        Rotation::from_xyzw(rotation.i, rotation.j, rotation.k, rotation.w),
    )
}

pub(super) fn isometry(pose: &Pose) -> Isometry3<f64> {
    let rotation = pose.rotation;
    let quaternion = Quaternion::new(rotation.w, rotation.x, rotation.y, rotation.z);
    Isometry3::from_parts(
        Translation3::from(vector(pose.translation)),
        UnitQuaternion::from_quaternion(quaternion),
    )
}

/// From the moments xx, yy, zz, xy, xz, yz.
pub(super) fn inertia([xx, yy, zz, xy, xz, yz]: [f64; 6]) -> Matrix {
    Matrix::from_cols(
        Vector::new(xx, xy, xz),
        Vector::new(xy, yy, yz),
        Vector::new(xz, yz, zz),
    )
}
