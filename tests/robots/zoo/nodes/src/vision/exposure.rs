//! A second setup node: reads the one before it, keeps a state, and has a parameter that is a value for each instance.

use framework::{CyclerState, Input, MainOutput, Parameter, Result, context};
use serde::{Deserialize, Serialize};

use crate::types::Image;

#[derive(Deserialize, Serialize)]
pub struct Exposure;

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    image: Input<Image, "image">,
    wanted: Parameter<f32, "exposure.$cycler_instance">,
    smoothed: CyclerState<f32, "exposure">,
}

#[context]
pub struct MainOutputs {
    exposure: MainOutput<f32>,
}

impl Exposure {
    pub fn new(_: CreationContext) -> Result<Self> {
        Ok(Self)
    }

    pub fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs> {
        let brightest = context.image.data.iter().max().copied().unwrap_or_default();
        let wanted = context.wanted * f32::from(brightest);
        *context.smoothed += 0.5 * (wanted - *context.smoothed);
        Ok(MainOutputs {
            exposure: (*context.smoothed).into(),
        })
    }
}
