//! Cuts columns of the image into pieces that show the field and pieces that show something else.
//!
//! Only below the horizon and down to the robot's own limbs, and only at every few pixels: what is
//! smaller is too far away to matter.

use framework::pool::Leased;
use framework::{Input, MainOutput, Parameter, Reflect, RequiredInput, Result, context};
use serde::{Deserialize, Serialize};
use types::camera::CameraMatrix;
use types::image::YuyvImage;
use types::limbs::LimbMask;

use crate::field_color::FieldColor;
use crate::segments::{ImageSegments, Segment};

/// How densely an image is scanned.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct ScanSteps {
    /// Distance between scanned columns in px.
    pub columns: u32,
    /// Distance between samples within a column in px.
    pub rows: u32,
}

/// Has nothing to remember.
#[derive(Debug, Deserialize, Serialize)]
pub struct ImageSegmenter {}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    image: RequiredInput<Option<Leased<YuyvImage>>, "image?">,
    camera_matrix: Input<Option<CameraMatrix>, "camera_matrix?">,
    limb_mask: Input<LimbMask, "limb_mask">,
    field_color: Input<FieldColor, "field_color">,
    steps: Parameter<ScanSteps, "$cycler_instance.scan_steps">,
    /// Columns from left to right, each from the horizon down to the robot's own limbs.
    image_segments: MainOutput<ImageSegments>,
}

#[context]
pub struct MainOutputs {}

impl ImageSegmenter {
    /// Never fails.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self {})
    }

    /// Without a camera matrix the whole image is scanned.
    pub fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs> {
        let image = context.image;
        let columns = context.steps.columns.max(1);
        let horizon = context.camera_matrix.and_then(CameraMatrix::horizon);
        context.image_segments.column_step = columns;
        // Not the first column: what is cut by the edge of the image is seen only in part.
        for column in (columns / 2..image.columns()).step_by(columns as usize) {
            let first = horizon.map_or(0.0, |horizon| horizon.at(column as f32).max(0.0).ceil());
            let limb = context.limb_mask.first_row(column as f32);
            let end = limb.map_or(image.rows(), |row| image.rows().min(row as u32));
            let scan = Scan {
                image,
                color: context.field_color,
                column,
                end,
            };
            scan.cut(
                first as u32,
                context.steps.rows.clamp(1, image.rows().max(1)),
                &mut context.image_segments.segments,
            );
        }
        Ok(MainOutputs {})
    }
}

/// One column of an image.
struct Scan<'a> {
    image: &'a YuyvImage,
    color: &'a FieldColor,
    column: u32,
    /// The row after the last.
    end: u32,
}

impl Scan<'_> {
    fn cut(&self, first: u32, step: u32, segments: &mut Vec<Segment>) {
        let Some(mut is_field) = self.is_field(first) else {
            return;
        };
        let mut start = first;
        let mut row = first;
        while let Some(next) = self.is_field(row + step) {
            if next != is_field {
                let end = self.change(row, row + step, next);
                segments.push(Segment {
                    column: self.column,
                    start,
                    end,
                    is_field,
                });
                (start, is_field) = (end, next);
            }
            row += step;
        }
        segments.push(Segment {
            column: self.column,
            start,
            end: self.end,
            is_field,
        });
    }

    /// The first row after `low` and not after `high` that looks like `high`.
    fn change(&self, low: u32, high: u32, is_field: bool) -> u32 {
        (low + 1..high)
            .find(|&row| self.is_field(row) == Some(is_field))
            .unwrap_or(high)
    }

    fn is_field(&self, row: u32) -> Option<bool> {
        let color = self.image.yuv(self.column, row)?;
        (row < self.end).then(|| self.color.matches(color))
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{Isometry3, Point2, Translation3, UnitQuaternion, Vector2};
    use types::camera::Intrinsics;
    use types::image::Yuv;
    use types::limbs::LimbOutline;

    use super::*;
    use crate::field_color::tests::{GREEN, field_color};

    const WHITE: [u8; 3] = [220, 220, 220];

    /// Green, with white rows from 20 to 29.
    fn image() -> YuyvImage {
        let mut image = YuyvImage::new(64, 60);
        for row in 0..60 {
            let color = Yuv::from_rgb(if (20..30).contains(&row) {
                WHITE
            } else {
                GREEN
            });
            for pair in image.data[row * 128..][..128].chunks_exact_mut(4) {
                pair.copy_from_slice(&[color.y, color.u, color.y, color.v]);
            }
        }
        image
    }

    fn cut(image: &YuyvImage, camera_matrix: Option<&CameraMatrix>) -> ImageSegments {
        cut_above(image, camera_matrix, &LimbMask::default())
    }

    fn cut_above(
        image: &YuyvImage,
        camera_matrix: Option<&CameraMatrix>,
        limb_mask: &LimbMask,
    ) -> ImageSegments {
        let steps = ScanSteps {
            columns: 16,
            rows: 4,
        };
        cut_every(&steps, image, camera_matrix, limb_mask)
    }

    fn cut_every(
        steps: &ScanSteps,
        image: &YuyvImage,
        camera_matrix: Option<&CameraMatrix>,
        limb_mask: &LimbMask,
    ) -> ImageSegments {
        let mut image_segments = ImageSegments::default();
        ImageSegmenter::new(CreationContext {})
            .unwrap()
            .cycle(CycleContext {
                image: &Leased::of(image.clone()),
                camera_matrix,
                limb_mask,
                field_color: &field_color(),
                steps,
                image_segments: &mut image_segments,
            })
            .unwrap();
        image_segments
    }

    fn column(segments: &ImageSegments, column: u32) -> Vec<(u32, u32, bool)> {
        let own = segments
            .segments
            .iter()
            .filter(|segment| segment.column == column);
        own.map(|segment| (segment.start, segment.end, segment.is_field))
            .collect()
    }

    #[test]
    fn columns_are_cut_where_the_colour_changes_to_the_pixel() {
        let segments = cut(&image(), None);
        for x in [8, 24, 40, 56] {
            assert_eq!(
                column(&segments, x),
                [(0, 20, true), (20, 30, false), (30, 60, true)]
            );
        }
        assert_eq!(segments.segments.len(), 12);
    }

    #[test]
    fn what_is_above_the_horizon_is_left_out() {
        // Level with the floor, so that the horizon goes through the middle.
        let optical = UnitQuaternion::from_euler_angles(-std::f32::consts::FRAC_PI_2, 0.0, 0.0);
        let camera = Isometry3::from_parts(Translation3::new(0.0, 0.0, 0.5), optical);
        let matrix = CameraMatrix {
            ground_to_camera: camera.inverse(),
            intrinsics: Intrinsics {
                focal: Vector2::new(60.0, 60.0),
                center: Vector2::new(32.0, 25.0),
            },
        };
        let segments = cut(&image(), Some(&matrix));
        let first = column(&segments, 24)[0];
        assert!(
            (24..=26).contains(&first.0) && first.1 == 30 && !first.2,
            "{first:?}"
        );
    }

    #[test]
    fn own_limbs_are_left_out() {
        let limb = LimbOutline {
            corners: vec![Point2::new(20.0, 25.0), Point2::new(30.0, 25.0)],
        };
        let limb_mask = LimbMask { limbs: vec![limb] };
        let segments = cut_above(&image(), None, &limb_mask);
        assert_eq!(column(&segments, 24), [(0, 20, true), (20, 25, false)]);
        assert_eq!(column(&segments, 40).len(), 3);
    }

    #[test]
    fn steps_longer_than_the_image_see_the_first_pixel_of_a_column() {
        for rows in [60, u32::MAX] {
            let steps = ScanSteps { columns: 16, rows };
            let segments = cut_every(&steps, &image(), None, &LimbMask::default());
            assert_eq!(column(&segments, 24), [(0, 60, true)], "{rows} rows");
        }
        let steps = ScanSteps {
            columns: u32::MAX,
            rows: 4,
        };
        let segments = cut_every(&steps, &image(), None, &LimbMask::default());
        assert_eq!(segments.segments, []);
    }

    #[test]
    fn an_image_without_pixels_has_no_segments() {
        assert_eq!(cut(&YuyvImage::default(), None).segments, []);
    }
}
