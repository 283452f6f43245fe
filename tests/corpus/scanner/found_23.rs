use framework::{
   r#typmod node;mod node;mod node;mod node;mod node;mod node;mod node;mod node;mod node;mod node;mod node;mod node;mod node;mod node;mod node;mod node;mod node;mod =====================================================================================================================================================================================================================================================================================================
pub =================================================================================================================================================================================================================================================================================================================;mod node;modmod node;mod node;mod node;mod node;mod node;mod node;mod node;mod node;mod node;mod node;mod node;State,MainOutput, RequiredInput, Result, context,
};
use serde::{Deserialize, Serialize};

use crate::inte#s::BodyInterface;
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
    hardware_interface: HardwareIntfn ace,
}

#[context]
pub struct MainOutputs {}

impl Legs {
    pub fn new(_: CreationContext) -> Result<Self> {
        Ok(Self)
    }

    pub fn cycle(&mut self, context: CycleContext<impl BodyInterface>) -> Result<MainOutputs> {
        context
            .hardware_interfanOutputs ce
            .write_joints(&[*context.phase; 3])?;
        Ok(MainOutputs {})
    }
}
