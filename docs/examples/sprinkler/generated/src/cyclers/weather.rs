//! Cycler `Weather` (perception), one instance.
//!
//! Written by `hulkgen generate` from hulk.toml and the nodes it names. Do not edit.

use framework::Guarded;
use framework::InNode;
use framework::OnFailure;
use framework::Result;
use sprinkler_nodes::RainGauge;
use sprinkler_nodes::rain_mean;
use sprinkler_nodes::rain_receiver;

use crate::databases::weather::Frame;

/// The nodes of one instance; they keep their state between cycles.
pub struct Nodes {
    pub rain_mean: Guarded<rain_mean::RainMean>,
    pub rain_receiver: Guarded<rain_receiver::RainReceiver>,
}

impl Nodes {
    pub fn new() -> Result<Self> {
        Ok(Self {
            rain_receiver: Guarded::new(
                "sprinkler_nodes::rain_receiver",
                OnFailure::Stop,
                Self::create_rain_receiver()?,
            ),
            rain_mean: Guarded::new(
                "sprinkler_nodes::rain_mean",
                OnFailure::Stop,
                Self::create_rain_mean()?,
            ),
        })
    }

    /// Setup nodes: wait for the data this cycle is about.
    #[inline(always)]
    pub fn setup(&mut self, frame: &mut Frame<'_, impl RainGauge>) -> Result<()> {
        self.rain_receiver(frame)?;
        Ok(())
    }

    /// Clients' values in place of what setup nodes wrote.
    pub fn inject<Hardware>(frame: &mut Frame<'_, Hardware>) {
        if let Some(injections) = frame.injections {
            injections.rain.replace(&mut frame.own.rain);
        }
    }

    /// Nodes: each call reads only what a call above it, or another cycler, wrote.
    #[inline(always)]
    pub fn cycle<Hardware>(&mut self, frame: &mut Frame<'_, Hardware>) -> Result<()> {
        self.rain_mean(frame)?;
        Ok(())
    }

    /// As `cycle`, when it is timed or clients replace outputs.
    #[cold]
    #[inline(never)]
    pub fn cycle_closely<Hardware>(
        &mut self,
        frame: &mut Frame<'_, Hardware>,
    ) -> Result<()> {
        self.cycle(frame)
    }

    /// rain -> mean_rain
    #[inline(always)]
    fn rain_mean<Hardware>(&mut self, frame: &mut Frame<'_, Hardware>) -> Result<()> {
        let context = rain_mean::CycleContext {
            rain: &frame.own.rain,
            share: &frame.parameters.rain_mean.share,
        };
        let outputs = self.rain_mean.call(&frame.cycle, |node| node.cycle(context))?;
        frame.shared.mean_rain = outputs.mean_rain.value;
        if let Some(injections) = frame.injections {
            injections.mean_rain.replace(&mut frame.shared.mean_rain);
        }
        Ok(())
    }

    /// hardware -> rain
    #[inline(always)]
    fn rain_receiver(&mut self, frame: &mut Frame<'_, impl RainGauge>) -> Result<()> {
        let context = rain_receiver::CycleContext {
            hardware_interface: frame.hardware_interface,
        };
        let outputs = self.rain_receiver.call(&frame.cycle, |node| node.cycle(context))?;
        frame.own.rain = outputs.rain.value;
        *frame.capture_time = Some(outputs.captured_at.0);
        Ok(())
    }

    fn create_rain_mean() -> Result<rain_mean::RainMean> {
        let context = rain_mean::CreationContext {};
        rain_mean::RainMean::new(context).in_node("sprinkler_nodes::rain_mean")
    }

    fn create_rain_receiver() -> Result<rain_receiver::RainReceiver> {
        let context = rain_receiver::CreationContext {};
        rain_receiver::RainReceiver::new(context)
            .in_node("sprinkler_nodes::rain_receiver")
    }
}
