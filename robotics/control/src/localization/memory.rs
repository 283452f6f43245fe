//! Owns `Memory`, lines and corners that were seen lately: one image rarely shows enough to find a lost robot.

use framework::Timestamp;
use nalgebra::Isometry2;
use serde::{Deserialize, Serialize};

use super::features::{Corner, Line};
use super::seen::Seen;
use super::sight::View;

/// How many lines are remembered.
const MOST_LINES: usize = 32;
/// How many of one image.
const OF_ONE_IMAGE: usize = 4;
/// How many corners are remembered.
const MOST_CORNERS: usize = 8;
/// How many of one image.
const CORNERS_OF_ONE_IMAGE: usize = 2;

/// The newest ones, in the start frame of odometry.
#[derive(Clone, Copy, Debug, Default, Deserialize, Serialize)]
pub(super) struct Memory {
    lines: [Option<Remembered<Line>>; MOST_LINES],
    next: usize,
    corners: [Option<Remembered<Corner>>; MOST_CORNERS],
    next_corner: usize,
    newest: Timestamp,
}

#[derive(Clone, Copy, Debug, Deserialize, Serialize)]
struct Remembered<T> {
    what: T,
    seen_at: Timestamp,
}

impl<T> Remembered<T> {
    fn is_recent(&self, now: Timestamp, view: &View<'_>) -> bool {
        (now - self.seen_at).as_secs_f32() <= view.parameters.memory_time
    }
}

impl Memory {
    /// Keeps the first lines and corners of an image, in which those with the most points stand first. Images
    /// that follow at once show the same.
    pub(super) fn remember(
        &mut self,
        seen_at: Timestamp,
        ground_to_start: &Isometry2<f32>,
        seen: &Seen<'_>,
        view: &View<'_>,
    ) {
        let since = (seen_at - self.newest).as_secs_f32();
        if self.newest > Timestamp::ZERO && since < view.parameters.memory_step {
            return;
        }
        self.newest = seen_at;
        for line in seen.lines.iter().take(OF_ONE_IMAGE) {
            let what = Line::from(line).moved(ground_to_start);
            self.lines[self.next] = Some(Remembered { what, seen_at });
            self.next = (self.next + 1) % MOST_LINES;
        }
        let corners = seen.corners.iter().map(Corner::from);
        let corners = corners.filter(Corner::is_on_field);
        for corner in corners.take(CORNERS_OF_ONE_IMAGE) {
            let what = corner.moved(ground_to_start);
            self.corners[self.next_corner] = Some(Remembered { what, seen_at });
            self.next_corner = (self.next_corner + 1) % MOST_CORNERS;
        }
    }

    /// What is not too old, in the ground frame, those of the newest image first, of one image the one that was told last.
    pub(super) fn corners(
        &self,
        now: Timestamp,
        ground_to_start: &Isometry2<f32>,
        view: &View<'_>,
    ) -> Vec<Corner> {
        let to_ground = ground_to_start.inverse();
        let oldest_first = self.corners[self.next_corner..]
            .iter()
            .chain(&self.corners[..self.next_corner]);
        let newest_first = oldest_first.rev().flatten();
        newest_first
            .filter(|remembered| remembered.is_recent(now, view))
            .map(|remembered| remembered.what.moved(&to_ground))
            .collect()
    }

    /// What is not too old, in the ground frame, the longest first.
    pub(super) fn lines(
        &self,
        now: Timestamp,
        ground_to_start: &Isometry2<f32>,
        view: &View<'_>,
    ) -> Vec<Line> {
        let to_ground = ground_to_start.inverse();
        let all = self.lines.iter().flatten();
        let mut lines: Vec<_> = all
            .filter(|remembered| remembered.is_recent(now, view))
            .map(|remembered| remembered.what.moved(&to_ground))
            .collect();
        lines.sort_by(|a, b| b.length().total_cmp(&a.length()));
        lines
    }
}
