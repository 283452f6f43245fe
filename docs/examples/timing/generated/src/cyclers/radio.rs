//! Cycler `Radio` (perception), one instance.
//!
//! Written by `hulkgen generate` from hulk.toml and the nodes it names. Do not edit.

use framework::Guarded;
use framework::InNode;
use framework::OnFailure;
use framework::Result;
use timing_nodes::interfaces::Radio;
use timing_nodes::message_receiver;

use crate::databases::radio::Frame;

/// The nodes of one instance; they keep their state between cycles.
pub struct Nodes {
    pub message_receiver: Guarded<message_receiver::MessageReceiver>,
}

impl Nodes {
    pub fn new() -> Result<Self> {
        Ok(Self {
            message_receiver: Guarded::new(
                "timing_nodes::message_receiver",
                OnFailure::Stop,
                Self::create_message_receiver()?,
            ),
        })
    }

    /// Setup nodes: wait for the data this cycle is about.
    #[inline(always)]
    pub fn setup(&mut self, frame: &mut Frame<'_, impl Radio>) -> Result<()> {
        self.message_receiver(frame)?;
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
    fn message_receiver(&mut self, frame: &mut Frame<'_, impl Radio>) -> Result<()> {
        let context = message_receiver::CycleContext {
            hardware_interface: frame.hardware_interface,
        };
        let outputs = self
            .message_receiver
            .call(&frame.cycle, |node| node.cycle(context))?;
        frame.shared.measurement = outputs.measurement.value;
        *frame.capture_time = Some(outputs.captured_at.0);
        Ok(())
    }

    fn create_message_receiver() -> Result<message_receiver::MessageReceiver> {
        let context = message_receiver::CreationContext {};
        message_receiver::MessageReceiver::new(context)
            .in_node("timing_nodes::message_receiver")
    }
}
