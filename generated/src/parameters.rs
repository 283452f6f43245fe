//! The parameter tree; each field names the nodes that read it.
//!
//! Written by `hulkgen generate` from hulk.toml and the nodes it names. Do not edit.

use framework::Reflect;
use serde::Deserialize;
use serde::Serialize;
use types::camera::CameraCalibration;
use types::camera::CameraPosition;
use types::head::HeadAngles;
use types::joints::Joints;
use types::leds::Color;
use vision::ball_detection::BallDetectionParameters;
use vision::field_color::FieldColor;
use vision::image_segmenter::ScanSteps;

/// Everything that the parameter files say to nodes.
#[derive(Clone, Debug, Deserialize, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Parameters {
    /// vision::ball_detection
    pub ball_detection: BallDetectionParameters,
    pub ball_memory: BallMemory,
    pub cameras: Cameras,
    /// vision::ball_detection, vision::image_segmenter
    pub field_color: FieldColor,
    pub field_dimensions: FieldDimensions,
    pub foot_pressure: FootPressure,
    pub head_scan: HeadScan,
    pub led_status: LedStatus,
    pub motor_commands_collector: MotorCommandsCollector,
    pub orientation_filter: OrientationFilter,
    pub ready_pose: ReadyPose,
    pub vision_bottom: VisionInstance,
    pub vision_top: VisionInstance,
}

#[derive(Clone, Debug, Deserialize, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct BallMemory {
    /// control::ball_memory
    pub forget_after: f32,
    /// control::ball_memory
    pub gain: f32,
    /// control::ball_memory
    pub same_place: f32,
}

#[derive(Clone, Debug, Deserialize, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Cameras {
    /// control::camera_matrices
    pub bottom: CameraCalibration,
    /// control::camera_matrices
    pub top: CameraCalibration,
}

#[derive(Clone, Debug, Deserialize, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct FieldDimensions {
    /// vision::ball_detection
    pub ball_radius: f32,
}

#[derive(Clone, Debug, Deserialize, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct FootPressure {
    /// control::foot_pressure
    pub contact_delay: f32,
    /// control::foot_pressure
    pub contact_hysteresis: f32,
    /// control::foot_pressure
    pub contact_pressure: f32,
    /// control::foot_pressure
    pub side_hysteresis: f32,
    /// control::foot_pressure
    pub smoothing_time: f32,
}

#[derive(Clone, Debug, Deserialize, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct HeadScan {
    /// control::head_scan
    pub stiffness: f32,
    /// control::head_scan
    pub velocity: f32,
    /// control::head_scan
    pub way_points: Vec<HeadAngles>,
}

#[derive(Clone, Debug, Deserialize, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct LedStatus {
    /// control::led_status
    pub ball_known: Color,
    /// control::led_status
    pub ball_unknown: Color,
    /// control::led_status
    pub in_the_air: Color,
    /// control::led_status
    pub on_ground: Color,
}

#[derive(Clone, Debug, Deserialize, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct MotorCommandsCollector {
    /// control::motor_commands_collector
    pub velocity_share: f32,
}

#[derive(Clone, Debug, Deserialize, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct OrientationFilter {
    /// control::orientation_filter
    pub bias_time: f32,
    /// control::orientation_filter
    pub gravity_time: f32,
    /// control::orientation_filter
    pub refused_deviation: f32,
    /// control::orientation_filter
    pub still_rotation: f32,
    /// control::orientation_filter
    pub trusted_deviation: f32,
}

#[derive(Clone, Debug, Deserialize, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct ReadyPose {
    /// control::ready_pose
    pub minimum_duration: f32,
    /// control::ready_pose
    pub positions: Joints<f32>,
    /// control::ready_pose
    pub stiffness: f32,
    /// control::ready_pose
    pub velocity_share: f32,
}

#[derive(Clone, Debug, Deserialize, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct VisionInstance {
    /// vision::camera_matrix_extractor, vision::image_receiver
    pub camera_position: CameraPosition,
    /// vision::image_segmenter
    pub scan_steps: ScanSteps,
}
