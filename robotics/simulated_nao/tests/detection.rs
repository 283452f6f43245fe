//! How well vision finds the ball in images of the simulated cameras, with the true camera pose.

use framework::{AdditionalOutput, AdditionalSlot, Timestamp};
use kinematics::cameras::{
    FOCAL_LENGTH, IMAGE_SIZE, OPTICAL_CENTER, camera_to_head, optical_to_camera,
};
use kinematics::forward_kinematics;
use kinematics::links::LinkName;
use nalgebra::{Point3, Vector2};
use simulated_nao::camera::{Exposure, render};
use simulated_nao::field::Field;
use simulated_nao::ground_truth::ImageTruth;
use simulated_nao::physics::{Kinematic, Physics};
use simulated_nao::posture;
use types::ball::BallCandidate;
use types::camera::{CameraPosition, Intrinsics};
use types::image::YuyvImage;
use vision::ball_detection::{self, BallDetection, BallDetectionParameters};
use vision::field_color::FieldColor;
use vision::image_segmenter::{self, ImageSegmenter, ScanSteps};
use vision::segments::ImageSegments;

const FIELD_COLOR: FieldColor = FieldColor {
    minimum_green: 0.45,
    maximum_red: 0.37,
    maximum_blue: 0.38,
    minimum_luminance: 16,
};

const PARAMETERS: BallDetectionParameters = BallDetectionParameters {
    least_radius: 3.5,
    radius_tolerance: 1.4,
    least_rim: 0.5,
    least_field_around: 0.5,
    most_field_inside: 0.15,
    least_contrast: 35.0,
    least_dark: 0.04,
    most_dark: 0.6,
};

/// A robot that stands somewhere and looks somewhere.
#[derive(Clone, Copy, Debug)]
struct Look {
    robot: [f64; 3],
    yaw: f64,
    pitch: f64,
    camera: CameraPosition,
}

/// The two nodes that lead from an image to a ball, and what they work on.
struct Detector {
    field: Field,
    segmenter: ImageSegmenter,
    detection: BallDetection,
    image: YuyvImage,
    segments: ImageSegments,
}

impl Detector {
    fn new() -> Self {
        Self {
            field: Field::default(),
            segmenter: ImageSegmenter::new(image_segmenter::CreationContext {}).unwrap(),
            detection: BallDetection::new(ball_detection::CreationContext {}).unwrap(),
            image: YuyvImage::default(),
            segments: ImageSegments::default(),
        }
    }

    fn detect(&mut self, exposure: &Exposure) -> Vec<BallCandidate> {
        render(exposure, &self.field, &mut self.image);
        let camera_matrix = ImageTruth::from(exposure).camera_matrix;
        self.segments.segments.clear();
        self.segmenter
            .cycle(image_segmenter::CycleContext {
                image: &self.image,
                camera_matrix: Some(&camera_matrix),
                field_color: &FIELD_COLOR,
                steps: &ScanSteps {
                    columns: 4,
                    rows: 2,
                },
                image_segments: &mut self.segments,
            })
            .unwrap();
        let mut balls = Vec::new();
        self.detection
            .cycle(ball_detection::CycleContext {
                image: &self.image,
                image_segments: &self.segments,
                camera_matrix: &camera_matrix,
                field_color: &FIELD_COLOR,
                parameters: &PARAMETERS,
                ball_radius: &0.05,
                ball_candidates: AdditionalOutput::new(false, 1, &mut AdditionalSlot::default()),
                balls: &mut balls,
            })
            .unwrap();
        balls
    }
}

impl Look {
    fn expose(&self, number: u64, ball: Option<Point3<f32>>) -> Exposure {
        let mut joints = posture::standing();
        joints.head_yaw = self.yaw;
        joints.head_pitch = self.pitch;
        let body = *Kinematic::new(joints, self.robot).body();
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
        }
    }
}

/// All over the field, with the head turned and tilted.
fn looks() -> impl Iterator<Item = Look> {
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

/// A ball at these places in front of the robot, in its ground frame.
fn balls(look: &Look) -> Vec<Point3<f32>> {
    let mut balls = Vec::new();
    for distance in [0.5, 0.8, 1.2, 1.7, 2.3, 3.0_f64] {
        for bearing in [-0.9, -0.5, -0.2, 0.0, 0.1, 0.4, 0.7_f64] {
            let [x, y, heading] = look.robot;
            let angle = heading + bearing;
            let at = [x + distance * angle.cos(), y + distance * angle.sin()];
            balls.push(Point3::new(at[0] as f32, at[1] as f32, 0.05));
        }
    }
    balls
}

#[test]
fn a_whole_ball_is_found_where_it_is() {
    let mut detector = Detector::new();
    let (mut shown, mut found, mut wrong) = (0, 0, 0);
    for look in looks() {
        for (number, ball) in balls(&look).into_iter().enumerate() {
            let exposure = look.expose(number as u64, Some(ball));
            let Some(truth) = ImageTruth::from(&exposure)
                .ball
                .filter(|ball| ball.is_whole)
            else {
                continue;
            };
            shown += 1;
            let balls = detector.detect(&exposure);
            let is_right = |ball: &BallCandidate| (ball.center - truth.center).norm() <= 15.0;
            found += usize::from(balls.iter().any(is_right));
            wrong += balls.iter().filter(|ball| !is_right(ball)).count();
            if !balls.iter().any(is_right) {
                println!("{look:?}: {balls:?} instead of {truth:?}");
            }
        }
    }
    println!("{found} of {shown} balls found, {wrong} in the wrong place");
    assert!(shown > 300, "{shown}");
    assert!(found * 10 >= shown * 9, "{found} of {shown}");
    assert!(wrong * 100 <= shown, "{wrong} of {shown}");
}

#[test]
fn without_a_ball_none_is_found() {
    let mut detector = Detector::new();
    for (number, look) in looks().enumerate() {
        for turn in [0.0, 0.13, 0.37, 0.71] {
            let look = Look {
                yaw: look.yaw + turn,
                ..look
            };
            let balls = detector.detect(&look.expose(number as u64, None));
            assert_eq!(balls, [], "{look:?}");
        }
    }
}
