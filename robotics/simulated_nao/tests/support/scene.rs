//! All nodes of vision on rendered images with the true camera pose, and places to look from.

use std::time::Duration;

use framework::testing::{AdditionalProbe, ParameterFile};
use framework::{Leased, Timestamp, math, testing};
use kinematics::cameras::{
    FOCAL_LENGTH, IMAGE_SIZE, OPTICAL_CENTER, camera_to_head, optical_to_camera,
};
use kinematics::forward_kinematics;
use kinematics::links::LinkName;
use nalgebra::{Point3, Vector2};
use simulated_nao::camera::{Exposure, OwnBody, render};
use simulated_nao::field::{Field, LENGTH, WIDTH};
use simulated_nao::ground_truth::ImageTruth;
use simulated_nao::physics::{Body, Start};
use simulated_nao::posture;
use simulated_nao::scene::{Robot, RobotSettings, Team};
use types::ball::BallCandidate;
use types::camera::{CameraMatrix, CameraPosition, Intrinsics};
use types::field_features::{CenterCircle, FieldBorder, LineCorner, LineSegment, PenaltyMark};
use types::image::YuyvImage;
use types::joints::Joints;
use types::limbs::LimbMask;
use types::obstacles::ObstacleCandidate;
use types::robot_kinematics::RobotKinematics;
use vision::ball_detection::{self, BallDetection, BallProposal};
use vision::center_circle_detection::{self, CenterCircleDetection};
use vision::corner_detection::{self, CornerDetection};
use vision::field_border::{self, FieldBorderDetection};
use vision::field_color::FieldColor;
use vision::field_color_detection::{self, FieldColorDetection};
use vision::image_segmenter::{self, ImageSegmenter};
use vision::limb_projector::{self, LimbProjector};
use vision::line_detection::{self, LineDetection};
use vision::obstacle_detection::{self, ObstacleDetection};
use vision::penalty_mark_detection::{self, PenaltyMarkDetection};
use vision::segments::ImageSegments;

/// A robot that stands somewhere and looks somewhere.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Look {
    pub(crate) robot: [f64; 3],
    pub(crate) yaw: f64,
    pub(crate) pitch: f64,
    pub(crate) camera: CameraPosition,
}

/// What vision makes of one image.
#[derive(Debug, Default)]
pub(crate) struct Sight {
    pub(crate) limb_mask: LimbMask,
    pub(crate) color: FieldColor,
    pub(crate) border: FieldBorder,
    pub(crate) lines: Vec<LineSegment>,
    pub(crate) center_circle: Option<CenterCircle>,
    pub(crate) corners: Vec<LineCorner>,
    pub(crate) penalty_mark: Option<PenaltyMark>,
    pub(crate) balls: Vec<BallCandidate>,
    pub(crate) obstacles: Vec<ObstacleCandidate>,
}

/// The nodes, their parameters, and what they work on.
pub(crate) struct Vision {
    pub(crate) parameters: ParameterFile,
    field: Field,
    image: Leased<YuyvImage>,
    limb_projector: LimbProjector,
    segmenter: ImageSegmenter,
    border: FieldBorderDetection,
    lines: LineDetection,
    circle: CenterCircleDetection,
    corners: CornerDetection,
    mark: PenaltyMarkDetection,
    balls: BallDetection,
    obstacles: ObstacleDetection,
    /// Time of the processor that all nodes together took for the image that was seen last.
    pub(crate) spent: Duration,
    /// Circles that were looked at closely, if somebody subscribes.
    pub(crate) proposals: AdditionalProbe<Vec<BallProposal>>,
}

impl Vision {
    pub(crate) fn new() -> Self {
        let parameters = include_str!("../../../parameters/default.toml");
        Self {
            parameters: ParameterFile::new(parameters),
            field: Field::default(),
            image: Leased::of(YuyvImage::default()),
            limb_projector: LimbProjector::new(limb_projector::CreationContext {}).unwrap(),
            segmenter: ImageSegmenter::new(image_segmenter::CreationContext {}).unwrap(),
            border: FieldBorderDetection::new(field_border::CreationContext {}).unwrap(),
            lines: LineDetection::new(line_detection::CreationContext {}).unwrap(),
            circle: CenterCircleDetection::new(center_circle_detection::CreationContext {})
                .unwrap(),
            corners: CornerDetection::new(corner_detection::CreationContext {}).unwrap(),
            mark: PenaltyMarkDetection::new(penalty_mark_detection::CreationContext {}).unwrap(),
            balls: BallDetection::new(ball_detection::CreationContext {}).unwrap(),
            obstacles: ObstacleDetection::new(obstacle_detection::CreationContext {}).unwrap(),
            spent: Duration::ZERO,
            proposals: AdditionalProbe::unsubscribed(),
        }
    }

    /// What the nodes find in the image of this exposure, one after the other as in the robot.
    pub(crate) fn see(&mut self, look: &Look, exposure: &Exposure) -> Sight {
        let mut image = YuyvImage::default();
        render(exposure, &self.field, &mut image);
        self.image = Leased::of(image);
        let matrix = ImageTruth::from(exposure).camera_matrix;
        let begun = processor_time();
        let limb_mask = self.limb_mask(look);
        let mut sight = Sight {
            color: self.color(&matrix, &limb_mask),
            ..Sight::default()
        };
        let image_segments = self.segments(look, &matrix, &limb_mask, sight.color);
        self.find_border(look, &matrix, &image_segments, &mut sight);
        self.find_lines(look, &matrix, &image_segments, &limb_mask, &mut sight);
        self.find_circle_and_corners(look, &matrix, &limb_mask, &mut sight);
        self.find_penalty_mark(&matrix, &image_segments, &mut sight);
        self.find_balls(&matrix, &image_segments, &mut sight);
        self.find_obstacles(&matrix, &image_segments, &mut sight);
        self.spent = processor_time() - begun;
        sight.limb_mask = limb_mask;
        sight
    }

    fn color(&self, camera_matrix: &CameraMatrix, limb_mask: &LimbMask) -> FieldColor {
        // A node of its own for each image: what it has learnt of other light does not count.
        FieldColorDetection::new(field_color_detection::CreationContext {})
            .unwrap()
            .cycle(field_color_detection::CycleContext {
                image: &self.image,
                camera_matrix: Some(camera_matrix),
                limb_mask,
                initial: &self.parameters.get("field_color"),
                parameters: &self.parameters.get("field_color_detection"),
            })
            .unwrap()
            .field_color
            .value
    }

    fn segments(
        &mut self,
        look: &Look,
        camera_matrix: &CameraMatrix,
        limb_mask: &LimbMask,
        color: FieldColor,
    ) -> ImageSegments {
        let mut image_segments = ImageSegments::default();
        self.segmenter
            .cycle(image_segmenter::CycleContext {
                image: &self.image,
                camera_matrix: Some(camera_matrix),
                limb_mask,
                field_color: &color,
                steps: &self.parameters.get(&look.own("scan_steps")),
                image_segments: &mut image_segments,
            })
            .unwrap();
        image_segments
    }

    fn find_border(
        &mut self,
        look: &Look,
        camera_matrix: &CameraMatrix,
        image_segments: &ImageSegments,
        sight: &mut Sight,
    ) {
        self.border
            .cycle(field_border::CycleContext {
                image_segments,
                camera_matrix: Some(camera_matrix),
                parameters: &self.parameters.get(&look.own("field_border")),
                field_border_points: AdditionalProbe::unsubscribed().output(),
                field_border: &mut sight.border,
            })
            .unwrap();
    }

    fn find_lines(
        &mut self,
        look: &Look,
        camera_matrix: &CameraMatrix,
        image_segments: &ImageSegments,
        limb_mask: &LimbMask,
        sight: &mut Sight,
    ) {
        self.lines
            .cycle(line_detection::CycleContext {
                image: &self.image,
                image_segments,
                limb_mask,
                field_border: &sight.border,
                camera_matrix,
                field_color: &sight.color,
                line_width: &self.parameters.get("field_dimensions.line_width"),
                parameters: &self.parameters.get(&look.own("line_detection")),
                projection_noise: &self.parameters.get("projection_noise"),
                line_points: AdditionalProbe::unsubscribed().output(),
                image_lines: AdditionalProbe::unsubscribed().output(),
                lines: &mut sight.lines,
            })
            .unwrap();
    }

    fn find_circle_and_corners(
        &mut self,
        look: &Look,
        camera_matrix: &CameraMatrix,
        limb_mask: &LimbMask,
        sight: &mut Sight,
    ) {
        let radius = self
            .parameters
            .get("field_dimensions.markings.circle_radius");
        sight.center_circle = self
            .circle
            .cycle(center_circle_detection::CycleContext {
                lines: &sight.lines,
                camera_matrix,
                radius: &radius,
                parameters: &self.parameters.get(&look.own("center_circle_detection")),
                image_circle: AdditionalProbe::unsubscribed().output(),
            })
            .unwrap()
            .center_circle
            .value;
        self.corners
            .cycle(corner_detection::CycleContext {
                image: &self.image,
                lines: &sight.lines,
                center_circle: sight.center_circle.as_ref(),
                limb_mask,
                camera_matrix,
                radius: &radius,
                parameters: &self.parameters.get("corner_detection"),
                projection_noise: &self.parameters.get("projection_noise"),
                corners: &mut sight.corners,
            })
            .unwrap();
    }

    fn find_penalty_mark(
        &mut self,
        camera_matrix: &CameraMatrix,
        image_segments: &ImageSegments,
        sight: &mut Sight,
    ) {
        sight.penalty_mark = self
            .mark
            .cycle(penalty_mark_detection::CycleContext {
                image: &self.image,
                image_segments,
                field_border: &sight.border,
                lines: &sight.lines,
                camera_matrix,
                field_color: &sight.color,
                line_width: &self.parameters.get("field_dimensions.line_width"),
                mark_size: &self.parameters.get("field_dimensions.penalty_mark_size"),
                parameters: &self.parameters.get("penalty_mark_detection"),
                projection_noise: &self.parameters.get("projection_noise"),
                penalty_mark_candidates: AdditionalProbe::unsubscribed().output(),
            })
            .unwrap()
            .penalty_mark
            .value;
    }

    fn find_balls(
        &mut self,
        camera_matrix: &CameraMatrix,
        image_segments: &ImageSegments,
        sight: &mut Sight,
    ) {
        self.balls
            .cycle(ball_detection::CycleContext {
                image: &self.image,
                image_segments,
                field_border: &sight.border,
                lines: &sight.lines,
                penalty_mark: sight.penalty_mark.as_ref(),
                camera_matrix,
                field_color: &sight.color,
                parameters: &self.parameters.get("ball_detection"),
                projection_noise: &self.parameters.get("projection_noise"),
                ball_radius: &self.parameters.get("field_dimensions.ball_radius"),
                line_width: &self.parameters.get("field_dimensions.line_width"),
                ball_candidates: AdditionalProbe::unsubscribed().output(),
                ball_proposals: self.proposals.output(),
                balls: &mut sight.balls,
            })
            .unwrap();
    }

    fn find_obstacles(
        &mut self,
        camera_matrix: &CameraMatrix,
        image_segments: &ImageSegments,
        sight: &mut Sight,
    ) {
        self.obstacles
            .cycle(obstacle_detection::CycleContext {
                image_segments,
                field_border: &sight.border,
                lines: &sight.lines,
                camera_matrix,
                line_width: &self.parameters.get("field_dimensions.line_width"),
                ball_radius: &self.parameters.get("field_dimensions.ball_radius"),
                parameters: &self.parameters.get("obstacle_detection"),
                projection_noise: &self.parameters.get("projection_noise"),
                obstacle_feet: AdditionalProbe::unsubscribed().output(),
                obstacles: &mut sight.obstacles,
            })
            .unwrap();
    }

    fn limb_mask(&mut self, look: &Look) -> LimbMask {
        let joints = look.joints().map(|angle| angle as f32);
        let kinematics = RobotKinematics::from(&forward_kinematics(&joints));
        let now = testing::at_millis(10);
        let mut limb_mask = LimbMask::default();
        self.limb_projector
            .cycle(limb_projector::CycleContext {
                image: &self.image,
                robot_kinematics: testing::latest(now, &kinematics, now),
                camera_position: &look.camera,
                top: &self.parameters.get("cameras.top"),
                bottom: &self.parameters.get("cameras.bottom"),
                parameters: &self.parameters.get("limb_projector"),
                limb_mask: &mut limb_mask,
            })
            .unwrap();
        limb_mask
    }
}

/// Of this thread, whatever else the machine does.
fn processor_time() -> Duration {
    let now = rustix::time::clock_gettime(rustix::time::ClockId::ThreadCPUTime);
    Duration::new(now.tv_sec.unsigned_abs(), now.tv_nsec as u32)
}

impl Look {
    pub(crate) fn expose(&self, number: u64, ball: Option<Point3<f32>>) -> Exposure {
        let joints = self.joints();
        let body = self.body(joints);
        let head = forward_kinematics(&joints).link(LinkName::Head);
        let camera = head * camera_to_head::<f64>(self.camera) * optical_to_camera::<f64>();
        let size = Vector2::from(IMAGE_SIZE.map(f64::from));
        Exposure {
            number,
            captured_at: Timestamp::ZERO,
            ready_at: Timestamp::ZERO,
            camera_to_field: (body.torso_to_field * camera).cast(),
            ground_to_field: body.ground_to_field().cast(),
            intrinsics: Intrinsics {
                focal: Vector2::from(FOCAL_LENGTH).component_mul(&size).cast(),
                center: Vector2::from(OPTICAL_CENTER).component_mul(&size).cast(),
            },
            ball,
            ..Exposure::default()
        }
    }

    fn body(&self, joints: Joints<f64>) -> Body {
        let pose = self.robot;
        Body::standing(&Start { joints, pose })
    }

    /// The same with other robots and the own body.
    pub(crate) fn expose_among(
        &self,
        number: u64,
        ball: Option<Point3<f32>>,
        robots: &[Robot],
    ) -> Exposure {
        let joints = self.joints();
        let torso_to_field = self.body(joints).torso_to_field;
        Exposure {
            robots: robots.into(),
            body: Some(OwnBody {
                joints: joints.map(|angle| angle as f32),
                torso_to_field: torso_to_field.cast(),
            }),
            ..self.expose(number, ball)
        }
    }

    /// Robots before the camera in several ways, near and far; none of them beside the field.
    pub(crate) fn crowds(&self) -> impl Iterator<Item = Vec<Robot>> + use<> {
        let [x, y, heading] = self.robot;
        let ahead = heading + self.yaw;
        CROWDS.into_iter().map(move |crowd| {
            let settings = crowd.map(|(distance, bearing, turned)| RobotSettings {
                position: [
                    x + distance * math::cos(ahead + bearing),
                    y + distance * math::sin(ahead + bearing),
                ],
                heading: ahead + turned,
                team: if turned > 1.6 {
                    Team::Opponent
                } else {
                    Team::Own
                },
                number: 2,
            });
            let on_field = settings.iter().filter(|robot| {
                let [x, y] = robot.position.map(|place| place.abs() as f32);
                x < LENGTH / 2.0 && y < WIDTH / 2.0
            });
            on_field.map(Robot::from).collect()
        })
    }

    /// The path of a parameter that each camera has for itself.
    fn own(&self, name: &str) -> String {
        match self.camera {
            CameraPosition::Top => format!("vision_top.{name}"),
            CameraPosition::Bottom => format!("vision_bottom.{name}"),
        }
    }

    fn joints(&self) -> Joints<f64> {
        Joints {
            head_yaw: self.yaw,
            head_pitch: self.pitch,
            ..posture::standing()
        }
    }
}

/// How far away (m), how far to the left of where the camera looks (rad) and how turned (rad) robots
/// stand.
const CROWDS: [[(f64, f64, f64); 3]; 6] = [
    [(0.6, 0.1, 3.1), (1.9, -0.35, 0.0), (2.8, 0.3, 2.0)],
    [(0.9, -0.2, 0.4), (1.5, 0.25, 3.3), (3.4, 0.05, 3.1)],
    [(1.2, 0.0, 3.1), (2.2, 0.38, 1.0), (2.6, -0.3, 4.4)],
    [(1.4, -0.3, 1.6), (2.0, 0.0, 2.6), (3.0, 0.35, 3.1)],
    [(0.75, 0.35, 2.4), (1.7, -0.1, 3.1), (3.2, -0.38, 0.7)],
    [(1.1, 0.3, 5.0), (2.4, 0.12, 3.6), (3.3, -0.15, 3.1)],
];

/// All over the field, with the head turned and tilted.
pub(crate) fn looks() -> impl Iterator<Item = Look> {
    let robots = [
        [2.0, 0.0, 0.0],
        [-1.0, 0.3, 0.4],
        [-3.0, -2.0, 1.2],
        [0.5, 2.5, -1.0],
        [3.5, 1.0, 3.0],
    ];
    let angles = [
        (0.0, 0.0),
        (0.0, 0.4),
        (0.5, 0.2),
        (-0.7, 0.35),
        (1.0, 0.1),
        (-0.3, -0.2),
    ];
    robots.into_iter().flat_map(move |robot| {
        angles.into_iter().flat_map(move |(yaw, pitch)| {
            [CameraPosition::Top, CameraPosition::Bottom].map(|camera| Look {
                robot,
                yaw,
                pitch,
                camera,
            })
        })
    })
}
