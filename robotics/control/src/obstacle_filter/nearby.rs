//! What the body itself feels in front of it: echoes of the sonar, and what its feet push against.
//!
//! Both come from the near side of something; its middle is farther away.

use framework::math;
use nalgebra::Point2;
use types::feet::Feet;
use types::obstacles::ObstacleKind;
use types::sonar::SonarDistances;

use super::ObstacleFilterParameters;
use super::hypotheses::Measurement;

/// The sonar measures so often, in s; until then its echo is repeated.
const ECHO_INTERVAL: f32 = 0.1;

/// Where the sonar says that something stands in a cycle of `step` seconds, in the ground frame.
///
/// What both receivers hear at about the same distance is one thing straight ahead. All cycles with
/// the same echo together are as sure as that echo, each of them by its share.
pub(super) fn echoes(
    distances: &SonarDistances,
    step: f32,
    parameters: &ObstacleFilterParameters,
) -> impl Iterator<Item = Measurement> + use<> {
    let reach = parameters.sonar_reach;
    let heard =
        |distance: Option<f32>| distance.filter(|distance| (0.0..=reach).contains(distance));
    let angle = parameters.sonar_angle;
    let middle = |distance, angle| behind(distance, angle, parameters);
    let places = match (heard(distances.left), heard(distances.right)) {
        (Some(left), Some(right)) if (left - right).abs() <= parameters.same_place => {
            [Some(middle((left + right) * 0.5, 0.0)), None]
        }
        (left, right) => [
            left.map(|distance| middle(distance, angle)),
            right.map(|distance| middle(distance, -angle)),
        ],
    };
    let share = (step / ECHO_INTERVAL).min(1.0);
    let (noise, evidence) = (
        parameters.sonar_noise / share.sqrt(),
        parameters.sonar_evidence,
    );
    places
        .into_iter()
        .flatten()
        .filter(move |_| share > 0.0)
        .map(move |position| Measurement {
            position,
            noise,
            evidence,
            kind: ObstacleKind::Unknown,
        })
}

/// Where the feet push against something, in the ground frame.
pub(super) fn bumps(
    bumpers: &Feet<bool>,
    parameters: &ObstacleFilterParameters,
) -> impl Iterator<Item = Measurement> + use<> {
    let (distance, angle) = (parameters.bumper_distance, parameters.bumper_angle);
    let places = [
        bumpers.left.then(|| behind(distance, angle, parameters)),
        bumpers.right.then(|| behind(distance, -angle, parameters)),
    ];
    let (noise, evidence) = (parameters.bumper_noise, parameters.bumper_evidence);
    places
        .into_iter()
        .flatten()
        .map(move |position| Measurement {
            position,
            noise,
            evidence,
            kind: ObstacleKind::Unknown,
        })
}

/// The middle of something whose near side is that far away.
fn behind(distance: f32, angle: f32, parameters: &ObstacleFilterParameters) -> Point2<f32> {
    let distance = distance + parameters.unknown_radius;
    let (sine, cosine) = math::sin_cos(angle);
    Point2::new(distance * cosine, distance * sine)
}
