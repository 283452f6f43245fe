//! Finds out which colour the field has in this light: carpets differ, and what a camera makes of them differs more.
//!
//! Of some hundred pixels below the horizon those that may be carpet vote for their chromaticity; most of them agree. What
//! counts as field then lies around it, as far as half of the way to what has no colour.

use framework::context;
use framework::pool::Leased;
use framework::{Input, MainOutput, Parameter, Reflect, RequiredInput, Result};
use nalgebra::Vector2;
use serde::{Deserialize, Serialize};
use types::camera::CameraMatrix;
use types::image::YuyvImage;
use types::limbs::LimbMask;

use crate::field_color::{FieldColor, shares};

/// Cells of the vote along each axis.
const CELLS: usize = 24;
/// The largest shares of red and blue that can vote.
const LARGEST: f32 = 0.48;
/// The share of each channel in what has no colour.
const GREY: f32 = 1.0 / 3.0;

/// What may be carpet, and what follows from its colour.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct FieldColorDetectionParameters {
    /// Distance between the pixels that are looked at.
    #[reflect(unit = "px")]
    pub step: u32,
    /// Whatever has a smaller share of green is no carpet.
    #[reflect(range = 0.0..=1.0)]
    pub least_green: f32,
    /// By which factor green exceeds red and blue, at least.
    pub least_dominance: f32,
    /// Whatever is brighter dazzles: it has no colour left.
    pub brightest: u8,
    /// How many of the pixels have to agree.
    #[reflect(range = 0.0..=1.0)]
    pub least_agreement: f32,
    /// And never fewer than so many.
    pub least_votes: u32,
    /// How much of the newest image is learnt, after the first.
    #[reflect(range = 0.0..=1.0)]
    pub adaption: f32,
    /// How far from grey to the carpet's share of green the limit lies.
    #[reflect(range = 0.0..=1.0)]
    pub green_limit: f32,
    /// How far beyond the carpet's shares of red and blue their limits lie.
    #[reflect(range = 0.0..=1.0)]
    pub margin: f32,
}

/// Remembers the colour.
#[derive(Debug, Deserialize, Serialize)]
pub struct FieldColorDetection {
    /// Shares of red and blue.
    carpet: Option<Vector2<f32>>,
}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    image: RequiredInput<Option<Leased<YuyvImage>>, "image?">,
    camera_matrix: Input<Option<CameraMatrix>, "camera_matrix?">,
    limb_mask: Input<LimbMask, "limb_mask">,
    /// As long as no carpet was seen.
    initial: Parameter<FieldColor, "field_color">,
    parameters: Parameter<FieldColorDetectionParameters, "field_color_detection">,
}

#[context]
pub struct MainOutputs {
    /// What counts as field in this image.
    field_color: MainOutput<FieldColor>,
}

impl FieldColorDetection {
    /// Never fails.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self { carpet: None })
    }

    /// Without enough carpet in sight the colour stays what it was.
    pub fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs> {
        let parameters = context.parameters;
        if let Some(seen) = vote(&context) {
            let known = self.carpet.unwrap_or(seen);
            let carpet = known + (seen - known) * parameters.adaption;
            self.carpet = Some(carpet);
        }
        let field_color = self.carpet.map_or(*context.initial, |carpet| {
            let green = 1.0 - carpet.sum();
            FieldColor {
                minimum_green: GREY + (green - GREY) * parameters.green_limit,
                maximum_red: carpet.x + parameters.margin,
                maximum_blue: carpet.y + parameters.margin,
                minimum_luminance: context.initial.minimum_luminance,
            }
        });
        Ok(MainOutputs {
            field_color: field_color.into(),
        })
    }
}

/// The shares of red and blue on which most of the pixels agree.
fn vote(context: &CycleContext<'_>) -> Option<Vector2<f32>> {
    let parameters = context.parameters;
    let mut cells = [(0_u32, Vector2::zeros()); CELLS * CELLS];
    let mut count = 0_u32;
    for seen in pixels(context) {
        count += 1;
        let [red, green, blue] = seen;
        let may_be_carpet =
            green >= parameters.least_green && green >= parameters.least_dominance * red.max(blue);
        let cell = |share: f32| (share / LARGEST * CELLS as f32) as usize;
        let (row, column) = (cell(red), cell(blue));
        if may_be_carpet && row < CELLS && column < CELLS {
            let (votes, sum) = &mut cells[row * CELLS + column];
            *votes += 1;
            *sum += Vector2::new(red, blue);
        }
    }
    // With its neighbours, so that the edges between cells do not matter.
    let around = |row: usize, column: usize| {
        let rows = row.saturating_sub(1)..(row + 2).min(CELLS);
        let neighbours = rows.flat_map(|row| {
            let columns = column.saturating_sub(1)..(column + 2).min(CELLS);
            columns.map(move |column| row * CELLS + column)
        });
        neighbours.fold((0, Vector2::zeros()), |(votes, sum), index| {
            (votes + cells[index].0, sum + cells[index].1)
        })
    };
    let places = (0..CELLS).flat_map(|row| (0..CELLS).map(move |column| (row, column)));
    let (votes, sum) = places
        .filter(|(row, column)| cells[row * CELLS + column].0 > 0)
        .map(|(row, column)| around(row, column))
        .max_by_key(|(votes, _)| *votes)?;
    let needed = (count as f32 * parameters.least_agreement).max(parameters.least_votes as f32);
    (votes as f32 >= needed).then(|| sum / votes as f32)
}

/// Shares of red, green and blue in the pixels that are looked at: below the horizon, no limbs, neither dark nor dazzling.
fn pixels(context: &CycleContext<'_>) -> impl Iterator<Item = [f32; 3]> {
    let image = context.image;
    let step = context.parameters.step.max(2) as usize;
    let darkest = context.initial.minimum_luminance;
    let brightest = context.parameters.brightest;
    let horizon = context.camera_matrix.and_then(CameraMatrix::horizon);
    let limb_mask = context.limb_mask;
    (0..image.columns()).step_by(step).flat_map(move |column| {
        let first = horizon.map_or(0.0, |horizon| horizon.at(column as f32).max(0.0));
        let limb = limb_mask.first_row(column as f32);
        let end = limb.map_or(image.rows(), |row| image.rows().min(row as u32));
        (first as u32..end).step_by(step).filter_map(move |row| {
            let color = image.yuv(column, row)?;
            (darkest..brightest)
                .contains(&color.y)
                .then(|| shares(color))
        })
    })
}

#[cfg(test)]
mod tests {
    use framework::testing::parameter;
    use nalgebra::Point2;

    use super::*;
    use crate::field_color::tests::field_color;
    use crate::painting::{WHITE, camera_matrix, paint};
    use types::image::Yuv;

    fn detect(node: &mut FieldColorDetection, image: &YuyvImage) -> FieldColor {
        let parameters = parameter(
            "{ step = 16, least_green = 0.36, least_dominance = 1.1, brightest = 240, least_agreement = 0.1, \
             least_votes = 10, adaption = 0.2, green_limit = 0.5, margin = 0.13 }",
        );
        let outputs = node.cycle(CycleContext {
            image: &Leased::of(image.clone()),
            camera_matrix: Some(&camera_matrix(0.4)),
            limb_mask: &LimbMask::default(),
            initial: &field_color(),
            parameters: &parameters,
        });
        outputs.unwrap().field_color.value
    }

    fn node() -> FieldColorDetection {
        FieldColorDetection::new(CreationContext {}).unwrap()
    }

    /// Carpet of this colour with a line.
    fn field_of(carpet: [u8; 3]) -> YuyvImage {
        let is_line = |point: Point2<f32>| (point.x - 1.5).abs() < 0.1;
        paint(&camera_matrix(0.4), &[], |point| {
            if is_line(point) { WHITE } else { carpet }
        })
    }

    #[test]
    fn carpets_of_any_green_are_field_and_lines_on_them_are_not() {
        for carpet in [
            [38, 128, 52],
            [70, 110, 70],
            [30, 100, 85],
            [85, 125, 45],
            [110, 150, 60],
        ] {
            let color = detect(&mut node(), &field_of(carpet));
            assert!(
                color.matches(Yuv::from_rgb(carpet)),
                "{carpet:?}: {color:?}"
            );
            let shade = carpet.map(|channel| channel / 2);
            assert!(color.matches(Yuv::from_rgb(shade)), "{carpet:?}: {color:?}");
            for other in [WHITE, [90, 90, 90], [140, 120, 100], [60, 62, 110]] {
                assert!(
                    !color.matches(Yuv::from_rgb(other)),
                    "{carpet:?}: {color:?}"
                );
            }
        }
    }

    #[test]
    fn the_initial_colour_holds_until_carpet_is_seen_and_what_was_learnt_after() {
        let mut node = node();
        let hall = field_of([130, 120, 110]);
        assert_eq!(detect(&mut node, &hall), field_color());
        let learnt = detect(&mut node, &field_of([70, 110, 70]));
        assert_ne!(learnt, field_color());
        assert_eq!(detect(&mut node, &hall), learnt);
    }

    #[test]
    fn another_light_is_learnt_step_by_step() {
        let mut node = node();
        let before = detect(&mut node, &field_of([38, 128, 52]));
        let next = detect(&mut node, &field_of([60, 120, 40]));
        assert!(
            next.maximum_red > before.maximum_red && next.maximum_red < before.maximum_red + 0.05
        );
        for _ in 0..30 {
            detect(&mut node, &field_of([60, 120, 40]));
        }
        let last = detect(&mut node, &field_of([60, 120, 40]));
        assert!(
            (last.maximum_red - (60.0 / 220.0 + 0.13)).abs() < 0.01,
            "{last:?}"
        );
    }

    /// A client may inject one.
    #[test]
    fn an_image_that_lies_about_its_size_has_nothing_to_look_at() {
        let mut node = FieldColorDetection { carpet: None };
        let lying = YuyvImage {
            width: u32::MAX - 1,
            height: u32::MAX,
            data: Vec::new(),
        };
        detect(&mut node, &lying);
        assert_eq!(node.carpet, None);
    }

    #[test]
    fn an_image_without_pixels_teaches_nothing() {
        assert_eq!(detect(&mut node(), &YuyvImage::default()), field_color());
    }
}
