//! Finds the ball: a circle on the field, as large as a ball would be there, printed black and white.
//!
//! What lies flat on a known line or the penalty mark and what is beyond the border is not looked at.
//! A grid of places proposes, the rim says where exactly a circle is, and a small network decides; or, as it was before there
//! was one, the rim and the print decide. Parameters choose.

pub mod patch;

mod circle;
mod disc;
mod field_mask;
mod grid;
mod inspection;
mod known;
mod network;
mod view;

use framework::pool::Leased;
use framework::{
    AdditionalOutput, Clear, Input, MainOutput, Parameter, Reflect, RequiredInput, Result, context,
};
use nalgebra::{Point2, Vector2};
use serde::{Deserialize, Serialize};
use types::ball::{BallCandidate, BallView};
use types::camera::CameraMatrix;
use types::field_features::{FieldBorder, LineSegment, PenaltyMark};
use types::image::YuyvImage;
use types::projection_noise::ProjectionNoise;

use self::field_mask::FieldMask;
use self::grid::Grid;
use self::inspection::{Finding, Proposal, propose};
use self::known::Known;
use self::patch::{Patch, cut};
use self::view::View;
use crate::field_color::FieldColor;
use crate::segments::ImageSegments;

/// Who decides whether a circle is a ball.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, PartialEq, Reflect, Serialize)]
pub enum BallClassifier {
    /// The network; see `network.toml` for what it has learnt.
    #[default]
    Network,
    /// Thresholds of the rim and of the print.
    Print,
}

/// What lets the network see a circle, and believe in it.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct BallNetworkParameters {
    /// Least share of the rim that must be found.
    #[reflect(range = 0.0..=1.0)]
    pub least_rim: f32,
    /// Least share of field in the ring around it.
    #[reflect(range = 0.0..=1.0)]
    pub least_field_around: f32,
    /// Least probability.
    #[reflect(range = 0.0..=1.0)]
    pub least_confidence: f32,
}

/// How closely a place is looked at; lengths in radii of a ball there.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct BallInspectionParameters {
    /// So much of the height of a cell of the grid is no field where it is looked at all.
    #[reflect(range = 0.0..=2.0)]
    pub least_piece: f32,
    /// In so large a disc what is not field has its middle.
    #[reflect(range = 0.0..=4.0)]
    pub first_disc: f32,
    /// So many of the samples in it, of some hundred, are not field, at least.
    pub least_samples: u32,
    /// A disc with more field than this is not worth a search for its rim.
    #[reflect(range = 0.0..=1.0)]
    pub most_field_at_first: f32,
    /// From a middle that is not yet the circle's at least this part of the needed rim is found.
    #[reflect(range = 0.0..=1.0)]
    pub rim_at_first: f32,
    /// From here on the rim is looked for.
    #[reflect(range = 0.0..=4.0)]
    pub nearest_rim: f32,
    /// Up to here.
    #[reflect(range = 0.0..=4.0)]
    pub furthest_rim: f32,
    /// Where around the circle field is looked for: on a ring that is so large, in radii of the circle.
    #[reflect(range = 0.0..=4.0)]
    pub inner_ring: f32,
    /// And on one that is so large.
    #[reflect(range = 0.0..=4.0)]
    pub outer_ring: f32,
    /// The print is looked at within so much of the circle, in radii of it.
    #[reflect(range = 0.0..=1.0)]
    pub print_disc: f32,
}

/// A circle that was looked at closely, for who wants to collect such.
#[derive(Clear, Clone, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
pub struct BallProposal {
    /// The circle.
    pub candidate: BallCandidate,
    /// The share of its rim that was found, 0 to 1.
    pub rim: f32,
    /// Luminances of 16 rows of 16 cells; the circle has a third of the side as its radius.
    #[serde(with = "framework::bytes")]
    pub patch: Vec<u8>,
    /// How sure the network is that it is a ball, 0 to 1.
    pub confidence: f32,
}

/// What makes a circle a ball.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct BallDetectionParameters {
    /// Who decides.
    pub classifier: BallClassifier,
    /// For the network; what follows is for the print, but for inspection and radii.
    pub network: BallNetworkParameters,
    /// For both.
    pub inspection: BallInspectionParameters,
    /// Smaller balls in px are not looked for.
    pub least_radius: f32,
    /// By which factor the radius may differ from what the distance says.
    pub radius_tolerance: f32,
    /// Least share of the rim that must be found.
    #[reflect(range = 0.0..=1.0)]
    pub least_rim: f32,
    /// Least share of field in the ring around it.
    #[reflect(range = 0.0..=1.0)]
    pub least_field_around: f32,
    /// Largest share of field within it.
    #[reflect(range = 0.0..=1.0)]
    pub most_field_inside: f32,
    /// Least difference between the mean luminances of print and ground.
    pub least_contrast: f32,
    /// Print is dark up to this share of the brightest luminance.
    #[reflect(range = 0.0..=1.0)]
    pub dark_limit: f32,
    /// Least share of dark print.
    #[reflect(range = 0.0..=1.0)]
    pub least_dark: f32,
    /// Largest share of dark print.
    #[reflect(range = 0.0..=1.0)]
    pub most_dark: f32,
}

/// Has nothing to remember.
#[derive(Debug, Deserialize, Serialize)]
pub struct BallDetection {}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    image: RequiredInput<Option<Leased<YuyvImage>>, "image?">,
    image_segments: Input<ImageSegments, "image_segments">,
    field_border: Input<FieldBorder, "field_border">,
    lines: Input<Vec<LineSegment>, "lines">,
    penalty_mark: Input<Option<PenaltyMark>, "penalty_mark?">,
    camera_matrix: RequiredInput<Option<CameraMatrix>, "camera_matrix?">,
    field_color: Input<FieldColor, "field_color">,
    parameters: Parameter<BallDetectionParameters, "ball_detection">,
    #[reflect(unit = "m", range = 0.0..)]
    ball_radius: Parameter<f32, "field_dimensions.ball_radius">,
    line_width: Parameter<f32, "field_dimensions.line_width">,
    projection_noise: Parameter<ProjectionNoise, "projection_noise">,
    /// Where a ball was looked for.
    ball_candidates: AdditionalOutput<Vec<BallCandidate>, "ball_candidates">,
    /// Circles that were looked at closely.
    ball_proposals: AdditionalOutput<Vec<BallProposal>, "ball_proposals">,
    /// What passed every test, best first; no two of them overlap.
    balls: MainOutput<Vec<BallCandidate>>,
}

#[context]
pub struct MainOutputs {
    /// Where balls were looked for; `None` where no image was.
    ball_view: MainOutput<Option<BallView>>,
}

impl BallDetection {
    /// Never fails.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self {})
    }

    /// The circles that pass every test.
    pub fn cycle(&mut self, mut context: CycleContext) -> Result<MainOutputs> {
        let view = View {
            image: context.image,
            matrix: context.camera_matrix,
            field: &FieldMask::new(context.image, context.field_color),
            ball_radius: *context.ball_radius,
            noise: context.projection_noise,
        };
        let known = Known {
            border: context.field_border,
            lines: context.lines,
            line_width: *context.line_width,
            penalty_mark: context.penalty_mark,
        };
        let mut grid = Grid::new(&view, context.parameters.least_radius.max(1.0));
        let pieces = context.image_segments.segments.iter();
        let pieces = pieces.filter(|piece| !piece.is_field);
        let pieces = pieces.filter_map(|piece| known.unexplained(&view, piece));
        grid.mark(pieces, context.parameters.inspection.least_piece);
        context.ball_candidates.fill_if_subscribed(|| {
            grid.cells()
                .map(|(center, radius)| locate(&view, center, radius))
                .collect()
        });
        let parameters = context.parameters;
        let proposals: Vec<_> = grid
            .cells()
            .filter_map(|(center, radius)| propose(&view, parameters, center, radius))
            .collect();
        context
            .ball_proposals
            .fill_if_subscribed(|| proposals.iter().map(|one| told(&view, one)).collect());
        let mut findings: Vec<_> = proposals
            .iter()
            .filter_map(|proposal| judge(&view, parameters, proposal))
            .collect();
        findings.sort_by(|one, other| other.score.total_cmp(&one.score));
        for Finding { circle, .. } in findings {
            let ball = locate(&view, circle.center, circle.radius);
            let is_new = !context.balls.iter().any(|better| overlap(better, &ball));
            if is_new && !known.refuses(&ball) {
                context.balls.push(ball);
            }
        }
        let ball_view = BallView {
            camera_matrix: *context.camera_matrix,
            size: Vector2::new(context.image.columns() as f32, context.image.rows() as f32),
            least_radius: parameters.least_radius,
            ball_radius: *context.ball_radius,
        };
        Ok(MainOutputs {
            ball_view: Some(ball_view).into(),
        })
    }
}

/// How much a circle is like a ball; `None` if it is none.
fn judge(
    view: &View<'_>,
    parameters: &BallDetectionParameters,
    proposal: &Proposal,
) -> Option<Finding> {
    let circle = proposal.circle;
    let score = match parameters.classifier {
        BallClassifier::Print => {
            inspection::is_printed(view, parameters, &circle).then_some(proposal.rim)?
        }
        BallClassifier::Network => network::confidence(&cut(view.image, &circle)),
    };
    let is_ball = parameters.classifier == BallClassifier::Print
        || score >= parameters.network.least_confidence;
    is_ball.then_some(Finding { circle, score })
}

fn told(view: &View<'_>, proposal: &Proposal) -> BallProposal {
    let patch: Patch = cut(view.image, &proposal.circle);
    BallProposal {
        candidate: locate(view, proposal.circle.center, proposal.circle.radius),
        rim: proposal.rim,
        patch: patch.to_vec(),
        confidence: network::confidence(&patch),
    }
}

fn locate(view: &View<'_>, center: Point2<f32>, radius: f32) -> BallCandidate {
    let position = view.matrix.pixel_to_ground(center, view.ball_radius);
    let covariance = |place| {
        view.matrix
            .ground_covariance(place, view.ball_radius, view.noise)
    };
    let known = position.and_then(|position| Some((position, covariance(position)?)));
    BallCandidate {
        center,
        radius,
        position: known.map(|(position, _)| position),
        covariance: known.map(|(_, covariance)| covariance),
    }
}

/// Neighbouring cells often find the same circle.
fn overlap(one: &BallCandidate, other: &BallCandidate) -> bool {
    nalgebra::distance(&one.center, &other.center) < one.radius + other.radius
}

#[cfg(test)]
mod tests {
    use framework::testing::{AdditionalProbe, parameter};
    use nalgebra::{Isometry3, Point3, Translation3, UnitQuaternion, Vector2};
    use types::camera::Intrinsics;
    use types::image::Yuv;

    use super::*;
    use crate::field_color::tests::{GREEN, field_color};
    use crate::painting::{PROJECTION_NOISE, border_at};
    use crate::segments::Segment;

    const WHITE: [u8; 3] = [220, 220, 220];
    const BLACK: [u8; 3] = [40, 40, 40];

    /// Half a metre up, looking 0.4 rad down along y of the ground.
    fn camera_matrix() -> CameraMatrix {
        let down = -std::f32::consts::FRAC_PI_2 - 0.4;
        let optical = UnitQuaternion::from_euler_angles(down, 0.0, 0.0);
        let camera = Isometry3::from_parts(Translation3::new(0.0, 0.0, 0.5), optical);
        CameraMatrix {
            ground_to_camera: camera.inverse(),
            intrinsics: Intrinsics {
                focal: Vector2::new(608.0, 609.6),
                center: Vector2::new(320.0, 240.0),
            },
        }
    }

    fn parameters() -> BallDetectionParameters {
        parameter(
            "{ classifier = \"Print\", network = { least_rim = 0.4, least_field_around = 0.4, least_confidence = 0.5 }, \
             inspection = { least_piece = 0.4, first_disc = 1.4, least_samples = 8, most_field_at_first = 0.6, rim_at_first = 0.5, \
             nearest_rim = 0.3, furthest_rim = 1.9, inner_ring = 1.2, outer_ring = 1.4, print_disc = 0.85 }, \
             least_radius = 3.5, radius_tolerance = 1.35, least_rim = 0.6, \
             least_field_around = 0.6, most_field_inside = 0.15, least_contrast = 35.0, \
             dark_limit = 0.4, least_dark = 0.04, most_dark = 0.6 }",
        )
    }

    /// A green image with discs of these colours, in this order.
    fn image(discs: &[(Point2<f32>, f32, [u8; 3])]) -> YuyvImage {
        let mut image = YuyvImage::new(640, 480);
        for row in 0..480 {
            for pair in 0..320 {
                let place = Point2::new(2.0 * pair as f32 + 0.5, row as f32);
                let hit = |(center, radius, _): &&(Point2<f32>, f32, [u8; 3])| {
                    nalgebra::distance(center, &place) <= *radius
                };
                let color = discs
                    .iter()
                    .rfind(hit)
                    .map_or(GREEN, |(_, _, color)| *color);
                let Yuv { y, u, v } = Yuv::from_rgb(color);
                let offset = (row * 320 + pair) * 4;
                image.data[offset..offset + 4].copy_from_slice(&[y, u, y, v]);
            }
        }
        image
    }

    /// Where a ball at this place of the ground is seen, and how large.
    fn seen(x: f32, y: f32) -> (Point2<f32>, f32) {
        let center = Point3::new(x, y, 0.05);
        let matrix = camera_matrix();
        (
            matrix.ground_to_pixel(center).unwrap(),
            matrix.pixel_radius(center, 0.05).unwrap(),
        )
    }

    fn balls(
        image: &YuyvImage,
        candidates: &mut AdditionalProbe<Vec<BallCandidate>>,
    ) -> Vec<BallCandidate> {
        balls_besides(image, &FieldBorder::default(), None, candidates).0
    }

    fn balls_besides(
        image: &YuyvImage,
        field_border: &FieldBorder,
        penalty_mark: Option<&PenaltyMark>,
        candidates: &mut AdditionalProbe<Vec<BallCandidate>>,
    ) -> (Vec<BallCandidate>, Option<BallView>) {
        // Every fourth column as one piece that is not field: the grid then looks everywhere.
        let pieces = (2..640).step_by(4);
        let image_segments = ImageSegments {
            column_step: 4,
            segments: pieces
                .map(|column| Segment {
                    column,
                    start: 0,
                    end: 480,
                    is_field: false,
                })
                .collect(),
        };
        let mut balls = Vec::new();
        let outputs = BallDetection::new(CreationContext {})
            .unwrap()
            .cycle(CycleContext {
                image: &Leased::of(image.clone()),
                image_segments: &image_segments,
                field_border,
                lines: &Vec::new(),
                penalty_mark,
                camera_matrix: &camera_matrix(),
                field_color: &field_color(),
                parameters: &parameters(),
                ball_radius: &0.05,
                line_width: &0.05,
                projection_noise: &PROJECTION_NOISE,
                ball_candidates: candidates.output(),
                ball_proposals: AdditionalProbe::unsubscribed().output(),
                balls: &mut balls,
            })
            .unwrap();
        (balls, outputs.ball_view.value)
    }

    fn printed(center: Point2<f32>, radius: f32) -> YuyvImage {
        let print = Vector2::new(0.4, -0.3) * radius;
        image(&[
            (center, radius, WHITE),
            (center + print, radius * 0.3, BLACK),
            (center - print, radius * 0.3, BLACK),
        ])
    }

    #[test]
    fn a_printed_disc_of_the_right_size_is_the_ball() {
        let (center, radius) = seen(0.2, 1.1);
        let balls = balls(
            &printed(center, radius),
            &mut AdditionalProbe::unsubscribed(),
        );
        assert_eq!(balls.len(), 1, "{balls:?}");
        assert!((balls[0].center - center).norm() < 2.0, "{balls:?}");
        assert!((balls[0].radius - radius).abs() < 2.0, "{balls:?}");
        let position = balls[0].position.unwrap();
        assert!(
            (position - Point2::new(0.2, 1.1)).norm() < 0.03,
            "{position}"
        );
    }

    #[test]
    fn a_white_disc_without_print_is_none() {
        let (center, radius) = seen(0.2, 1.1);
        let image = image(&[(center, radius, WHITE)]);
        assert_eq!(balls(&image, &mut AdditionalProbe::unsubscribed()), []);
    }

    #[test]
    fn a_ball_of_the_wrong_size_is_none() {
        let (center, radius) = seen(0.2, 1.1);
        let image = image(&[(center, radius * 2.0, WHITE), (center, radius * 0.7, BLACK)]);
        assert_eq!(balls(&image, &mut AdditionalProbe::unsubscribed()), []);
    }

    #[test]
    fn beyond_the_border_and_on_the_penalty_mark_there_is_no_ball() {
        let (center, radius) = seen(0.2, 1.1);
        let image = printed(center, radius);
        let found = |border: f32, mark: Point2<f32>| {
            let mark = PenaltyMark {
                center: mark,
                ..PenaltyMark::default()
            };
            let mut candidates = AdditionalProbe::unsubscribed();
            balls_besides(&image, &border_at(border), Some(&mark), &mut candidates)
                .0
                .len()
        };
        let beside = center + Vector2::new(3.0 * radius, 0.0);
        assert_eq!(found(center.y - radius, beside), 1);
        assert_eq!(found(center.y + 2.0 * radius, beside), 0);
        assert_eq!(found(center.y - radius, center), 0);
    }

    #[test]
    fn without_a_ball_it_is_told_where_one_was_looked_for_and_to_who_listens_what_was_looked_at() {
        let mut candidates = AdditionalProbe::default();
        let (border, nothing) = (FieldBorder::default(), image(&[]));
        let (balls, view) = balls_besides(&nothing, &border, None, &mut candidates);
        let expected = BallView {
            camera_matrix: camera_matrix(),
            size: Vector2::new(640.0, 480.0),
            least_radius: 3.5,
            ball_radius: 0.05,
        };
        assert_eq!((balls, view), (vec![], Some(expected)));
        assert!(
            candidates
                .value()
                .is_some_and(|candidates| candidates.len() > 50)
        );
    }
}
