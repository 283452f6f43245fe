//! Cycler `Vision` (perception), one instance.
//!
//! Written by `hulkgen generate` from hulk.toml and the nodes it names. Do not edit.

use framework::Guarded;
use framework::InNode;
use framework::OnFailure;
use framework::Result;
use timing_nodes::image_receiver;
use timing_nodes::interfaces::Camera;
use timing_nodes::interfaces::Effort;
use timing_nodes::position_detection;

use crate::databases::vision::Frame;

/// The nodes of one instance; they keep their state between cycles.
pub struct Nodes {
    pub image_receiver: Guarded<image_receiver::ImageReceiver>,
    pub position_detection: Guarded<position_detection::PositionDetection>,
}

impl Nodes {
    pub fn new() -> Result<Self> {
        Ok(Self {
            image_receiver: Guarded::new(
                "timing_nodes::image_receiver",
                OnFailure::Stop,
                Self::create_image_receiver()?,
            ),
            position_detection: Guarded::new(
                "timing_nodes::position_detection",
                OnFailure::Stop,
                Self::create_position_detection()?,
            ),
        })
    }

    /// Setup nodes: wait for the data this cycle is about.
    #[inline(always)]
    pub fn setup(&mut self, frame: &mut Frame<'_, impl Camera>) -> Result<()> {
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
    pub fn cycle(&mut self, frame: &mut Frame<'_, impl Effort>) -> Result<()> {
        self.position_detection(frame)?;
        Ok(())
    }

    /// As `cycle`, when it is timed or clients replace outputs.
    #[cold]
    #[inline(never)]
    pub fn cycle_closely(&mut self, frame: &mut Frame<'_, impl Effort>) -> Result<()> {
        self.cycle(frame)
    }

    /// hardware -> image
    #[inline(always)]
    fn image_receiver(&mut self, frame: &mut Frame<'_, impl Camera>) -> Result<()> {
        let context = image_receiver::CycleContext {
            hardware_interface: frame.hardware_interface,
        };
        let outputs = self
            .image_receiver
            .call(&frame.cycle, |node| node.cycle(context))?;
        frame.own.image = outputs.image.value;
        *frame.capture_time = Some(outputs.captured_at.0);
        Ok(())
    }

    /// image -> measurement, hardware
    #[inline(always)]
    fn position_detection(&mut self, frame: &mut Frame<'_, impl Effort>) -> Result<()> {
        let context = position_detection::CycleContext {
            hardware_interface: frame.hardware_interface,
            image: &frame.own.image,
            mark: &frame.parameters.position_detection.mark,
            effort: &frame.parameters.position_detection.effort,
        };
        let outputs = self
            .position_detection
            .call(&frame.cycle, |node| node.cycle(context))?;
        frame.shared.measurement = outputs.measurement.value;
        if let Some(injections) = frame.injections {
            injections.measurement.replace(&mut frame.shared.measurement);
        }
        Ok(())
    }

    fn create_image_receiver() -> Result<image_receiver::ImageReceiver> {
        let context = image_receiver::CreationContext {};
        image_receiver::ImageReceiver::new(context)
            .in_node("timing_nodes::image_receiver")
    }

    fn create_position_detection() -> Result<position_detection::PositionDetection> {
        let context = position_detection::CreationContext {};
        position_detection::PositionDetection::new(context)
            .in_node("timing_nodes::position_detection")
    }
}
