//! Cycler `Vision` (perception), instances `VisionTop` and `VisionBottom`.
//!
//! Written by `hulkgen generate` from hulk.toml and the nodes it names. Do not edit.

use framework::AdditionalOutput;
use framework::Clear;
use framework::Guarded;
use framework::InNode;
use framework::OnFailure;
use framework::Result;
use hardware::CameraInterface;
use vision::ball_detection;
use vision::camera_matrix_extractor;
use vision::image_receiver;
use vision::image_segmenter;

use crate::databases::vision::Frame;

/// The nodes of one instance; they keep their state between cycles.
pub struct Nodes {
    pub image_receiver: Guarded<image_receiver::ImageReceiver>,
    pub camera_matrix_extractor: Guarded<camera_matrix_extractor::CameraMatrixExtractor>,
    pub image_segmenter: Guarded<image_segmenter::ImageSegmenter>,
    pub ball_detection: Guarded<ball_detection::BallDetection>,
}

impl Nodes {
    pub fn new() -> Result<Self> {
        Ok(Self {
            image_receiver: Guarded::new(
                "vision::image_receiver",
                OnFailure::Restart,
                Self::create_image_receiver()?,
            ),
            camera_matrix_extractor: Guarded::new(
                "vision::camera_matrix_extractor",
                OnFailure::Restart,
                Self::create_camera_matrix_extractor()?,
            ),
            image_segmenter: Guarded::new(
                "vision::image_segmenter",
                OnFailure::Restart,
                Self::create_image_segmenter()?,
            ),
            ball_detection: Guarded::new(
                "vision::ball_detection",
                OnFailure::Restart,
                Self::create_ball_detection()?,
            ),
        })
    }

    /// Setup nodes: wait for the data this cycle is about.
    pub fn setup(&mut self, frame: &mut Frame<'_, impl CameraInterface>) -> Result<()> {
        self.image_receiver(frame)?;
        Ok(())
    }

    /// Clients' values in place of what setup nodes wrote.
    pub fn inject<Hardware>(frame: &mut Frame<'_, Hardware>) {
        if let Some(injections) = frame.injections {
            injections.image.replace(&mut frame.own.image);
        }
    }

    /// Nodes: each call reads only what a call above it, or another cycler, wrote.
    pub fn cycle<Hardware>(&mut self, frame: &mut Frame<'_, Hardware>) -> Result<()> {
        self.camera_matrix_extractor(frame)?;
        self.image_segmenter(frame)?;
        self.ball_detection(frame)?;
        Ok(())
    }

    /// hardware -> image
    fn image_receiver(
        &mut self,
        frame: &mut Frame<'_, impl CameraInterface>,
    ) -> Result<()> {
        Clear::clear(&mut frame.own.image);
        let context = image_receiver::CycleContext {
            camera_position: &frame.instance_parameters.camera_position,
            hardware_interface: frame.hardware_interface,
            image: &mut frame.own.image,
        };
        let outputs = self.image_receiver.call(frame.cycle, |node| node.cycle(context))?;
        *frame.capture_time = Some(outputs.captured_at.0);
        Ok(())
    }

    /// latest Control.camera_matrices -> camera_matrix
    fn camera_matrix_extractor<Hardware>(
        &mut self,
        frame: &mut Frame<'_, Hardware>,
    ) -> Result<()> {
        let context = camera_matrix_extractor::CycleContext {
            camera_position: &frame.instance_parameters.camera_position,
            camera_matrices: frame
                .latest
                .control
                .latest(frame.cycle.time.start, |outputs| &outputs.camera_matrices),
            cycle_time: frame.cycle.time,
        };
        let outputs = self
            .camera_matrix_extractor
            .call(frame.cycle, |node| node.cycle(context))?;
        frame.own.camera_matrix = outputs.camera_matrix.value;
        if let Some(injections) = frame.injections {
            injections.camera_matrix.replace(&mut frame.own.camera_matrix);
        }
        Ok(())
    }

    /// image, camera_matrix -> image_segments
    fn image_segmenter<Hardware>(
        &mut self,
        frame: &mut Frame<'_, Hardware>,
    ) -> Result<()> {
        Clear::clear(&mut frame.own.image_segments);
        let context = image_segmenter::CycleContext {
            image: &frame.own.image,
            camera_matrix: frame.own.camera_matrix.as_ref(),
            field_color: &frame.parameters.field_color,
            steps: &frame.instance_parameters.scan_steps,
            image_segments: &mut frame.own.image_segments,
        };
        self.image_segmenter.call(frame.cycle, |node| node.cycle(context))?;
        if let Some(injections) = frame.injections {
            injections.image_segments.replace(&mut frame.own.image_segments);
        }
        Ok(())
    }

    /// image, image_segments, camera_matrix (required) -> balls; when subscribed:
    /// ball_candidates
    fn ball_detection<Hardware>(
        &mut self,
        frame: &mut Frame<'_, Hardware>,
    ) -> Result<()> {
        Clear::clear(&mut frame.shared.balls);
        if let Some(camera_matrix) = frame.own.camera_matrix.as_ref() {
            let context = ball_detection::CycleContext {
                image: &frame.own.image,
                image_segments: &frame.own.image_segments,
                camera_matrix,
                field_color: &frame.parameters.field_color,
                parameters: &frame.parameters.ball_detection,
                ball_radius: &frame.parameters.field_dimensions.ball_radius,
                ball_candidates: AdditionalOutput::new(
                    frame.subscribed.ball_candidates,
                    frame.cycle.number,
                    &mut frame.additional_outputs.ball_candidates,
                ),
                balls: &mut frame.shared.balls,
            };
            self.ball_detection.call(frame.cycle, |node| node.cycle(context))?;
        } else {
            // A required input is absent: the main outputs take their defaults.
            self.ball_detection.skip();
        }
        if let Some(injections) = frame.injections {
            injections.balls.replace(&mut frame.shared.balls);
        }
        Ok(())
    }

    fn create_image_receiver() -> Result<image_receiver::ImageReceiver> {
        let context = image_receiver::CreationContext {};
        image_receiver::ImageReceiver::new(context).in_node("vision::image_receiver")
    }

    fn create_camera_matrix_extractor() -> Result<
        camera_matrix_extractor::CameraMatrixExtractor,
    > {
        let context = camera_matrix_extractor::CreationContext {};
        camera_matrix_extractor::CameraMatrixExtractor::new(context)
            .in_node("vision::camera_matrix_extractor")
    }

    fn create_image_segmenter() -> Result<image_segmenter::ImageSegmenter> {
        let context = image_segmenter::CreationContext {};
        image_segmenter::ImageSegmenter::new(context).in_node("vision::image_segmenter")
    }

    fn create_ball_detection() -> Result<ball_detection::BallDetection> {
        let context = ball_detection::CreationContext {};
        ball_detection::BallDetection::new(context).in_node("vision::ball_detection")
    }
}
