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
use vision::center_circle_detection;
use vision::corner_detection;
use vision::field_border;
use vision::field_color_detection;
use vision::image_receiver;
use vision::image_segmenter;
use vision::limb_projector;
use vision::line_detection;
use vision::obstacle_detection;
use vision::penalty_mark_detection;

use crate::databases::vision::Frame;

/// The nodes of one instance; they keep their state between cycles.
pub struct Nodes {
    pub ball_detection: Guarded<ball_detection::BallDetection>,
    pub camera_matrix_extractor: Guarded<camera_matrix_extractor::CameraMatrixExtractor>,
    pub center_circle_detection: Guarded<center_circle_detection::CenterCircleDetection>,
    pub corner_detection: Guarded<corner_detection::CornerDetection>,
    pub field_border: Guarded<field_border::FieldBorderDetection>,
    pub field_color_detection: Guarded<field_color_detection::FieldColorDetection>,
    pub image_receiver: Guarded<image_receiver::ImageReceiver>,
    pub image_segmenter: Guarded<image_segmenter::ImageSegmenter>,
    pub limb_projector: Guarded<limb_projector::LimbProjector>,
    pub line_detection: Guarded<line_detection::LineDetection>,
    pub obstacle_detection: Guarded<obstacle_detection::ObstacleDetection>,
    pub penalty_mark_detection: Guarded<penalty_mark_detection::PenaltyMarkDetection>,
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
            limb_projector: Guarded::new(
                "vision::limb_projector",
                OnFailure::Restart,
                Self::create_limb_projector()?,
            ),
            field_color_detection: Guarded::new(
                "vision::field_color_detection",
                OnFailure::Restart,
                Self::create_field_color_detection()?,
            ),
            image_segmenter: Guarded::new(
                "vision::image_segmenter",
                OnFailure::Restart,
                Self::create_image_segmenter()?,
            ),
            field_border: Guarded::new(
                "vision::field_border",
                OnFailure::Restart,
                Self::create_field_border()?,
            ),
            line_detection: Guarded::new(
                "vision::line_detection",
                OnFailure::Restart,
                Self::create_line_detection()?,
            ),
            center_circle_detection: Guarded::new(
                "vision::center_circle_detection",
                OnFailure::Restart,
                Self::create_center_circle_detection()?,
            ),
            corner_detection: Guarded::new(
                "vision::corner_detection",
                OnFailure::Restart,
                Self::create_corner_detection()?,
            ),
            penalty_mark_detection: Guarded::new(
                "vision::penalty_mark_detection",
                OnFailure::Restart,
                Self::create_penalty_mark_detection()?,
            ),
            ball_detection: Guarded::new(
                "vision::ball_detection",
                OnFailure::Restart,
                Self::create_ball_detection()?,
            ),
            obstacle_detection: Guarded::new(
                "vision::obstacle_detection",
                OnFailure::Restart,
                Self::create_obstacle_detection()?,
            ),
        })
    }

    /// Setup nodes: wait for the data this cycle is about.
    #[inline(always)]
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
    #[inline(always)]
    pub fn cycle<Hardware>(&mut self, frame: &mut Frame<'_, Hardware>) -> Result<()> {
        self.camera_matrix_extractor(frame)?;
        self.limb_projector(frame)?;
        self.field_color_detection(frame)?;
        self.image_segmenter(frame)?;
        self.field_border(frame)?;
        self.line_detection(frame)?;
        self.center_circle_detection(frame)?;
        self.corner_detection(frame)?;
        self.penalty_mark_detection(frame)?;
        self.ball_detection(frame)?;
        self.obstacle_detection(frame)?;
        Ok(())
    }

    /// As `cycle`, when it is timed or clients replace outputs.
    #[cold]
    #[inline(never)]
    pub fn cycle_closely<Hardware>(
        &mut self,
        frame: &mut Frame<'_, Hardware>,
    ) -> Result<()> {
        self.cycle(frame)
    }

    /// image (required), image_segments, field_border, lines, penalty_mark, camera_matrix
    /// (required), field_color -> balls, ball_view; when subscribed: ball_candidates,
    /// ball_proposals
    #[inline(always)]
    fn ball_detection<Hardware>(
        &mut self,
        frame: &mut Frame<'_, Hardware>,
    ) -> Result<()> {
        Clear::clear(&mut frame.shared.balls);
        if let Some(image) = frame.own.image.as_ref()
            && let Some(camera_matrix) = frame.own.camera_matrix.as_ref()
        {
            let context = ball_detection::CycleContext {
                image,
                image_segments: &frame.own.image_segments,
                field_border: &frame.shared.field_border,
                lines: &frame.shared.lines,
                penalty_mark: frame.shared.penalty_mark.as_ref(),
                camera_matrix,
                field_color: &frame.own.field_color,
                parameters: &frame.parameters.ball_detection,
                ball_radius: &frame.parameters.field_dimensions.ball_radius,
                line_width: &frame.parameters.field_dimensions.line_width,
                projection_noise: &frame.parameters.projection_noise,
                ball_candidates: AdditionalOutput::new(
                    frame.subscribed.ball_candidates,
                    frame.cycle.number,
                    &mut frame.additional_outputs.ball_candidates,
                ),
                ball_proposals: AdditionalOutput::new(
                    frame.subscribed.ball_proposals,
                    frame.cycle.number,
                    &mut frame.additional_outputs.ball_proposals,
                ),
                balls: &mut frame.shared.balls,
            };
            let outputs = self
                .ball_detection
                .call(&frame.cycle, |node| node.cycle(context))?;
            frame.shared.ball_view = outputs.ball_view.value;
        } else {
            // A required input is absent: the main outputs take their defaults.
            self.ball_detection.skip();
            frame.shared.ball_view = Default::default();
        }
        if let Some(injections) = frame.injections {
            injections.balls.replace(&mut frame.shared.balls);
            injections.ball_view.replace(&mut frame.shared.ball_view);
        }
        Ok(())
    }

    /// latest Control.camera_matrices -> camera_matrix
    #[inline(always)]
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
            parameters: &frame.parameters.camera_matrix_extractor,
        };
        let outputs = self
            .camera_matrix_extractor
            .call(&frame.cycle, |node| node.cycle(context))?;
        frame.own.camera_matrix = outputs.camera_matrix.value;
        if let Some(injections) = frame.injections {
            injections.camera_matrix.replace(&mut frame.own.camera_matrix);
        }
        Ok(())
    }

    /// lines, camera_matrix (required) -> center_circle; when subscribed: image_circle
    #[inline(always)]
    fn center_circle_detection<Hardware>(
        &mut self,
        frame: &mut Frame<'_, Hardware>,
    ) -> Result<()> {
        if let Some(camera_matrix) = frame.own.camera_matrix.as_ref() {
            let context = center_circle_detection::CycleContext {
                lines: &frame.shared.lines,
                camera_matrix,
                radius: &frame.parameters.field_dimensions.markings.circle_radius,
                parameters: &frame.instance_parameters.center_circle_detection,
                image_circle: AdditionalOutput::new(
                    frame.subscribed.image_circle,
                    frame.cycle.number,
                    &mut frame.additional_outputs.image_circle,
                ),
            };
            let outputs = self
                .center_circle_detection
                .call(&frame.cycle, |node| node.cycle(context))?;
            frame.shared.center_circle = outputs.center_circle.value;
        } else {
            // A required input is absent: the main outputs take their defaults.
            self.center_circle_detection.skip();
            frame.shared.center_circle = Default::default();
        }
        if let Some(injections) = frame.injections {
            injections.center_circle.replace(&mut frame.shared.center_circle);
        }
        Ok(())
    }

    /// image (required), lines, center_circle, limb_mask, camera_matrix (required) -> corners
    #[inline(always)]
    fn corner_detection<Hardware>(
        &mut self,
        frame: &mut Frame<'_, Hardware>,
    ) -> Result<()> {
        Clear::clear(&mut frame.shared.corners);
        if let Some(image) = frame.own.image.as_ref()
            && let Some(camera_matrix) = frame.own.camera_matrix.as_ref()
        {
            let context = corner_detection::CycleContext {
                image,
                lines: &frame.shared.lines,
                center_circle: frame.shared.center_circle.as_ref(),
                limb_mask: &frame.shared.limb_mask,
                camera_matrix,
                radius: &frame.parameters.field_dimensions.markings.circle_radius,
                parameters: &frame.parameters.corner_detection,
                projection_noise: &frame.parameters.projection_noise,
                corners: &mut frame.shared.corners,
            };
            self.corner_detection.call(&frame.cycle, |node| node.cycle(context))?;
        } else {
            // A required input is absent: the main outputs take their defaults.
            self.corner_detection.skip();
        }
        if let Some(injections) = frame.injections {
            injections.corners.replace(&mut frame.shared.corners);
        }
        Ok(())
    }

    /// image_segments, camera_matrix -> field_border; when subscribed: field_border_points
    #[inline(always)]
    fn field_border<Hardware>(&mut self, frame: &mut Frame<'_, Hardware>) -> Result<()> {
        Clear::clear(&mut frame.shared.field_border);
        let context = field_border::CycleContext {
            image_segments: &frame.own.image_segments,
            camera_matrix: frame.own.camera_matrix.as_ref(),
            parameters: &frame.instance_parameters.field_border,
            field_border_points: AdditionalOutput::new(
                frame.subscribed.field_border_points,
                frame.cycle.number,
                &mut frame.additional_outputs.field_border_points,
            ),
            field_border: &mut frame.shared.field_border,
        };
        self.field_border.call(&frame.cycle, |node| node.cycle(context))?;
        if let Some(injections) = frame.injections {
            injections.field_border.replace(&mut frame.shared.field_border);
        }
        Ok(())
    }

    /// image (required), camera_matrix, limb_mask -> field_color
    #[inline(always)]
    fn field_color_detection<Hardware>(
        &mut self,
        frame: &mut Frame<'_, Hardware>,
    ) -> Result<()> {
        if let Some(image) = frame.own.image.as_ref() {
            let context = field_color_detection::CycleContext {
                image,
                camera_matrix: frame.own.camera_matrix.as_ref(),
                limb_mask: &frame.shared.limb_mask,
                initial: &frame.parameters.field_color,
                parameters: &frame.parameters.field_color_detection,
            };
            let outputs = self
                .field_color_detection
                .call(&frame.cycle, |node| node.cycle(context))?;
            frame.own.field_color = outputs.field_color.value;
        } else {
            // A required input is absent: the main outputs take their defaults.
            self.field_color_detection.skip();
            frame.own.field_color = Default::default();
        }
        if let Some(injections) = frame.injections {
            injections.field_color.replace(&mut frame.own.field_color);
        }
        Ok(())
    }

    /// hardware -> image
    #[inline(always)]
    fn image_receiver(
        &mut self,
        frame: &mut Frame<'_, impl CameraInterface>,
    ) -> Result<()> {
        let context = image_receiver::CycleContext {
            camera_position: &frame.instance_parameters.camera_position,
            hardware_interface: frame.hardware_interface,
        };
        let outputs = self
            .image_receiver
            .call(&frame.cycle, |node| node.cycle(context))?;
        frame.own.image = outputs.image.value;
        *frame.capture_time = Some(outputs.captured_at.0);
        Ok(())
    }

    /// image (required), camera_matrix, limb_mask, field_color -> image_segments
    #[inline(always)]
    fn image_segmenter<Hardware>(
        &mut self,
        frame: &mut Frame<'_, Hardware>,
    ) -> Result<()> {
        Clear::clear(&mut frame.own.image_segments);
        if let Some(image) = frame.own.image.as_ref() {
            let context = image_segmenter::CycleContext {
                image,
                camera_matrix: frame.own.camera_matrix.as_ref(),
                limb_mask: &frame.shared.limb_mask,
                field_color: &frame.own.field_color,
                steps: &frame.instance_parameters.scan_steps,
                image_segments: &mut frame.own.image_segments,
            };
            self.image_segmenter.call(&frame.cycle, |node| node.cycle(context))?;
        } else {
            // A required input is absent: the main outputs take their defaults.
            self.image_segmenter.skip();
        }
        if let Some(injections) = frame.injections {
            injections.image_segments.replace(&mut frame.own.image_segments);
        }
        Ok(())
    }

    /// image (required), latest Control.robot_kinematics -> limb_mask
    #[inline(always)]
    fn limb_projector<Hardware>(
        &mut self,
        frame: &mut Frame<'_, Hardware>,
    ) -> Result<()> {
        Clear::clear(&mut frame.shared.limb_mask);
        if let Some(image) = frame.own.image.as_ref() {
            let context = limb_projector::CycleContext {
                image,
                robot_kinematics: frame
                    .latest
                    .control
                    .latest(frame.cycle.time.start, |outputs| &outputs.robot_kinematics),
                camera_position: &frame.instance_parameters.camera_position,
                top: &frame.parameters.cameras.top,
                bottom: &frame.parameters.cameras.bottom,
                parameters: &frame.parameters.limb_projector,
                limb_mask: &mut frame.shared.limb_mask,
            };
            self.limb_projector.call(&frame.cycle, |node| node.cycle(context))?;
        } else {
            // A required input is absent: the main outputs take their defaults.
            self.limb_projector.skip();
        }
        if let Some(injections) = frame.injections {
            injections.limb_mask.replace(&mut frame.shared.limb_mask);
        }
        Ok(())
    }

    /// image (required), image_segments, limb_mask, field_border, camera_matrix (required),
    /// field_color -> lines; when subscribed: line_points, image_lines
    #[inline(always)]
    fn line_detection<Hardware>(
        &mut self,
        frame: &mut Frame<'_, Hardware>,
    ) -> Result<()> {
        Clear::clear(&mut frame.shared.lines);
        if let Some(image) = frame.own.image.as_ref()
            && let Some(camera_matrix) = frame.own.camera_matrix.as_ref()
        {
            let context = line_detection::CycleContext {
                image,
                image_segments: &frame.own.image_segments,
                limb_mask: &frame.shared.limb_mask,
                field_border: &frame.shared.field_border,
                camera_matrix,
                field_color: &frame.own.field_color,
                line_width: &frame.parameters.field_dimensions.line_width,
                parameters: &frame.instance_parameters.line_detection,
                projection_noise: &frame.parameters.projection_noise,
                line_points: AdditionalOutput::new(
                    frame.subscribed.line_points,
                    frame.cycle.number,
                    &mut frame.additional_outputs.line_points,
                ),
                image_lines: AdditionalOutput::new(
                    frame.subscribed.image_lines,
                    frame.cycle.number,
                    &mut frame.additional_outputs.image_lines,
                ),
                lines: &mut frame.shared.lines,
            };
            self.line_detection.call(&frame.cycle, |node| node.cycle(context))?;
        } else {
            // A required input is absent: the main outputs take their defaults.
            self.line_detection.skip();
        }
        if let Some(injections) = frame.injections {
            injections.lines.replace(&mut frame.shared.lines);
        }
        Ok(())
    }

    /// image_segments, field_border, lines, camera_matrix (required) -> obstacles; when
    /// subscribed: obstacle_feet
    #[inline(always)]
    fn obstacle_detection<Hardware>(
        &mut self,
        frame: &mut Frame<'_, Hardware>,
    ) -> Result<()> {
        Clear::clear(&mut frame.shared.obstacles);
        if let Some(camera_matrix) = frame.own.camera_matrix.as_ref() {
            let context = obstacle_detection::CycleContext {
                image_segments: &frame.own.image_segments,
                field_border: &frame.shared.field_border,
                lines: &frame.shared.lines,
                camera_matrix,
                line_width: &frame.parameters.field_dimensions.line_width,
                ball_radius: &frame.parameters.field_dimensions.ball_radius,
                parameters: &frame.parameters.obstacle_detection,
                projection_noise: &frame.parameters.projection_noise,
                obstacle_feet: AdditionalOutput::new(
                    frame.subscribed.obstacle_feet,
                    frame.cycle.number,
                    &mut frame.additional_outputs.obstacle_feet,
                ),
                obstacles: &mut frame.shared.obstacles,
            };
            self.obstacle_detection.call(&frame.cycle, |node| node.cycle(context))?;
        } else {
            // A required input is absent: the main outputs take their defaults.
            self.obstacle_detection.skip();
        }
        if let Some(injections) = frame.injections {
            injections.obstacles.replace(&mut frame.shared.obstacles);
        }
        Ok(())
    }

    /// image (required), image_segments, field_border, lines, camera_matrix (required),
    /// field_color -> penalty_mark; when subscribed: penalty_mark_candidates
    #[inline(always)]
    fn penalty_mark_detection<Hardware>(
        &mut self,
        frame: &mut Frame<'_, Hardware>,
    ) -> Result<()> {
        if let Some(image) = frame.own.image.as_ref()
            && let Some(camera_matrix) = frame.own.camera_matrix.as_ref()
        {
            let context = penalty_mark_detection::CycleContext {
                image,
                image_segments: &frame.own.image_segments,
                field_border: &frame.shared.field_border,
                lines: &frame.shared.lines,
                camera_matrix,
                field_color: &frame.own.field_color,
                line_width: &frame.parameters.field_dimensions.line_width,
                mark_size: &frame.parameters.field_dimensions.penalty_mark_size,
                parameters: &frame.parameters.penalty_mark_detection,
                projection_noise: &frame.parameters.projection_noise,
                penalty_mark_candidates: AdditionalOutput::new(
                    frame.subscribed.penalty_mark_candidates,
                    frame.cycle.number,
                    &mut frame.additional_outputs.penalty_mark_candidates,
                ),
            };
            let outputs = self
                .penalty_mark_detection
                .call(&frame.cycle, |node| node.cycle(context))?;
            frame.shared.penalty_mark = outputs.penalty_mark.value;
        } else {
            // A required input is absent: the main outputs take their defaults.
            self.penalty_mark_detection.skip();
            frame.shared.penalty_mark = Default::default();
        }
        if let Some(injections) = frame.injections {
            injections.penalty_mark.replace(&mut frame.shared.penalty_mark);
        }
        Ok(())
    }

    fn create_ball_detection() -> Result<ball_detection::BallDetection> {
        let context = ball_detection::CreationContext {};
        ball_detection::BallDetection::new(context).in_node("vision::ball_detection")
    }

    fn create_camera_matrix_extractor() -> Result<
        camera_matrix_extractor::CameraMatrixExtractor,
    > {
        let context = camera_matrix_extractor::CreationContext {};
        camera_matrix_extractor::CameraMatrixExtractor::new(context)
            .in_node("vision::camera_matrix_extractor")
    }

    fn create_center_circle_detection() -> Result<
        center_circle_detection::CenterCircleDetection,
    > {
        let context = center_circle_detection::CreationContext {};
        center_circle_detection::CenterCircleDetection::new(context)
            .in_node("vision::center_circle_detection")
    }

    fn create_corner_detection() -> Result<corner_detection::CornerDetection> {
        let context = corner_detection::CreationContext {};
        corner_detection::CornerDetection::new(context)
            .in_node("vision::corner_detection")
    }

    fn create_field_border() -> Result<field_border::FieldBorderDetection> {
        let context = field_border::CreationContext {};
        field_border::FieldBorderDetection::new(context).in_node("vision::field_border")
    }

    fn create_field_color_detection() -> Result<
        field_color_detection::FieldColorDetection,
    > {
        let context = field_color_detection::CreationContext {};
        field_color_detection::FieldColorDetection::new(context)
            .in_node("vision::field_color_detection")
    }

    fn create_image_receiver() -> Result<image_receiver::ImageReceiver> {
        let context = image_receiver::CreationContext {};
        image_receiver::ImageReceiver::new(context).in_node("vision::image_receiver")
    }

    fn create_image_segmenter() -> Result<image_segmenter::ImageSegmenter> {
        let context = image_segmenter::CreationContext {};
        image_segmenter::ImageSegmenter::new(context).in_node("vision::image_segmenter")
    }

    fn create_limb_projector() -> Result<limb_projector::LimbProjector> {
        let context = limb_projector::CreationContext {};
        limb_projector::LimbProjector::new(context).in_node("vision::limb_projector")
    }

    fn create_line_detection() -> Result<line_detection::LineDetection> {
        let context = line_detection::CreationContext {};
        line_detection::LineDetection::new(context).in_node("vision::line_detection")
    }

    fn create_obstacle_detection() -> Result<obstacle_detection::ObstacleDetection> {
        let context = obstacle_detection::CreationContext {};
        obstacle_detection::ObstacleDetection::new(context)
            .in_node("vision::obstacle_detection")
    }

    fn create_penalty_mark_detection() -> Result<
        penalty_mark_detection::PenaltyMarkDetection,
    > {
        let context = penalty_mark_detection::CreationContext {};
        penalty_mark_detection::PenaltyMarkDetection::new(context)
            .in_node("vision::penalty_mark_detection")
    }
}
