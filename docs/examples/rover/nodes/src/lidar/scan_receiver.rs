//! Waits for the next turn of the lidar: this cycle is about it.

use framework::{CaptureTime, HardwareInterface, MainOutput, Result, context};
use serde::{Deserialize, Serialize};

use crate::interfaces::Lidar;
use crate::types::Scan;

/// Keeps nothing between cycles.
#[derive(Debug, Deserialize, Serialize)]
pub struct ScanReceiver {}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    hardware_interface: HardwareInterface,
    /// Written in place: its memory is used again and again.
    scan: MainOutput<Scan>,
}

#[context]
pub struct MainOutputs {
    captured_at: CaptureTime,
}

impl ScanReceiver {
    /// Nothing to prepare.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self {})
    }

    /// Blocks until the turn is complete.
    pub fn cycle(&mut self, context: CycleContext<impl Lidar>) -> Result<MainOutputs> {
        let captured_at = context.hardware_interface.read_scan(context.scan)?;
        Ok(MainOutputs {
            captured_at: captured_at.into(),
        })
    }
}
