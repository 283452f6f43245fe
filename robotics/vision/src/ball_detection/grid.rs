//! Proposes where to look: a grid over the floor with one cell for each place of a ball.
//!
//! Rows and columns of cells are as far apart as a ball there is wide, so a ball always fills a good
//! part of one cell, near or far. A cell counts if something in it is not field.

use nalgebra::Point2;

use super::view::View;
use crate::segments::Segment;

/// Cells in which a ball might be.
pub(super) struct Grid {
    /// From the bottom of the image upwards.
    rows: Vec<Row>,
}

struct Row {
    /// First row of pixels.
    top: f32,
    bottom: f32,
    radius: f32,
    marked: Vec<bool>,
}

impl Grid {
    /// Rows from the bottom of the image up to where a ball's radius falls below `smallest` px.
    pub(super) fn new(view: &View<'_>, smallest: f32) -> Self {
        let width = view.image.columns() as f32;
        let mut rows = Vec::new();
        let mut bottom = view.image.rows() as f32;
        while bottom > 0.0
            && let Some(radius) = view.expected_radius(Point2::new(width / 2.0, bottom))
            && radius >= smallest
        {
            let top = bottom - 2.0 * radius;
            let cells = (width / (2.0 * radius)).ceil() as usize;
            rows.push(Row {
                top,
                bottom,
                radius,
                marked: vec![false; cells],
            });
            bottom = top;
        }
        Self { rows }
    }

    /// Marks the cells that hold at least so much (in radii) of one of these pieces.
    pub(super) fn mark(&mut self, segments: impl Iterator<Item = Segment>, least: f32) {
        for segment in segments {
            let (start, end) = (segment.start as f32, segment.end as f32);
            for row in self
                .rows
                .iter_mut()
                .filter(|row| row.top < end && start < row.bottom)
            {
                let inside = end.min(row.bottom) - start.max(row.top);
                let cell = (segment.column as f32 / (2.0 * row.radius)) as usize;
                if inside >= row.radius * least
                    && let Some(marked) = row.marked.get_mut(cell)
                {
                    *marked = true;
                }
            }
        }
    }

    /// Centres of the marked cells and the radius of a ball there.
    pub(super) fn cells(&self) -> impl Iterator<Item = (Point2<f32>, f32)> {
        self.rows.iter().flat_map(|row| {
            let marked = row.marked.iter().enumerate().filter(|(_, marked)| **marked);
            marked.map(|(cell, _)| {
                let x = (cell as f32 * 2.0 + 1.0) * row.radius;
                (
                    Point2::new(x, f32::midpoint(row.top, row.bottom)),
                    row.radius,
                )
            })
        })
    }
}
