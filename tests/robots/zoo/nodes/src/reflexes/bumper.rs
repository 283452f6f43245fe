//! Waits for the bumper; knows no capture time.

use framework::{HardwareInterface, MainOutput, Result, context};
use serde::{Deserialize, Serialize};

use crate::interfaces::BumperInterface;

#[derive(Deserialize, Serialize)]
pub struct Bumper;

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    hardware_interface: HardwareInterface,
}

#[context]
pub struct MainOutputs {
    pressed: MainOutput<bool>,
}

impl Bumper {
    pub fn new(_: CreationContext) -> Result<Self> {
        Ok(Self)
    }

    pub fn cycle(&mut self, context: CycleContext<impl BumperInterface>) -> Result<MainOutputs> {
        Ok(MainOutputs {
            pressed: context.hardware_interface.read_bumper()?.into(),
        })
    }
}
