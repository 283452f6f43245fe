//! What cycler `Vision` writes, and what its nodes see.
//!
//! Written by `hulkgen generate` from hulk.toml and the nodes it names. Do not edit.

use std::sync::Arc;

use framework::AdditionalSlot;
use framework::Cycle;
use framework::Injection;
use framework::InjectionCell;
use framework::InjectionTable;
use framework::Reflect;
use framework::Timestamp;
use framework::View;
use framework::pool::Leased;
use framework::recorded::Outputs;
use nalgebra::Point2;
use serde::Deserialize;
use serde::Serialize;
use types::ball::BallCandidate;
use types::ball::BallView;
use types::camera::CameraMatrix;
use types::field_features::CenterCircle;
use types::field_features::FieldBorder;
use types::field_features::LineCorner;
use types::field_features::LineSegment;
use types::field_features::PenaltyMark;
use types::image::YuyvImage;
use types::limbs::LimbMask;
use types::obstacles::ObstacleCandidate;
use vision::ball_detection::BallProposal;
use vision::field_color::FieldColor;
use vision::segments::ImageSegments;

use crate::databases::control;
use crate::parameters::Parameters;
use crate::parameters::VisionInstance;

/// Main outputs that only nodes of `Vision` read: they stay with the instance.
#[derive(Clone, Debug, Default, Deserialize, Reflect, Serialize)]
pub struct OwnOutputs {
    /// vision::camera_matrix_extractor
    pub camera_matrix: Option<CameraMatrix>,
    /// vision::field_color_detection
    pub field_color: FieldColor,
    /// vision::image_receiver
    pub image: Option<Leased<YuyvImage>>,
    /// vision::image_segmenter
    pub image_segments: ImageSegments,
}

/// Main outputs that other instances read, too: written in the slot that those will read.
#[derive(Clone, Debug, Default, Deserialize, Outputs, Reflect, Serialize)]
pub struct SharedOutputs {
    /// vision::ball_detection
    pub ball_view: Option<BallView>,
    /// vision::ball_detection
    pub balls: Vec<BallCandidate>,
    /// vision::center_circle_detection
    pub center_circle: Option<CenterCircle>,
    /// vision::corner_detection
    pub corners: Vec<LineCorner>,
    /// vision::field_border
    pub field_border: FieldBorder,
    /// vision::limb_projector
    pub limb_mask: LimbMask,
    /// vision::line_detection
    pub lines: Vec<LineSegment>,
    /// vision::obstacle_detection
    pub obstacles: Vec<ObstacleCandidate>,
    /// vision::penalty_mark_detection
    pub penalty_mark: Option<PenaltyMark>,
}

/// Computed only while somebody listens.
#[derive(Debug, Default)]
pub struct AdditionalOutputs {
    /// vision::ball_detection
    pub ball_candidates: AdditionalSlot<Vec<BallCandidate>>,
    /// vision::ball_detection
    pub ball_proposals: AdditionalSlot<Vec<BallProposal>>,
    /// vision::field_border
    pub field_border_points: AdditionalSlot<Vec<Point2<f32>>>,
    /// vision::center_circle_detection
    pub image_circle: AdditionalSlot<Vec<Point2<f32>>>,
    /// vision::line_detection
    pub image_lines: AdditionalSlot<Vec<[Point2<f32>; 2]>>,
    /// vision::line_detection
    pub line_points: AdditionalSlot<Vec<Point2<f32>>>,
    /// vision::obstacle_detection
    pub obstacle_feet: AdditionalSlot<Vec<Point2<f32>>>,
    /// vision::penalty_mark_detection
    pub penalty_mark_candidates: AdditionalSlot<Vec<PenaltyMark>>,
}

/// Who listens to which additional output, decided once per cycle.
#[derive(Clone, Copy, Debug, Default, Deserialize, Serialize)]
pub struct Subscribed {
    pub ball_candidates: bool,
    pub ball_proposals: bool,
    pub field_border_points: bool,
    pub image_circle: bool,
    pub image_lines: bool,
    pub line_points: bool,
    pub obstacle_feet: bool,
    pub penalty_mark_candidates: bool,
}

/// Values of clients in place of main outputs.
#[derive(Clone, Debug, Default, Deserialize, Outputs, Serialize)]
pub struct Injections {
    pub ball_view: Injection<Option<BallView>>,
    pub balls: Injection<Vec<BallCandidate>>,
    pub camera_matrix: Injection<Option<CameraMatrix>>,
    pub center_circle: Injection<Option<CenterCircle>>,
    pub corners: Injection<Vec<LineCorner>>,
    pub field_border: Injection<FieldBorder>,
    pub field_color: Injection<FieldColor>,
    pub image: Injection<Option<Leased<YuyvImage>>>,
    pub image_segments: Injection<ImageSegments>,
    pub limb_mask: Injection<LimbMask>,
    pub lines: Injection<Vec<LineSegment>>,
    pub obstacles: Injection<Vec<ObstacleCandidate>>,
    pub penalty_mark: Injection<Option<PenaltyMark>>,
}

impl InjectionTable for Injections {
    fn get_mut(&mut self, output: &str) -> Option<&mut dyn InjectionCell> {
        match output {
            "ball_view" => Some(&mut self.ball_view),
            "balls" => Some(&mut self.balls),
            "camera_matrix" => Some(&mut self.camera_matrix),
            "center_circle" => Some(&mut self.center_circle),
            "corners" => Some(&mut self.corners),
            "field_border" => Some(&mut self.field_border),
            "field_color" => Some(&mut self.field_color),
            "image" => Some(&mut self.image),
            "image_segments" => Some(&mut self.image_segments),
            "limb_mask" => Some(&mut self.limb_mask),
            "lines" => Some(&mut self.lines),
            "obstacles" => Some(&mut self.obstacles),
            "penalty_mark" => Some(&mut self.penalty_mark),
            _ => None,
        }
    }
}

/// The newest finished cycle of other instances.
#[derive(Clone, Copy)]
pub struct Latest<'a> {
    pub control: View<'a, control::SharedOutputs>,
}

/// Everything the nodes of one cycle may touch, borrowed.
pub struct Frame<'a, Hardware> {
    pub additional_outputs: &'a mut AdditionalOutputs,
    pub capture_time: &'a mut Option<Timestamp>,
    pub cycle: Cycle,
    pub hardware_interface: &'a Arc<Hardware>,
    pub injections: Option<&'a Injections>,
    pub instance_parameters: &'a VisionInstance,
    pub latest: Latest<'a>,
    pub own: &'a mut OwnOutputs,
    pub parameters: &'a Parameters,
    pub shared: &'a mut SharedOutputs,
    pub subscribed: Subscribed,
}
