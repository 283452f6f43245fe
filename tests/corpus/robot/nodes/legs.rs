use framework::{
    CyclerState, HardwareInterface, Input, MainOutput, RequiredInput, Result, context,
};
use serde::{Deserialize, Serialize};

use crate::interfaces::BodyInterface;
use crate::types::Spot;

#[derive(Deserialize, Serialize)]
pub struct Legs;

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    plan: Input<Vec<f32>, "plan">,
    certain: RequiredInput<Option<bool>, "target?.certain">,
    target: Input<Option<Spot>, "target">,
    phase: CyclerState<&f32, "gait.phase">,
    hardware_interface: HardwareInterface,
}

#[context]
pub struct MainOutputs {}

impl Legs {
    pub fn new(_: CreationContext) -> Result<Self> {
        Ok(Self)
    }

    pub fn cycle(&mut self, context: CycleContext<impl BodyInterface>) -> Result<MainOutputs> {
        context
            .hardware_interface
            .write_joints(&[*context.phase; 3])?;
        Ok(MainOutputs {})
    }
}
