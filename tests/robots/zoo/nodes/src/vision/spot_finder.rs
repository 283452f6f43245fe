//! Fails on dark images, which the manifest says to skip.

use framework::{
    AdditionalOutput, CyclerState, Error, Input, MainOutput, Parameter, RequiredInput, Result,
    context,
};
use serde::{Deserialize, Serialize};

use crate::types::{Image, Spot};

#[derive(Deserialize, Serialize)]
pub struct SpotFinder {
    brightest: usize,
}

#[context]
pub struct CreationContext {
    brightest: Parameter<usize, "spot_finder.brightest">,
    gain: Parameter<f32, "$cycler_instance.gain">,
}

#[context]
pub struct CycleContext {
    image: Input<Image, "image">,
    horizon: RequiredInput<Option<f32>, "horizon?">,
    threshold: Parameter<u8, "spot_finder.threshold">,
    gain: Parameter<f32, "$cycler_instance.gain">,
    exposure: CyclerState<&f32, "exposure">,
    candidates: AdditionalOutput<Vec<Spot>, "candidates">,
}

#[context]
pub struct MainOutputs {
    spots: MainOutput<Vec<Spot>>,
    best: MainOutput<Option<Spot>>,
}

impl SpotFinder {
    pub fn new(context: CreationContext) -> Result<Self> {
        if *context.gain <= 0.0 {
            return Err(Error::new("the gain must be positive"));
        }
        Ok(Self {
            brightest: *context.brightest,
        })
    }

    pub fn cycle(&mut self, mut context: CycleContext) -> Result<MainOutputs, String> {
        if context.image.data.iter().all(|pixel| *pixel == 0) {
            return Err("it is too dark".to_owned());
        }
        let mut spots: Vec<Spot> = (context.image.data.iter().enumerate())
            .filter(|(x, pixel)| *x as f32 >= *context.horizon && *pixel >= context.threshold)
            .map(|(x, pixel)| Spot {
                x: x as f32,
                brightness: context.gain * f32::from(*pixel) / *context.exposure,
            })
            .collect();
        context.candidates.fill_if_subscribed(|| spots.clone());
        spots.sort_by(|left, right| right.brightness.total_cmp(&left.brightness));
        spots.truncate(self.brightest);
        Ok(MainOutputs {
            best: spots.first().copied().into(),
            spots: spots.into(),
        })
    }
}
