//! Cycler `Hearing` (perception), one instance.
//!
//! Written by `hulkgen generate` from hulk.toml and the nodes it names. Do not edit.

use framework::Guarded;
use framework::Held;
use framework::InNode;
use framework::OnFailure;
use framework::Result;
use zoo_nodes::hearing::ear;
use zoo_nodes::hearing::whistle;
use zoo_nodes::interfaces::EarInterface;

use crate::databases::hearing::Frame;

/// The nodes of one instance; they keep their state between cycles.
pub struct Nodes {
    pub ear: Guarded<ear::Ear>,
    pub whistle: Guarded<whistle::Whistle>,
}

impl Nodes {
    pub fn new() -> Result<Self> {
        Ok(Self {
            ear: Guarded::new(
                "zoo_nodes::hearing::ear",
                OnFailure::Hold,
                Self::create_ear()?,
            ),
            whistle: Guarded::new(
                "zoo_nodes::hearing::whistle",
                OnFailure::Hold,
                Self::create_whistle()?,
            ),
        })
    }

    /// Setup nodes: wait for the data this cycle is about.
    #[inline(always)]
    pub fn setup(&mut self, frame: &mut Frame<'_, impl EarInterface>) -> Result<()> {
        self.ear(frame)?;
        Ok(())
    }

    /// Clients' values in place of what setup nodes wrote.
    pub fn inject<Hardware>(frame: &mut Frame<'_, Hardware>) {
        if let Some(injections) = frame.injections {
            injections.loudness.replace(&mut frame.shared.loudness);
        }
    }

    /// Nodes: each call reads only what a call above it, or another cycler, wrote.
    #[inline(always)]
    pub fn cycle<Hardware>(&mut self, frame: &mut Frame<'_, Hardware>) -> Result<()> {
        self.whistle(frame)?;
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

    /// hardware -> loudness
    #[inline(always)]
    fn ear(&mut self, frame: &mut Frame<'_, impl EarInterface>) -> Result<()> {
        self.ear.renew_if_broken(Self::create_ear)?;
        let context = ear::CycleContext {
            hardware_interface: frame.hardware_interface,
        };
        let outputs = self.ear.call(&frame.cycle, |node| node.cycle(context))?;
        frame.shared.loudness = outputs.loudness.value;
        *frame.capture_time = Some(outputs.heard_at.0);
        Ok(())
    }

    /// loudness -> whistle
    #[inline(always)]
    fn whistle<Hardware>(&mut self, frame: &mut Frame<'_, Hardware>) -> Result<()> {
        self.whistle.renew_if_broken(Self::create_whistle)?;
        let context = whistle::CycleContext {
            loudness: &frame.shared.loudness,
        };
        let outputs = self
            .whistle
            .call_or_hold(&frame.cycle, |node| node.cycle(context))?;
        match outputs {
            Held::Written(outputs) => {
                frame.shared.whistle = outputs.whistle.value;
            }
            Held::Hold => {
                frame.shared.whistle.clone_from(&frame.previous.shared.whistle);
            }
            Held::Skip => {
                frame.shared.whistle = Default::default();
            }
        }
        if let Some(injections) = frame.injections {
            let replaced = [injections.whistle.replace(&mut frame.shared.whistle)];
            self.whistle.replaced(&replaced);
        }
        Ok(())
    }

    fn create_ear() -> Result<ear::Ear> {
        let context = ear::CreationContext {};
        ear::Ear::new(context).in_node("zoo_nodes::hearing::ear")
    }

    fn create_whistle() -> Result<whistle::Whistle> {
        let context = whistle::CreationContext {};
        whistle::Whistle::new(context).in_node("zoo_nodes::hearing::whistle")
    }
}
