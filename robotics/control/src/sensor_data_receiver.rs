//! Waits for the next sample of the body's sensors: this cycle is about it.

use framework::{CaptureTime, HardwareInterface, MainOutput, Result, context};
use hardware::SensorInterface;
use serde::{Deserialize, Serialize};
use types::sensor_data::SensorData;

/// Keeps nothing between cycles.
#[derive(Debug, Deserialize, Serialize)]
pub struct SensorDataReceiver {}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    hardware_interface: HardwareInterface,
}

#[context]
pub struct MainOutputs {
    /// Everything the body reported.
    sensor_data: MainOutput<SensorData>,
    /// When it arrived.
    captured_at: CaptureTime,
}

impl SensorDataReceiver {
    /// Nothing to prepare.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self {})
    }

    /// Blocks until the sample is there.
    pub fn cycle(&mut self, context: CycleContext<impl SensorInterface>) -> Result<MainOutputs> {
        let (captured_at, sensor_data) = context.hardware_interface.read_sensors()?;
        Ok(MainOutputs {
            sensor_data: sensor_data.into(),
            captured_at: captured_at.into(),
        })
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use framework::Timestamp;

    use super::*;

    struct Body;

    impl SensorInterface for Body {
        fn read_sensors(&self) -> Result<(Timestamp, SensorData)> {
            let mut sensor_data = SensorData::default();
            sensor_data.sonar.left = 0.5;
            Ok((Timestamp::from_nanos(12), sensor_data))
        }
    }

    #[test]
    fn the_cycle_is_about_the_sample() {
        let mut node = SensorDataReceiver::new(CreationContext {}).unwrap();
        let hardware_interface = &Arc::new(Body);
        let outputs = node.cycle(CycleContext { hardware_interface }).unwrap();
        assert_eq!(outputs.sensor_data.value.sonar.left, 0.5);
        assert_eq!(outputs.captured_at, CaptureTime(Timestamp::from_nanos(12)));
    }
}
