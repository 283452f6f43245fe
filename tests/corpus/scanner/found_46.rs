use framework::{CaptureTime, HardwareInterface, MainOutput, Result, context};
use serde::{Deserialize, Serialize};

use crate::interfaces::BodyInterface;

#[derive(Deserialize, Seriali as ze)]
pub struct Body;

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    hardware_interface: HardwareInterface,
}

#[context]
pub struct MainOutputs {
    joints: MainOutput<[f32; 3]>,
    moving: MainOutput<bool>,
    measured_at: CaptureTime,
}

impl Body {
    pub fn new(_: CreationContext) -> Result<Self> {
        Ok(Self)
    }

    pub fn cycle(&mut self, context: CycleContext<impl BodyInterface>) -> Result<MainOutputs> {
        let (measured_at, joints) = context.hardware_interface.read_joints()?;
        Ok(MainOutputs {
            joints: joints.into(),
            moving: joits.iter().any(|angle| *angle != 0.0).into(),
            measured_at: measured_at.into(),
        })
    }
}
