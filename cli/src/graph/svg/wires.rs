//! Wires between rows: which lane of which gap each one runs in.
//!
//! All edges of one kind from one output into one column are one wire. Wires that share no height
//! share a lane; short ones lie next to the cards, so that few wires cross.

use super::cards::Column;
use super::gather::gather;
use super::lanes::{Gap, LANE, count};
use crate::graph::{EdgeKind, Graph};

/// Between the cards and the first lane.
const SHOULDER: i32 = 22;
/// Between wires of a cycler and wires between cyclers.
const DIVIDE: i32 = 16;
/// Least width of a gap.
const GAP: i32 = 40;

/// Every wire with its way, and the gaps that they need.
pub(super) struct Wiring<'g> {
    pub(super) wires: Vec<Wire<'g>>,
    gaps: Vec<Gap>,
    tracks: Vec<Track>,
}

/// Where a wire passes below the columns between the two that it joins.
struct Track {
    y: i32,
    /// The gaps that it leads from and to, the left one first.
    gaps: (usize, usize),
}

/// A value on its way to the readers of one column.
pub(super) struct Wire<'g> {
    pub(super) kind: EdgeKind,
    /// The row that writes, as `cycler`, `node`, `output`.
    pub(super) source: (&'g str, &'g str, &'g str),
    pub(super) from: End,
    pub(super) to: Vec<End>,
    pub(super) way: Way,
}

/// A row of a card of a column.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) struct End {
    pub(super) column: usize,
    pub(super) card: usize,
    pub(super) row: usize,
}

pub(super) enum Way {
    /// In the gap on the right of the only column.
    Own { lane: usize },
    /// In the gap between neighbours.
    Neighbour { gap: usize, lane: usize },
    /// Down, below the columns between, and up.
    Around {
        down: (usize, usize),
        y: i32,
        up: (usize, usize),
    },
}

impl<'g> Wiring<'g> {
    pub(super) fn new(graph: &'g Graph, columns: &[Column<'g>]) -> Self {
        let mut wires = gather(graph, columns);
        let mut gaps = vec![Gap::default(); columns.len()];
        let mut tracks = Vec::new();
        let mut shortest_first: Vec<usize> = (0..wires.len()).collect();
        shortest_first.sort_by_key(|&index| {
            let (top, bottom) = wires[index].heights(columns);
            bottom - top
        });
        for index in shortest_first {
            let wire = &wires[index];
            let heights = wire.heights(columns);
            let (from, to) = (wire.from.column, wire.to[0].column);
            wires[index].way = if from == to {
                Way::Own {
                    lane: gaps[from].own.take(heights),
                }
            } else if from.abs_diff(to) == 1 {
                let gap = from.min(to);
                Way::Neighbour {
                    gap,
                    lane: gaps[gap].across.take(heights),
                }
            } else {
                let (first, last) = if from < to {
                    (from, to - 1)
                } else {
                    (from - 1, to)
                };
                let y = take_track(&mut tracks, columns, (first.min(last), first.max(last)));
                let start = wire.from.y(columns);
                let down = gaps[first].across.take((start.min(y), start.max(y)));
                let ends = wire.to.iter().map(|end| end.y(columns));
                let reach = ends.fold((y, y), |(top, bottom), end| (top.min(end), bottom.max(end)));
                let up = gaps[last].across.take(reach);
                Way::Around {
                    down: (first, down),
                    y,
                    up: (last, up),
                }
            };
        }
        Self {
            wires,
            gaps,
            tracks,
        }
    }

    /// As they are drawn: the lane next to the cards last, so that its beginning is seen where
    /// several wires begin at one row.
    pub(super) fn back_to_front(&self) -> Vec<&Wire<'g>> {
        let mut wires: Vec<&Wire<'g>> = self.wires.iter().collect();
        wires.sort_by_key(|wire| match wire.way {
            Way::Around { .. } => (0, 0),
            Way::Neighbour { .. } => (1, 0),
            Way::Own { lane } => (2, -count(lane)),
        });
        wires
    }

    /// Width of the gap on the right of a column.
    pub(super) fn gap_width(&self, gap: usize) -> i32 {
        let Gap { own, across } = &self.gaps[gap];
        let divide = if across.is_empty() {
            0
        } else {
            DIVIDE + SHOULDER
        };
        let own_width = if own.is_empty() {
            0
        } else {
            SHOULDER + own.width()
        };
        GAP.max(own_width + divide + across.width())
    }

    /// Below all wires that pass below columns.
    pub(super) fn bottom(&self) -> i32 {
        let lowest = self.tracks.iter().map(|track| track.y + LANE).max();
        lowest.unwrap_or(0)
    }

    /// Corners of a wire from its source to one of its readers. `rights`: where the cards of each
    /// column end.
    pub(super) fn corners(
        &self,
        wire: &Wire<'_>,
        to: End,
        columns: &[Column<'_>],
        rights: &[i32],
    ) -> Vec<(i32, i32)> {
        let (start_y, end_y) = (wire.from.y(columns), to.y(columns));
        let left = |column: usize| rights[column] - columns[column].width;
        let (start_x, end_x) = if wire.from.column < to.column {
            (rights[wire.from.column], left(to.column))
        } else if wire.from.column > to.column {
            (left(wire.from.column), rights[to.column])
        } else {
            (rights[to.column], rights[to.column])
        };
        let mut corners = vec![(start_x, start_y)];
        match wire.way {
            Way::Own { lane } => {
                let x = rights[to.column] + SHOULDER + LANE * count(lane);
                corners.extend([(x, start_y), (x, end_y)]);
            }
            Way::Neighbour { gap, lane } => {
                let x = self.across_x(gap, lane, rights);
                corners.extend([(x, start_y), (x, end_y)]);
            }
            Way::Around { down, y, up } => {
                let (down, up) = (
                    self.across_x(down.0, down.1, rights),
                    self.across_x(up.0, up.1, rights),
                );
                corners.extend([(down, start_y), (down, y), (up, y), (up, end_y)]);
            }
        }
        corners.push((end_x, end_y));
        corners
    }

    fn across_x(&self, gap: usize, lane: usize, rights: &[i32]) -> i32 {
        let own = &self.gaps[gap].own;
        let own_width = if own.is_empty() {
            0
        } else {
            SHOULDER + own.width()
        };
        rights[gap] + own_width + DIVIDE + LANE * count(lane)
    }
}

/// The first height below the columns between two gaps where no other wire passes.
fn take_track(tracks: &mut Vec<Track>, columns: &[Column<'_>], gaps: (usize, usize)) -> i32 {
    let between = &columns[gaps.0 + 1..=gaps.1];
    let bottom = between.iter().map(|column| column.bottom).max();
    let mut y = bottom.unwrap_or_default() + LANE;
    let is_taken = |tracks: &[Track], y: i32| {
        let mut near = tracks.iter().filter(|track| (track.y - y).abs() < LANE);
        near.any(|track| track.gaps.0 <= gaps.1 && gaps.0 <= track.gaps.1)
    };
    while is_taken(tracks, y) {
        y += LANE;
    }
    tracks.push(Track { y, gaps });
    y
}

impl Wire<'_> {
    /// From the highest to the lowest row that it touches.
    fn heights(&self, columns: &[Column<'_>]) -> (i32, i32) {
        let from = self.from.y(columns);
        self.to
            .iter()
            .map(|end| end.y(columns))
            .fold((from, from), |(top, bottom), y| (top.min(y), bottom.max(y)))
    }
}

impl End {
    pub(super) fn y(self, columns: &[Column<'_>]) -> i32 {
        columns[self.column].cards[self.card].rows[self.row].y
    }
}
