//! Finds places from which the field looks as it was seen, wherever the robot believed to be.
//!
//! Two lines that cross at a right angle fix the pose but for which lines they are: every pair of the
//! field's lines is tried, and what else was seen lately decides. So do the middle line and a piece of the
//! centre circle: the circle's middle lies on both the line and the normal of the piece. A corner fixes the pose
//! but for which corner it is: all of its kind are tried. The field looks
//! the same from both goals, so each place has a twin: the one near the last belief counts, else the one in
//! the own half, where the rules have robots put back.

use nalgebra::{Isometry2, Rotation2, Vector2};
use types::field_features::chord_distance;
use types::field_markings::{Course, FieldCorner, FieldLine};

use super::belief::{Hypothesis, quality};
use super::estimate::Estimate;
use super::features::{Corner, Line};
use super::sight::View;
use crate::angle::wrap;

/// How many places are found at most.
pub(super) const MOST_PLACES: usize = 4;

/// So many places by the circle are judged: a search takes no longer than that.
const MOST_BY_CIRCLE: usize = 16;
/// So many of the newest corners are tried, for the same reason.
const MOST_CORNERS: usize = 4;

/// Places that explain enough of the lines, the longest first, and of the corners, the newest first, in the ground
/// frame; the best place first.
pub(super) fn places(
    lines: &[Line],
    corners: &[Corner],
    anchor: Option<&Isometry2<f32>>,
    view: &View<'_>,
) -> [Option<Hypothesis>; MOST_PLACES] {
    let mut found = [None; MOST_PLACES];
    let known = view.markings.corners();
    let mut judge = |pose: Isometry2<f32>| {
        let pose = resolved(pose, anchor, view);
        if let Some(hypothesis) = judged(&pose, lines, (corners, &known), view) {
            keep(&mut found, hypothesis, view);
        }
    };
    if let Some((one, other)) = crossing(lines, view) {
        for (across, along) in [(one, other), (other, one)] {
            let heading = heading(across, along);
            for (first, second) in pairs(view) {
                judge(place(heading, (across, first.at), (along, second.at)));
            }
        }
    }
    by_circle(lines, view)
        .take(MOST_BY_CIRCLE)
        .for_each(&mut judge);
    by_corner(corners, &known).for_each(judge);
    found
}

/// Places from which one of the corners is one of the field.
fn by_corner(corners: &[Corner], known: &[FieldCorner]) -> impl Iterator<Item = Isometry2<f32>> {
    corners.iter().take(MOST_CORNERS).flat_map(move |seen| {
        let same = known.iter().filter(|corner| corner.kind == seen.kind);
        same.map(|corner| {
            let heading = Rotation2::rotation_between(&seen.direction, &corner.direction);
            let position = corner.position - heading * seen.position;
            Isometry2::new(position, heading.angle())
        })
    })
}

/// Places from which one of the longest lines is the middle line and another one a piece of the circle.
fn by_circle(lines: &[Line], view: &View<'_>) -> impl Iterator<Item = Isometry2<f32>> {
    let radius = view.markings.circle_radius;
    let parameters = view.parameters;
    let longest = lines
        .iter()
        .filter(|line| line.length() >= parameters.least_length);
    longest
        .take(parameters.middle_lines as usize)
        .flat_map(move |middle_line| {
            let pieces = lines.iter().filter(move |line| {
                (parameters.least_chord..=parameters.longest_chord * radius)
                    .contains(&line.length())
            });
            pieces.filter_map(move |piece| {
                let middle = circle_middle(middle_line, piece, view)?;
                // The middle line goes across the field, and the circle's middle is that of the field.
                let heading = Rotation2::rotation_between(&direction(middle_line), &Vector2::y());
                Some(Isometry2::new(-(heading * middle), heading.angle()))
            })
        })
}

/// Where the line meets the normal of the piece, if that is as far from it as the middle of the circle is.
fn circle_middle(line: &Line, piece: &Line, view: &View<'_>) -> Option<Vector2<f32>> {
    let parameters = view.parameters;
    let (along, chord) = (direction(line), direction(piece));
    let normal = Vector2::new(-chord.y, chord.x);
    let sine = normal.perp(&along);
    if sine.abs() < parameters.least_sine {
        return None;
    }
    let from = nalgebra::center(&piece.start, &piece.end).coords;
    let distance = (line.start.coords - from).perp(&along) / sine;
    let expected = chord_distance(piece.length(), view.markings.circle_radius);
    ((distance.abs() - expected).abs() <= parameters.chord_tolerance)
        .then(|| from + normal * distance)
}

/// Every line across the field with every one along it that has another place; ends are judged later.
fn pairs(view: &View<'_>) -> impl Iterator<Item = (FieldLine, FieldLine)> {
    let lines = view.markings.lines();
    let of = move |course| lines.into_iter().filter(move |line| line.course == course);
    let is_first = move |line: &FieldLine| {
        let same = of(Course::Along).find(|other| other.at == line.at);
        same == Some(*line)
    };
    let along = move || of(Course::Along).filter(is_first);
    of(Course::Across).flat_map(move |first| along().map(move |second| (first, second)))
}

/// The longest two lines at a right angle.
fn crossing<'a>(lines: &'a [Line], view: &View<'_>) -> Option<(&'a Line, &'a Line)> {
    let parameters = view.parameters;
    let long = lines
        .iter()
        .filter(|line| line.length() >= parameters.least_length);
    long.clone().find_map(|one| {
        let direction = direction(one);
        let other = long.clone().find(|other| {
            direction.dot(&self::direction(other)).abs() <= parameters.greatest_cosine
        })?;
        Some((one, other))
    })
}

fn direction(line: &Line) -> Vector2<f32> {
    (line.end - line.start) / line.length().max(f32::MIN_POSITIVE)
}

/// Of a robot that sees one line go across the field and one along it; the twin looks the other way.
fn heading(across: &Line, along: &Line) -> Rotation2<f32> {
    let (across_length, along_length) = (across.length(), along.length());
    let (across, along) = (direction(across), direction(along));
    // The line along the field turned by a right angle goes across it.
    let turned = Vector2::new(-along.y, along.x);
    let same_way = if turned.dot(&across) < 0.0 { -1.0 } else { 1.0 };
    let mean = across * across_length + turned * (same_way * along_length);
    Rotation2::rotation_between(&mean, &Vector2::y())
}

fn place(
    heading: Rotation2<f32>,
    (across, x): (&Line, f32),
    (along, y): (&Line, f32),
) -> Isometry2<f32> {
    let middle = |line: &Line| heading * nalgebra::center(&line.start, &line.end);
    let position = Vector2::new(x - middle(across).x, y - middle(along).y);
    Isometry2::new(position, heading.angle())
}

/// The pose or its twin.
fn resolved(
    pose: Isometry2<f32>,
    anchor: Option<&Isometry2<f32>>,
    view: &View<'_>,
) -> Isometry2<f32> {
    let twin = Isometry2::rotation(std::f32::consts::PI) * pose;
    let is_near = |pose: &Isometry2<f32>| {
        anchor.is_some_and(|anchor| {
            let apart = anchor.inv_mul(pose);
            apart.translation.vector.norm() <= view.parameters.anchor_distance
                && wrap(apart.rotation.angle()).abs() <= view.parameters.anchor_heading
        })
    };
    let is_twin = match (is_near(&pose), is_near(&twin)) {
        (false, true) => true,
        (true, false) => false,
        _ => pose.translation.x > 0.0,
    };
    if is_twin { twin } else { pose }
}

/// `None` where it explains too little, or lies beside the field.
fn judged(
    pose: &Isometry2<f32>,
    lines: &[Line],
    (corners, known): (&[Corner], &[FieldCorner]),
    view: &View<'_>,
) -> Option<Hypothesis> {
    let parameters = view.parameters;
    let margin = parameters.greatest_distance_outside;
    if !view
        .markings
        .is_inside(pose.translation.vector.into(), margin)
    {
        return None;
    }
    let estimate = Estimate::new(*pose, parameters.found_noise, parameters.found_turn_noise);
    let (mut total, mut explained) = (0.0, 0.0);
    for line in lines {
        let length = line.length();
        total += length;
        if let Some(found) = view.line(&estimate, line) {
            explained += length * quality(&found, view);
        }
    }
    for corner in corners {
        total += parameters.corner_length;
        if let Some(found) = view.corner(&estimate, corner, known) {
            explained += parameters.corner_length * quality(&found, view);
        }
    }
    let share = explained / total;
    (share >= parameters.found_share).then_some(Hypothesis {
        estimate,
        evidence: share * parameters.found_evidence,
    })
}

/// In the order of what speaks for them; of the same place once.
fn keep(found: &mut [Option<Hypothesis>; MOST_PLACES], hypothesis: Hypothesis, view: &View<'_>) {
    let evidence = |place: &Option<Hypothesis>| place.map_or(-1.0, |known| known.evidence);
    let same = found
        .iter()
        .position(|known| known.is_some_and(|known| known.is_same(&hypothesis, view)));
    let index = same.unwrap_or(MOST_PLACES - 1);
    if evidence(&found[index]) < hypothesis.evidence {
        found[index] = Some(hypothesis);
        found.sort_by(|a, b| evidence(b).total_cmp(&evidence(a)));
    }
}
