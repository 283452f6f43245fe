//! Behaviour, motions, and head together move an ideal body: from limp through a game to limp again.

use control::{
    behavior, camera_matrices, head_motion, look_around, look_at, motion_dispatcher,
    motion_selector, motor_commands_collector, penalized_pose, sit_down, stand,
};
use framework::testing::{self, AdditionalProbe, ParameterFile};
use framework::{CycleTime, math};
use kinematics::{forward_kinematics, limits};
use nalgebra::{Point2, Point3};
use types::ball::Ball;
use types::camera::{CameraCalibration, CameraMatrices};
use types::fall_state::{Facing, FallState};
use types::feet::Side;
use types::game::PrimaryState;
use types::head::{HeadAngles, HeadCommand};
use types::joints::Joints;
use types::motion::{BodyMotion, MotionCommand, MotionSelection, SafeExits};
use types::motor_commands::MotorCommands;
use types::robot_kinematics::RobotKinematics;
use types::sensor_data::InertialMeasurement;
use types::world_state::WorldState;

/// In s, of the NAO's body.
const CYCLE: f32 = 0.012;

/// The nodes, what they keep between cycles, and a body that obeys at once.
struct Robot {
    parameters: ParameterFile,
    top: CameraCalibration,
    bottom: CameraCalibration,
    stand_pose: Joints<f32>,
    penalized: Joints<f32>,
    crouch: Joints<f32>,
    sitting: Joints<f32>,
    way_points: Vec<HeadAngles>,
    behavior: behavior::Behavior,
    motion_selector: motion_selector::MotionSelector,
    stand: stand::Stand,
    penalized_pose: penalized_pose::PenalizedPose,
    sit_down: sit_down::SitDown,
    motion_dispatcher: motion_dispatcher::MotionDispatcher,
    look_around: look_around::LookAround,
    look_at: look_at::LookAt,
    head_motion: head_motion::HeadMotion,
    collector: motor_commands_collector::MotorCommandsCollector,
    cameras: camera_matrices::CameraMatricesProvider,

    world_state: WorldState,
    cycles: u64,
    safe_exits: SafeExits,
    selection: MotionSelection,
    head_command: Option<HeadCommand>,
    motor_commands: Option<MotorCommands>,
    body: Joints<f32>,
    /// The hardware drops all commands, and the body stays where gravity takes it.
    is_in_safe_state: bool,
}

/// What the motions want in one cycle.
struct Wanted {
    dispatch: Option<MotorCommands>,
    stand: Option<MotorCommands>,
    penalized: Option<MotorCommands>,
    sit_down: Option<MotorCommands>,
}

impl Robot {
    fn new(body: Joints<f32>) -> Self {
        let parameters = ParameterFile::new(include_str!("../../parameters/default.toml"));
        Self {
            top: parameters.get("cameras.top"),
            bottom: parameters.get("cameras.bottom"),
            stand_pose: parameters.get("stand.positions"),
            penalized: parameters.get("penalized_pose.positions"),
            crouch: parameters.get("sit_down.crouch"),
            sitting: parameters.get("sit_down.sitting"),
            way_points: parameters.get("look_around.way_points"),
            parameters,
            behavior: behavior::Behavior::new(behavior::CreationContext {}).unwrap(),
            motion_selector: motion_selector::MotionSelector::new(
                motion_selector::CreationContext {},
            )
            .unwrap(),
            stand: stand::Stand::new(stand::CreationContext {}).unwrap(),
            penalized_pose: penalized_pose::PenalizedPose::new(penalized_pose::CreationContext {})
                .unwrap(),
            sit_down: sit_down::SitDown::new(sit_down::CreationContext {}).unwrap(),
            motion_dispatcher: motion_dispatcher::MotionDispatcher::new(
                motion_dispatcher::CreationContext {},
            )
            .unwrap(),
            look_around: look_around::LookAround::new(look_around::CreationContext {}).unwrap(),
            look_at: look_at::LookAt::new(look_at::CreationContext {}).unwrap(),
            head_motion: head_motion::HeadMotion::new(head_motion::CreationContext {}).unwrap(),
            collector: motor_commands_collector::MotorCommandsCollector::new(
                motor_commands_collector::CreationContext {},
            )
            .unwrap(),
            cameras: camera_matrices::CameraMatricesProvider::new(
                camera_matrices::CreationContext {},
            )
            .unwrap(),
            world_state: WorldState::default(),
            cycles: 0,
            safe_exits: SafeExits::default(),
            selection: MotionSelection::default(),
            head_command: None,
            motor_commands: None,
            body,
            is_in_safe_state: false,
        }
    }

    /// Sitting and limp, as before a game.
    fn sitting() -> Self {
        let mut robot = Self::new(Joints::filled(0.0));
        robot.body = robot.sitting;
        robot
    }

    fn time(&self) -> CycleTime {
        testing::cycle_time(12 * self.cycles, 12)
    }

    fn kinematics(&self) -> RobotKinematics {
        RobotKinematics::from(&forward_kinematics(&self.body))
    }

    fn camera_matrices(&mut self) -> CameraMatrices {
        let kinematics = self.kinematics();
        let torso_to_world = kinematics.soles_to_torso.left.rotation.inverse();
        let (roll, pitch, _) = torso_to_world.euler_angles();
        let context = camera_matrices::CycleContext {
            support_side: Some(&Side::Left),
            fall_state: &FallState::Upright,
            cycle_time: self.time(),
            robot_kinematics: &kinematics,
            inertial: &InertialMeasurement {
                roll,
                pitch,
                ..InertialMeasurement::default()
            },
            top: &self.top,
            bottom: &self.bottom,
            steady_after: &0.0,
        };
        let outputs = self.cameras.cycle(context).unwrap();
        outputs.camera_matrices.value.unwrap()
    }

    /// One cycle of all nodes, then of the body.
    fn cycle(&mut self) {
        self.cycles += 1;
        let mut plan = AdditionalProbe::unsubscribed();
        let context = behavior::CycleContext {
            world_state: &self.world_state,
            client_wish: None,
            cycle_time: self.time(),
            parameters: &self.parameters.get("behavior"),
            plan: plan.output(),
        };
        let command = self.behavior.cycle(context).unwrap().motion_command.value;
        let context = motion_selector::CycleContext {
            motion_command: &command,
            is_in_safe_state: &self.is_in_safe_state,
            safe_exits: &mut self.safe_exits,
        };
        let outputs = self.motion_selector.cycle(context).unwrap();
        self.selection = outputs.motion_selection.value;
        let wanted = self.move_body(&command);
        self.head_command = self.move_head(&command);
        let commands = self.collect(&wanted);
        self.body = Joints::from_fn(|joint| {
            if commands.stiffnesses[joint] > 0.0 && !self.is_in_safe_state {
                commands.positions[joint]
            } else {
                self.body[joint]
            }
        });
        self.motor_commands = Some(commands);
    }

    fn move_body(&mut self, motion_command: &MotionCommand) -> Wanted {
        let cycle_time = self.time();
        let context = stand::CycleContext {
            motion_selection: &self.selection,
            positions: &self.stand_pose,
            stiffness: &self.parameters.get("stand.stiffness"),
        };
        let stand = self.stand.cycle(context).unwrap().stand_commands.value;
        let context = penalized_pose::CycleContext {
            motion_selection: &self.selection,
            positions: &self.penalized,
            stiffness: &self.parameters.get("penalized_pose.stiffness"),
        };
        let penalized = self.penalized_pose.cycle(context).unwrap();
        let context = sit_down::CycleContext {
            motion_selection: &self.selection,
            cycle_time,
            safe_exit: &mut self.safe_exits.sit_down,
            crouch: &self.crouch,
            sitting: &self.sitting,
            stiffness: &self.parameters.get("sit_down.stiffness"),
            velocity_share: &self.parameters.get("sit_down.velocity_share"),
            minimum_duration: &self.parameters.get("sit_down.minimum_duration"),
            release_duration: &self.parameters.get("sit_down.release_duration"),
        };
        let sit_down = self.sit_down.cycle(context).unwrap();
        let context = motion_dispatcher::CycleContext {
            motion_command,
            motion_selection: &self.selection,
            positions: &self.body,
            previous: self.motor_commands.as_ref(),
            cycle_time,
            safe_exit: &mut self.safe_exits.dispatch,
            stand: &self.stand_pose,
            penalized_pose: &self.penalized,
            crouch: &self.crouch,
            walk: &self.parameters.get("walking_engine"),
            motions: &self.parameters.get("motions"),
            stiffness: &self.parameters.get("motion_dispatcher.stiffness"),
            velocity_share: &self.parameters.get("motion_dispatcher.velocity_share"),
            minimum_duration: &self.parameters.get("motion_dispatcher.minimum_duration"),
        };
        let dispatch = self.motion_dispatcher.cycle(context).unwrap();
        Wanted {
            dispatch: dispatch.dispatch_commands.value,
            stand,
            penalized: penalized.penalized_commands.value,
            sit_down: sit_down.sit_down_commands.value,
        }
    }

    fn move_head(&mut self, command: &MotionCommand) -> Option<HeadCommand> {
        let camera_matrices = self.camera_matrices();
        let head_to_torso = self.kinematics().head_to_torso;
        let cycle_time = self.time();
        let context = look_around::CycleContext {
            motion_command: command,
            previous: self.head_command.as_ref(),
            way_points: &self.way_points,
        };
        let around = self.look_around.cycle(context).unwrap().look_around.value;
        let context = look_at::CycleContext {
            motion_command: command,
            camera_matrices: Some(&camera_matrices),
            head_to_torso: &head_to_torso,
            bottom_camera_range: &self.parameters.get("look_at.bottom_camera_range"),
            hysteresis: &self.parameters.get("look_at.hysteresis"),
        };
        let at_point = self.look_at.cycle(context).unwrap().look_at.value;
        let context = head_motion::CycleContext {
            motion_command: command,
            motion_selection: &self.selection,
            around: around.as_ref(),
            at_point: at_point.as_ref(),
            positions: &self.body,
            previous: self.motor_commands.as_ref(),
            cycle_time,
            velocity: &self.parameters.get("head_motion.velocity"),
            stiffness: &self.parameters.get("head_motion.stiffness"),
            look_at: None,
        };
        self.head_motion.cycle(context).unwrap().head_command.value
    }

    fn collect(&mut self, wanted: &Wanted) -> MotorCommands {
        let context = motor_commands_collector::CycleContext {
            motion_selection: &self.selection,
            dispatch_commands: wanted.dispatch.as_ref(),
            stand_commands: wanted.stand.as_ref(),
            penalized_commands: wanted.penalized.as_ref(),
            sit_down_commands: wanted.sit_down.as_ref(),
            // These have tests of their own, on the physics.
            walk_commands: None,
            script_commands: None,
            head_command: self.head_command.as_ref(),
            previous: self.motor_commands.as_ref(),
            positions: &self.body,
            cycle_time: self.time(),
            velocity_share: &self
                .parameters
                .get("motor_commands_collector.velocity_share"),
        };
        let outputs = self.collector.cycle(context).unwrap();
        outputs.motor_commands.value.unwrap()
    }

    /// Cycles for so many seconds, and holds every one of them against what no body may do.
    fn live(&mut self, primary_state: PrimaryState, seconds: f32) {
        self.world_state.primary_state = primary_state;
        for _ in 0..(seconds / CYCLE) as usize {
            let (body, selection, exits) = (self.body, self.selection, self.safe_exits);
            let stiffness = self.stiffness();
            self.cycle();
            assert_within_limits(&body, &self.body);
            if selection.current == BodyMotion::SitDown && exits.sit_down {
                assert_eq!(stiffness, 0.0);
            }
            self.assert_change(selection, exits, &body);
        }
    }

    fn assert_change(&self, before: MotionSelection, exits: SafeExits, body: &Joints<f32>) {
        if self.selection == before || self.is_in_safe_state {
            return;
        }
        if before.is_dispatching {
            assert!(exits.dispatch, "{before:?} to {:?}", self.selection);
            match before.current {
                BodyMotion::SitDown => assert_eq!(*body, self.crouch),
                BodyMotion::Stand => assert_eq!(body_alone(body), body_alone(&self.stand_pose)),
                BodyMotion::Penalized => assert_eq!(body_alone(body), body_alone(&self.penalized)),
                BodyMotion::Unstiff | BodyMotion::Walk | BodyMotion::Scripted(_) => {}
            }
        } else if before.current == BodyMotion::SitDown {
            assert!(exits.sit_down, "{before:?} to {:?}", self.selection);
        }
    }

    /// The greatest that was commanded.
    fn stiffness(&self) -> f32 {
        let stiffnesses = self.motor_commands.unwrap_or_default().stiffnesses;
        stiffnesses.to_array().into_iter().fold(0.0, f32::max)
    }

    fn has(&self, motion: BodyMotion) -> bool {
        self.selection.is_at(motion)
    }
}

/// Without the head, which goes its own way while the body is upright.
fn body_alone(joints: &Joints<f32>) -> Joints<f32> {
    Joints {
        head_yaw: 0.0,
        head_pitch: 0.0,
        ..*joints
    }
}

/// All joints at an angle, as far as they reach.
fn somewhere(angle: f32) -> Joints<f32> {
    let mut body = Joints::from_fn(|joint| limits::clamp(joint, angle));
    let head = limits::clamp_head(HeadAngles {
        yaw: body.head_yaw,
        pitch: body.head_pitch,
    });
    (body.head_yaw, body.head_pitch) = (head.yaw, head.pitch);
    body
}

fn assert_within_limits(before: &Joints<f32>, after: &Joints<f32>) {
    for (joint, angle) in after.iter() {
        let limits = limits::of(joint);
        assert_eq!(*angle, limits::clamp(joint, *angle), "{joint:?}");
        let velocity = (angle - before[joint]).abs() / CYCLE;
        // No motion takes more than a quarter of what the motors can do.
        let limit = limits.velocity as f32 * 0.25;
        assert!(velocity <= limit * 1.01, "{joint:?}: {velocity} > {limit}");
    }
}

#[test]
fn a_robot_goes_from_limp_through_a_game_to_limp() {
    let mut robot = Robot::sitting();
    let sitting = robot.body;
    robot.live(PrimaryState::Unstiff, 1.0);
    assert_eq!((robot.body, robot.stiffness()), (sitting, 0.0));

    robot.live(PrimaryState::Initial, 4.0);
    assert!(robot.has(BodyMotion::Stand));
    robot.live(PrimaryState::Ready, 1.0);
    robot.live(PrimaryState::Playing, 1.0);
    assert!(robot.has(BodyMotion::Stand));

    robot.live(PrimaryState::Penalized, 4.0);
    assert!(robot.has(BodyMotion::Penalized));
    assert_eq!(robot.body, robot.penalized);
    robot.live(PrimaryState::Playing, 4.0);
    assert!(robot.has(BodyMotion::Stand));

    robot.live(PrimaryState::Unstiff, 6.0);
    assert!(robot.has(BodyMotion::Unstiff));
    assert_eq!((robot.body, robot.stiffness()), (sitting, 0.0));
}

#[test]
fn a_change_of_mind_on_the_way_harms_nobody() {
    use PrimaryState::{Initial, Penalized, Playing, Unstiff};
    for seconds in [0.1, 0.3, 0.7, 1.1, 1.5, 1.9, 2.5] {
        let mut robot = Robot::sitting();
        for primary_state in [Initial, Penalized, Playing, Unstiff, Initial, Unstiff] {
            robot.live(primary_state, seconds);
        }
        robot.live(Unstiff, 10.0);
        assert!(robot.has(BodyMotion::Unstiff), "{seconds}");
        assert_eq!(robot.body, robot.sitting);
    }
}

#[test]
fn a_robot_that_was_let_down_rises_from_where_it_sank_to() {
    for standing in [0.5, 4.0] {
        let mut robot = Robot::sitting();
        robot.live(PrimaryState::Initial, standing);
        robot.is_in_safe_state = true;
        robot.body = robot.sitting;
        robot.live(PrimaryState::Initial, 1.0);
        robot.is_in_safe_state = false;
        assert_eq!(robot.stiffness(), 0.0);
        // No joint is faster than it may be, from the first command on.
        robot.live(PrimaryState::Initial, 4.0);
        assert!(robot.has(BodyMotion::Stand));
    }
}

#[test]
fn from_any_pose_the_robot_stands_within_five_seconds_and_then_scans_slowly() {
    for angle in [-0.3, 0.0, 0.4, 1.0] {
        let mut robot = Robot::new(somewhere(angle));
        robot.live(PrimaryState::Initial, 5.0);
        assert!(robot.has(BodyMotion::Stand));
        let mut yaws = Vec::new();
        for _ in 0..2000 {
            let before = robot.body;
            robot.live(PrimaryState::Initial, 1.5 * CYCLE);
            let after = robot.body;
            let way = math::hypot(
                after.head_yaw - before.head_yaw,
                after.head_pitch - before.head_pitch,
            );
            assert!(way <= 0.3 * CYCLE * 1.001, "{way}");
            yaws.push(after.head_yaw);
        }
        assert!(yaws.contains(&0.7) && yaws.contains(&-0.7));
    }
}

#[test]
fn a_known_ball_is_looked_at_until_it_is_in_the_middle_of_an_image() {
    for (x, y) in [(2.0, 0.8), (0.5, -0.2), (5.0, 0.0)] {
        let mut robot = Robot::sitting();
        robot.world_state.ball = Some(Ball {
            position: Point2::new(x, y),
            ..Ball::default()
        });
        robot.live(PrimaryState::Set, 12.0);
        let matrices = robot.camera_matrices();
        let off = [matrices.top, matrices.bottom].map(|matrix| {
            let pixel = matrix.ground_to_pixel(Point3::new(x, y, 0.0));
            pixel.map_or(f32::MAX, |pixel| {
                (pixel.coords - matrix.intrinsics.center).norm()
            })
        });
        assert!(off[0].min(off[1]) < 2.0, "({x}, {y}): {off:?} px");
    }
}

#[test]
fn a_robot_that_lies_before_the_game_is_limp_at_once_and_rises_from_where_it_was_put() {
    for seconds in [0.5, 3.0] {
        let mut robot = Robot::sitting();
        robot.live(PrimaryState::Initial, seconds);
        robot.world_state.fall_state = FallState::Lying(Facing::Down);
        robot.cycle();
        assert_eq!(robot.stiffness(), 0.0);
        robot.body = somewhere(0.5);
        robot.cycle();
        assert_eq!(robot.stiffness(), 0.0);

        robot.world_state.fall_state = FallState::Upright;
        robot.live(PrimaryState::Playing, 5.0);
        assert!(robot.has(BodyMotion::Stand));
    }
}
