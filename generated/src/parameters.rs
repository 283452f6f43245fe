//! The parameter tree; each field names the nodes that read it.
//!
//! Written by `hulkgen generate` from hulk.toml and the nodes it names. Do not edit.

use audio::whistle_detection::WhistleDetectionParameters;
use control::ball_filter::BallFilterParameters;
use control::behavior::BehaviorParameters;
use control::fall_state_filter::Sitting;
use control::fall_state_filter::TiltLimits;
use control::localization::LocalizationParameters;
use control::obstacle_filter::ObstacleFilterParameters;
use control::role_assignment::RoleParameters;
use control::team_ball_filter::TeamBallParameters;
use control::team_rhythm::TeamRhythm;
use control::walking_engine::Heat;
use framework::Reflect;
use keyframes::Motions;
use serde::Deserialize;
use serde::Serialize;
use types::audio::Tone;
use types::camera::CameraCalibration;
use types::camera::CameraPosition;
use types::field_markings::FieldMarkings;
use types::game::Player;
use types::game::PrimaryState;
use types::head::HeadAngles;
use types::joints::Joints;
use types::leds::ChestColors;
use types::leds::Color;
use types::projection_noise::ProjectionNoise;
use vision::ball_detection::BallDetectionParameters;
use vision::camera_matrix_extractor::CameraMatrixExtractorParameters;
use vision::center_circle_detection::CenterCircleDetectionParameters;
use vision::corner_detection::CornerDetectionParameters;
use vision::field_border::FieldBorderParameters;
use vision::field_color::FieldColor;
use vision::field_color_detection::FieldColorDetectionParameters;
use vision::image_segmenter::ScanSteps;
use vision::limb_projector::LimbProjectorParameters;
use vision::line_detection::LineDetectionParameters;
use vision::obstacle_detection::ObstacleDetectionParameters;
use vision::penalty_mark_detection::PenaltyMarkDetectionParameters;

/// Everything that the parameter files say to nodes.
#[derive(Clone, Debug, Deserialize, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Parameters {
    /// vision::ball_detection
    pub ball_detection: BallDetectionParameters,
    /// control::ball_filter
    pub ball_filter: BallFilterParameters,
    /// control::behavior
    pub behavior: BehaviorParameters,
    pub button_filter: ButtonFilter,
    /// vision::camera_matrix_extractor
    pub camera_matrix_extractor: CameraMatrixExtractorParameters,
    pub cameras: Cameras,
    pub client_wishes: ClientWishes,
    /// vision::corner_detection
    pub corner_detection: CornerDetectionParameters,
    pub fall_state_filter: FallStateFilter,
    /// vision::field_color_detection
    pub field_color: FieldColor,
    /// vision::field_color_detection
    pub field_color_detection: FieldColorDetectionParameters,
    pub field_dimensions: FieldDimensions,
    pub foot_pressure_filter: FootPressureFilter,
    pub game_controller_filter: GameControllerFilter,
    pub game_controller_responder: GameControllerResponder,
    pub game_state_filter: GameStateFilter,
    pub ground_contact_filter: GroundContactFilter,
    pub head_motion: HeadMotion,
    pub led_status: LedStatus,
    /// vision::limb_projector
    pub limb_projector: LimbProjectorParameters,
    /// control::localization
    pub localization: LocalizationParameters,
    pub look_around: LookAround,
    pub look_at: LookAt,
    pub motion_dispatcher: MotionDispatcher,
    /// control::motion_dispatcher, control::scripted_motion
    pub motions: Motions,
    pub motor_commands_collector: MotorCommandsCollector,
    /// vision::obstacle_detection
    pub obstacle_detection: ObstacleDetectionParameters,
    /// control::obstacle_filter
    pub obstacle_filter: ObstacleFilterParameters,
    pub odometry: Odometry,
    pub orientation_filter: OrientationFilter,
    pub penalized_pose: PenalizedPose,
    /// vision::penalty_mark_detection
    pub penalty_mark_detection: PenaltyMarkDetectionParameters,
    /// control::game_controller_filter, control::game_controller_responder,
    /// control::localization, control::role_assignment, control::self_report,
    /// control::team_ball_filter, spl_network::message_receiver,
    /// spl_network::team_message_parser
    pub player: Player,
    /// vision::ball_detection, vision::corner_detection, vision::line_detection,
    /// vision::obstacle_detection, vision::penalty_mark_detection
    pub projection_noise: ProjectionNoise,
    pub recording_switch: RecordingSwitch,
    /// control::role_assignment
    pub role_assignment: RoleParameters,
    pub sit_down: SitDown,
    pub sonar_filter: SonarFilter,
    pub stand: Stand,
    pub support_foot_filter: SupportFootFilter,
    /// control::team_ball_filter, control::team_message_filter
    pub team_ball_filter: TeamBallParameters,
    pub team_message_filter: TeamMessageFilter,
    pub team_message_sender: TeamMessageSender,
    /// control::team_message_filter, control::team_message_sender
    pub team_rhythm: TeamRhythm,
    pub tone_selector: ToneSelector,
    pub vision_bottom: VisionInstance,
    pub vision_top: VisionInstance,
    /// control::client_wishes, control::motion_dispatcher, control::walking_engine
    pub walking_engine: walking::Parameters,
    pub walking_feet: WalkingFeet,
    /// control::walking_engine
    pub walking_heat: Heat,
    /// audio::whistle_detection, control::tone_selector
    pub whistle_detection: WhistleDetectionParameters,
    pub whistle_filter: WhistleFilter,
    pub whose_ball_filter: WhoseBallFilter,
}

#[derive(Clone, Debug, Deserialize, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct ButtonFilter {
    /// control::button_filter
    #[reflect(unit = "s", range = 0..)]
    pub bounce_time: f32,
    /// control::button_filter
    #[reflect(unit = "s", range = 0..)]
    pub head_hold_time: f32,
}

#[derive(Clone, Debug, Deserialize, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Cameras {
    /// control::camera_matrices, vision::limb_projector
    pub bottom: CameraCalibration,
    /// control::camera_matrices
    #[reflect(unit = "s", range = 0..)]
    pub steady_after: f32,
    /// control::camera_matrices, vision::limb_projector
    pub top: CameraCalibration,
}

#[derive(Clone, Debug, Deserialize, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct ClientWishes {
    /// control::client_wishes
    pub kick_duration: f32,
    /// control::client_wishes
    pub motion_duration: f32,
    /// control::client_wishes
    pub walk_duration: f32,
}

#[derive(Clone, Debug, Deserialize, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct FallStateFilter {
    /// control::fall_state_filter
    #[reflect(unit = "s", range = 0..)]
    pub acceleration_time: f32,
    /// control::fall_state_filter
    #[reflect(unit = "s", range = 0..)]
    pub longest_fall: f32,
    /// control::fall_state_filter
    #[reflect(unit = "m", range = 0..)]
    pub overhang: f32,
    /// control::fall_state_filter
    #[reflect(unit = "m/s²", range = 0..)]
    pub resting_deviation: f32,
    /// control::fall_state_filter
    pub sitting: Sitting,
    /// control::fall_state_filter
    pub tilt: TiltLimits,
    /// control::fall_state_filter
    #[reflect(unit = "rad/s", range = 0..)]
    pub tilting_rotation: f32,
}

#[derive(Clone, Debug, Deserialize, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct FieldDimensions {
    /// vision::ball_detection, vision::obstacle_detection
    #[reflect(unit = "m", range = 0..)]
    pub ball_radius: f32,
    /// vision::ball_detection, vision::line_detection, vision::obstacle_detection,
    /// vision::penalty_mark_detection
    #[reflect(unit = "m", range = 0..)]
    pub line_width: f32,
    /// control::localization, control::role_assignment, control::team_message_filter,
    /// vision::center_circle_detection, vision::corner_detection
    pub markings: FieldMarkings,
    /// vision::penalty_mark_detection
    #[reflect(unit = "m", range = 0..)]
    pub penalty_mark_size: f32,
}

#[derive(Clone, Debug, Deserialize, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct FootPressureFilter {
    /// control::foot_pressure_filter
    #[reflect(unit = "s", range = 0..)]
    pub smoothing_time: f32,
}

#[derive(Clone, Debug, Deserialize, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct GameControllerFilter {
    /// control::game_controller_filter
    #[reflect(unit = "s", range = 0..)]
    pub forget_after: f32,
}

#[derive(Clone, Debug, Deserialize, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct GameControllerResponder {
    /// control::game_controller_responder
    #[reflect(unit = "s", range = 0..)]
    pub interval: f32,
}

#[derive(Clone, Debug, Deserialize, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct GameStateFilter {
    /// control::game_state_filter
    #[reflect(unit = "s", range = 0..)]
    pub playing_delay: f32,
    /// control::game_state_filter
    #[reflect(unit = "s", range = 0..)]
    pub playing_margin: f32,
}

#[derive(Clone, Debug, Deserialize, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct GroundContactFilter {
    /// control::ground_contact_filter
    #[reflect(unit = "s", range = 0..)]
    pub delay: f32,
    /// control::ground_contact_filter
    #[reflect(unit = "kg", range = 0..)]
    pub hysteresis: f32,
    /// control::ground_contact_filter
    pub pressure: f32,
}

#[derive(Clone, Debug, Deserialize, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct HeadMotion {
    /// control::head_motion
    pub stiffness: f32,
    /// control::head_motion
    pub velocity: f32,
}

#[derive(Clone, Debug, Deserialize, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct LedStatus {
    /// control::led_status
    pub ball_known: Color,
    /// control::led_status
    pub ball_unknown: Color,
    /// control::led_status
    #[reflect(unit = "s", range = 0..)]
    pub blink_period: f32,
    /// control::led_status
    pub chest: ChestColors,
    /// control::led_status
    #[reflect(range = 0..= 1)]
    pub ear_brightness: f32,
    /// control::led_status
    pub in_the_air: Color,
    /// control::led_status
    pub on_ground: Color,
    /// control::led_status
    pub own_kick_off: Color,
    /// control::led_status
    pub team_color: Color,
}

#[derive(Clone, Debug, Deserialize, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct LookAround {
    /// control::look_around
    pub way_points: Vec<HeadAngles>,
}

#[derive(Clone, Debug, Deserialize, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct LookAt {
    /// control::look_at
    #[reflect(unit = "m", range = 0..)]
    pub bottom_camera_range: f32,
    /// control::look_at
    #[reflect(unit = "m", range = 0..)]
    pub hysteresis: f32,
}

#[derive(Clone, Debug, Deserialize, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct MotionDispatcher {
    /// control::motion_dispatcher
    pub minimum_duration: f32,
    /// control::motion_dispatcher
    pub stiffness: f32,
    /// control::motion_dispatcher
    pub velocity_share: f32,
}

#[derive(Clone, Debug, Deserialize, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct MotorCommandsCollector {
    /// control::motor_commands_collector
    pub velocity_share: f32,
}

#[derive(Clone, Debug, Deserialize, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Odometry {
    /// control::odometry
    pub forward_scale: f32,
    /// control::odometry
    pub left_scale: f32,
    /// control::odometry
    #[reflect(unit = "rad")]
    pub still_angle: f32,
    /// control::odometry
    #[reflect(unit = "m", range = 0..)]
    pub still_distance: f32,
    /// control::odometry
    #[reflect(unit = "rad/s", range = 0..)]
    pub still_rotation: f32,
    /// control::odometry
    #[reflect(unit = "s", range = 0..)]
    pub still_time: f32,
}

#[derive(Clone, Debug, Deserialize, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct OrientationFilter {
    /// control::orientation_filter
    #[reflect(unit = "s", range = 0..)]
    pub bias_time: f32,
    /// control::orientation_filter
    #[reflect(unit = "s", range = 0..)]
    pub gravity_time: f32,
    /// control::orientation_filter
    pub refused_deviation: f32,
    /// control::orientation_filter
    #[reflect(unit = "rad/s", range = 0..)]
    pub still_rotation: f32,
    /// control::orientation_filter
    pub trusted_deviation: f32,
}

#[derive(Clone, Debug, Deserialize, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct PenalizedPose {
    /// control::motion_dispatcher, control::penalized_pose
    pub positions: Joints<f32>,
    /// control::penalized_pose
    #[reflect(range = 0..= 1)]
    pub stiffness: f32,
}

#[derive(Clone, Debug, Deserialize, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct RecordingSwitch {
    /// control::recording_switch
    #[reflect(unit = "s", range = 0..)]
    pub after_fall: f32,
    /// control::recording_switch
    pub states: Vec<PrimaryState>,
}

#[derive(Clone, Debug, Deserialize, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct SitDown {
    /// control::motion_dispatcher, control::sit_down
    pub crouch: Joints<f32>,
    /// control::sit_down
    #[reflect(unit = "s", range = 0..)]
    pub minimum_duration: f32,
    /// control::sit_down
    #[reflect(unit = "s", range = 0..)]
    pub release_duration: f32,
    /// control::sit_down
    pub sitting: Joints<f32>,
    /// control::sit_down
    #[reflect(range = 0..= 1)]
    pub stiffness: f32,
    /// control::sit_down
    pub velocity_share: f32,
}

#[derive(Clone, Debug, Deserialize, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct SonarFilter {
    /// control::sonar_filter
    #[reflect(unit = "s", range = 0..)]
    pub echo_delay: f32,
    /// control::sonar_filter
    #[reflect(unit = "m", range = 0..)]
    pub largest_distance: f32,
    /// control::sonar_filter
    #[reflect(unit = "m", range = 0..)]
    pub least_distance: f32,
    /// control::sonar_filter
    #[reflect(unit = "s", range = 0..)]
    pub smoothing_time: f32,
}

#[derive(Clone, Debug, Deserialize, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Stand {
    /// control::motion_dispatcher, control::stand
    pub positions: Joints<f32>,
    /// control::stand
    #[reflect(range = 0..= 1)]
    pub stiffness: f32,
}

#[derive(Clone, Debug, Deserialize, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct SupportFootFilter {
    /// control::support_foot_filter
    #[reflect(unit = "kg", range = 0..)]
    pub hysteresis: f32,
}

#[derive(Clone, Debug, Deserialize, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct TeamMessageFilter {
    /// control::team_message_filter
    #[reflect(unit = "m", range = 0..)]
    pub carpet: f32,
    /// control::team_message_filter
    #[reflect(unit = "s", range = 0..)]
    pub forget_after: f32,
}

#[derive(Clone, Debug, Deserialize, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct TeamMessageSender {
    /// control::team_message_sender
    #[reflect(unit = "s", range = 1..)]
    pub least_interval: f32,
}

#[derive(Clone, Debug, Deserialize, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct ToneSelector {
    /// control::tone_selector
    pub state_tone: Tone,
    /// control::tone_selector
    pub whistle_tone: Tone,
}

#[derive(Clone, Debug, Deserialize, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct VisionInstance {
    /// vision::camera_matrix_extractor, vision::image_receiver, vision::limb_projector
    pub camera_position: CameraPosition,
    /// vision::center_circle_detection
    pub center_circle_detection: CenterCircleDetectionParameters,
    /// vision::field_border
    pub field_border: FieldBorderParameters,
    /// vision::line_detection
    pub line_detection: LineDetectionParameters,
    /// vision::image_segmenter
    pub scan_steps: ScanSteps,
}

#[derive(Clone, Debug, Deserialize, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct WalkingFeet {
    /// control::walking_engine
    #[reflect(unit = "kg", range = 0..)]
    pub least_weight: f32,
}

#[derive(Clone, Debug, Deserialize, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct WhistleFilter {
    /// control::whistle_filter
    #[reflect(range = 1..= 16)]
    pub least_blocks: u32,
    /// control::whistle_filter
    pub least_microphones: u32,
    /// control::whistle_filter
    #[reflect(unit = "s", range = 0..)]
    pub window: f32,
}

#[derive(Clone, Debug, Deserialize, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct WhoseBallFilter {
    /// control::whose_ball_filter
    #[reflect(unit = "s", range = 0..)]
    pub set_play_lasts: f32,
}
