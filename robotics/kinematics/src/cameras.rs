//! Owns where the cameras sit in the head and how they see by default.

use nalgebra::{
    Isometry3, Matrix3, RealField, Rotation3, Translation3, UnitQuaternion, Vector3, convert,
};
use types::camera::{CameraCalibration, CameraPosition};

/// Width and height of the images in px.
pub const IMAGE_SIZE: [u32; 2] = [640, 480];

/// Images per second.
pub const IMAGE_RATE: f64 = 30.0;

/// Focal lengths in widths and heights of the image: the usual value of uncalibrated NAO V6 cameras.
pub const FOCAL_LENGTH: [f64; 2] = [0.95, 1.27];

/// Where the optical axis meets the image, in widths and heights of the image.
pub const OPTICAL_CENTER: [f64; 2] = [0.5, 0.5];

/// How a camera is mounted in the head (NAO V6 URDF, Aldebaran documentation).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mount {
    /// In the head frame, in m.
    pub position: [f64; 3],
    /// Rotation about y in rad, positive looks down.
    pub pitch: f64,
}

/// How one camera is mounted.
pub const fn mount(camera: CameraPosition) -> Mount {
    match camera {
        CameraPosition::Top => Mount {
            position: [0.05871, 0.0, 0.06364],
            pitch: 0.020943951,
        },
        CameraPosition::Bottom => Mount {
            position: [0.05071, 0.0, 0.01774],
            pitch: 0.692895713,
        },
    }
}

/// From the frame of a camera with x along its optical axis, y left, z up to the head frame.
pub fn camera_to_head<T: RealField + Copy>(camera: CameraPosition) -> Isometry3<T> {
    let Mount { position, pitch } = mount(camera);
    Isometry3::from_parts(
        Translation3::from(Vector3::from(position.map(convert))),
        UnitQuaternion::from_axis_angle(&Vector3::y_axis(), convert(pitch)),
    )
}

/// From the optical frame of a camera as it is calibrated to the head frame.
pub fn optical_to_head(camera: CameraPosition, calibration: &CameraCalibration) -> Isometry3<f32> {
    let CameraCalibration {
        roll, pitch, yaw, ..
    } = *calibration;
    let correction = UnitQuaternion::from_euler_angles(roll, pitch, yaw);
    let mount = camera_to_head(camera);
    let rotation = correction * mount.rotation * optical_to_camera();
    Isometry3::from_parts(mount.translation, rotation)
}

/// From an optical frame (z forward, x right, y down) to the same camera's x forward, y left, z up.
pub fn optical_to_camera<T: RealField + Copy>() -> UnitQuaternion<T> {
    let (zero, one) = (T::zero(), T::one());
    UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(Matrix3::new(
        zero, zero, one, //
        -one, zero, zero, //
        zero, -one, zero,
    )))
}
