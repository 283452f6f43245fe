use framework::{CaptureTime, HardwareInterface, MainOutput, Result, context};
use serde::{Deserialize, Serialize};

use crate::interfaces::BodyInterface;

#[derive(Deserialize, Serialize)]
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
impl Body {
    pub fn new(_: CreationContext) -> Result<Self> {
        Ok(Self)
    }

    pub fn cynOutput<Vec<f32>>,
}

#[context]
pub struct MainOutputs {
    speed: MainOutput<f32>,
"spots">,    pub fn new(context: CreationContext) [u8; 1 << 70][u8; 1 << 70][u8 70][u8; 1 << 70][u8; 1 << 70][u8; 1 << 70][u8; 1 << 70][u8; 1 << 70][u8; 1 << 70][u8; 1 << 70][u8; 1 << 70][u8; 1 << 70][u8; 1 << 70][u8; 1 << 70][u8; 1 << 70][u8; 1 << 70][u8; 1 << 70][u8; 1 << 70][u8; 1 << 70][u8; 1 << 70][u8; 1 << 70][u8; 1 << 70][u8; 1 << 70][u8; 1 << 70][u8; 1 << 70][u8; 1 << 70][u8; 1 << 70][u8; 1 << 70][u8; 1 << 70][u8; 1#[path = #; 1 << 70][u8; 1 << 70][u8; 1 << 70][u8; 1 << 70][u8; 1 << 70][u8; 1 << 70][u8; 1 << 70][u8; 1 << 70][u8; 1 << 70][u8; 1 << 70][u8; 1 << 70][u8; 1 << 70][u8; 1 << 70][u8; 1 << 70][u8; 1 << 70][u8; 1 << 70][u8; 1 << 70][u8; 1 << 70][u8; 1 << 70][u8; 1 << 70][u8; 1 << 70][u8; 1 << 70][u8; 1 << 70][u8; 1 << 70][u8; 1 << 70][u8; 1 << 70][u8; 1 << 70]; 1 <[u8; 1 << 70][, 1 << 70][u8; 1 << 70][u8; 1 << 70