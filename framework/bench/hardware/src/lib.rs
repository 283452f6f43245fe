//! The platform of the robots that are measured: there is none, whoever measures says when a cycle begins.

use framework::{HardwareContext, Result, Stop};

/// Nothing to wait for and nothing to move.
pub struct Hardware {
    stop: Stop,
}

impl framework::Hardware for Hardware {
    fn new(context: HardwareContext) -> Result<Self> {
        Ok(Self { stop: context.stop })
    }

    fn stop(&self) {
        self.stop.request();
    }

    fn enter_safe_state(&self) {}

    fn is_simulated(&self) -> bool {
        true
    }
}
