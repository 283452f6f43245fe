//! Lanes of the gaps beside columns, and which heights of them are taken.

/// Between lanes, in pixels.
pub(super) const LANE: i32 = 9;

/// How many lanes are taken on the right of a column.
#[derive(Clone, Default)]
pub(super) struct Gap {
    pub(super) own: Lanes,
    pub(super) across: Lanes,
}

/// Heights that are taken in each lane.
#[derive(Clone, Default)]
pub(super) struct Lanes {
    taken: Vec<Vec<(i32, i32)>>,
}

impl Lanes {
    /// The first lane that is free at these heights.
    pub(super) fn take(&mut self, (top, bottom): (i32, i32)) -> usize {
        let free = self.taken.iter().position(|taken| {
            taken
                .iter()
                .all(|&(other_top, other_bottom)| bottom < other_top || other_bottom < top)
        });
        let lane = free.unwrap_or_else(|| {
            self.taken.push(Vec::new());
            self.taken.len() - 1
        });
        self.taken[lane].push((top, bottom));
        lane
    }

    pub(super) fn is_empty(&self) -> bool {
        self.taken.is_empty()
    }

    pub(super) fn width(&self) -> i32 {
        LANE * count(self.taken.len())
    }
}

/// Lanes and tracks are few: as many as there are wires.
pub(super) fn count(number: usize) -> i32 {
    i32::try_from(number).unwrap_or(i32::MAX / 1024)
}
