//! A setup node that may fail: then setup starts over.

use framework::{CaptureTime, HardwareInterface, MainOutput, Result, context};
use serde::{Deserialize, Serialize};

use crate::interfaces::EarInterface;

#[derive(Deserialize, Serialize)]
pub struct Ear;

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    hardware_interface: HardwareInterface,
}

#[context]
pub struct MainOutputs {
    loudness: MainOutput<f32>,
    heard_at: CaptureTime,
}

impl Ear {
    pub fn new(_: CreationContext) -> Result<Self> {
        Ok(Self)
    }

    pub fn cycle<Interface>(&mut self, context: CycleContext<Interface>) -> Result<MainOutputs>
    where
        Interface: EarInterface,
    {
        let (heard_at, loudness) = context.hardware_interface.read_sound()?;
        Ok(MainOutputs {
            loudness: loudness.into(),
            heard_at: heard_at.into(),
        })
    }
}
