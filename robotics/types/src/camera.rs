//! Owns the geometry of a camera: from the ground to pixels and back.
//!
//! A pinhole without distortion (Hartley and Zisserman, Multiple View Geometry, section 6.1). Pixels
//! count from the upper left corner, x to the right and y down; the centre of the pixel in row `y`,
//! column `x` is (x, y). Optical frame: origin in the focal point, z forward, x right, y down.
//! Ground frame: origin on the floor midway between the soles, x along the heading, z up.

use framework::{Clear, Reflect};
use nalgebra::{Isometry3, Point2, Point3, Vector2, Vector3};
use serde::{Deserialize, Serialize};

/// One of the two cameras in the head.
#[derive(Clear, Clone, Copy, Debug, Default, Deserialize, Eq, PartialEq, Reflect, Serialize)]
pub enum CameraPosition {
    /// In the forehead, looks ahead.
    #[default]
    Top,
    /// In the mouth, looks down in front of the feet.
    Bottom,
}

/// How a camera maps directions to pixels.
#[derive(Clear, Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
pub struct Intrinsics {
    /// Focal lengths along x and y in px.
    pub focal: Vector2<f32>,
    /// Where the optical axis meets the image, in px.
    pub center: Vector2<f32>,
}

/// What can be calibrated about one camera.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct CameraCalibration {
    /// Focal length along x, in widths of the image.
    pub focal_x: f32,
    /// Focal length along y, in heights of the image.
    pub focal_y: f32,
    /// Where the optical axis meets the image, in widths of the image.
    pub center_x: f32,
    /// Where the optical axis meets the image, in heights of the image.
    pub center_y: f32,
    /// Width of the images in px.
    pub width: f32,
    /// Height of the images in px.
    pub height: f32,
    /// Rotation of the real camera against its nominal mount about x of the head frame, in rad.
    pub roll: f32,
    /// Rotation of the real camera against its nominal mount about y of the head frame, in rad.
    pub pitch: f32,
    /// Rotation of the real camera against its nominal mount about z of the head frame, in rad.
    pub yaw: f32,
}

/// Where a camera was and what it saw there.
#[derive(Clear, Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
pub struct CameraMatrix {
    /// From the ground frame to the optical frame.
    pub ground_to_camera: Isometry3<f32>,
    /// How directions become pixels.
    pub intrinsics: Intrinsics,
}

/// The matrices of both cameras at one time.
#[derive(Clear, Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
pub struct CameraMatrices {
    /// Of the top camera.
    pub top: CameraMatrix,
    /// Of the bottom camera.
    pub bottom: CameraMatrix,
}

/// The pixels whose rays never meet the floor nor leave it: `y = at_left + slope * x`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Horizon {
    /// Row in px at x = 0.
    pub at_left: f32,
    /// Rows per column.
    pub slope: f32,
}

impl CameraCalibration {
    /// The intrinsics in pixels.
    pub fn intrinsics(&self) -> Intrinsics {
        Intrinsics {
            focal: Vector2::new(self.focal_x * self.width, self.focal_y * self.height),
            center: Vector2::new(self.center_x * self.width, self.center_y * self.height),
        }
    }
}

impl Intrinsics {
    /// The pixel that shows a point of the optical frame in m; `None` behind the camera.
    pub fn project(&self, point: Point3<f32>) -> Option<Point2<f32>> {
        let pixel = self.focal.component_mul(&(point.xy().coords / point.z)) + self.center;
        (point.z > 0.0 && is_finite(pixel)).then(|| pixel.into())
    }

    /// The direction in the optical frame of what a pixel shows; its z is 1.
    pub fn ray(&self, pixel: Point2<f32>) -> Vector3<f32> {
        (pixel.coords - self.center)
            .component_div(&self.focal)
            .push(1.0)
    }
}

impl CameraMatrix {
    /// The pixel that shows a point of the ground frame; `None` behind the camera.
    pub fn ground_to_pixel(&self, point: Point3<f32>) -> Option<Point2<f32>> {
        self.intrinsics.project(self.ground_to_camera * point)
    }

    /// Where the ray of a pixel meets the plane `height` m above the floor, in the ground frame.
    ///
    /// `None` where the ray does not come down to it: above the horizon.
    pub fn pixel_to_ground(&self, pixel: Point2<f32>, height: f32) -> Option<Point2<f32>> {
        let camera = self.position();
        let ray = self.ground_to_camera.rotation.inverse() * self.intrinsics.ray(pixel);
        let distance = (height - camera.z) / ray.z;
        let point = (camera + ray * distance).xy();
        (distance > 0.0 && is_finite(point.coords)).then_some(point)
    }

    /// Radius in px of a ball of that `radius` in m with its centre at `center` in the ground frame.
    ///
    /// Exact on the optical axis; elsewhere the ellipse is a little longer than this. `None` where the
    /// ball is behind the camera or around it.
    pub fn pixel_radius(&self, center: Point3<f32>, radius: f32) -> Option<f32> {
        let seen = self.ground_to_camera * center;
        let tangent = seen.coords.norm_squared() - radius * radius;
        (seen.z > 0.0 && tangent > 0.0).then(|| self.intrinsics.focal.y * radius / tangent.sqrt())
    }

    /// The horizon; `None` where the camera looks straight up or down, or is rolled by 90°.
    pub fn horizon(&self) -> Option<Horizon> {
        // A ray is level where its z in the ground frame vanishes: up · ray = 0.
        let up = self.ground_to_camera.rotation * Vector3::z();
        let Intrinsics { focal, center } = self.intrinsics;
        let per_column = up.x / focal.x;
        let per_row = up.y / focal.y;
        let horizon = Horizon {
            at_left: center.y + (per_column * center.x - up.z) / per_row,
            slope: -per_column / per_row,
        };
        is_finite(Vector2::new(horizon.at_left, horizon.slope)).then_some(horizon)
    }

    /// Where the camera is in the ground frame, in m.
    pub fn position(&self) -> Point3<f32> {
        self.ground_to_camera
            .inverse_transform_point(&Point3::origin())
    }
}

impl CameraMatrices {
    /// The matrix of one camera.
    pub fn of(&self, position: CameraPosition) -> &CameraMatrix {
        match position {
            CameraPosition::Top => &self.top,
            CameraPosition::Bottom => &self.bottom,
        }
    }
}

impl Horizon {
    /// Row in px at a column.
    pub fn at(&self, x: f32) -> f32 {
        self.at_left + self.slope * x
    }
}

fn is_finite(values: Vector2<f32>) -> bool {
    values.x.is_finite() && values.y.is_finite()
}

#[cfg(test)]
mod tests {
    use framework::math;
    use nalgebra::{Rotation3, Translation3, UnitQuaternion};

    use super::*;

    /// Half a metre above the origin, looking along x of the ground and `pitch` down.
    fn looking_down(pitch: f32, roll: f32) -> CameraMatrix {
        let optical_to_level = Rotation3::from_matrix_unchecked(nalgebra::Matrix3::new(
            0.0, 0.0, 1.0, -1.0, 0.0, 0.0, 0.0, -1.0, 0.0,
        ));
        let camera_to_ground = Isometry3::from_parts(
            Translation3::new(0.0, 0.0, 0.5),
            UnitQuaternion::from_euler_angles(roll, pitch, 0.0)
                * UnitQuaternion::from_rotation_matrix(&optical_to_level),
        );
        CameraMatrix {
            ground_to_camera: camera_to_ground.inverse(),
            intrinsics: Intrinsics {
                focal: Vector2::new(608.0, 609.6),
                center: Vector2::new(320.0, 240.0),
            },
        }
    }

    #[test]
    fn the_optical_axis_meets_the_floor_where_trigonometry_says() {
        let matrix = looking_down(0.5, 0.0);
        let point = matrix
            .pixel_to_ground(Point2::new(320.0, 240.0), 0.0)
            .unwrap();
        assert!((point.x - 0.5 / math::tan(0.5_f32)).abs() < 1e-4, "{point}");
        assert!(point.y.abs() < 1e-5);
    }

    #[test]
    fn left_on_the_ground_is_left_in_the_image() {
        let matrix = looking_down(0.3, 0.0);
        let pixel = matrix.ground_to_pixel(Point3::new(1.0, 0.2, 0.0)).unwrap();
        assert!(pixel.x < 320.0, "{pixel}");
    }

    #[test]
    fn the_ground_is_found_again_through_its_pixel() {
        let matrix = looking_down(0.4, 0.1);
        for (x, y, height) in [(1.0, 0.3, 0.0), (0.6, -0.2, 0.05), (3.0, 1.0, 0.05)] {
            let pixel = matrix.ground_to_pixel(Point3::new(x, y, height)).unwrap();
            let ground = matrix.pixel_to_ground(pixel, height).unwrap();
            assert!((ground - Point2::new(x, y)).norm() < 1e-3, "{ground}");
        }
    }

    #[test]
    fn above_the_horizon_there_is_no_ground() {
        let matrix = looking_down(0.2, 0.15);
        let horizon = matrix.horizon().unwrap();
        for x in [0.0, 320.0, 639.0] {
            let row = horizon.at(x);
            assert_eq!(matrix.pixel_to_ground(Point2::new(x, row - 1.0), 0.0), None);
            assert!(
                matrix
                    .pixel_to_ground(Point2::new(x, row + 1.0), 0.0)
                    .is_some()
            );
        }
    }

    #[test]
    fn behind_the_camera_there_is_no_pixel() {
        let matrix = looking_down(0.2, 0.0);
        assert_eq!(matrix.ground_to_pixel(Point3::new(-1.0, 0.0, 0.0)), None);
        assert_eq!(matrix.pixel_radius(Point3::new(-1.0, 0.0, 0.0), 0.05), None);
    }

    #[test]
    fn a_ball_on_the_optical_axis_has_the_radius_of_its_tangent() {
        let matrix = looking_down(0.0, 0.0);
        let radius = matrix
            .pixel_radius(Point3::new(1.0, 0.0, 0.5), 0.05)
            .unwrap();
        assert!(
            (radius - 609.6 * math::tan(math::asin(0.05_f32))).abs() < 1e-2,
            "{radius}"
        );
    }

    #[test]
    fn a_default_matrix_answers_nothing() {
        let matrix = CameraMatrix::default();
        assert_eq!(matrix.horizon(), None);
        assert_eq!(matrix.pixel_to_ground(Point2::new(1.0, 1.0), 0.0), None);
    }
}
