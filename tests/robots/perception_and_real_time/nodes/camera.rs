use framework::{CaptureTime, MainOutput, Timestamp, context, Result};
use serde::{Deserialize, Serialize};

#[derive(Deserialize, Serialize)]
pub struct Camera;

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {}

#[context]
pub struct MainOutputs {
    brightness: MainOutput<u8>,
    captured_at: CaptureTime,
}

impl Camera {
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self)
    }

    pub fn cycle(&mut self, _context: CycleContext) -> Result<MainOutputs> {
        Ok(MainOutputs { brightness: 1.into(), captured_at: Timestamp::ZERO.into() })
    }
}
