use framework::{HardwareInterface, PerceptionInput, Result, context};
use serde::{Deserialize, Serialize};

use crate::Motors;

#[derive(Deserialize, Serialize)]
pub struct Follower;

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    hardware: HardwareInterface,
    distances: PerceptionInput<f32, "Vision", "distance">,
}

#[context]
pub struct MainOutputs {}

impl Follower {
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self)
    }

    pub fn cycle(&mut self, context: CycleContext<impl Motors>) -> Result<MainOutputs> {
        for (_, distance) in context.distances.persistent() {
            context.hardware.write(*distance)?;
        }
        Ok(MainOutputs {})
    }
}
