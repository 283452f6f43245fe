//! Finds where the field ends in the image: beyond its border nothing belongs to the game.
//!
//! In every column the field begins at some row, at the border or below something that hides it. Most
//! columns agree on a line; where a corner is in sight the others agree on a second one.

use framework::{AdditionalOutput, Input, MainOutput, Parameter, Reflect, Result, context, math};
use nalgebra::Point2;
use serde::{Deserialize, Serialize};
use types::camera::CameraMatrix;
use types::field_features::{FieldBorder, ImageLine};

use crate::sampler::{self, Sampler};
use crate::segments::{ImageSegments, Segment};

/// What makes a border.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct FieldBorderParameters {
    /// How many pairs of columns are tried for each line.
    pub attempts: u32,
    /// How far a column may be off its line.
    #[reflect(unit = "px", range = 0.0..)]
    pub tolerance: f32,
    /// In how many columns a line must be seen; in half of them, where it makes a corner with the first.
    pub least_columns: u32,
    /// How long the piece of field below the border must be.
    #[reflect(unit = "px")]
    pub least_field: u32,
    /// How far the ground beyond the border must be seen.
    #[reflect(unit = "m", range = 0.0..)]
    pub least_beyond: f32,
    /// How far the two lines may be off a right angle on the ground.
    #[reflect(unit = "rad")]
    pub angle_tolerance: f32,
}

/// Keeps its heap; empty between cycles.
#[derive(Debug, Deserialize, Serialize)]
pub struct FieldBorderDetection {
    points: Vec<Point2<f32>>,
}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    image_segments: Input<ImageSegments, "image_segments">,
    camera_matrix: Input<Option<CameraMatrix>, "camera_matrix?">,
    parameters: Parameter<FieldBorderParameters, "$cycler_instance.field_border">,
    /// Where the field begins in each column, px.
    field_border_points: AdditionalOutput<Vec<Point2<f32>>, "field_border_points">,
    /// One line, or two that meet in a corner; none where the image shows no border, px.
    field_border: MainOutput<FieldBorder>,
}

#[context]
pub struct MainOutputs {}

impl FieldBorderDetection {
    /// Never fails.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self { points: Vec::new() })
    }

    /// Without a camera matrix there is at most one line: a corner is known by its right angle.
    pub fn cycle(&mut self, mut context: CycleContext) -> Result<MainOutputs> {
        let parameters = context.parameters;
        let points = border_points(context.image_segments, context.camera_matrix, parameters);
        self.points.extend(points);
        context
            .field_border_points
            .fill_if_subscribed(|| self.points.clone());
        let lines = &mut context.field_border.lines;
        let mut sampler = Sampler::new();
        let needed = parameters.least_columns.max(2) as usize;
        if let Some(first) = take_line(&mut self.points, needed, parameters, &mut sampler) {
            lines.push(first);
            if let Some(matrix) = context.camera_matrix
                && let Some(second) =
                    take_line(&mut self.points, needed / 2, parameters, &mut sampler)
                && is_right_angle(matrix, &first, &second, parameters.angle_tolerance)
            {
                lines.push(second);
            }
        }
        // The field is below both, so the left one is the lower at the left edge.
        lines.sort_unstable_by(|one, other| other.at_left.total_cmp(&one.at_left));
        self.points.clear();
        Ok(MainOutputs {})
    }
}

/// The upper ends of the first long enough pieces of field, where enough is seen beyond.
fn border_points<'a>(
    image_segments: &'a ImageSegments,
    matrix: Option<&'a CameraMatrix>,
    parameters: &'a FieldBorderParameters,
) -> impl Iterator<Item = Point2<f32>> + 'a {
    image_segments.columns().filter_map(move |column| {
        let mut pieces = column.iter();
        let is_long =
            |piece: &&Segment| piece.is_field && piece.end - piece.start >= parameters.least_field;
        let field = pieces.find(is_long)?;
        let at = |row: u32| Point2::new(field.column as f32, row as f32 - 0.5);
        let (first, border) = (at(column[0].start), at(field.start));
        // A line at the upper edge of the image looks like a border.
        let ground = |pixel| matrix?.pixel_to_ground(pixel, 0.0);
        let beyond = ground(first).zip(ground(border));
        let is_seen = beyond
            .is_none_or(|(far, near)| nalgebra::distance(&far, &near) >= parameters.least_beyond);
        (field.start > column[0].start && is_seen).then_some(border)
    })
}

/// The line that most points agree on; those are removed.
fn take_line(
    points: &mut Vec<Point2<f32>>,
    needed: usize,
    parameters: &FieldBorderParameters,
    sampler: &mut Sampler,
) -> Option<ImageLine> {
    if points.len() < needed.max(2) {
        return None;
    }
    let is_near =
        |line: &ImageLine, point: &Point2<f32>| distance(line, point) <= parameters.tolerance;
    let support = |line: &ImageLine| points.iter().filter(|point| is_near(line, point)).count();
    let attempts = sampler::attempts(parameters.attempts).filter_map(|_| {
        let (one, other) = sampler.pair(points.len());
        let line = fit([points[one], points[other]].iter())?;
        Some((support(&line), line))
    });
    let (support, rough) = attempts.max_by_key(|(support, _)| *support)?;
    if support < needed {
        return None;
    }
    let line = fit(points.iter().filter(|point| is_near(&rough, point)))?;
    points.retain(|point| !is_near(&rough, point) && !is_near(&line, point));
    Some(line)
}

/// Least squares of the rows.
fn fit<'a>(points: impl Iterator<Item = &'a Point2<f32>> + Clone) -> Option<ImageLine> {
    let (sum, count) = points
        .clone()
        .fold((Point2::origin(), 0.0), |(sum, count), point| {
            (sum + point.coords, count + 1.0)
        });
    let mean = sum / count;
    let (across, along) = points.fold((0.0, 0.0), |(across, along), point| {
        let offset = point - mean;
        (across + offset.x * offset.y, along + offset.x * offset.x)
    });
    let slope = across / along;
    slope.is_finite().then(|| ImageLine {
        at_left: mean.y - slope * mean.x,
        slope,
    })
}

fn distance(line: &ImageLine, point: &Point2<f32>) -> f32 {
    (point.y - line.row_at(point.x)).abs() / math::hypot(line.slope, 1.0)
}

fn is_right_angle(
    matrix: &CameraMatrix,
    first: &ImageLine,
    second: &ImageLine,
    tolerance: f32,
) -> bool {
    // On each line ten columns to both sides of where they meet; no angle above the horizon.
    let corner = (second.at_left - first.at_left) / (first.slope - second.slope);
    let direction = |line: &ImageLine| {
        let ground = |x: f32| matrix.pixel_to_ground(Point2::new(x, line.row_at(x)), 0.0);
        Some((ground(corner + 10.0)? - ground(corner - 10.0)?).normalize())
    };
    let cosine = direction(first).zip(direction(second));
    cosine.is_some_and(|(first, second)| first.dot(&second).abs() <= math::sin(tolerance))
}

#[cfg(test)]
mod tests {
    use framework::testing::{AdditionalProbe, parameter};

    use super::*;
    use crate::field_color::tests::GREEN;
    use crate::painting::{self, Board, GREY, camera_matrix, paint};

    fn parameters() -> FieldBorderParameters {
        parameter(
            "{ attempts = 30, tolerance = 2.0, least_columns = 15, least_field = 8, least_beyond = 0.3, \
             angle_tolerance = 0.35 }",
        )
    }

    fn border(boards: &[Board], is_field: impl Fn(Point2<f32>) -> bool) -> FieldBorder {
        border_with(&parameters(), boards, is_field)
    }

    fn border_with(
        parameters: &FieldBorderParameters,
        boards: &[Board],
        is_field: impl Fn(Point2<f32>) -> bool,
    ) -> FieldBorder {
        let matrix = camera_matrix(0.2);
        let floor = |point| if is_field(point) { GREEN } else { GREY };
        let image = paint(&matrix, boards, floor);
        let mut field_border = FieldBorder::default();
        FieldBorderDetection::new(CreationContext {})
            .unwrap()
            .cycle(CycleContext {
                image_segments: &painting::segments(&image, &matrix),
                camera_matrix: Some(&matrix),
                parameters,
                field_border_points: AdditionalProbe::unsubscribed().output(),
                field_border: &mut field_border,
            })
            .unwrap();
        field_border
    }

    fn row(x: f32, y: f32) -> Point2<f32> {
        let point = nalgebra::Point3::new(x, y, 0.0);
        camera_matrix(0.2).ground_to_pixel(point).unwrap()
    }

    fn assert_at(border: &FieldBorder, x: f32, y: f32) {
        let pixel = row(x, y);
        let row = border.row_at(pixel.x).unwrap();
        assert!((row - pixel.y).abs() < 2.0, "{row} instead of {pixel}");
    }

    #[test]
    fn a_straight_border_is_one_line() {
        let border = border(&[], |point| point.x + 0.2 * point.y < 3.0);
        assert_eq!(border.lines.len(), 1, "{border:?}");
        assert_at(&border, 3.0, 0.0);
        assert_at(&border, 2.8, 1.0);
    }

    #[test]
    fn however_many_attempts_are_wanted_the_search_ends() {
        let parameters = FieldBorderParameters {
            attempts: u32::MAX,
            ..parameters()
        };
        let border = border_with(&parameters, &[], |point| point.x < 3.0);
        assert_at(&border, 3.0, 0.0);
    }

    #[test]
    fn robots_in_front_of_the_border_do_not_move_it() {
        let board = |x: f32, y: f32| Board {
            x,
            y: y..y + 0.25,
            z: 0.0..0.55,
        };
        let boards = [board(1.5, 0.1), board(2.0, -0.6)];
        let border = border(&boards, |point| point.x < 3.5);
        assert_eq!(border.lines.len(), 1, "{border:?}");
        assert_at(&border, 3.5, -1.0);
        assert_at(&border, 3.5, 1.0);
    }

    #[test]
    fn a_corner_of_the_field_has_two_lines() {
        let border = border(&[], |point| {
            point.x + point.y < 3.0 && point.x - point.y < 3.2
        });
        assert_eq!(border.lines.len(), 2, "{border:?}");
        assert_at(&border, 2.5, 0.5);
        assert_at(&border, 2.5, -0.7);
        assert!(border.is_inside(row(2.5, 0.0)));
        assert!(!border.is_inside(row(3.3, 0.0)));
    }

    #[test]
    fn two_lines_that_are_no_corner_of_a_field_are_one() {
        let border = border(&[], |point| point.x < 3.0 && point.x + 0.5 * point.y < 3.0);
        assert_eq!(border.lines.len(), 1, "{border:?}");
    }

    #[test]
    fn field_up_to_the_horizon_has_no_border() {
        assert_eq!(border(&[], |_| true), FieldBorder::default());
    }

    #[test]
    fn without_field_there_is_no_border() {
        assert_eq!(border(&[], |_| false), FieldBorder::default());
    }
}
