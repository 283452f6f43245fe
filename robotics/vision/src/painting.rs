//! Paints images for tests: a coloured floor and upright boards, as a camera on a robot sees them.

use framework::pool::Leased;
use framework::testing::{AdditionalProbe, ParameterFile};
use nalgebra::{Isometry3, Matrix3, Point2, Rotation3, Translation3, UnitQuaternion, Vector2};
use types::camera::{CameraMatrix, Intrinsics};
use types::field_features::{FieldBorder, LineSegment};
use types::image::{Yuv, YuyvImage};
use types::limbs::LimbMask;
use types::projection_noise::ProjectionNoise;

use crate::field_color::tests::{GREEN, field_color};
use crate::image_segmenter::{self, ImageSegmenter, ScanSteps};
use crate::line_detection::{self, LineDetection};
use crate::segments::ImageSegments;

pub(crate) const WHITE: [u8; 3] = [210, 212, 210];
/// One standard deviation of everything.
pub(crate) const PROJECTION_NOISE: ProjectionNoise = ProjectionNoise {
    pixel: 1.0,
    angle: 0.01,
    ground: 0.005,
};

pub(crate) const GREY: [u8; 3] = [130, 120, 110];

/// An upright rectangle across the line of sight.
pub(crate) struct Board {
    /// Ahead of the robot, m.
    pub(crate) x: f32,
    /// From right to left, m.
    pub(crate) y: std::ops::Range<f32>,
    /// Lower and upper edge, m.
    pub(crate) z: std::ops::Range<f32>,
}

/// Half a metre above the origin, looking along x of the ground and `pitch` down.
pub(crate) fn camera_matrix(pitch: f32) -> CameraMatrix {
    let optical_to_level = Rotation3::from_matrix_unchecked(Matrix3::new(
        0.0, 0.0, 1.0, -1.0, 0.0, 0.0, 0.0, -1.0, 0.0,
    ));
    let rotation = UnitQuaternion::from_euler_angles(0.0, pitch, 0.0)
        * UnitQuaternion::from_rotation_matrix(&optical_to_level);
    let camera_to_ground = Isometry3::from_parts(Translation3::new(0.0, 0.0, 0.5), rotation);
    CameraMatrix {
        ground_to_camera: camera_to_ground.inverse(),
        intrinsics: Intrinsics {
            focal: Vector2::new(608.0, 609.6),
            center: Vector2::new(320.0, 240.0),
        },
    }
}

/// The floor in the colour that `floor` says, grey walls, and white boards, nearest last.
pub(crate) fn paint(
    matrix: &CameraMatrix,
    boards: &[Board],
    floor: impl Fn(Point2<f32>) -> [u8; 3],
) -> YuyvImage {
    let mut image = YuyvImage::new(640, 480);
    let camera = matrix.position();
    let to_ground = matrix.ground_to_camera.rotation.inverse();
    let color = |column: u32, row: u32| {
        let pixel = Point2::new(column as f32, row as f32);
        let ray = to_ground * matrix.intrinsics.ray(pixel);
        let is_hit = |board: &Board| {
            let point = camera + ray * ((board.x - camera.x) / ray.x);
            ray.x > 0.0 && board.y.contains(&point.y) && board.z.contains(&point.z)
        };
        if boards.iter().any(is_hit) {
            return WHITE;
        }
        matrix.pixel_to_ground(pixel, 0.0).map_or(GREY, &floor)
    };
    for row in 0..480 {
        for pair in 0..320 {
            let colors = [0, 1].map(|side| Yuv::from_rgb(color(2 * pair + side, row)));
            let offset = (row * 320 + pair) as usize * 4;
            image.data[offset..offset + 4].copy_from_slice(&[
                colors[0].y,
                colors[0].u,
                colors[1].y,
                colors[0].v,
            ]);
        }
    }
    image
}

/// A green floor.
pub(crate) fn plain(_point: Point2<f32>) -> [u8; 3] {
    GREEN
}

/// The columns of an image cut as on the robot.
pub(crate) fn segments(image: &YuyvImage, matrix: &CameraMatrix) -> ImageSegments {
    let mut image_segments = ImageSegments::default();
    ImageSegmenter::new(image_segmenter::CreationContext {})
        .unwrap()
        .cycle(image_segmenter::CycleContext {
            image: &Leased::of(image.clone()),
            camera_matrix: Some(matrix),
            limb_mask: &LimbMask::default(),
            field_color: &field_color(),
            steps: &ScanSteps {
                columns: 4,
                rows: 2,
            },
            image_segments: &mut image_segments,
        })
        .unwrap();
    image_segments
}

/// The lines that the robot's top camera finds.
pub(crate) fn lines(image: &YuyvImage, matrix: &CameraMatrix) -> Vec<LineSegment> {
    let file = ParameterFile::new(include_str!("../../parameters/default.toml"));
    let mut lines = Vec::new();
    LineDetection::new(line_detection::CreationContext {})
        .unwrap()
        .cycle(line_detection::CycleContext {
            image: &Leased::of(image.clone()),
            image_segments: &segments(image, matrix),
            limb_mask: &LimbMask::default(),
            field_border: &FieldBorder::default(),
            camera_matrix: matrix,
            field_color: &field_color(),
            line_width: &0.05,
            parameters: &file.get("vision_top.line_detection"),
            projection_noise: &PROJECTION_NOISE,
            line_points: AdditionalProbe::unsubscribed().output(),
            image_lines: AdditionalProbe::unsubscribed().output(),
            lines: &mut lines,
        })
        .unwrap();
    lines
}

/// A border at this row, all over the image.
pub(crate) fn border_at(row: f32) -> FieldBorder {
    FieldBorder {
        lines: vec![types::field_features::ImageLine {
            at_left: row,
            slope: 0.0,
        }],
    }
}
