//! Finds the penalty mark, the one place between the lines that says where on the field it is.
//!
//! A bright patch flat on the field, as large as the mark and about as long as wide, with nothing but
//! field around it. Balls and feet rise from the ground: seen as if flat they are much longer.

use framework::context;
use framework::pool::Leased;
use framework::{
    AdditionalOutput, Input, MainOutput, Parameter, Reflect, RequiredInput, Result, math,
};
use nalgebra::{Matrix2, Point2, Vector2};
use serde::{Deserialize, Serialize};
use types::camera::CameraMatrix;
use types::field_features::{FieldBorder, LineSegment, PenaltyMark};
use types::image::YuyvImage;
use types::projection_noise::ProjectionNoise;

use crate::field_color::FieldColor;
use crate::landmarks::{is_near_border, is_on_line};
use crate::nearest_pixel::nearest_pixel;
use crate::segments::ImageSegments;

/// What makes a penalty mark.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct PenaltyMarkDetectionParameters {
    /// Marks further away from the robot are left out.
    #[reflect(unit = "m", range = 0.0..)]
    pub greatest_distance: f32,
    /// How far before the border of the field it must lie.
    #[reflect(unit = "m", range = 0.0..)]
    pub before_border: f32,
    /// By which factor the white area may differ from that of the mark.
    pub area_tolerance: f32,
    /// Least ratio of the shorter to the longer extent of the white area.
    pub least_roundness: f32,
    /// Least share of field in the rings around it.
    #[reflect(range = 0.0..=1.0)]
    pub least_field_around: f32,
    /// A piece of a column that is longer is no candidate, in sizes of the mark.
    #[reflect(range = 0.0..)]
    pub longest_piece: f32,
    /// Around a candidate the ring is so large, in sizes of the mark: it is not yet the mark's middle.
    #[reflect(range = 0.0..)]
    pub ring_at_first: f32,
    /// Around the middle it is so large.
    #[reflect(range = 0.0..)]
    pub ring: f32,
    /// Largest share of the patch that may be darker than the field.
    #[reflect(range = 0.0..=1.0)]
    pub most_dark: f32,
}

/// Has nothing to remember.
#[derive(Debug, Deserialize, Serialize)]
pub struct PenaltyMarkDetection {}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    image: RequiredInput<Option<Leased<YuyvImage>>, "image?">,
    image_segments: Input<ImageSegments, "image_segments">,
    field_border: Input<FieldBorder, "field_border">,
    lines: Input<Vec<LineSegment>, "lines">,
    camera_matrix: RequiredInput<Option<CameraMatrix>, "camera_matrix?">,
    field_color: Input<FieldColor, "field_color">,
    line_width: Parameter<f32, "field_dimensions.line_width">,
    #[reflect(unit = "m", range = 0.0..)]
    mark_size: Parameter<f32, "field_dimensions.penalty_mark_size">,
    parameters: Parameter<PenaltyMarkDetectionParameters, "penalty_mark_detection">,
    projection_noise: Parameter<ProjectionNoise, "projection_noise">,
    /// Places that were looked at closely.
    penalty_mark_candidates: AdditionalOutput<Vec<PenaltyMark>, "penalty_mark_candidates">,
}

#[context]
pub struct MainOutputs {
    /// The one that looks most like one; `None` where the image shows none.
    penalty_mark: MainOutput<Option<PenaltyMark>>,
}

impl PenaltyMarkDetection {
    /// Never fails.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self {})
    }

    /// The patch that is most like the mark.
    pub fn cycle(&mut self, mut context: CycleContext) -> Result<MainOutputs> {
        let view = View {
            image: context.image,
            matrix: context.camera_matrix,
            color: context.field_color,
            line_width: *context.line_width,
            mark_size: *context.mark_size,
            parameters: context.parameters,
            noise: context.projection_noise,
        };
        let candidates = || {
            candidates(
                &view,
                context.image_segments,
                context.field_border,
                context.lines,
            )
        };
        context.penalty_mark_candidates.fill_if_subscribed(|| {
            candidates()
                .filter_map(|place| view.mark_at(place))
                .collect()
        });
        let mut inspected: Option<Point2<f32>> = None;
        let mut best: Option<(f32, PenaltyMark)> = None;
        for place in candidates() {
            // The columns of one patch lead to the same middle.
            let is_known = |known| nalgebra::distance(&known, &place) < view.mark_size / 2.0;
            if inspected.is_some_and(is_known) {
                continue;
            }
            inspected = Some(place);
            let found = view.inspect(place);
            best = [best, found]
                .into_iter()
                .flatten()
                .reduce(|one, other| if other.0 > one.0 { other } else { one });
        }
        let penalty_mark = best.map(|(_, mark)| mark);
        Ok(MainOutputs {
            penalty_mark: penalty_mark.into(),
        })
    }
}

/// Places on the ground where something small between two pieces of field has only field around it.
fn candidates<'a>(
    view: &'a View<'a>,
    image_segments: &'a ImageSegments,
    border: &'a FieldBorder,
    lines: &'a [LineSegment],
) -> impl Iterator<Item = Point2<f32>> + 'a {
    let before_border = view.parameters.before_border;
    image_segments.enclosed().filter_map(move |piece| {
        let at = |row: f32| Point2::new(piece.column as f32, row);
        let (start, end) = (at(piece.start as f32 - 0.5), at(piece.end as f32 - 0.5));
        let (far, near) = (view.ground(start)?, view.ground(end)?);
        let place = nalgebra::center(&far, &near);
        let is_candidate = nalgebra::distance(&far, &near)
            <= view.parameters.longest_piece * view.mark_size
            && place.coords.norm() <= view.parameters.greatest_distance
            && border.is_inside(start)
            && !is_near_border(border, view.matrix, start.x, place, before_border)
            && !is_on_line(lines, view.line_width, place)
            && view.field_around(place, view.parameters.ring_at_first)
                >= view.parameters.least_field_around;
        is_candidate.then_some(place)
    })
}

/// An image with the knowledge of where the floor is.
struct View<'a> {
    image: &'a YuyvImage,
    matrix: &'a CameraMatrix,
    color: &'a FieldColor,
    line_width: f32,
    mark_size: f32,
    parameters: &'a PenaltyMarkDetectionParameters,
    noise: &'a ProjectionNoise,
}

/// What a square of the floor shows.
struct Patch {
    /// Of what is not field.
    middle: Point2<f32>,
    /// In m².
    area: f32,
    /// The second moments of its area, divided by it.
    spread: Matrix2<f32>,
    /// The share of it that is darker than the field around.
    dark: f32,
}

impl View<'_> {
    /// A mark near this place and how much it is like one, 0 to 1.
    fn inspect(&self, place: Point2<f32>) -> Option<(f32, PenaltyMark)> {
        let first = self.patch(place)?;
        let patch = self.patch(first.middle)?;
        let cross = self.line_width * (2.0 * self.mark_size - self.line_width);
        let ratio = patch.area / cross;
        let likeness = ratio.min(ratio.recip());
        let is_mark = likeness * self.parameters.area_tolerance >= 1.0
            && roundness(&patch.spread) >= self.parameters.least_roundness
            && patch.dark <= self.parameters.most_dark
            && self.field_around(patch.middle, self.parameters.ring)
                >= self.parameters.least_field_around;
        let mark = self.mark_at(patch.middle)?;
        is_mark.then_some((likeness, mark))
    }

    fn mark_at(&self, position: Point2<f32>) -> Option<PenaltyMark> {
        let center = self.pixel(position)?;
        let covariance = self.matrix.ground_covariance(position, 0.0, self.noise)?;
        Some(PenaltyMark {
            center,
            position,
            covariance,
        })
    }

    /// The share of field in a ring so many sizes of the mark away; what is not seen is none.
    fn field_around(&self, place: Point2<f32>, sizes: f32) -> f32 {
        const SAMPLES: usize = 16;
        let field = (0..SAMPLES).filter(|sample| {
            let angle = *sample as f32 * std::f32::consts::TAU / SAMPLES as f32;
            let offset =
                Vector2::new(math::cos(angle), math::sin(angle)) * (self.mark_size * sizes);
            self.look(place + offset)
                .is_some_and(|(is_field, _)| is_field)
        });
        field.count() as f32 / SAMPLES as f32
    }

    /// Samples the square in which a mark at this place lies.
    fn patch(&self, place: Point2<f32>) -> Option<Patch> {
        const HALF: i32 = 10;
        let step = self.mark_size / HALF as f32;
        let (mut count, mut sum, mut moments) = (0.0, Vector2::zeros(), Matrix2::zeros());
        let (mut field, mut field_luminance, mut dark) = (0.0, 0.0, 0.0);
        let offsets = || {
            let rows = -HALF..=HALF;
            rows.flat_map(|x| (-HALF..=HALF).map(move |y| Vector2::new(x as f32, y as f32)))
        };
        for offset in offsets() {
            let (is_field, luminance) = self.look(place + offset * step)?;
            if is_field {
                field += 1.0;
                field_luminance += luminance;
            } else {
                count += 1.0;
                sum += offset * step;
                moments += offset * offset.transpose() * (step * step);
            }
        }
        if count < 1.0 || field < 1.0 {
            return None;
        }
        for offset in offsets() {
            let (is_field, luminance) = self.look(place + offset * step)?;
            if !is_field && luminance < field_luminance / field {
                dark += 1.0;
            }
        }
        let mean = sum / count;
        Some(Patch {
            middle: place + mean,
            area: count * step * step,
            spread: moments / count - mean * mean.transpose(),
            dark: dark / count,
        })
    }

    /// Whether a place of the floor shows field, and its luminance; `None` where it is not seen.
    fn look(&self, place: Point2<f32>) -> Option<(bool, f32)> {
        let (column, row) = nearest_pixel(self.pixel(place)?)?;
        let color = self.image.yuv(column, row)?;
        Some((self.color.matches(color), f32::from(color.y)))
    }

    fn pixel(&self, place: Point2<f32>) -> Option<Point2<f32>> {
        self.matrix.ground_to_pixel(place.coords.push(0.0).into())
    }

    fn ground(&self, pixel: Point2<f32>) -> Option<Point2<f32>> {
        self.matrix.pixel_to_ground(pixel, 0.0)
    }
}

/// The ratio of the shorter to the longer extent.
fn roundness(spread: &Matrix2<f32>) -> f32 {
    let mean = spread.trace() / 2.0;
    let difference = (mean * mean - spread.determinant()).max(0.0).sqrt();
    ((mean - difference).max(0.0) / (mean + difference)).sqrt()
}

#[cfg(test)]
mod tests {
    use framework::testing::{AdditionalProbe, parameter};
    use nalgebra::Rotation2;

    use super::*;
    use crate::field_color::tests::{GREEN, field_color};
    use crate::painting::{self, Board, PROJECTION_NOISE, WHITE, border_at, camera_matrix, paint};

    fn parameters() -> PenaltyMarkDetectionParameters {
        parameter(
            "{ greatest_distance = 3.0, before_border = 1.0, area_tolerance = 1.8, least_roundness = 0.55, \
             least_field_around = 0.9, longest_piece = 2.0, ring_at_first = 1.6, ring = 1.1, most_dark = 0.1 }",
        )
    }

    fn detect(
        image: &YuyvImage,
        border: &FieldBorder,
        lines: &Vec<LineSegment>,
    ) -> Option<PenaltyMark> {
        let matrix = camera_matrix(0.4);
        let outputs = PenaltyMarkDetection::new(CreationContext {})
            .unwrap()
            .cycle(CycleContext {
                image: &Leased::of(image.clone()),
                image_segments: &painting::segments(image, &matrix),
                field_border: border,
                lines,
                camera_matrix: &matrix,
                field_color: &field_color(),
                line_width: &0.05,
                mark_size: &0.1,
                parameters: &parameters(),
                projection_noise: &PROJECTION_NOISE,
                penalty_mark_candidates: AdditionalProbe::unsubscribed().output(),
            });
        outputs.unwrap().penalty_mark.value
    }

    fn mark(boards: &[Board], is_white: impl Fn(Point2<f32>) -> bool) -> Option<PenaltyMark> {
        let floor = |point| if is_white(point) { WHITE } else { GREEN };
        let image = paint(&camera_matrix(0.4), boards, floor);
        detect(&image, &FieldBorder::default(), &Vec::new())
    }

    /// A cross at this place, turned by this angle.
    fn cross(place: Point2<f32>, angle: f32) -> impl Fn(Point2<f32>) -> bool {
        move |point| {
            let offset = (Rotation2::new(angle) * (point - place)).abs();
            offset.max() < 0.05 && offset.min() < 0.025
        }
    }

    #[test]
    fn a_cross_is_found_where_it_is_however_it_is_turned() {
        for (x, y, angle) in [(0.8, 0.1, 0.0), (1.5, -0.2, 0.4), (2.2, 0.3, 0.7)] {
            let place = Point2::new(x, y);
            let mark = mark(&[], cross(place, angle)).expect("the mark is seen");
            let off = nalgebra::distance(&mark.position, &place);
            assert!(off < 0.03 + 0.02 * x, "{mark:?} instead of {place}");
        }
    }

    #[test]
    fn a_line_near_the_cross_does_not_hide_it() {
        let is_cross = cross(Point2::new(1.2, 0.0), 0.2);
        let mark = mark(&[], |point| {
            is_cross(point) || (point.x - 1.55).abs() < 0.025
        });
        assert!(mark.is_some());
    }

    #[test]
    fn neither_a_dash_nor_a_crossing_of_lines_is_a_mark() {
        let dash = |point: Point2<f32>| (point.x - 1.2).abs() < 0.025 && point.y.abs() < 0.1;
        assert_eq!(mark(&[], dash), None);
        let crossing = |point: Point2<f32>| (point.x - 1.2).abs() < 0.025 || point.y.abs() < 0.025;
        assert_eq!(mark(&[], crossing), None);
    }

    #[test]
    fn what_stands_on_the_field_is_no_mark() {
        let foot = Board {
            x: 1.2,
            y: -0.05..0.05,
            z: 0.0..0.1,
        };
        assert_eq!(mark(&[foot], |_| false), None);
    }

    #[test]
    fn beyond_the_border_there_is_no_mark() {
        let place = Point2::new(1.5, 0.0);
        let is_cross = cross(place, 0.0);
        let floor = |point| if is_cross(point) { WHITE } else { GREEN };
        let image = paint(&camera_matrix(0.4), &[], floor);
        assert!(detect(&image, &border_at(50.0), &Vec::new()).is_some());
        assert_eq!(detect(&image, &border_at(400.0), &Vec::new()), None);
    }

    #[test]
    fn a_piece_of_a_line_is_no_mark() {
        let place = Point2::new(1.5, 0.0);
        let is_cross = cross(place, 0.0);
        let floor = |point| if is_cross(point) { WHITE } else { GREEN };
        let image = paint(&camera_matrix(0.4), &[], floor);
        let line = LineSegment {
            start: Point2::new(1.5, -1.0),
            end: Point2::new(1.5, 1.0),
            ..LineSegment::default()
        };
        assert_eq!(detect(&image, &FieldBorder::default(), &vec![line]), None);
    }
}
