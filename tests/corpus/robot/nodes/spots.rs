use framework::{CyclerState, Input, MainOutput, Parameter, Result, context};
use serde::{Deserialize, Serialize};

use crate::types::{Image, Report, Spot};

#[derive(Deserialize, Serialize)]
pub struct Spots;

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    image: Input<Image, "image">,
    threshold: Parameter<u8, "spots.threshold">,
    limits: Parameter<[f64; 2], "spots.limits">,
    seen: CyclerState<u64, "seen">,
}

#[context]
pub struct MainOutputs {
    spots: MainOutput<Vec<Spot>>,
    best: MainOutput<Option<Spot>>,
    report: MainOutput<Report>,
}

impl Spots {
    pub fn new(_: CreationContext) -> Result<Self> {
        Ok(Self)
    }

    pub fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs> {
        *context.seen += u64::from(
            context
                .image
                .pixels
                .iter()
                .any(|pixel| pixel > context.threshold),
        );
        Ok(MainOutputs {
            spots: Vec::new().into(),
            best: None.into(),
            report: Report::default().into(),
        })
    }
}
