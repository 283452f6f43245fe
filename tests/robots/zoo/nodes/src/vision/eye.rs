//! Waits for an image: written in place, with the time at which it was taken.

use framework::{
    AdditionalOutput, CaptureTime, HardwareInterface, MainOutput, Parameter, Result, context,
};
use serde::{Deserialize, Serialize};

use crate::interfaces::EyeInterface;
use crate::types::{Camera, Image};

#[derive(Deserialize, Serialize)]
pub struct Eye {
    camera: Camera,
}

#[context]
pub struct CreationContext {
    camera: Parameter<Camera, "$cycler_instance.camera">,
}

#[context]
pub struct CycleContext {
    hardware: HardwareInterface,
    image: MainOutput<Image>,
    width: AdditionalOutput<usize, "$cycler_instance.width">,
}

#[context]
pub struct MainOutputs {
    taken_at: CaptureTime,
}

impl Eye {
    pub fn new(context: CreationContext) -> Result<Self> {
        Ok(Self {
            camera: *context.camera,
        })
    }

    pub fn cycle(&mut self, mut context: CycleContext<impl EyeInterface>) -> Result<MainOutputs> {
        let taken_at = context.hardware.read_image(self.camera, context.image)?;
        let width = context.image.width;
        context.width.fill_if_subscribed(|| width);
        Ok(MainOutputs {
            taken_at: taken_at.into(),
        })
    }
}
