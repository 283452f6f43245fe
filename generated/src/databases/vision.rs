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
use serde::Deserialize;
use serde::Serialize;
use types::ball::BallCandidate;
use types::camera::CameraMatrix;
use types::image::YuyvImage;
use vision::segments::ImageSegments;

use crate::databases::control;
use crate::parameters::Parameters;
use crate::parameters::VisionInstance;

/// Main outputs that only nodes of `Vision` read: they stay with the instance.
#[derive(Clone, Debug, Default, Deserialize, Reflect, Serialize)]
pub struct OwnOutputs {
    /// vision::camera_matrix_extractor
    pub camera_matrix: Option<CameraMatrix>,
    /// vision::image_receiver
    pub image: YuyvImage,
    /// vision::image_segmenter
    pub image_segments: ImageSegments,
}

/// Main outputs that other instances read, too: written in the slot that those will read.
#[derive(Clone, Debug, Default, Deserialize, Reflect, Serialize)]
pub struct SharedOutputs {
    /// vision::ball_detection
    pub balls: Vec<BallCandidate>,
}

/// Computed only while somebody listens.
#[derive(Debug, Default)]
pub struct AdditionalOutputs {
    /// vision::ball_detection
    pub ball_candidates: AdditionalSlot<Vec<BallCandidate>>,
}

/// Who listens to which additional output, decided once per cycle.
#[derive(Clone, Copy, Debug, Default)]
pub struct Subscribed {
    pub ball_candidates: bool,
}

/// Values of clients in place of main outputs.
#[derive(Clone, Debug, Default)]
pub struct Injections {
    pub balls: Injection<Vec<BallCandidate>>,
    pub camera_matrix: Injection<Option<CameraMatrix>>,
    pub image: Injection<YuyvImage>,
    pub image_segments: Injection<ImageSegments>,
}

impl InjectionTable for Injections {
    fn get_mut(&mut self, output: &str) -> Option<&mut dyn InjectionCell> {
        match output {
            "balls" => Some(&mut self.balls),
            "camera_matrix" => Some(&mut self.camera_matrix),
            "image" => Some(&mut self.image),
            "image_segments" => Some(&mut self.image_segments),
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
