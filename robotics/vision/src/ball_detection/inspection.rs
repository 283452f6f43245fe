//! Looks at one place closely: is there a circle of the right size on the field, and is it printed like a ball?

use std::f32::consts::TAU;
use std::sync::LazyLock;

use framework::math;
use nalgebra::{Point2, Vector2};

use super::circle::{self, Circle};
use super::view::View;
use super::{BallClassifier, BallDetectionParameters, BallInspectionParameters};

/// Rays on which the rim is looked for.
const RAYS: usize = 32;
/// So often the middle is looked for anew.
const MOVES: usize = 3;

/// A circle that may be a ball.
#[derive(Clone, Copy, Debug)]
pub(super) struct Proposal {
    pub(super) circle: Circle,
    /// The share of the rim that was found, 0 to 1.
    pub(super) rim: f32,
}

/// A circle that passed every test.
#[derive(Clone, Copy, Debug)]
pub(super) struct Finding {
    pub(super) circle: Circle,
    /// How much it is like a ball, 0 to 1.
    pub(super) score: f32,
}

/// Looks for a circle on the field around `center`, where a ball would have about this radius in px.
pub(super) fn propose(
    view: &View<'_>,
    parameters: &BallDetectionParameters,
    center: Point2<f32>,
    radius: f32,
) -> Option<Proposal> {
    let (least_rim, least_field_around) = match parameters.classifier {
        BallClassifier::Print => (parameters.least_rim, parameters.least_field_around),
        BallClassifier::Network => (
            parameters.network.least_rim,
            parameters.network.least_field_around,
        ),
    };
    let inspection = &parameters.inspection;
    let middle = move_to_middle(view, inspection, center, radius)?;
    if field_inside(view, middle, radius) > inspection.most_field_at_first {
        return None;
    }
    let first = find_rim(view, parameters, middle)?;
    if first.rim < least_rim * inspection.rim_at_first {
        return None;
    }
    // From the middle of the circle every ray meets the rim squarely.
    let proposal = find_rim(view, parameters, first.circle.center)?;
    let is_proposed = proposal.rim >= least_rim
        && ring_on_field(view, inspection, &proposal.circle) >= least_field_around;
    is_proposed.then_some(proposal)
}

/// Follows what is not field to its middle.
fn move_to_middle(
    view: &View<'_>,
    inspection: &BallInspectionParameters,
    start: Point2<f32>,
    radius: f32,
) -> Option<Point2<f32>> {
    let mut center = start;
    for _ in 0..MOVES {
        let mut sum = Vector2::zeros();
        let mut count = 0.0;
        view.visit_disc(
            center,
            radius * inspection.first_disc,
            |offset, is_field| {
                if is_field == Some(false) {
                    sum += offset;
                    count += 1.0;
                }
            },
        );
        if count < inspection.least_samples.max(1) as f32 {
            return None;
        }
        center += sum / count;
    }
    Some(center)
}

/// The share of a disc that is field.
fn field_inside(view: &View<'_>, center: Point2<f32>, radius: f32) -> f32 {
    let (mut field, mut count) = (0.0, 0.0);
    view.visit_disc(center, radius, |_, is_field| {
        count += 1.0;
        if is_field == Some(true) {
            field += 1.0;
        }
    });
    field / count
}

/// The circle where, coming from outside, the field ends.
fn find_rim(
    view: &View<'_>,
    parameters: &BallDetectionParameters,
    center: Point2<f32>,
) -> Option<Proposal> {
    let expected = view.expected_radius(center)?;
    let mut rim = Vec::with_capacity(RAYS);
    let on_ray = |direction: &Vector2<f32>| {
        rim_on_ray(view, &parameters.inspection, center, *direction, expected)
    };
    rim.extend(DIRECTIONS.iter().filter_map(on_ray));
    let tolerance = parameters.radius_tolerance;
    let circle = circle::find(&rim, expected / tolerance..expected * tolerance)?;
    let expected = view.expected_radius(circle.center)?;
    let fits = (expected / tolerance..expected * tolerance).contains(&circle.radius);
    fits.then(|| Proposal {
        circle,
        rim: circle.support(&rim) as f32 / RAYS as f32,
    })
}

/// The outermost place on a ray where field is followed by two pixels that are not.
fn rim_on_ray(
    view: &View<'_>,
    inspection: &BallInspectionParameters,
    center: Point2<f32>,
    direction: Vector2<f32>,
    expected: f32,
) -> Option<Point2<f32>> {
    let at = |distance: f32| view.is_field(center + direction * distance);
    let furthest = (expected * inspection.furthest_rim).ceil() as i32;
    let nearest = (expected * inspection.nearest_rim) as i32;
    let mut outside_was_field = false;
    for distance in (nearest..furthest).rev() {
        let distance = distance as f32;
        match at(distance) {
            Some(true) => outside_was_field = true,
            Some(false) if outside_was_field && at(distance - 1.0) == Some(false) => {
                return Some(center + direction * (distance + 0.5));
            }
            // Something else than field outside, or beyond the edge of the image.
            Some(false) | None => {}
        }
    }
    None
}

/// The share of a ring around the circle that is field.
fn ring_on_field(view: &View<'_>, inspection: &BallInspectionParameters, circle: &Circle) -> f32 {
    let rings = [inspection.inner_ring, inspection.outer_ring];
    let samples = DIRECTIONS.iter().flat_map(|direction| {
        rings.map(|distance| circle.center + direction * (circle.radius * distance))
    });
    let (field, seen) = samples
        .filter_map(|point| view.is_field(point))
        .fold((0.0, 0.0), |(field, seen), is_field| {
            (field + f32::from(u8::from(is_field)), seen + 1.0)
        });
    if seen == 0.0 { 0.0 } else { field / seen }
}

/// Whether the disc has dark patches on a bright ground, and no field shows through.
pub(super) fn is_printed(
    view: &View<'_>,
    parameters: &BallDetectionParameters,
    circle: &Circle,
) -> bool {
    let radius = circle.radius * parameters.inspection.print_disc;
    let luminances = view.luminances(circle.center, radius);
    let brightest = luminances.iter().copied().fold(0.0, f32::max);
    let bright = |luminance: f32| luminance > brightest * parameters.dark_limit;
    let (dark_sum, dark, bright_sum, light) = luminances.iter().fold(
        (0.0, 0.0, 0.0, 0.0),
        |(dark_sum, dark, bright_sum, light), luminance| {
            if bright(*luminance) {
                (dark_sum, dark, bright_sum + luminance, light + 1.0)
            } else {
                (dark_sum + luminance, dark + 1.0, bright_sum, light)
            }
        },
    );
    if dark == 0.0 || light == 0.0 {
        return false;
    }
    let contrast = bright_sum / light - dark_sum / dark;
    field_inside(view, circle.center, radius) <= parameters.most_field_inside
        && contrast >= parameters.least_contrast
        && (parameters.least_dark..parameters.most_dark).contains(&(dark / (dark + light)))
}

/// Of length 1, evenly around.
static DIRECTIONS: LazyLock<[Vector2<f32>; RAYS]> = LazyLock::new(|| {
    std::array::from_fn(|ray| {
        let (sine, cosine) = math::sin_cos(ray as f32 * TAU / RAYS as f32);
        Vector2::new(cosine, sine)
    })
});
