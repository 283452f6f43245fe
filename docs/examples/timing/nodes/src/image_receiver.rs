//! Waits for the next image: this cycle is about it, however long looking at it takes.

use framework::{CaptureTime, HardwareInterface, MainOutput, Result, context};
use serde::{Deserialize, Serialize};

use crate::interfaces::Camera;

/// Keeps nothing between cycles.
#[derive(Debug, Deserialize, Serialize)]
pub struct ImageReceiver {}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    hardware_interface: HardwareInterface,
}

#[context]
pub struct MainOutputs {
    /// Metres to the mark that the image shows.
    image: MainOutput<f32>,
    captured_at: CaptureTime,
}

impl ImageReceiver {
    /// Nothing to prepare.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self {})
    }

    /// The cycle is about the moment of exposure.
    pub fn cycle(&mut self, context: CycleContext<impl Camera>) -> Result<MainOutputs> {
        let (captured_at, distance) = context.hardware_interface.read_image()?;
        Ok(MainOutputs {
            image: distance.into(),
            captured_at: captured_at.into(),
        })
    }
}
