//! Finds the centre circle, whose middle is the one place that says alone where on the field it is.
//!
//! Line detection sees an arc as short straight pieces. Each of them proposes a middle to either side of it; the
//! circle is where pieces with different directions, and the middle line if it is seen, propose the same one.

use framework::{
    AdditionalOutput, Input, MainOutput, Parameter, Reflect, RequiredInput, Result, context, math,
};
use nalgebra::{Matrix2, Point2, Vector2};
use serde::{Deserialize, Serialize};
use types::camera::CameraMatrix;
use types::field_features::{CenterCircle, LineSegment};

/// So many pieces are looked at, those with the most points.
const MOST_CHORDS: usize = 10;
/// Of the corners of the polygon that is drawn for a circle.
const OUTLINE: u16 = 36;

/// What makes a centre circle.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct CenterCircleDetectionParameters {
    /// Shorter pieces have too uncertain a direction.
    #[reflect(unit = "m", range = 0.0..)]
    pub least_chord: f32,
    /// Longer ones are straight.
    #[reflect(unit = "m", range = 0.0..)]
    pub longest_chord: f32,
    /// How far apart middles may be that are the same.
    #[reflect(unit = "m", range = 0.0..)]
    pub tolerance: f32,
    /// By how much two of the pieces have to be turned against each other.
    #[reflect(unit = "rad", range = 0.0..)]
    pub least_turn: f32,
    /// How many pieces there have to be; the middle line counts as one.
    pub least_pieces: u32,
    /// How far a piece lies off the circle beside what the camera's pose does, one standard deviation.
    #[reflect(unit = "m", range = 0.0..)]
    pub chord_noise: f32,
    /// Nothing but the middle line comes nearer to the middle, in radii.
    #[reflect(range = 0.0..=1.0)]
    pub empty_share: f32,
}

/// Keeps its heap; empty between cycles.
#[derive(Debug, Deserialize, Serialize)]
pub struct CenterCircleDetection {
    chords: Vec<Chord>,
}

/// A segment that may be a piece of the circle.
#[derive(Clone, Copy, Debug, Deserialize, Serialize)]
struct Chord {
    line: LineSegment,
    direction: Vector2<f32>,
    centers: [Point2<f32>; 2],
}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    lines: Input<Vec<LineSegment>, "lines">,
    camera_matrix: RequiredInput<Option<CameraMatrix>, "camera_matrix?">,
    radius: Parameter<f32, "field_dimensions.markings.circle_radius">,
    parameters:
        Parameter<CenterCircleDetectionParameters, "$cycler_instance.center_circle_detection">,
    /// The circle as a polygon, as far as it can be seen, px.
    image_circle: AdditionalOutput<Vec<Point2<f32>>, "image_circle">,
}

#[context]
pub struct MainOutputs {
    /// `None` where too little of it is seen.
    center_circle: MainOutput<Option<CenterCircle>>,
}

impl CenterCircleDetection {
    /// Never fails.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self { chords: Vec::new() })
    }

    /// The circle on which most pieces lie.
    pub fn cycle(&mut self, mut context: CycleContext) -> Result<MainOutputs> {
        let (radius, parameters) = (*context.radius, context.parameters);
        let chords = context.lines.iter().filter_map(|line| {
            let length = parameters.least_chord..=parameters.longest_chord;
            length.contains(&line.length()).then_some(Chord {
                line: *line,
                direction: line.direction()?,
                centers: line.circle_centers(radius)?,
            })
        });
        // A cycle that failed may have left some.
        self.chords.clear();
        self.chords.extend(chords.take(MOST_CHORDS));
        let view = View {
            chords: &self.chords,
            lines: context.lines,
            radius,
            parameters,
        };
        let center_circle = view.best().and_then(|center| view.fit(center));
        self.chords.clear();
        let matrix = context.camera_matrix;
        context.image_circle.fill_if_subscribed(|| {
            let outline = center_circle.into_iter().flat_map(|circle| {
                let corner = move |index| {
                    let angle = std::f32::consts::TAU * f32::from(index) / f32::from(OUTLINE);
                    let outward = Vector2::new(math::cos(angle), math::sin(angle)) * radius;
                    circle.position + outward
                };
                (0..=OUTLINE).map(corner)
            });
            let pixel =
                |corner: Point2<f32>| matrix.ground_to_pixel(corner.coords.push(0.0).into());
            outline.filter_map(pixel).collect()
        });
        Ok(MainOutputs {
            center_circle: center_circle.into(),
        })
    }
}

/// What one image shows.
struct View<'a> {
    chords: &'a [Chord],
    lines: &'a [LineSegment],
    radius: f32,
    parameters: &'a CenterCircleDetectionParameters,
}

impl View<'_> {
    /// The middle that most pieces propose, and of those the one on which they agree best.
    fn best(&self) -> Option<Point2<f32>> {
        let pairs = self.chords.iter().enumerate().flat_map(|(index, one)| {
            let others = self.chords.iter().skip(index + 1);
            others.map(move |other| (one, other))
        });
        let sine = math::sin(self.parameters.least_turn);
        let turned =
            pairs.filter(|(one, other)| one.direction.perp(&other.direction).abs() >= sine);
        let middles = turned.flat_map(|(one, other)| {
            let both = one.centers.into_iter();
            let both = both.flat_map(|first| other.centers.map(|second| (first, second)));
            let is_same = |(first, second): &(Point2<f32>, Point2<f32>)| {
                nalgebra::distance(first, second) <= self.parameters.tolerance
            };
            let same = both.filter(is_same);
            same.map(|(first, second)| nalgebra::center(&first, &second))
        });
        let judged = middles.filter_map(|middle| Some((self.pieces(middle)?, middle)));
        let best = judged.max_by(|((pieces, apart), _), ((others, other), _)| {
            pieces.cmp(others).then(other.total_cmp(apart))
        });
        best.map(|(_, middle)| middle)
    }

    /// How many pieces of its circle were seen, and how far apart (m) they propose its middle, together.
    ///
    /// `None` where these are too few, or something lies inside of it.
    fn pieces(&self, middle: Point2<f32>) -> Option<(u32, f32)> {
        let (mut pieces, mut apart) = (0, 0.0);
        for (_, center) in self.supporters(middle) {
            pieces += 1;
            apart += nalgebra::distance(&center, &middle);
        }
        let is_through = |line: &LineSegment| {
            let off = line
                .direction()
                .map(|along| along.perp(&(middle - line.start)));
            off.is_some_and(|off| off.abs() <= self.parameters.tolerance)
        };
        let empty = self.parameters.empty_share * self.radius;
        let is_inside = |line: &LineSegment| line.distance_to(middle) <= empty;
        if self
            .lines
            .iter()
            .any(|line| is_inside(line) && !is_through(line))
        {
            return None;
        }
        let is_middle_line = |line: &LineSegment| {
            line.length() > self.parameters.longest_chord
                && line.distance_to(middle) <= self.radius
                && is_through(line)
        };
        pieces += u32::from(self.lines.iter().any(is_middle_line));
        (pieces >= self.parameters.least_pieces).then_some((pieces, apart))
    }

    /// The pieces of the circle about this middle, each with the middle that it proposes.
    fn supporters(&self, middle: Point2<f32>) -> impl Iterator<Item = (&Chord, Point2<f32>)> {
        let off = move |center: &Point2<f32>| nalgebra::distance(center, &middle);
        self.chords.iter().filter_map(move |chord| {
            let [one, other] = chord.centers;
            let center = if off(&one) <= off(&other) { one } else { other };
            (off(&center) <= self.parameters.tolerance).then_some((chord, center))
        })
    }

    /// Least squares: a piece says how far away the middle is, and less well where along itself.
    ///
    /// What the camera's pose does to the pieces of one image is the same for all of them, and is not averaged out.
    fn fit(&self, middle: Point2<f32>) -> Option<CenterCircle> {
        let mut information = Matrix2::zeros();
        let mut weighted = Vector2::zeros();
        let mut of_camera = Matrix2::zeros();
        let mut chords = 0;
        for (chord, center) in self.supporters(middle) {
            let along = chord.direction * chord.direction.transpose();
            let across = Matrix2::identity() - along;
            let weight = across * math::powi(self.parameters.chord_noise, -2)
                + along * math::powi(chord.line.length() / 4.0, -2);
            information += weight;
            weighted += weight * center.coords;
            of_camera += (chord.line.start_covariance + chord.line.end_covariance) * 0.5;
            chords += 1;
        }
        let of_pieces = information.try_inverse()?;
        let covariance = of_pieces + of_camera / chords as f32;
        let position = of_pieces * weighted;
        let is_usable = covariance
            .iter()
            .chain(&position)
            .all(|one| one.is_finite());
        is_usable.then_some(CenterCircle {
            position: position.into(),
            covariance: (covariance + covariance.transpose()) * 0.5,
            chords,
        })
    }
}

#[cfg(test)]
mod tests;
