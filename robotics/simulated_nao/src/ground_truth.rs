//! What is really the case in the world, for tests: nodes see only what sensors and cameras say.

use std::f32::consts::TAU;

use framework::{Timestamp, math};
use nalgebra::{Isometry3, Point2, Point3, Vector2};
use types::camera::CameraMatrix;
use types::feet::Feet;
use types::game::{GameState, SetPlay};
use types::joints::Joints;
use types::motor_commands::MotorCommands;

use crate::camera::{Cover, Exposure, HEIGHT, WIDTH};
use crate::field::{BALL_RADIUS, LENGTH, PENALTY_MARK_DISTANCE, goal_posts};
use crate::scene::{Robot, Team};
use crate::world::World;

/// The world at one moment.
#[derive(Clone, Debug)]
pub struct GroundTruth {
    /// The moment.
    pub now: Timestamp,
    /// Angles in rad; hands from 0 to 1.
    pub positions: Joints<f32>,
    /// What the motors were told last.
    pub commands: MotorCommands,
    /// From the torso frame to the field frame.
    pub torso_to_field: Isometry3<f32>,
    /// From the ground frame (on the floor midway between the soles) to the field frame.
    pub ground_to_field: Isometry3<f32>,
    /// How far the robot has gone over the floor, m: from place to place, a second apart.
    pub walked: f64,
    /// For how long it has been stuck, s: it lies, or its legs move, and it gets nowhere.
    pub stuck: f64,
    /// For how long it has stood still, s: within 0.05 m and 0.15 rad.
    pub still: f64,
    /// How often the feet of any robot have come to the ball.
    pub ball_contacts: u64,
    /// How many commands have come until now that want a joint beyond its limits.
    pub harmful_commands: u64,
    /// Centre of the ball in the field frame, m.
    pub ball: Option<Point3<f32>>,
    /// The other robots.
    pub robots: Vec<Robot>,
    /// What the robot can run into: the middle of each obstacle in the field frame and its radius, m.
    pub obstacles: Vec<(Point2<f64>, f64)>,
    /// The robot's team.
    pub team: Team,
    /// The game, where a referee plays one.
    pub game: Option<GameTruth>,
}

/// How a game really stands; the referee's computer tells some of it later.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GameTruth {
    /// What robots may do.
    pub state: GameState,
    /// How it was resumed.
    pub set_play: SetPlay,
    /// Who kicks.
    pub kicking: Team,
    /// Goals of the own (blue) and the other (red) team.
    pub score: [u8; 2],
    /// How often the referee has taken the robot out.
    pub removed: usize,
    /// How often for where it stood or walked.
    pub misplaced: usize,
    /// Whether the robot is not taken out now.
    pub plays: bool,
}

/// The body when a state was sent.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyTruth {
    /// When.
    pub at: Timestamp,
    /// Angles in rad; hands from 0 to 1.
    pub positions: Joints<f32>,
    /// What the motors are told from then on.
    pub commands: MotorCommands,
}

/// A camera at the exposure of an image.
#[derive(Clone, Debug, PartialEq)]
pub struct ImageTruth {
    /// The exposure; the timestamp of the cycle that is about this image.
    pub captured_at: Timestamp,
    /// Where the camera was.
    pub camera_matrix: CameraMatrix,
    /// From the ground frame to the field frame.
    pub ground_to_field: Isometry3<f32>,
    /// The ball, if some of it can be in front of the camera.
    pub ball: Option<BallTruth>,
    exposure: Exposure,
}

/// Where an image shows the ball.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BallTruth {
    /// Its centre, px; may lie outside of the image.
    pub center: Point2<f32>,
    /// Its radius, px.
    pub radius: f32,
    /// From the camera to its centre, m.
    pub distance: f32,
    /// Whether all of it is in the image and nothing stands in front of it.
    pub is_whole: bool,
}

/// Another robot, and where an image shows it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RobotTruth {
    /// On the floor midway between its soles, in the ground frame of the robot that looks, m.
    pub position: Point2<f32>,
    /// Whose it is.
    pub team: Team,
    /// Number of its shirt.
    pub number: u8,
    /// The origins of its soles' frames, px; `None` outside of the image.
    pub feet: Feet<Option<Point2<f32>>>,
}

/// A post of a goal, and where an image shows it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GoalPostTruth {
    /// Its middle on the floor in the ground frame, m.
    pub position: Point2<f32>,
    /// That place in the image, px.
    pub foot: Point2<f32>,
}

impl GroundTruth {
    /// As one of the robots has it.
    pub(crate) fn new(world: &World, robot: usize, harmful_commands: u64) -> Self {
        let body = world.body(robot);
        Self {
            now: world.now(),
            positions: body.joints.map(|angle| angle as f32),
            commands: *world.commands(robot),
            torso_to_field: body.torso_to_field.cast(),
            ground_to_field: body.ground_to_field().cast(),
            walked: world.walked(robot),
            stuck: world.stuck(robot),
            still: world.still(robot),
            ball_contacts: world.ball_contacts(),
            harmful_commands,
            ball: world.ball().map(|ball| ball.cast()),
            robots: world.robots(robot).to_vec(),
            obstacles: world.obstacles(robot).collect(),
            team: world.team(robot),
            game: world.game_truth(robot),
        }
    }
}

impl ImageTruth {
    /// The pixel that shows a point of the field frame (m); `None` outside of the image.
    pub fn project(&self, point: Point3<f32>) -> Option<Point2<f32>> {
        let pixel = self
            .camera_matrix
            .ground_to_pixel(self.ground_to_field.inverse() * point)?;
        is_inside(&pixel, 0.0).then_some(pixel)
    }

    /// The other robots, whether the image shows them or not.
    pub fn robots(&self) -> impl Iterator<Item = RobotTruth> {
        self.exposure.robots.iter().map(|robot| RobotTruth {
            position: self.to_ground(robot.position.cast()),
            team: robot.team,
            number: robot.number,
            feet: Feet {
                left: self.project(robot.soles.left),
                right: self.project(robot.soles.right),
            },
        })
    }

    /// The goal posts whose feet lie in the image, behind whatever else may be there.
    pub fn goal_posts(&self) -> impl Iterator<Item = GoalPostTruth> {
        goal_posts().into_iter().filter_map(|post| {
            Some(GoalPostTruth {
                position: self.to_ground(post),
                foot: self.project(Point3::new(post.x, post.y, 0.0))?,
            })
        })
    }

    /// Whether a pixel shows a robot, a limb of the own or the frame of a goal. Nets are no cover.
    pub fn covers(&self, pixel: Point2<f32>) -> bool {
        Cover::new(&self.exposure).depth_at(pixel).is_some()
    }

    fn to_ground(&self, place: Point2<f32>) -> Point2<f32> {
        let place = Point3::new(place.x, place.y, 0.0);
        self.ground_to_field.inverse_transform_point(&place).xy()
    }

    /// The penalty marks, on the floor of the field frame.
    pub fn penalty_marks() -> [Point3<f32>; 2] {
        [1.0, -1.0].map(|side| Point3::new(side * (LENGTH / 2.0 - PENALTY_MARK_DISTANCE), 0.0, 0.0))
    }
}

impl From<&Exposure> for ImageTruth {
    fn from(exposure: &Exposure) -> Self {
        let field_to_camera = exposure.camera_to_field.inverse();
        let ball = exposure.ball_in_camera().and_then(|center| {
            let pixel = exposure.intrinsics.project(center)?;
            let distance = center.coords.norm();
            let tangent = (distance * distance - BALL_RADIUS * BALL_RADIUS)
                .max(1e-6)
                .sqrt();
            let radius = exposure.intrinsics.focal.y * BALL_RADIUS / tangent;
            let is_whole =
                is_inside(&pixel, 1.1 * radius) && !is_hidden(exposure, &pixel, radius, center.z);
            Some(BallTruth {
                center: pixel,
                radius,
                distance,
                is_whole,
            })
        });
        Self {
            captured_at: exposure.captured_at,
            camera_matrix: CameraMatrix {
                ground_to_camera: field_to_camera * exposure.ground_to_field,
                intrinsics: exposure.intrinsics,
            },
            ground_to_field: exposure.ground_to_field,
            ball,
            exposure: exposure.clone(),
        }
    }
}

/// Whether something stands in front of the ball, by its middle and places on its rim.
fn is_hidden(exposure: &Exposure, center: &Point2<f32>, radius: f32, depth: f32) -> bool {
    let covers = Cover::new(exposure);
    let rim = (0..12_u8).map(|hour| f32::from(hour) * (TAU / 12.0));
    let rim = rim.map(|angle| center + Vector2::new(math::cos(angle), math::sin(angle)) * radius);
    let is_covered = |pixel| covers.depth_at(pixel).is_some_and(|cover| cover < depth);
    rim.chain([*center]).any(is_covered)
}

fn is_inside(pixel: &Point2<f32>, margin: f32) -> bool {
    let inside = |at: f32, size: usize| at >= margin && at <= size as f32 - 1.0 - margin;
    inside(pixel.x, WIDTH) && inside(pixel.y, HEIGHT)
}
