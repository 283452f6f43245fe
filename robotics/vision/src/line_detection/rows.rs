//! Cuts rows of the image: columns run along the lines that lead away from the robot and miss them.

use nalgebra::Point2;
use types::limbs::LimbMask;

use super::points::View;
use crate::field_color::FieldColor;

/// Calls `found` with the first and the last pixel of every piece between two pieces of field.
pub(super) fn scan(
    view: &View<'_>,
    color: &FieldColor,
    limb_mask: &LimbMask,
    mut found: impl FnMut(Point2<f32>, Point2<f32>),
) {
    let width = view.image.columns();
    let step = view.parameters.row_step.max(1);
    let sample_step = view.parameters.sample_step.max(1);
    for row in (first_row(view)..view.image.rows()).step_by(step as usize) {
        let is_field = |column: u32| {
            let color_there = view.image.yuv(column, row);
            color_there.is_some_and(|there| color.matches(there))
        };
        // Where the piece that is not field began, if field came before it.
        let mut start = None;
        let mut was_field = false;
        for column in (0..width).step_by(sample_step as usize) {
            let now_field = is_field(column);
            if was_field && !now_field {
                start = Some(first_like(column, sample_step, false, is_field));
            } else if !was_field
                && now_field
                && let Some(start) = start.take()
            {
                let end = first_like(column, sample_step, true, is_field) - 1;
                let at = |column: u32| Point2::new(column as f32, row as f32);
                let middle = nalgebra::center(&at(start), &at(end));
                if !limb_mask.covers(middle) {
                    found(at(start), at(end));
                }
            }
            was_field = now_field;
        }
    }
}

/// The first column after the sample before `column` that is like it.
fn first_like(column: u32, step: u32, wanted: bool, is_field: impl Fn(u32) -> bool) -> u32 {
    let before = column.saturating_sub(step) + 1;
    (before..column)
        .find(|&between| is_field(between) == wanted)
        .unwrap_or(column)
}

/// The first row that shows some of the field.
fn first_row(view: &View<'_>) -> u32 {
    let right = view.image.columns() as f32;
    let border = |x: f32| view.border.row_at(x);
    let horizon = view.matrix.horizon();
    let first = |x: f32| border(x).or(horizon.map(|horizon| horizon.at(x)));
    let rows = [first(0.0), first(right)].into_iter().flatten();
    // Lower than both ends the border may only be between them.
    rows.reduce(f32::min).unwrap_or(0.0).max(0.0) as u32
}
