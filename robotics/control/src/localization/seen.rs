//! Owns what one image shows of the field.

use framework::{Timeline, Timestamp};
use types::field_features::{CenterCircle, LineCorner, LineSegment, PenaltyMark};

use super::sight::View;

/// What one image shows of the field.
#[derive(Clone, Copy, Debug)]
pub(super) struct Seen<'a> {
    pub(super) lines: &'a [LineSegment],
    pub(super) mark: Option<&'a PenaltyMark>,
    pub(super) circle: Option<&'a CenterCircle>,
    pub(super) corners: &'a [LineCorner],
}

impl Seen<'_> {
    /// Circle and corners are made of lines.
    pub(super) fn is_empty(&self) -> bool {
        self.lines.is_empty() && self.mark.is_none()
    }

    /// Whether the line is a piece of the circle that was seen.
    pub(super) fn is_piece(&self, line: &LineSegment, view: &View<'_>) -> bool {
        let radius = view.markings.circle_radius;
        let tolerance = view.parameters.piece_tolerance;
        self.circle
            .is_some_and(|circle| circle.has_piece(line, radius, tolerance))
    }
}

/// What each image shows, of the outputs of the same cycles.
pub(super) fn images<'c>(
    lines: Timeline<'c, &'c Vec<LineSegment>>,
    marks: Timeline<'c, &'c Option<PenaltyMark>>,
    circles: Timeline<'c, &'c Option<CenterCircle>>,
    corners: Timeline<'c, &'c Vec<LineCorner>>,
) -> impl Iterator<Item = (Timestamp, Seen<'c>)> {
    let rest = circles.zip(corners);
    let images = lines.zip(marks).zip(rest);
    images.map(|((timestamp, (lines, mark)), (_, (circle, corners)))| {
        let seen = Seen {
            lines,
            mark: mark.as_ref(),
            circle: circle.as_ref(),
            corners,
        };
        (timestamp, seen)
    })
}

#[cfg(test)]
mod tests {
    use framework::testing::{at_millis, perception};

    use super::*;

    #[test]
    fn images_of_one_time_keep_what_each_of_them_shows() {
        let at = at_millis(33);
        let mark = PenaltyMark::default();
        let (one, two) = (LineSegment::default(), LineCorner::default());
        let (lines, corners) = ([vec![one], Vec::new()], [Vec::new(), vec![two]]);
        let (marks, circles) = ([None, Some(mark)], [Some(CenterCircle::default()), None]);
        let lines = lines.each_ref().map(|lines| (at, lines));
        let corners = corners.each_ref().map(|corners| (at, corners));
        let marks = marks.each_ref().map(|mark| (at, mark));
        let circles = circles.each_ref().map(|circle| (at, circle));
        let seen: Vec<_> = images(
            perception(&lines, &[]).persistent,
            perception(&marks, &[]).persistent,
            perception(&circles, &[]).persistent,
            perception(&corners, &[]).persistent,
        )
        .map(|(taken_at, seen)| {
            assert_eq!(taken_at, at);
            let Seen {
                lines,
                mark,
                circle,
                corners,
            } = seen;
            (lines.len(), mark.is_some(), circle.is_some(), corners.len())
        })
        .collect();
        assert_eq!(seen, [(1, false, true, 0), (0, true, false, 1)]);
    }
}
