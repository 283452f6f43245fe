//! What is really the case in the world, for tests: nodes see only what sensors and cameras say.

use framework::Timestamp;
use nalgebra::{Isometry3, Point2, Point3};
use types::camera::CameraMatrix;
use types::joints::Joints;
use types::motor_commands::MotorCommands;

use crate::camera::{Exposure, HEIGHT, WIDTH};
use crate::field::{BALL_RADIUS, LENGTH, PENALTY_MARK_DISTANCE};
use crate::world::World;

/// The world at one moment.
#[derive(Clone, Copy, Debug)]
pub struct GroundTruth {
    /// The moment.
    pub now: Timestamp,
    /// Angles in rad; hands from 0 to 1.
    pub positions: Joints<f32>,
    /// What the motors were told last.
    pub commands: MotorCommands,
    /// From the torso frame to the field frame.
    pub torso_to_field: Isometry3<f32>,
    /// From the ground frame (on the floor midway between the soles) to the field frame.
    pub ground_to_field: Isometry3<f32>,
    /// Centre of the ball in the field frame, m.
    pub ball: Option<Point3<f32>>,
}

/// The body when a state was sent.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyTruth {
    /// When.
    pub at: Timestamp,
    /// Angles in rad; hands from 0 to 1.
    pub positions: Joints<f32>,
    /// What the motors are told from then on.
    pub commands: MotorCommands,
}

/// A camera at the exposure of an image.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ImageTruth {
    /// The exposure; the timestamp of the cycle that is about this image.
    pub captured_at: Timestamp,
    /// Where the camera was.
    pub camera_matrix: CameraMatrix,
    /// From the ground frame to the field frame.
    pub ground_to_field: Isometry3<f32>,
    /// The ball, if some of it can be in front of the camera.
    pub ball: Option<BallTruth>,
}

/// Where an image shows the ball.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BallTruth {
    /// Its centre, px; may lie outside of the image.
    pub center: Point2<f32>,
    /// Its radius, px.
    pub radius: f32,
    /// From the camera to its centre, m.
    pub distance: f32,
    /// Whether all of it is in the image.
    pub is_whole: bool,
}

impl GroundTruth {
    pub(crate) fn new(world: &World) -> Self {
        let body = world.body();
        Self {
            now: world.now(),
            positions: body.joints.map(|angle| angle as f32),
            commands: *world.commands(),
            torso_to_field: body.torso_to_field.cast(),
            ground_to_field: body.ground_to_field().cast(),
            ball: world.ball().map(|ball| ball.cast()),
        }
    }
}

impl ImageTruth {
    /// The pixel that shows a point of the field frame (m); `None` outside of the image.
    pub fn project(&self, point: Point3<f32>) -> Option<Point2<f32>> {
        let pixel = self
            .camera_matrix
            .ground_to_pixel(self.ground_to_field.inverse() * point)?;
        is_inside(&pixel, 0.0).then_some(pixel)
    }

    /// The penalty marks, on the floor of the field frame.
    pub fn penalty_marks() -> [Point3<f32>; 2] {
        [1.0, -1.0].map(|side| Point3::new(side * (LENGTH / 2.0 - PENALTY_MARK_DISTANCE), 0.0, 0.0))
    }
}

impl From<&Exposure> for ImageTruth {
    fn from(exposure: &Exposure) -> Self {
        let field_to_camera = exposure.camera_to_field.inverse();
        let ball = exposure.ball_in_camera().and_then(|center| {
            let pixel = exposure.intrinsics.project(center)?;
            let distance = center.coords.norm();
            let tangent = (distance * distance - BALL_RADIUS * BALL_RADIUS)
                .max(1e-6)
                .sqrt();
            let radius = exposure.intrinsics.focal.y * BALL_RADIUS / tangent;
            let is_whole = is_inside(&pixel, 1.1 * radius);
            Some(BallTruth {
                center: pixel,
                radius,
                distance,
                is_whole,
            })
        });
        Self {
            captured_at: exposure.captured_at,
            camera_matrix: CameraMatrix {
                ground_to_camera: field_to_camera * exposure.ground_to_field,
                intrinsics: exposure.intrinsics,
            },
            ground_to_field: exposure.ground_to_field,
            ball,
        }
    }
}

fn is_inside(pixel: &Point2<f32>, margin: f32) -> bool {
    let inside = |at: f32, size: usize| at >= margin && at <= size as f32 - 1.0 - margin;
    inside(pixel.x, WIDTH) && inside(pixel.y, HEIGHT)
}
