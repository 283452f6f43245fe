//! Says what the rest of vision has explained already: no ball is there.

use nalgebra::{Point2, Vector2};
use types::ball::BallCandidate;
use types::field_features::{FieldBorder, LineSegment, PenaltyMark};

use super::view::View;
use crate::landmarks::is_on_line;
use crate::segments::Segment;

/// Border, lines and mark of one image.
pub(super) struct Known<'a> {
    pub(super) border: &'a FieldBorder,
    pub(super) lines: &'a [LineSegment],
    /// In m.
    pub(super) line_width: f32,
    pub(super) penalty_mark: Option<&'a PenaltyMark>,
}

impl Known<'_> {
    /// What of a piece of a column may show a ball.
    ///
    /// Nothing of one that is beyond the border or lies flat on a line from end to end, and nothing that is further above
    /// the border than the top of a ball which stands on it.
    pub(super) fn unexplained(&self, view: &View<'_>, piece: &Segment) -> Option<Segment> {
        let at = |row: u32| Point2::new(piece.column as f32, row as f32);
        let is_on_line = |row: u32| {
            let place = view.matrix.pixel_to_ground(at(row), 0.0);
            place.is_some_and(|place| is_on_line(self.lines, self.line_width, place))
        };
        let is_explained = !self.border.is_inside(at(piece.end))
            || is_on_line(piece.start) && is_on_line(piece.end);
        let top = self.highest(view, piece.column as f32).unwrap_or(0.0);
        (!is_explained).then(|| Segment {
            start: piece.start.max(top as u32).min(piece.end),
            ..*piece
        })
    }

    /// The row of the top of a ball that stands on the border in this column, px.
    fn highest(&self, view: &View<'_>, column: f32) -> Option<f32> {
        let border = self.border.row_at(column)?;
        let radius = view.expected_radius(Point2::new(column, border))?;
        Some(border - 2.0 * radius)
    }

    /// Whether a ball touches the ground beyond the border, or is the penalty mark.
    pub(super) fn refuses(&self, ball: &BallCandidate) -> bool {
        let foot = ball.center + Vector2::new(0.0, ball.radius);
        let is_mark =
            |mark: &PenaltyMark| nalgebra::distance(&mark.center, &ball.center) < ball.radius;
        !self.border.is_inside(foot) || self.penalty_mark.is_some_and(is_mark)
    }
}

#[cfg(test)]
mod tests {
    use types::image::YuyvImage;

    use super::*;
    use crate::ball_detection::field_mask::FieldMask;
    use crate::field_color::tests::field_color;
    use crate::painting::{PROJECTION_NOISE, border_at, camera_matrix};

    const LINE_WIDTH: f32 = 0.05;

    /// Whether a piece of the middle column is explained, from one place ahead to another, in m.
    fn explains(border: &FieldBorder, lines: &[LineSegment], from: f32, to: f32) -> bool {
        unexplained(border, lines, from, to).is_none()
    }

    /// What of it is not, between rows of the image.
    fn unexplained(
        border: &FieldBorder,
        lines: &[LineSegment],
        from: f32,
        to: f32,
    ) -> Option<(u32, u32)> {
        let matrix = camera_matrix(0.4);
        let (image, color) = (YuyvImage::default(), field_color());
        let view = View {
            image: &image,
            matrix: &matrix,
            field: &FieldMask::new(&image, &color),
            ball_radius: 0.05,
            noise: &PROJECTION_NOISE,
        };
        let known = Known {
            border,
            lines,
            line_width: LINE_WIDTH,
            penalty_mark: None,
        };
        let piece = Segment {
            column: 320,
            start: row(to).round() as u32,
            end: row(from).round() as u32,
            is_field: false,
        };
        let left = known.unexplained(&view, &piece)?;
        Some((left.start, left.end))
    }

    /// Where the middle column shows the floor so far ahead, in m.
    fn row(ahead: f32) -> f32 {
        let place = nalgebra::Point3::new(ahead, 0.0, 0.0);
        camera_matrix(0.4).ground_to_pixel(place).unwrap().y
    }

    /// So far ahead, from one place to another.
    fn line_ahead(from: f32, to: f32) -> LineSegment {
        LineSegment {
            start: Point2::new(from, 0.0),
            end: Point2::new(to, 0.0),
            ..LineSegment::default()
        }
    }

    #[test]
    fn a_piece_is_explained_where_both_ends_lie_on_lines() {
        let nothing = FieldBorder::default();
        let line = line_ahead(1.0, 2.0);
        assert!(explains(&nothing, &[line], 1.2, 1.8));
        for (from, to) in [(0.7, 1.5), (1.5, 2.6), (0.7, 2.6)] {
            assert!(!explains(&nothing, &[line], from, to), "{from} to {to}");
        }
        // From one line to another one.
        let lines = [line_ahead(0.6, 0.8), line];
        assert!(explains(&nothing, &lines, 0.7, 1.5));
        assert!(!explains(&nothing, &[], 1.2, 1.8));
    }

    #[test]
    fn a_piece_that_ends_beyond_the_border_is_explained() {
        let border = border_at(row(2.0));
        assert!(explains(&border, &[], 2.2, 3.0));
        // The upper half of a ball before the border may hide what is beyond.
        assert!(!explains(&border, &[], 1.8, 3.0));
        assert!(!explains(&border, &[], 1.2, 1.8));
    }

    #[test]
    fn what_rises_above_a_ball_on_the_border_is_left_out() {
        let border = border_at(row(2.0));
        let (start, end) = unexplained(&border, &[], 1.2, 6.0).unwrap();
        assert_eq!(end, row(1.2).round() as u32);
        // A ball of 10 cm whose middle is seen there, 1.86 m from the camera: 608 px of focal length make it 33 px wide.
        let height = row(2.0) - start as f32;
        assert!((32.0..35.0).contains(&height), "{height} px");
        // Before the border nothing is cut.
        let (start, _) = unexplained(&border, &[], 1.2, 1.8).unwrap();
        assert_eq!(start, row(1.8).round() as u32);
        let nothing = FieldBorder::default();
        let (start, _) = unexplained(&nothing, &[], 1.2, 6.0).unwrap();
        assert_eq!(start, row(6.0).round() as u32);
    }

    #[test]
    fn a_ball_beyond_the_border_and_the_penalty_mark_are_refused() {
        let border = border_at(100.0);
        let mark = PenaltyMark {
            center: Point2::new(320.0, 200.0),
            ..PenaltyMark::default()
        };
        let known = Known {
            border: &border,
            lines: &[],
            line_width: LINE_WIDTH,
            penalty_mark: Some(&mark),
        };
        let ball = |x: f32, y: f32| BallCandidate {
            center: Point2::new(x, y),
            radius: 10.0,
            ..BallCandidate::default()
        };
        assert!(known.refuses(&ball(200.0, 85.0)));
        assert!(!known.refuses(&ball(200.0, 95.0)));
        assert!(known.refuses(&ball(325.0, 205.0)));
        assert!(!known.refuses(&ball(335.0, 205.0)));
    }
}
