//! What a scan of an image's columns found: pieces that are field and pieces that are not.

use framework::{Clear, Reflect};
use serde::{Deserialize, Serialize};

/// The pieces of all scanned columns, columns from left to right and each from top to bottom.
#[derive(Clear, Clone, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
pub struct ImageSegments {
    /// Distance between scanned columns in px.
    pub column_step: u32,
    /// The pieces; within a column each starts where the one before ended.
    pub segments: Vec<Segment>,
}

impl ImageSegments {
    /// The pieces of each scanned column, from left to right; none of them is empty.
    pub fn columns(&self) -> impl Iterator<Item = &[Segment]> {
        self.segments
            .chunk_by(|one, other| one.column == other.column)
    }

    /// The pieces that are not field between two that are, column by column.
    pub fn enclosed(&self) -> impl Iterator<Item = &Segment> {
        self.columns()
            .flat_map(|column| column.windows(3).map(|pieces| &pieces[1]))
            .filter(|piece| !piece.is_field)
    }
}

/// A piece of a column whose pixels all are field or all are not.
#[derive(Clear, Clone, Copy, Debug, Default, Deserialize, Eq, PartialEq, Reflect, Serialize)]
pub struct Segment {
    /// Column in px.
    pub column: u32,
    /// First row in px.
    pub start: u32,
    /// The row in px after the last.
    pub end: u32,
    /// Whether it has the colour of the field.
    pub is_field: bool,
}
