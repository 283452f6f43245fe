//! Asks two traits of the hardware, one of them for what is written only.

use framework::{CyclerState, HardwareInterface, Input, Result, context};
use serde::{Deserialize, Serialize};

use crate::interfaces::{LampInterface, LegInterface};

#[derive(Deserialize, Serialize)]
pub struct Lamp;

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    heading: Input<f32, "Control", "pose.heading">,
    beat: CyclerState<&u64, "beat">,
    hardware_interface: HardwareInterface,
}

#[context]
pub struct MainOutputs {}

impl Lamp {
    pub fn new(_: CreationContext) -> Result<Self> {
        Ok(Self)
    }

    pub fn cycle(
        &mut self,
        context: CycleContext<impl LampInterface + LegInterface>,
    ) -> Result<MainOutputs> {
        if context.beat.is_multiple_of(2) {
            context
                .hardware_interface
                .write_brightness(*context.heading);
        } else {
            context.hardware_interface.write_angles(&[])?;
        }
        Ok(MainOutputs {})
    }
}
