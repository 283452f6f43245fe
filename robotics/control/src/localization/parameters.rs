//! Owns the numbers that localisation believes of the robot and of what it sees.

use framework::Reflect;
use serde::{Deserialize, Serialize};

/// What is believed of the robot, its eyes and its legs; noises are one standard deviation.
#[derive(Clone, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct LocalizationParameters {
    /// Where robots stand before the game, by the number of the shirt; a single one is everybody's. Whose number has none may stand at any of them.
    pub start_poses: Vec<FieldPose>,
    /// How far beside the touch line robots are put after a penalty.
    #[reflect(unit = "m", range = 0.0..)]
    pub return_distance: f32,
    /// How exactly people put robots down.
    #[reflect(unit = "m", range = 0.0..)]
    pub start_noise: f32,
    /// Likewise.
    #[reflect(unit = "rad", range = 0.0..)]
    pub start_turn_noise: f32,
    /// In m after 1 m of way.
    pub way_noise: f32,
    /// In rad after 1 rad of turning.
    pub turn_noise: f32,
    /// In rad after 1 m of way.
    pub heading_noise: f32,
    /// In m after 1 s.
    pub standing_noise: f32,
    /// In rad after 1 s.
    pub standing_turn_noise: f32,
    /// In m after 1 s of falling, lying and getting up.
    pub fallen_noise: f32,
    /// In rad after 1 s of falling, lying and getting up.
    pub fallen_turn_noise: f32,
    /// How wrong a place just in front of the robot is seen.
    #[reflect(unit = "m", range = 0.0..)]
    pub least_noise: f32,
    /// By how much more per m of distance, along the line of sight.
    pub noise_along: f32,
    /// By how much more per m² of distance, along the line of sight: an error of the camera's tilt over its height.
    pub noise_by_tilt: f32,
    /// By how much more per m of distance, across the line of sight.
    pub noise_across: f32,
    /// In standard deviations: what is seen farther away from a marking is another one.
    pub gate: f32,
    /// In standard deviations: what another marking explains as well but for this says nothing about where.
    pub clear_by: f32,
    /// What a sighting at the gate still speaks for a place, of one exactly where it was expected.
    #[reflect(range = 0.0..=1.0)]
    pub gate_quality: f32,
    /// A line may be a piece of the centre circle up to this length of a chord, in radii.
    #[reflect(range = 0.0..=2.0)]
    pub longest_chord: f32,
    /// How far the middle of a circle may be off of which a line is a piece.
    #[reflect(unit = "m", range = 0.0..)]
    pub piece_tolerance: f32,
    /// A corner whose opening points elsewhere is another one: the cosine of the angle between both, at least.
    #[reflect(range = -1.0..=1.0)]
    pub same_opening: f32,
    /// A line of this length or longer counts fully.
    #[reflect(unit = "m", range = 0.0..)]
    pub full_length: f32,
    /// As how much line a penalty mark counts.
    #[reflect(unit = "m", range = 0.0..)]
    pub mark_length: f32,
    /// As how much line the centre circle counts.
    #[reflect(unit = "m", range = 0.0..)]
    pub circle_length: f32,
    /// As how much line a corner counts in the search, where its lines count as well.
    #[reflect(unit = "m", range = 0.0..)]
    pub corner_length: f32,
    /// How far a seen line may reach beyond the end of the marking.
    #[reflect(unit = "m", range = 0.0..)]
    pub end_tolerance: f32,
    /// A robot farther beside the field is elsewhere.
    #[reflect(unit = "m", range = 0.0..)]
    pub greatest_distance_outside: f32,
    /// Over how many images evidence is averaged.
    pub evidence_images: f32,
    /// What speaks for a place where somebody put the robot, before it has seen anything.
    #[reflect(range = 0.0..=1.0)]
    pub start_evidence: f32,
    /// More has to speak for another hypothesis than for the one that counts.
    #[reflect(range = 0.0..=1.0)]
    pub switch_margin: f32,
    /// While less speaks for the best hypothesis, others are looked for.
    #[reflect(range = 0.0..=1.0)]
    pub doubted_evidence: f32,
    /// While less speaks for the best hypothesis, the robot does not know where it is.
    #[reflect(range = 0.0..=1.0)]
    pub lost_evidence: f32,
    /// How often places are looked for.
    #[reflect(unit = "s", range = 0.0..)]
    pub search_interval: f32,
    /// What was seen longer ago does not count in the search.
    #[reflect(unit = "s", range = 0.0..)]
    pub memory_time: f32,
    /// Lines are remembered so often.
    #[reflect(unit = "s", range = 0.0..)]
    pub memory_step: f32,
    /// Two lines cross at a right angle in the search while the cosine between them is not greater.
    #[reflect(range = 0.0..=1.0)]
    pub greatest_cosine: f32,
    /// Shorter lines may be pieces of the circle, and are not searched by as lines.
    #[reflect(unit = "m", range = 0.0..)]
    pub least_length: f32,
    /// As pieces of the circle shorter lines have too uncertain a direction to search by.
    #[reflect(unit = "m", range = 0.0..)]
    pub least_chord: f32,
    /// A piece whose normal crosses the middle line at a smaller angle says too little about where; the sine of that.
    #[reflect(range = 0.0..=1.0)]
    pub least_sine: f32,
    /// A piece is none of the circle if the middle lies so much nearer or farther than it has to.
    #[reflect(unit = "m", range = 0.0..)]
    pub chord_tolerance: f32,
    /// So many of the longest lines are tried as the middle line.
    #[reflect(range = 0..=32)]
    pub middle_lines: u32,
    /// Share of what was seen lately that a place has to explain.
    #[reflect(range = 0.0..=1.0)]
    pub found_share: f32,
    /// What speaks for a place that explains all of it.
    #[reflect(range = 0.0..=1.0)]
    pub found_evidence: f32,
    /// How exactly a place is found.
    #[reflect(unit = "m", range = 0.0..)]
    pub found_noise: f32,
    /// Likewise.
    #[reflect(unit = "rad", range = 0.0..)]
    pub found_turn_noise: f32,
    /// Of a place and its twin in the other half the one counts that is so near to the last belief.
    #[reflect(unit = "m", range = 0.0..)]
    pub anchor_distance: f32,
    /// Likewise.
    #[reflect(unit = "rad", range = 0.0..)]
    pub anchor_heading: f32,
    /// Two hypotheses that are so near to each other are one.
    #[reflect(unit = "m", range = 0.0..)]
    pub same_place: f32,
    /// Likewise.
    #[reflect(unit = "rad", range = 0.0..)]
    pub same_heading: f32,
}

/// A place and a heading in the field frame.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct FieldPose {
    /// Towards the opponents' goal from the middle, m.
    pub x: f32,
    /// To the left, m.
    pub y: f32,
    /// From x to y, rad.
    pub heading: f32,
}
