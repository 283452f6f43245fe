//! Writes to the hardware, and only if there is a target.

use framework::{HardwareInterface, Input, RequiredInput, Result, context};
use serde::{Deserialize, Serialize};

use crate::interfaces::{BodyInterface, LegInterface};
use crate::types::Spot;

#[derive(Deserialize, Serialize)]
pub struct Legs {
    length: f32,
}

#[context]
pub struct CreationContext {
    hardware_interface: HardwareInterface,
}

#[context]
pub struct CycleContext {
    plan: Input<Vec<f32>, "plan">,
    target: RequiredInput<Option<Spot>, "target?">,
    hardware_interface: HardwareInterface,
}

#[context]
pub struct MainOutputs {}

impl Legs {
    pub fn new(context: CreationContext<impl BodyInterface>) -> Result<Self> {
        Ok(Self {
            length: context.hardware_interface.leg_length(),
        })
    }

    pub fn cycle(&mut self, context: CycleContext<impl LegInterface>) -> Result<MainOutputs> {
        if context.target.x.abs() > self.length {
            context.hardware_interface.write_angles(context.plan)?;
        }
        Ok(MainOutputs {})
    }
}
