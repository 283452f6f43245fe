use framework::{HardwareInterface, LatestInput, Result, context};
use serde::{Deserialize, Serialize};

use crate::Motors;

#[derive(Deserialize, Serialize)]
pub struct Sender;

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    hardware: HardwareInterface,
    speed: LatestInput<Option<f32>, "Planning", "speed">,
}

#[context]
pub struct MainOutputs {}

impl Sender {
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self)
    }

    pub fn cycle(&mut self, context: CycleContext<impl Motors>) -> Result<MainOutputs> {
        let speed = context.speed.and_then(|latest| *latest.value);
        context.hardware.write(speed.unwrap_or_default())?;
        Ok(MainOutputs {})
    }
}
