//! Finds what stands on the field: feet of robots and goal posts.
//!
//! Where something stands, a column of the image shows no field from the foot upwards. Feet next to
//! each other on the ground are one obstacle; what seems to stand behind another obstacle is the rest
//! of that one, a hand above the ground for example. What is cut by the lower edge of the image or by the
//! robot's own limbs hides things too, but its own foot is not known: it counts where that edge is near, as
//! if it stood there. Somebody who lies before the robot is seen in no other way. How high something is, is
//! measured where a ball that touches the ground at the same place would end: seen from above a ball covers
//! as much as something high.

use framework::{
    AdditionalOutput, Input, MainOutput, Parameter, Reflect, RequiredInput, Result, context, math,
};
use nalgebra::{Point2, Point3};
use serde::{Deserialize, Serialize};
use types::camera::CameraMatrix;
use types::field_features::{FieldBorder, LineSegment};
use types::obstacles::ObstacleCandidate;
use types::projection_noise::ProjectionNoise;

use crate::landmarks::{is_near_border, is_on_line};
use crate::segments::{ImageSegments, Segment};

/// What makes an obstacle.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct ObstacleDetectionParameters {
    /// What rises less from the ground is none, measured a ball's diameter behind its foot.
    #[reflect(unit = "m", range = 0.0..)]
    pub least_height: f32,
    /// Obstacles further away from the robot are left out.
    #[reflect(unit = "m", range = 0.0..)]
    pub greatest_distance: f32,
    /// How far below the border of the field a foot must be.
    #[reflect(unit = "px", range = 0.0..)]
    pub below_border: f32,
    /// How far before the border of the field a foot must be.
    #[reflect(unit = "m", range = 0.0..)]
    pub before_border: f32,
    /// How long the piece of field below the foot must be.
    #[reflect(unit = "px")]
    pub least_field: u32,
    /// Feet so near to each other are one obstacle.
    #[reflect(unit = "m", range = 0.0..)]
    pub same_place: f32,
    /// How many columns an obstacle must have; twice as many at the sides of the image, where what is
    /// beyond a corner of the field looks like one.
    pub least_columns: u32,
    /// How wide an obstacle must be.
    #[reflect(unit = "m", range = 0.0..)]
    pub least_width: f32,
    /// Half the width of what an obstacle hides behind it.
    #[reflect(unit = "m", range = 0.0..)]
    pub hidden_half_width: f32,
    /// The same for what is cut by the lower edge or by the own limbs, at the place of that edge.
    #[reflect(unit = "m", range = 0.0..)]
    pub cut_half_width: f32,
    /// As high must be seen of what is cut by the upper edge and may rise further.
    #[reflect(unit = "m", range = 0.0..)]
    pub least_cut_height: f32,
    /// What is cut by the lower edge or by the own limbs is an obstacle where that edge is so near.
    #[reflect(unit = "m", range = 0.0..)]
    pub cut_reach: f32,
}

/// Keeps its heap; empty between cycles.
#[derive(Debug, Deserialize, Serialize)]
pub struct ObstacleDetection {
    clusters: Vec<Cluster>,
}

/// Feet at one place.
#[derive(Clone, Copy, Debug, Deserialize, Serialize)]
struct Cluster {
    mean: ObstacleCandidate,
    columns: u32,
    /// Whether it stands nearer, below what is seen.
    is_cut: bool,
}

/// The lower end of a piece that stands on the field or is cut.
#[derive(Clone, Copy, Debug)]
struct Foot {
    place: ObstacleCandidate,
    is_cut: bool,
}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    image_segments: Input<ImageSegments, "image_segments">,
    field_border: Input<FieldBorder, "field_border">,
    lines: Input<Vec<LineSegment>, "lines">,
    camera_matrix: RequiredInput<Option<CameraMatrix>, "camera_matrix?">,
    line_width: Parameter<f32, "field_dimensions.line_width">,
    ball_radius: Parameter<f32, "field_dimensions.ball_radius">,
    parameters: Parameter<ObstacleDetectionParameters, "obstacle_detection">,
    projection_noise: Parameter<ProjectionNoise, "projection_noise">,
    /// Where something stands in each column, px.
    obstacle_feet: AdditionalOutput<Vec<Point2<f32>>, "obstacle_feet">,
    /// Nearest first.
    obstacles: MainOutput<Vec<ObstacleCandidate>>,
}

#[context]
pub struct MainOutputs {}

impl ObstacleDetection {
    /// Never fails.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self {
            clusters: Vec::new(),
        })
    }

    /// What stands on the field within sight.
    pub fn cycle(&mut self, mut context: CycleContext) -> Result<MainOutputs> {
        let view = View {
            matrix: context.camera_matrix,
            border: context.field_border,
            lines: context.lines,
            line_width: *context.line_width,
            ball_radius: *context.ball_radius,
            parameters: context.parameters,
        };
        let feet = || view.feet(context.image_segments);
        context
            .obstacle_feet
            .fill_if_subscribed(|| feet().map(|foot| foot.place.foot).collect());
        for foot in feet() {
            self.collect(&foot, context.parameters.same_place);
        }
        self.clusters
            .retain(|cluster| view.is_wide(cluster, context.image_segments));
        self.clusters
            .sort_unstable_by(|one, other| distance(&one.mean).total_cmp(&distance(&other.mean)));
        let parameters = context.parameters;
        for cluster in &self.clusters {
            let mean = &cluster.mean;
            let mut cut = self.clusters.iter().filter(|cluster| cluster.is_cut);
            let obstacles = &mut *context.obstacles;
            let is_obstacle = match cluster.is_cut {
                true => distance(mean) <= parameters.cut_reach,
                false => {
                    !cut.any(|cut| view.hides(&cut.mean, mean, parameters.cut_half_width))
                        && !obstacles
                            .iter()
                            .any(|nearer| view.hides(nearer, mean, parameters.hidden_half_width))
                }
            };
            if is_obstacle {
                let matrix = context.camera_matrix;
                let covariance =
                    matrix.ground_covariance(mean.position, 0.0, context.projection_noise);
                obstacles.extend(covariance.map(|covariance| ObstacleCandidate {
                    covariance,
                    ..*mean
                }));
            }
        }
        self.clusters.clear();
        Ok(MainOutputs {})
    }

    /// Puts a foot to the cluster where it belongs.
    fn collect(&mut self, &Foot { place, is_cut }: &Foot, same_place: f32) {
        let near = self.clusters.iter_mut().find(|cluster| {
            cluster.is_cut == is_cut
                && nalgebra::distance(&cluster.mean.position, &place.position) <= same_place
        });
        let Some(Cluster { mean, columns, .. }) = near else {
            self.clusters.push(Cluster {
                mean: place,
                columns: 1,
                is_cut,
            });
            return;
        };
        *columns += 1;
        let share = (*columns as f32).recip();
        mean.foot += (place.foot - mean.foot) * share;
        mean.position += (place.position - mean.position) * share;
    }
}

fn distance(candidate: &ObstacleCandidate) -> f32 {
    candidate.position.coords.norm()
}

/// What is known before anything is looked for.
struct View<'a> {
    matrix: &'a CameraMatrix,
    border: &'a FieldBorder,
    lines: &'a [LineSegment],
    /// In m.
    line_width: f32,
    /// In m.
    ball_radius: f32,
    parameters: &'a ObstacleDetectionParameters,
}

impl View<'_> {
    /// The lower ends of all pieces that stand on field or are cut by the lower edge.
    fn feet(&self, image_segments: &ImageSegments) -> impl Iterator<Item = Foot> {
        image_segments
            .columns()
            .flat_map(|column| (0..column.len()).filter_map(|index| self.foot(column, index)))
    }

    /// The lower end of one of the pieces of a column.
    fn foot(&self, column: &[Segment], index: usize) -> Option<Foot> {
        let piece = column.get(index).filter(|piece| !piece.is_field)?;
        let below = column.get(index + 1);
        let field = below.map_or(0, |below| below.end - below.start);
        let is_cut = field < self.parameters.least_field;
        if is_cut && index + 2 < column.len() {
            return None;
        }
        let x = piece.column as f32;
        let foot = Point2::new(x, piece.end as f32 - 0.5);
        let above = Point2::new(x, foot.y - self.parameters.below_border);
        if !self.border.is_inside(above) {
            return None;
        }
        let position = self.matrix.pixel_to_ground(foot, 0.0)?;
        // So near to the border it may be a net's or belong to what is beyond.
        let before_border = self.parameters.before_border;
        let is_obstacle = position.coords.norm() <= self.parameters.greatest_distance
            && !is_near_border(self.border, self.matrix, x, position, before_border)
            && self.is_high(piece, position, index == 0)
            && !self.is_line(piece);
        let place = ObstacleCandidate {
            foot,
            position,
            ..ObstacleCandidate::default()
        };
        is_obstacle.then_some(Foot { place, is_cut })
    }

    /// Whether a piece rises as an obstacle does, as far as the image shows it.
    fn is_high(&self, piece: &Segment, place: Point2<f32>, is_first: bool) -> bool {
        let rises_to = |place: Point2<f32>, height: f32| {
            let top = Point3::new(place.x, place.y, height);
            let top = self.matrix.ground_to_pixel(top);
            top.is_some_and(|top| top.y >= piece.start as f32)
        };
        let away = (place - self.matrix.position().xy()).try_normalize(f32::MIN_POSITIVE);
        let behind_ball = place + away.unwrap_or_default() * (2.0 * self.ball_radius);
        let may_rise_further = is_first && piece.start == 0;
        rises_to(behind_ball, self.parameters.least_height)
            || may_rise_further && rises_to(place, self.parameters.least_cut_height)
    }

    /// Whether a piece lies flat on lines: a line that leads away fills its columns.
    fn is_line(&self, piece: &Segment) -> bool {
        let length = (piece.end - piece.start) as f32;
        [0.25, 0.5, 0.75].into_iter().all(|part| {
            let pixel = Point2::new(piece.column as f32, piece.start as f32 + length * part);
            let place = self.matrix.pixel_to_ground(pixel, 0.0);
            place.is_some_and(|place| is_on_line(self.lines, self.line_width, place))
        })
    }

    /// Whether enough columns show a cluster.
    fn is_wide(&self, cluster: &Cluster, image_segments: &ImageSegments) -> bool {
        let pixels = cluster.columns as f32 * image_segments.column_step as f32;
        let away = math::hypot(distance(&cluster.mean), self.matrix.position().z);
        let width = pixels * away / self.matrix.intrinsics.focal.x;
        let sides = [
            image_segments.segments.first(),
            image_segments.segments.last(),
        ];
        let is_at_side = sides.into_iter().flatten().any(|side| {
            let columns_away = (cluster.mean.foot.x - side.column as f32).abs();
            columns_away <= pixels / 2.0
        });
        let least = self.parameters.least_columns;
        let needed = least.saturating_mul(if is_at_side { 2 } else { 1 });
        cluster.columns >= needed && width >= self.parameters.least_width
    }

    /// Whether the camera sees `farther` behind `nearer`.
    fn hides(
        &self,
        nearer: &ObstacleCandidate,
        farther: &ObstacleCandidate,
        half_width: f32,
    ) -> bool {
        let camera = self.matrix.position().xy();
        let to_nearer = nearer.position - camera;
        let to_farther = farther.position - camera;
        let Some(ahead) = to_farther.try_normalize(f32::MIN_POSITIVE) else {
            return true;
        };
        to_nearer.dot(&ahead) > 0.0 && ahead.perp(&to_nearer).abs() <= half_width
    }
}

#[cfg(test)]
mod tests {
    use framework::testing::{AdditionalProbe, parameter};
    use types::image::YuyvImage;

    use super::*;
    use crate::field_color::tests::GREEN;
    use crate::painting::{
        self, Board, GREY, PROJECTION_NOISE, WHITE, border_at, camera_matrix, paint, plain,
    };

    fn parameters() -> ObstacleDetectionParameters {
        parameter(
            "{ least_height = 0.13, greatest_distance = 4.0, below_border = 5.0, before_border = 0.35, least_field = 6, \
             same_place = 0.25, least_columns = 4, least_width = 0.07, hidden_half_width = 0.25, \
             cut_half_width = 0.4, least_cut_height = 0.08, cut_reach = 0.45 }",
        )
    }

    fn detect(
        image: &YuyvImage,
        border: &FieldBorder,
        lines: &Vec<LineSegment>,
    ) -> Vec<ObstacleCandidate> {
        detect_with(&parameters(), image, &camera_matrix(0.3), border, lines)
    }

    fn detect_with(
        parameters: &ObstacleDetectionParameters,
        image: &YuyvImage,
        matrix: &CameraMatrix,
        border: &FieldBorder,
        lines: &Vec<LineSegment>,
    ) -> Vec<ObstacleCandidate> {
        let mut obstacles = Vec::new();
        ObstacleDetection::new(CreationContext {})
            .unwrap()
            .cycle(CycleContext {
                image_segments: &painting::segments(image, matrix),
                field_border: border,
                lines,
                camera_matrix: matrix,
                line_width: &0.05,
                ball_radius: &0.05,
                parameters,
                projection_noise: &PROJECTION_NOISE,
                obstacle_feet: AdditionalProbe::unsubscribed().output(),
                obstacles: &mut obstacles,
            })
            .unwrap();
        obstacles
    }

    fn obstacles(boards: &[Board]) -> Vec<ObstacleCandidate> {
        let image = paint(&camera_matrix(0.3), boards, plain);
        detect(&image, &FieldBorder::default(), &Vec::new())
    }

    fn board(x: f32, y: std::ops::Range<f32>, z: std::ops::Range<f32>) -> Board {
        Board { x, y, z }
    }

    fn assert_at(obstacle: &ObstacleCandidate, x: f32, y: f32) {
        let off = nalgebra::distance(&obstacle.position, &Point2::new(x, y));
        assert!(off < 0.05 + 0.02 * x, "{obstacle:?} instead of ({x}, {y})");
    }

    #[test]
    fn robots_and_posts_are_found_at_their_feet_nearest_first() {
        let robot = board(2.5, 0.3..0.6, 0.0..0.55);
        let post = board(1.5, -0.5..-0.4, 0.0..0.8);
        let obstacles = obstacles(&[robot, post]);
        assert_eq!(obstacles.len(), 2, "{obstacles:?}");
        assert_at(&obstacles[0], 1.5, -0.45);
        assert_at(&obstacles[1], 2.5, 0.45);
    }

    #[test]
    fn more_columns_than_there_are_make_no_obstacle() {
        // So wide that it reaches both sides of the image.
        let matrix = camera_matrix(0.3);
        let image = paint(&matrix, &[board(1.5, -3.0..3.0, 0.0..0.55)], plain);
        let count = |least_columns| {
            let parameters = ObstacleDetectionParameters {
                same_place: 10.0,
                least_columns,
                ..parameters()
            };
            let border = FieldBorder::default();
            detect_with(&parameters, &image, &matrix, &border, &Vec::new()).len()
        };
        assert_eq!((count(4), count(u32::MAX)), (1, 0));
    }

    #[test]
    fn two_feet_and_hanging_arms_are_one_robot() {
        let legs = [
            board(1.5, 0.03..0.1, 0.0..0.3),
            board(1.5, -0.1..-0.03, 0.0..0.3),
        ];
        let rest = [
            board(1.5, -0.1..0.1, 0.25..0.5),
            board(1.5, 0.1..0.18, 0.15..0.45),
        ];
        let boards: Vec<_> = legs.into_iter().chain(rest).collect();
        let obstacles = obstacles(&boards);
        assert_eq!(obstacles.len(), 1, "{obstacles:?}");
        assert_at(&obstacles[0], 1.5, 0.0);
    }

    #[test]
    fn what_is_as_low_as_a_ball_is_no_obstacle() {
        assert_eq!(obstacles(&[board(1.5, -0.05..0.05, 0.0..0.1)]), []);
        // As wide, but higher.
        assert_eq!(obstacles(&[board(1.5, -0.05..0.05, 0.0..0.3)]).len(), 1);
    }

    #[test]
    fn what_the_lower_edge_cuts_farther_away_has_no_foot() {
        assert_eq!(obstacles(&[board(0.5, -0.1..0.1, 0.0..0.5)]), []);
        // The same where its foot is in the image.
        assert_eq!(obstacles(&[board(1.0, -0.1..0.1, 0.0..0.5)]).len(), 1);
    }

    #[test]
    fn what_is_cut_right_before_the_robot_lies_at_the_lower_edge() {
        let matrix = camera_matrix(0.7);
        let seen = |boards: &[Board]| {
            let image = paint(&matrix, boards, plain);
            let border = FieldBorder::default();
            detect_with(&parameters(), &image, &matrix, &border, &Vec::new())
        };
        // Of somebody who lies across.
        let [near, far] = [0.25, 0.36].map(|x| board(x, -0.15..0.15, 0.0..0.17));
        let body = seen(&[near, far]);
        assert_eq!(body.len(), 1, "{body:?}");
        assert_at(&body[0], 0.27, 0.0);
        // A ball ends sooner.
        let ball = [0.25, 0.3, 0.34].map(|x| board(x, -0.05..0.05, 0.0..0.09));
        assert_eq!(seen(&ball), []);
        // Nor is a line across.
        let floor = |point: Point2<f32>| {
            let is_line = (point.x - 0.28).abs() < 0.03;
            if is_line { WHITE } else { GREEN }
        };
        let image = paint(&matrix, &[], floor);
        let border = FieldBorder::default();
        let line = detect_with(&parameters(), &image, &matrix, &border, &Vec::new());
        assert_eq!(line, []);
    }

    #[test]
    fn a_line_that_leads_away_is_no_obstacle() {
        let floor = |point: Point2<f32>| {
            let is_line = (point.y - 0.1).abs() < 0.025 && point.x > 1.0;
            if is_line { WHITE } else { GREEN }
        };
        let matrix = camera_matrix(0.3);
        let image = paint(&matrix, &[], floor);
        let line = LineSegment {
            start: Point2::new(1.0, 0.1),
            end: Point2::new(5.0, 0.1),
            ..LineSegment::default()
        };
        // As it is, a line is too narrow; where lines meet they are wider.
        let parameters = ObstacleDetectionParameters {
            least_width: 0.02,
            ..parameters()
        };
        let count = |lines: Vec<LineSegment>| {
            let border = FieldBorder::default();
            detect_with(&parameters, &image, &matrix, &border, &lines).len()
        };
        assert_eq!(count(vec![line]), 0);
        assert!(count(Vec::new()) > 0);
    }

    #[test]
    fn the_world_beyond_the_border_is_no_obstacle() {
        let floor = |point: Point2<f32>| if point.x < 2.0 { GREEN } else { GREY };
        let matrix = camera_matrix(0.3);
        let robot = || board(1.4, -0.1..0.2, 0.0..0.55);
        let image = paint(&matrix, &[robot()], floor);
        let border = matrix.ground_to_pixel(Point3::new(2.0, 0.0, 0.0)).unwrap();
        let obstacles = detect(&image, &border_at(border.y), &Vec::new());
        assert_eq!(obstacles.len(), 1, "{obstacles:?}");
        assert_at(&obstacles[0], 1.4, 0.05);
        // Nobody would know without the border.
        let all = detect(&image, &FieldBorder::default(), &Vec::new());
        assert!(all.len() > 1, "{all:?}");
    }
}
