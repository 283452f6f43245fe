//! Cycler `Odometry` (perception), one instance.
//!
//! Written by `hulkgen generate` from hulk.toml and the nodes it names. Do not edit.

use framework::Guarded;
use framework::InNode;
use framework::OnFailure;
use framework::Result;
use timing_nodes::interfaces::Odometer;
use timing_nodes::wheel_receiver;

use crate::databases::odometry::Frame;

/// The nodes of one instance; they keep their state between cycles.
pub struct Nodes {
    pub wheel_receiver: Guarded<wheel_receiver::WheelReceiver>,
}

impl Nodes {
    pub fn new() -> Result<Self> {
        Ok(Self {
            wheel_receiver: Guarded::new(
                "timing_nodes::wheel_receiver",
                OnFailure::Stop,
                Self::create_wheel_receiver()?,
            ),
        })
    }

    /// Setup nodes: wait for the data this cycle is about.
    #[inline(always)]
    pub fn setup(&mut self, frame: &mut Frame<'_, impl Odometer>) -> Result<()> {
        self.wheel_receiver(frame)?;
        Ok(())
    }

    /// Clients' values in place of what setup nodes wrote.
    pub fn inject<Hardware>(frame: &mut Frame<'_, Hardware>) {
        if let Some(injections) = frame.injections {
            injections.measurement.replace(&mut frame.shared.measurement);
        }
    }

    /// hardware -> measurement
    #[inline(always)]
    fn wheel_receiver(&mut self, frame: &mut Frame<'_, impl Odometer>) -> Result<()> {
        let context = wheel_receiver::CycleContext {
            hardware_interface: frame.hardware_interface,
        };
        let outputs = self
            .wheel_receiver
            .call(&frame.cycle, |node| node.cycle(context))?;
        frame.shared.measurement = outputs.measurement.value;
        *frame.capture_time = Some(outputs.captured_at.0);
        Ok(())
    }

    fn create_wheel_receiver() -> Result<wheel_receiver::WheelReceiver> {
        let context = wheel_receiver::CreationContext {};
        wheel_receiver::WheelReceiver::new(context)
            .in_node("timing_nodes::wheel_receiver")
    }
}
