//! Robots that see more than the field's lines: the strings of a net look like lines.

use super::*;

/// A place from which two long lines are seen.
fn place() -> Isometry2<f32> {
    pose(-3.0, 3.0, -FRAC_PI_2)
}

/// So many lines that the field's are about this share of all that is seen; none of them lies as any marking does.
fn strings(field: &[LineSegment], share: f32) -> Vec<LineSegment> {
    let counts = |line: &LineSegment| line.length().min(PARAMETERS.full_length);
    let explained: f32 = field.iter().map(counts).sum();
    let count = (explained / share - explained) / PARAMETERS.full_length;
    let aslant = Vector2::new(1.0, 1.0) * PARAMETERS.full_length;
    let string = |index: u16| {
        let start = Point2::new(0.4 + 0.3 * f32::from(index), 0.4);
        segment(start, start + aslant)
    };
    (0..count.round() as u16).map(string).collect()
}

/// What it believes after it has seen for 4 s what `more` adds to the field's lines, and what speaks for that.
fn look(
    node: &mut Localization,
    from: u64,
    more: &[LineSegment],
) -> (Option<Isometry2<f32>>, PoseHypothesis) {
    let mut lines = view_from(&place());
    lines.extend_from_slice(more);
    let images = (from..from + 120).map(|index| {
        let seen = cycle(node, &playing(33 * index, Isometry2::identity(), &lines));
        (seen.ground_to_field, seen.hypotheses[0])
    });
    images.last().unwrap()
}

#[test]
fn who_can_explain_too_little_of_what_it_sees_is_lost_until_it_can() {
    let least = PARAMETERS.lost_evidence;
    let field = view_from(&place());
    for (share, knows) in [(least + 0.15, true), (least - 0.15, false)] {
        let mut node = node();
        let (found, _) = look(&mut node, 1, &[]);
        assert_near(found, &place(), 0.1, 0.1);
        let more = strings(&field, share);
        let (found, best) = look(&mut node, 121, &more);
        let evidence = best.evidence;
        assert!((evidence - share).abs() < 0.12, "{evidence} of {share}");
        assert_eq!(found.is_some(), knows, "{evidence}");
        let (found, _) = look(&mut node, 241, &[]);
        assert_near(found, &place(), 0.1, 0.1);
    }
}
