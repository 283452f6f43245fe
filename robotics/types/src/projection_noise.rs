//! Owns how well a place on the ground is known that a camera saw.
//!
//! Invariant: every covariance is symmetric and, in the precision of its numbers, positive definite: no axis of its ellipse
//! is more than a hundred times as long as the other.

use framework::{Reflect, math};
use nalgebra::{Matrix2, Matrix2x3, Matrix3x2, Point2, Vector3};
use serde::{Deserialize, Serialize};

use crate::camera::CameraMatrix;

/// Variance of the short axis, at least, in parts of the sum of both.
const LEAST_SHARE: f32 = 1e-4;

/// What is wrong on the way from a pixel to the ground, one standard deviation.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct ProjectionNoise {
    /// Of what is found in an image, along both axes.
    #[reflect(unit = "px", range = 0.0..)]
    pub pixel: f32,
    /// Of the camera's roll and pitch over the ground.
    #[reflect(unit = "rad", range = 0.0..)]
    pub angle: f32,
    /// Of everything else, along both axes of the ground.
    #[reflect(unit = "m", range = 0.0..)]
    pub ground: f32,
}

impl CameraMatrix {
    /// Covariance in m² of a place in the ground frame that is seen `height` m above the floor.
    ///
    /// Propagated to first order. `None` where the camera does not look down onto the place, or so flatly that numbers end.
    pub fn ground_covariance(
        &self,
        place: Point2<f32>,
        height: f32,
        noise: &ProjectionNoise,
    ) -> Option<Matrix2<f32>> {
        let ray = place.coords.push(height) - self.position().coords;
        let depth = (self.ground_to_camera.rotation * ray).z;
        if !(depth > 0.0 && ray.z < 0.0) {
            return None;
        }
        // Where the end of the ray moves on the plane, if the ray itself is moved.
        let on_plane = Matrix2x3::new(
            1.0,
            0.0,
            -ray.x / ray.z, //
            0.0,
            1.0,
            -ray.y / ray.z,
        );
        let focal = self.intrinsics.focal;
        let to_ground = self.ground_to_camera.rotation.inverse();
        let by_pixel = Matrix3x2::from_columns(&[
            to_ground * Vector3::new(depth / focal.x, 0.0, 0.0),
            to_ground * Vector3::new(0.0, depth / focal.y, 0.0),
        ]);
        let by_angle = Matrix3x2::from_columns(&[
            Vector3::x().cross(&ray),
            Vector3::y().cross(&ray), //
        ]);
        let variance = |by: Matrix3x2<f32>, deviation: f32| {
            let moved = on_plane * by * deviation;
            moved * moved.transpose()
        };
        let known = variance(by_pixel, noise.pixel) + variance(by_angle, noise.angle);
        let least = math::powi(noise.ground, 2) + LEAST_SHARE * known.trace();
        let covariance = (known + known.transpose()) * 0.5 + Matrix2::identity() * least;
        let is_usable = covariance.iter().all(|value| value.is_finite()) && least > 0.0;
        is_usable.then_some(covariance)
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{Isometry3, Matrix3, Point3, Rotation3, Translation3, UnitQuaternion, Vector2};

    use super::*;
    use crate::camera::Intrinsics;

    const NOISE: ProjectionNoise = ProjectionNoise {
        pixel: 1.0,
        angle: 0.01,
        ground: 0.005,
    };

    fn camera(height: f32, [roll, pitch, yaw]: [f32; 3]) -> CameraMatrix {
        let optical_to_level = Rotation3::from_matrix_unchecked(Matrix3::new(
            0.0, 0.0, 1.0, -1.0, 0.0, 0.0, 0.0, -1.0, 0.0,
        ));
        let rotation = UnitQuaternion::from_euler_angles(roll, pitch, yaw)
            * UnitQuaternion::from_rotation_matrix(&optical_to_level);
        let place = Translation3::new(0.0, 0.0, height);
        CameraMatrix {
            ground_to_camera: Isometry3::from_parts(place, rotation).inverse(),
            intrinsics: Intrinsics {
                focal: Vector2::new(608.0, 609.6),
                center: Vector2::new(320.0, 240.0),
            },
        }
    }

    /// Numbers from 0 to 1 without a pattern (Marsaglia 2003).
    struct Draw(u32);

    impl Draw {
        fn next(&mut self) -> f32 {
            self.0 ^= self.0 << 13;
            self.0 ^= self.0 >> 17;
            self.0 ^= self.0 << 5;
            self.0 as f32 / u32::MAX as f32
        }

        fn between(&mut self, low: f32, high: f32) -> f32 {
            low + (high - low) * self.next()
        }
    }

    #[test]
    fn every_place_that_is_seen_has_a_symmetric_positive_definite_covariance() {
        let mut draw = Draw(7);
        let mut seen = 0;
        for _ in 0..20_000 {
            let matrix = camera(
                draw.between(0.1, 0.8),
                [
                    draw.between(-0.5, 0.5),
                    draw.between(-0.6, 1.4),
                    draw.between(-3.0, 3.0),
                ],
            );
            let pixel = Point2::new(draw.between(0.0, 640.0), draw.between(0.0, 480.0));
            let height = draw.between(0.0, 0.09);
            let noise = ProjectionNoise {
                pixel: draw.between(0.1, 4.0),
                angle: draw.between(0.0, 0.05),
                ground: draw.between(0.0, 0.02),
            };
            let Some(place) = matrix.pixel_to_ground(pixel, height) else {
                continue;
            };
            let Some(covariance) = matrix.ground_covariance(place, height, &noise) else {
                continue;
            };
            seen += 1;
            assert_eq!(covariance, covariance.transpose());
            assert!(
                covariance.cholesky().is_some() && covariance.determinant() > 0.0,
                "{covariance} at {place}"
            );
        }
        assert!(seen > 10_000, "{seen}");
    }

    #[test]
    fn it_is_what_small_errors_do() {
        let angles = [0.05, 0.4, 0.3];
        let matrix = camera(0.5, angles);
        for (pixel, height) in [
            ((100.0, 300.0), 0.0),
            ((500.0, 400.0), 0.05),
            ((320.0, 240.0), 0.0),
        ] {
            let pixel = Point2::new(pixel.0, pixel.1);
            let place = matrix.pixel_to_ground(pixel, height).unwrap();
            let moved = |seen: &CameraMatrix, by: Vector2<f32>, error: f32| {
                (seen.pixel_to_ground(pixel + by, height).unwrap() - place) / error
            };
            // About the fixed axes of the ground.
            let turned = |axis: Vector3<f32>| {
                let turn = UnitQuaternion::from_scaled_axis(axis * 1e-3);
                let to_ground = matrix.ground_to_camera.inverse();
                let turned =
                    Isometry3::from_parts(to_ground.translation, turn * to_ground.rotation);
                let turned = CameraMatrix {
                    ground_to_camera: turned.inverse(),
                    ..matrix
                };
                moved(&turned, Vector2::zeros(), 1e-3) * NOISE.angle
            };
            let pixels = [Vector2::x(), Vector2::y()]
                .map(|by| moved(&matrix, by * 0.25, 0.25) * NOISE.pixel);
            let angles = [Vector3::x(), Vector3::y()].map(turned);
            let expected = pixels.iter().chain(&angles).fold(
                Matrix2::identity() * math::powi(NOISE.ground, 2),
                |sum, off| sum + off * off.transpose(),
            );
            let covariance = matrix.ground_covariance(place, height, &NOISE).unwrap();
            let off = (covariance - expected).norm() / expected.norm();
            assert!(off < 0.03, "{covariance} instead of {expected}");
        }
    }

    #[test]
    fn what_is_far_is_known_less_well_along_the_line_of_sight() {
        let matrix = camera(0.5, [0.0, 0.2, 0.0]);
        let at = |x: f32| {
            let covariance = matrix
                .ground_covariance(Point2::new(x, 0.0), 0.0, &NOISE)
                .unwrap();
            (covariance[(0, 0)], covariance[(1, 1)])
        };
        let (near, far) = (at(1.0), at(3.0));
        assert!(far.0 > 10.0 * near.0 && far.1 > near.1, "{near:?} {far:?}");
        assert!(far.0 > 10.0 * far.1, "{far:?}");
    }

    #[test]
    fn what_cannot_be_seen_has_none() {
        let matrix = camera(0.5, [0.0, 0.2, 0.0]);
        assert_eq!(
            matrix.ground_covariance(Point2::new(-1.0, 0.0), 0.0, &NOISE),
            None
        );
        assert_eq!(
            matrix.ground_covariance(Point2::new(1.0, 0.0), 0.6, &NOISE),
            None
        );
        assert_eq!(
            CameraMatrix::default().ground_covariance(Point2::origin(), 0.0, &NOISE),
            None
        );
        let exact = ProjectionNoise::default();
        assert_eq!(
            matrix.ground_covariance(Point2::new(1.0, 0.0), 0.0, &exact),
            None
        );
        let pixel = matrix.ground_to_pixel(Point3::new(1.0, 0.0, 0.0));
        assert!(pixel.is_some());
    }
}
