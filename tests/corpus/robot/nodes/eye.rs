use framework::{CaptureTime, HardwareInterface, MainOutput, Parameter, Result, context};
use serde::{Deserialize, Serialize};

use crate::interfaces::EyeInterface;
use crate::types::Image;

#[derive(Deserialize, Serialize)]
pub struct Eye;

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    camera: Parameter<usize, "$cycler_instance.camera">,
    hardware_interface: HardwareInterface,
    image: MainOutput<Image>,
}

#[context]
pub struct MainOutputs {
    taken_at: CaptureTime,
}

impl Eye {
    pub fn new(_: CreationContext) -> Result<Self> {
        Ok(Self)
    }

    pub fn cycle(&mut self, context: CycleContext<impl EyeInterface>) -> Result<MainOutputs> {
        let (taken_at, pixels) = context.hardware_interface.read_image(*context.camera)?;
        context.image.pixels.extend(pixels);
        Ok(MainOutputs {
            taken_at: taken_at.into(),
        })
    }
}
