//! Finds the white lines of the field, which tell the robot where it is.
//!
//! Columns and rows of the image cross a line where a bright piece has the width of a line on the
//! ground and edges that face each other. Such points carry the direction of their edges; straight
//! lines are what many points agree on (RANSAC, Fischler and Bolles 1981), fitted by least squares.

mod fit;
mod points;
mod rows;

use framework::pool::Leased;
use framework::{
    AdditionalOutput, Input, MainOutput, Parameter, Reflect, RequiredInput, Result, context,
};
use nalgebra::Point2;
use serde::{Deserialize, Serialize};
use types::camera::CameraMatrix;
use types::field_features::{FieldBorder, LineSegment};
use types::image::YuyvImage;
use types::limbs::LimbMask;
use types::projection_noise::ProjectionNoise;

use self::fit::Fit;
use self::points::{LinePoint, View};
use crate::field_color::FieldColor;
use crate::segments::ImageSegments;

/// What makes a line.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct LineDetectionParameters {
    /// Distance between scanned rows in px.
    pub row_step: u32,
    /// Distance between samples within a row.
    #[reflect(unit = "px", range = 1..)]
    pub sample_step: u32,
    /// How much brighter a line must get per px at its edges.
    pub least_gradient: f32,
    /// How well the edges must face each other: the cosine of the angle between them.
    pub least_opposition: f32,
    /// By which share of a line's width the width may differ, beyond one pixel.
    pub width_tolerance: f32,
    /// Points further away from the robot are left out.
    #[reflect(unit = "m", range = 0.0..)]
    pub greatest_distance: f32,
    /// How far before the border of the field it must lie.
    #[reflect(unit = "m", range = 0.0..)]
    pub before_border: f32,
    /// How many pairs of points are tried for each line.
    pub attempts: u32,
    /// How far the points of a pair have to be apart.
    #[reflect(unit = "m", range = 0.0..)]
    pub least_apart: f32,
    /// How far a point near the robot may be off its line.
    #[reflect(unit = "m", range = 0.0..)]
    pub tolerance: f32,
    /// What one metre of distance adds to the tolerance.
    #[reflect(unit = "m", range = 0.0..)]
    pub tolerance_per_metre: f32,
    /// How far the edges at a point may be turned against the line.
    #[reflect(unit = "rad")]
    pub direction_tolerance: f32,
    /// What is nearer to a line that was found belongs to no other, in tolerances.
    #[reflect(range = 1.0..)]
    pub taken: f32,
    /// How far apart the points of one segment may be.
    #[reflect(unit = "m", range = 0.0..)]
    pub largest_gap: f32,
    /// How many points a segment must have.
    pub least_points: u32,
    /// How long a segment must be.
    #[reflect(unit = "m", range = 0.0..)]
    pub least_length: f32,
    /// How many segments there are at most.
    pub most_lines: u32,
}

/// Keeps its heap; empty between cycles.
#[derive(Debug, Deserialize, Serialize)]
pub struct LineDetection {
    points: Vec<LinePoint>,
    fit: Fit,
}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    image: RequiredInput<Option<Leased<YuyvImage>>, "image?">,
    image_segments: Input<ImageSegments, "image_segments">,
    limb_mask: Input<LimbMask, "limb_mask">,
    field_border: Input<FieldBorder, "field_border">,
    camera_matrix: RequiredInput<Option<CameraMatrix>, "camera_matrix?">,
    field_color: Input<FieldColor, "field_color">,
    #[reflect(unit = "m", range = 0.0..)]
    line_width: Parameter<f32, "field_dimensions.line_width">,
    parameters: Parameter<LineDetectionParameters, "$cycler_instance.line_detection">,
    projection_noise: Parameter<ProjectionNoise, "projection_noise">,
    /// Middles of the pieces that might belong to a line, px.
    line_points: AdditionalOutput<Vec<Point2<f32>>, "line_points">,
    /// Both ends of every line in the image, px.
    image_lines: AdditionalOutput<Vec<[Point2<f32>; 2]>, "image_lines">,
    /// In the ground frame, those with the most points first.
    lines: MainOutput<Vec<LineSegment>>,
}

#[context]
pub struct MainOutputs {}

impl LineDetection {
    /// Never fails.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self {
            points: Vec::new(),
            fit: Fit::default(),
        })
    }

    /// The lines on the floor below the border.
    pub fn cycle(&mut self, mut context: CycleContext) -> Result<MainOutputs> {
        let view = View {
            image: context.image,
            matrix: context.camera_matrix,
            border: context.field_border,
            line_width: *context.line_width,
            parameters: context.parameters,
        };
        self.points
            .extend(points::in_columns(&view, context.image_segments));
        rows::scan(
            &view,
            context.field_color,
            context.limb_mask,
            |start, end| {
                self.points.extend(points::in_row(&view, start, end));
            },
        );
        context
            .line_points
            .fill_if_subscribed(|| self.points.iter().map(|point| point.pixel).collect());
        self.fit
            .find(&mut self.points, context.parameters, context.lines);
        self.points.clear();
        let noise = context.projection_noise;
        context
            .lines
            .retain_mut(|line| know(line, context.camera_matrix, noise).is_some());
        context.image_lines.fill_if_subscribed(|| {
            let seen = |end: Point2<f32>| view.matrix.ground_to_pixel(end.coords.push(0.0).into());
            let lines = context.lines.iter();
            lines
                .filter_map(|line| Some([seen(line.start)?, seen(line.end)?]))
                .collect()
        });
        Ok(MainOutputs {})
    }
}

/// Says how well the ends of a line are known; `None` where that cannot be said.
fn know(line: &mut LineSegment, matrix: &CameraMatrix, noise: &ProjectionNoise) -> Option<()> {
    line.start_covariance = matrix.ground_covariance(line.start, 0.0, noise)?;
    line.end_covariance = matrix.ground_covariance(line.end, 0.0, noise)?;
    Some(())
}

#[cfg(test)]
mod tests {
    use framework::testing::{AdditionalProbe, parameter};
    use types::limbs::LimbOutline;

    use super::*;
    use crate::field_color::tests::{GREEN, field_color};
    use crate::painting::{self, Board, PROJECTION_NOISE, WHITE, camera_matrix, paint};

    fn parameters() -> LineDetectionParameters {
        parameter(
            "{ row_step = 6, sample_step = 2, least_gradient = 8.0, least_opposition = 0.9, width_tolerance = 0.5, \
             greatest_distance = 4.5, before_border = 0.45, attempts = 40, least_apart = 0.05, tolerance = 0.02, tolerance_per_metre = 0.01, \
             direction_tolerance = 0.3, taken = 2.0, largest_gap = 0.4, least_points = 8, least_length = 0.3, \
             most_lines = 10 }",
        )
    }

    fn detect(
        image: &YuyvImage,
        limb_mask: &LimbMask,
        image_lines: &mut AdditionalProbe<Vec<[Point2<f32>; 2]>>,
    ) -> Vec<LineSegment> {
        let matrix = camera_matrix(0.4);
        let mut lines = Vec::new();
        LineDetection::new(CreationContext {})
            .unwrap()
            .cycle(CycleContext {
                image: &Leased::of(image.clone()),
                image_segments: &painting::segments(image, &matrix),
                limb_mask,
                field_border: &FieldBorder::default(),
                camera_matrix: &matrix,
                field_color: &field_color(),
                line_width: &0.05,
                parameters: &parameters(),
                projection_noise: &PROJECTION_NOISE,
                line_points: AdditionalProbe::unsubscribed().output(),
                image_lines: image_lines.output(),
                lines: &mut lines,
            })
            .unwrap();
        lines
    }

    fn lines(boards: &[Board], is_white: impl Fn(Point2<f32>) -> bool) -> Vec<LineSegment> {
        let floor = |point| if is_white(point) { WHITE } else { GREEN };
        let image = paint(&camera_matrix(0.4), boards, floor);
        detect(
            &image,
            &LimbMask::default(),
            &mut AdditionalProbe::unsubscribed(),
        )
    }

    fn is_near(line: &LineSegment, distance: impl Fn(Point2<f32>) -> f32) -> bool {
        distance(line.start) < 0.02 && distance(line.end) < 0.02
    }

    #[test]
    fn a_line_across_and_a_line_ahead_are_found_where_they_are() {
        let lines = lines(&[], |point| {
            (point.x - 1.5).abs() < 0.025 || (point.y - 0.2).abs() < 0.025
        });
        assert_eq!(lines.len(), 2, "{lines:?}");
        let across = |line: &&LineSegment| is_near(line, |end| (end.x - 1.5).abs());
        let ahead = |line: &&LineSegment| is_near(line, |end| (end.y - 0.2).abs());
        assert!(
            lines.iter().find(across).unwrap().length() > 1.2,
            "{lines:?}"
        );
        assert!(
            lines.iter().find(ahead).unwrap().length() > 1.2,
            "{lines:?}"
        );
    }

    #[test]
    fn a_slanted_line_ends_where_it_ends() {
        let lines = lines(&[], |point| {
            (point.x - 1.2 - point.y).abs() < 0.035 && point.y.abs() < 0.3
        });
        assert_eq!(lines.len(), 1, "{lines:?}");
        assert!(is_near(&lines[0], |end| (end.x - 1.2 - end.y).abs() * 0.7));
        assert!((lines[0].length() - 0.85).abs() < 0.1, "{lines:?}");
    }

    #[test]
    fn a_stripe_too_wide_for_a_line_is_none() {
        let lines = lines(&[], |point| (point.x - 1.5).abs() < 0.08);
        assert_eq!(lines, []);
    }

    #[test]
    fn a_robot_is_no_line() {
        let robot = Board {
            x: 1.2,
            y: -0.1..0.1,
            z: 0.0..0.5,
        };
        assert_eq!(lines(&[robot], |_| false), []);
    }

    #[test]
    fn what_limbs_cover_is_no_line() {
        let limb = LimbOutline {
            corners: vec![Point2::new(0.0, 200.0), Point2::new(640.0, 200.0)],
        };
        let limb_mask = LimbMask { limbs: vec![limb] };
        let floor = |point: Point2<f32>| {
            if (point.y - 0.1).abs() < 0.025 {
                WHITE
            } else {
                GREEN
            }
        };
        let image = paint(&camera_matrix(0.4), &[], floor);
        let lines = detect(&image, &limb_mask, &mut AdditionalProbe::unsubscribed());
        let row = |end: Point2<f32>| {
            let end = end.coords.push(0.0).into();
            camera_matrix(0.4).ground_to_pixel(end).unwrap().y
        };
        let is_free = |line: &LineSegment| row(line.start) < 201.0 && row(line.end) < 201.0;
        assert!(!lines.is_empty(), "the line goes on above the limbs");
        assert!(lines.iter().all(is_free), "{lines:?}");
    }

    #[test]
    fn the_lines_in_the_image_are_told_to_who_listens() {
        let floor = |point: Point2<f32>| {
            if (point.x - 1.5).abs() < 0.025 {
                WHITE
            } else {
                GREEN
            }
        };
        let matrix = camera_matrix(0.4);
        let mut image_lines = AdditionalProbe::default();
        detect(
            &paint(&matrix, &[], floor),
            &LimbMask::default(),
            &mut image_lines,
        );
        let row = matrix
            .ground_to_pixel(nalgebra::Point3::new(1.5, 0.0, 0.0))
            .unwrap()
            .y;
        let [[start, end]] = image_lines.value().unwrap()[..] else {
            panic!("{image_lines:?}");
        };
        assert!((start.y - row).abs() < 2.0 && (end.y - row).abs() < 2.0);
    }

    #[test]
    fn the_same_image_has_the_same_lines_and_another_one_others() {
        let cross_at = |x: f32| {
            lines(&[], move |point: Point2<f32>| {
                (point.x - x).abs() < 0.025 || point.y.abs() < 0.025
            })
        };
        let first = cross_at(1.5);
        assert_eq!(first.len(), 2);
        assert_eq!(first, cross_at(1.5));
        assert_ne!(first, cross_at(1.52));
    }
}
