//! What cycler `Control` writes, and what its nodes see.
//!
//! Written by `hulkgen generate` from hulk.toml and the nodes it names. Do not edit.

use std::sync::Arc;

use control::ball_filter::BallHypothesis;
use control::localization::PoseHypothesis;
use framework::AdditionalSlot;
use framework::Answerer;
use framework::Consumer;
use framework::Cycle;
use framework::History;
use framework::Horizon;
use framework::Injection;
use framework::InjectionCell;
use framework::InjectionTable;
use framework::Interleaving;
use framework::Reflect;
use framework::Timestamp;
use framework::recorded::Outputs;
use nalgebra::Isometry2;
use nalgebra::Point2;
use nalgebra::Point3;
use nalgebra::UnitQuaternion;
use serde::Deserialize;
use serde::Serialize;
use types::audio::Tone;
use types::audio::Whistle;
use types::ball::Ball;
use types::ball::LearntImage;
use types::behavior::Activity;
use types::behavior::Plan;
use types::behavior::Role;
use types::buttons::Buttons;
use types::camera::CameraMatrices;
use types::fall_state::FallState;
use types::feet::Feet;
use types::feet::Side;
use types::game::GameControllerState;
use types::game::PrimaryState;
use types::game::WhoseBall;
use types::head::HeadAngles;
use types::head::HeadCommand;
use types::head::HeadRequest;
use types::leds::Leds;
use types::motion::ClientWish;
use types::motion::MotionCommand;
use types::motion::MotionRequest;
use types::motion::MotionSelection;
use types::motion::SafeExits;
use types::motion::Step;
use types::motor_commands::MotorCommands;
use types::obstacles::Obstacle;
use types::odometry::Odometry;
use types::robot_kinematics::RobotKinematics;
use types::sensor_data::SensorData;
use types::sonar::SonarDistances;
use types::team::TeamMessage;
use types::team::Teammate;
use types::world_state::WorldState;

use crate::databases::audio;
use crate::databases::spl_network;
use crate::databases::vision;
use crate::parameters::Parameters;

/// Main outputs that only nodes of `Control` read: they stay with the instance.
#[derive(Clone, Debug, Default, Deserialize, Reflect, Serialize)]
pub struct OwnOutputs {
    /// control::behavior
    pub activity: Activity,
    /// control::ball_filter
    pub ball: Option<Ball>,
    /// control::button_filter
    pub buttons: Buttons,
    /// control::center_of_mass
    pub center_of_mass: Point3<f32>,
    /// control::client_wishes
    pub client_wish: Option<ClientWish>,
    /// control::motion_dispatcher
    pub dispatch_commands: Option<MotorCommands>,
    /// control::fall_state_filter
    pub fall_state: FallState,
    /// control::game_controller_filter
    pub game_controller_state: Option<GameControllerState>,
    /// control::role_assignment
    pub goalkeeper: u8,
    /// control::localization
    pub ground_to_field: Option<Isometry2<f32>>,
    /// control::ground_contact_filter
    pub has_ground_contact: bool,
    /// control::head_motion
    pub head_command: Option<HeadCommand>,
    /// control::recording_switch
    pub is_recording_wanted: bool,
    /// control::led_status
    pub leds: Option<Leds>,
    /// control::look_around
    pub look_around: Option<HeadAngles>,
    /// control::look_at
    pub look_at: Option<HeadAngles>,
    /// control::behavior
    pub motion_command: MotionCommand,
    /// control::motion_selector
    pub motion_selection: MotionSelection,
    /// control::motor_commands_collector
    pub motor_commands: Option<MotorCommands>,
    /// control::obstacle_filter
    pub obstacles: Vec<Obstacle>,
    /// control::odometry
    pub odometry: Odometry,
    /// control::orientation_filter
    pub orientation: UnitQuaternion<f32>,
    /// control::penalized_pose
    pub penalized_commands: Option<MotorCommands>,
    /// control::game_state_filter
    pub primary_state: PrimaryState,
    /// control::role_assignment
    pub role: Option<Role>,
    /// control::scripted_motion
    pub script_commands: Option<MotorCommands>,
    /// control::self_report
    pub self_report: Option<TeamMessage>,
    /// control::sensor_data_receiver
    pub sensor_data: SensorData,
    /// control::sit_down
    pub sit_down_commands: Option<MotorCommands>,
    /// control::foot_pressure_filter
    pub sole_pressures: Feet<f32>,
    /// control::sonar_filter
    pub sonar_distances: SonarDistances,
    /// control::stand
    pub stand_commands: Option<MotorCommands>,
    /// control::support_foot_filter
    pub support_side: Option<Side>,
    /// control::team_ball_filter
    pub team_ball: Option<Point2<f32>>,
    /// control::self_report
    pub team_report: Option<TeamMessage>,
    /// control::team_message_filter
    pub teammates: Vec<Teammate>,
    /// control::tone_selector
    pub tone: Option<Tone>,
    /// control::walking_engine
    pub walk_commands: Option<MotorCommands>,
    /// control::whistle_filter
    pub whistle: Whistle,
    /// control::whose_ball_filter
    pub whose_ball: WhoseBall,
    /// control::world_state_composer
    pub world_state: WorldState,
}

/// Main outputs that other instances read, too: written in the slot that those will read.
#[derive(Clone, Debug, Default, Deserialize, Outputs, Reflect, Serialize)]
pub struct SharedOutputs {
    /// control::camera_matrices
    pub camera_matrices: Option<CameraMatrices>,
    /// control::forward_kinematics
    pub robot_kinematics: RobotKinematics,
}

/// Computed only while somebody listens.
#[derive(Debug, Default)]
pub struct AdditionalOutputs {
    pub ball_filter: AdditionalOutputsBallFilter,
    pub fall_state_filter: AdditionalOutputsFallStateFilter,
    pub localization: AdditionalOutputsLocalization,
    pub orientation_filter: AdditionalOutputsOrientationFilter,
    /// control::behavior
    pub plan: AdditionalSlot<Plan>,
    pub whistle_filter: AdditionalOutputsWhistleFilter,
}

#[derive(Debug, Default)]
pub struct AdditionalOutputsBallFilter {
    /// control::ball_filter
    pub delivered: AdditionalSlot<Vec<LearntImage>>,
    /// control::ball_filter
    pub hypotheses: AdditionalSlot<Vec<BallHypothesis>>,
    /// control::ball_filter
    pub persistent_ball: AdditionalSlot<Option<Ball>>,
}

#[derive(Debug, Default)]
pub struct AdditionalOutputsFallStateFilter {
    /// control::fall_state_filter
    pub center_of_mass_overhang: AdditionalSlot<f32>,
}

#[derive(Debug, Default)]
pub struct AdditionalOutputsLocalization {
    /// control::localization
    pub hypotheses: AdditionalSlot<Vec<PoseHypothesis>>,
}

#[derive(Debug, Default)]
pub struct AdditionalOutputsOrientationFilter {
    /// control::orientation_filter
    pub innovation: AdditionalSlot<f32>,
}

#[derive(Debug, Default)]
pub struct AdditionalOutputsWhistleFilter {
    /// control::whistle_filter
    pub votes: AdditionalSlot<u32>,
}

/// Who listens to which additional output, decided once per cycle.
#[derive(Clone, Copy, Debug, Default, Deserialize, Serialize)]
pub struct Subscribed {
    pub ball_filter_delivered: bool,
    pub ball_filter_hypotheses: bool,
    pub ball_filter_persistent_ball: bool,
    pub fall_state_filter_center_of_mass_overhang: bool,
    pub localization_hypotheses: bool,
    pub orientation_filter_innovation: bool,
    pub plan: bool,
    pub whistle_filter_votes: bool,
}

/// Values of clients in place of main outputs.
#[derive(Clone, Debug, Default, Deserialize, Outputs, Serialize)]
pub struct Injections {
    pub activity: Injection<Activity>,
    pub ball: Injection<Option<Ball>>,
    pub buttons: Injection<Buttons>,
    pub camera_matrices: Injection<Option<CameraMatrices>>,
    pub center_of_mass: Injection<Point3<f32>>,
    pub client_wish: Injection<Option<ClientWish>>,
    pub dispatch_commands: Injection<Option<MotorCommands>>,
    pub fall_state: Injection<FallState>,
    pub game_controller_state: Injection<Option<GameControllerState>>,
    pub goalkeeper: Injection<u8>,
    pub ground_to_field: Injection<Option<Isometry2<f32>>>,
    pub has_ground_contact: Injection<bool>,
    pub head_command: Injection<Option<HeadCommand>>,
    pub is_recording_wanted: Injection<bool>,
    pub leds: Injection<Option<Leds>>,
    pub look_around: Injection<Option<HeadAngles>>,
    pub look_at: Injection<Option<HeadAngles>>,
    pub motion_command: Injection<MotionCommand>,
    pub motion_selection: Injection<MotionSelection>,
    pub motor_commands: Injection<Option<MotorCommands>>,
    pub obstacles: Injection<Vec<Obstacle>>,
    pub odometry: Injection<Odometry>,
    pub orientation: Injection<UnitQuaternion<f32>>,
    pub penalized_commands: Injection<Option<MotorCommands>>,
    pub primary_state: Injection<PrimaryState>,
    pub robot_kinematics: Injection<RobotKinematics>,
    pub role: Injection<Option<Role>>,
    pub script_commands: Injection<Option<MotorCommands>>,
    pub self_report: Injection<Option<TeamMessage>>,
    pub sensor_data: Injection<SensorData>,
    pub sit_down_commands: Injection<Option<MotorCommands>>,
    pub sole_pressures: Injection<Feet<f32>>,
    pub sonar_distances: Injection<SonarDistances>,
    pub stand_commands: Injection<Option<MotorCommands>>,
    pub support_side: Injection<Option<Side>>,
    pub team_ball: Injection<Option<Point2<f32>>>,
    pub team_report: Injection<Option<TeamMessage>>,
    pub teammates: Injection<Vec<Teammate>>,
    pub tone: Injection<Option<Tone>>,
    pub walk_commands: Injection<Option<MotorCommands>>,
    pub whistle: Injection<Whistle>,
    pub whose_ball: Injection<WhoseBall>,
    pub world_state: Injection<WorldState>,
}

impl InjectionTable for Injections {
    fn get_mut(&mut self, output: &str) -> Option<&mut dyn InjectionCell> {
        match output {
            "activity" => Some(&mut self.activity),
            "ball" => Some(&mut self.ball),
            "buttons" => Some(&mut self.buttons),
            "camera_matrices" => Some(&mut self.camera_matrices),
            "center_of_mass" => Some(&mut self.center_of_mass),
            "client_wish" => Some(&mut self.client_wish),
            "dispatch_commands" => Some(&mut self.dispatch_commands),
            "fall_state" => Some(&mut self.fall_state),
            "game_controller_state" => Some(&mut self.game_controller_state),
            "goalkeeper" => Some(&mut self.goalkeeper),
            "ground_to_field" => Some(&mut self.ground_to_field),
            "has_ground_contact" => Some(&mut self.has_ground_contact),
            "head_command" => Some(&mut self.head_command),
            "is_recording_wanted" => Some(&mut self.is_recording_wanted),
            "leds" => Some(&mut self.leds),
            "look_around" => Some(&mut self.look_around),
            "look_at" => Some(&mut self.look_at),
            "motion_command" => Some(&mut self.motion_command),
            "motion_selection" => Some(&mut self.motion_selection),
            "motor_commands" => Some(&mut self.motor_commands),
            "obstacles" => Some(&mut self.obstacles),
            "odometry" => Some(&mut self.odometry),
            "orientation" => Some(&mut self.orientation),
            "penalized_commands" => Some(&mut self.penalized_commands),
            "primary_state" => Some(&mut self.primary_state),
            "robot_kinematics" => Some(&mut self.robot_kinematics),
            "role" => Some(&mut self.role),
            "script_commands" => Some(&mut self.script_commands),
            "self_report" => Some(&mut self.self_report),
            "sensor_data" => Some(&mut self.sensor_data),
            "sit_down_commands" => Some(&mut self.sit_down_commands),
            "sole_pressures" => Some(&mut self.sole_pressures),
            "sonar_distances" => Some(&mut self.sonar_distances),
            "stand_commands" => Some(&mut self.stand_commands),
            "support_side" => Some(&mut self.support_side),
            "team_ball" => Some(&mut self.team_ball),
            "team_report" => Some(&mut self.team_report),
            "teammates" => Some(&mut self.teammates),
            "tone" => Some(&mut self.tone),
            "walk_commands" => Some(&mut self.walk_commands),
            "whistle" => Some(&mut self.whistle),
            "whose_ball" => Some(&mut self.whose_ball),
            "world_state" => Some(&mut self.world_state),
            _ => None,
        }
    }
}

/// Shared by the nodes of one instance, kept between cycles.
#[derive(Clone, Debug, Default, Deserialize, Reflect, Serialize)]
pub struct CyclerState {
    /// control::motion_dispatcher, control::motion_selector, control::scripted_motion,
    /// control::sit_down, control::walking_engine
    pub safe_exits: SafeExits,
}

/// Calls that nodes answer, at most one of each in a cycle.
pub struct Procedures {
    /// control::head_motion
    pub look_at: Answerer<HeadRequest, HeadAngles>,
    /// control::client_wishes
    pub motion: Answerer<MotionRequest, f32>,
    /// control::client_wishes
    pub walk: Answerer<Step, Step>,
}

/// Main outputs that are read by time.
pub struct Historic {
    /// control::odometry
    pub odometry: History<Odometry>,
}

/// Perception instances in one order of time.
pub struct Perception {
    pub horizon: Horizon,
    pub vision: Interleaving,
    pub vision_top: Consumer<vision::SharedOutputs>,
    pub vision_bottom: Consumer<vision::SharedOutputs>,
    pub spl_network: Consumer<spl_network::SharedOutputs>,
    pub audio: Consumer<audio::SharedOutputs>,
}

/// What the last finished cycle wrote.
#[derive(Clone, Copy)]
pub struct Previous<'a> {
    pub own: &'a OwnOutputs,
}

/// Everything the nodes of one cycle may touch, borrowed.
pub struct Frame<'a, Hardware> {
    pub additional_outputs: &'a mut AdditionalOutputs,
    pub capture_time: &'a mut Option<Timestamp>,
    pub cycle: Cycle,
    pub cycler_state: &'a mut CyclerState,
    pub hardware_interface: &'a Arc<Hardware>,
    pub historic: &'a Historic,
    pub injections: Option<&'a Injections>,
    pub own: &'a mut OwnOutputs,
    pub parameters: &'a Parameters,
    pub perception: &'a Perception,
    pub previous: Previous<'a>,
    pub procedures: &'a mut Procedures,
    pub shared: &'a mut SharedOutputs,
    pub subscribed: Subscribed,
}
