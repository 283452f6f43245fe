//! Finds out from an image where the robot was when it was exposed, slowly.

use framework::{HardwareInterface, Input, MainOutput, Parameter, Result, context};
use serde::{Deserialize, Serialize};

use crate::interfaces::Effort;
use crate::types::Measurement;

/// Keeps nothing between cycles.
#[derive(Debug, Deserialize, Serialize)]
pub struct PositionDetection {}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    hardware_interface: HardwareInterface,
    image: Input<f32, "image">,

    /// Metres from the start, where the mark is.
    mark: Parameter<f32, "position_detection.mark">,
    /// Seconds that looking at an image takes.
    effort: Parameter<f32, "position_detection.effort">,
}

#[context]
pub struct MainOutputs {
    measurement: MainOutput<Measurement>,
}

impl PositionDetection {
    /// Nothing to prepare.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self {})
    }

    /// When it is done, the robot is somewhere else.
    pub fn cycle(&mut self, context: CycleContext<impl Effort>) -> Result<MainOutputs> {
        context.hardware_interface.take(*context.effort)?;
        Ok(MainOutputs {
            measurement: Measurement::Seen(context.mark - context.image).into(),
        })
    }
}
