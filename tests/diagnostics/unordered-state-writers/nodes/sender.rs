use framework::{CyclerState, HardwareInterface, PreviousInput, Result, context};
use serde::{Deserialize, Serialize};

use crate::Motors;

#[derive(Deserialize, Serialize)]
pub struct Sender;

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    hardware: HardwareInterface,
    speed: PreviousInput<Option<f32>, "speed">,
    pace: CyclerState<f32, "pace">,
}

#[context]
pub struct MainOutputs {}

impl Sender {
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self)
    }

    pub fn cycle(&mut self, context: CycleContext<impl Motors>) -> Result<MainOutputs> {
        context.hardware.write(context.speed.unwrap_or_default())?;
        Ok(MainOutputs {})
    }
}
