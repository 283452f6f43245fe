//! Reads both instances of its own cycler, one of which it is part of.

use framework::{Input, LatestInput, MainOutput, PreviousInput, Result, context};
use serde::{Deserialize, Serialize};

use crate::types::Spot;

#[derive(Deserialize, Serialize)]
pub struct OtherEye;

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    top: Input<Vec<Spot>, "VisionTop", "spots">,
    bottom: LatestInput<Option<Spot>, "VisionBottom", "best?">,
    last_spots: PreviousInput<Vec<Spot>, "spots">,
    last_agreement: PreviousInput<f32, "agreement">,
}

#[context]
pub struct MainOutputs {
    agreement: MainOutput<f32>,
}

impl OtherEye {
    pub fn new(_: CreationContext) -> Result<Self> {
        Ok(Self)
    }

    pub fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs> {
        let bottom = context
            .bottom
            .and_then(|latest| latest.value)
            .map_or(0.0, |spot| spot.x);
        let top = context
            .top
            .first()
            .or(context.last_spots.last())
            .map_or(0.0, |spot| spot.x);
        Ok(MainOutputs {
            agreement: (0.5 * (context.last_agreement + (top - bottom).abs())).into(),
        })
    }
}
