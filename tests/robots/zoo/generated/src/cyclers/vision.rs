//! Cycler `Vision` (perception), instances `VisionTop` and `VisionBottom`.
//!
//! Written by `hulkgen generate` from hulk.toml and the nodes it names. Do not edit.

use framework::AdditionalOutput;
use framework::Clear;
use framework::Guarded;
use framework::InNode;
use framework::OnFailure;
use framework::Result;
use zoo_nodes::interfaces::EyeInterface;
use zoo_nodes::shared::counter;
use zoo_nodes::vision::exposure;
use zoo_nodes::vision::eye;
use zoo_nodes::vision::horizon_finder;
use zoo_nodes::vision::other_eye;
use zoo_nodes::vision::spot_finder;

use crate::databases::vision::Creation;
use crate::databases::vision::Frame;

/// The nodes of one instance; they keep their state between cycles.
pub struct Nodes {
    pub counter: Guarded<counter::Counter>,
    pub exposure: Guarded<exposure::Exposure>,
    pub eye: Guarded<eye::Eye>,
    pub horizon_finder: Guarded<horizon_finder::HorizonFinder>,
    pub other_eye: Guarded<other_eye::OtherEye>,
    pub spot_finder: Guarded<spot_finder::SpotFinder>,
}

impl Nodes {
    pub fn new(creation: &mut Creation<'_>) -> Result<Self> {
        Ok(Self {
            eye: Guarded::new(
                "zoo_nodes::vision::eye",
                OnFailure::Restart,
                Self::create_eye(creation)?,
            ),
            exposure: Guarded::new(
                "zoo_nodes::vision::exposure",
                OnFailure::Restart,
                Self::create_exposure()?,
            ),
            spot_finder: Guarded::new(
                "zoo_nodes::vision::spot_finder",
                OnFailure::Skip,
                Self::create_spot_finder(creation)?,
            ),
            horizon_finder: Guarded::new(
                "zoo_nodes::vision::horizon_finder",
                OnFailure::Restart,
                Self::create_horizon_finder()?,
            ),
            other_eye: Guarded::new(
                "zoo_nodes::vision::other_eye",
                OnFailure::Restart,
                Self::create_other_eye()?,
            ),
            counter: Guarded::new(
                "zoo_nodes::shared::counter",
                OnFailure::Restart,
                Self::create_counter(creation)?,
            ),
        })
    }

    /// Setup nodes: wait for the data this cycle is about.
    #[inline(always)]
    pub fn setup(&mut self, frame: &mut Frame<'_, impl EyeInterface>) -> Result<()> {
        self.eye(frame)?;
        self.exposure(frame)?;
        Ok(())
    }

    /// Clients' values in place of what setup nodes wrote.
    pub fn inject<Hardware>(frame: &mut Frame<'_, Hardware>) {
        if let Some(injections) = frame.injections {
            injections.exposure.replace(&mut frame.own.exposure);
            injections.image.replace(&mut frame.own.image);
        }
    }

    /// Nodes: each call reads only what a call above it, or another cycler, wrote.
    #[inline(always)]
    pub fn cycle<Hardware>(&mut self, frame: &mut Frame<'_, Hardware>) -> Result<()> {
        self.horizon_finder(frame)?;
        self.spot_finder(frame)?;
        self.other_eye(frame)?;
        self.counter(frame)?;
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

    /// state count -> cycles
    #[inline(always)]
    fn counter<Hardware>(&mut self, frame: &mut Frame<'_, Hardware>) -> Result<()> {
        let context = counter::CycleContext {
            count: &mut frame.cycler_state.count,
        };
        let outputs = self.counter.call(&frame.cycle, |node| node.cycle(context))?;
        frame.own.cycles = outputs.cycles.value;
        if let Some(injections) = frame.injections {
            injections.cycles.replace(&mut frame.own.cycles);
        }
        Ok(())
    }

    /// image, state exposure -> exposure
    #[inline(always)]
    fn exposure<Hardware>(&mut self, frame: &mut Frame<'_, Hardware>) -> Result<()> {
        let context = exposure::CycleContext {
            image: &frame.own.image,
            wanted: frame.instance_exposure,
            smoothed: &mut frame.cycler_state.exposure,
        };
        let outputs = self.exposure.call(&frame.cycle, |node| node.cycle(context))?;
        frame.own.exposure = outputs.exposure.value;
        Ok(())
    }

    /// hardware -> image; when subscribed: $cycler_instance.width
    #[inline(always)]
    fn eye(&mut self, frame: &mut Frame<'_, impl EyeInterface>) -> Result<()> {
        Clear::clear(&mut frame.own.image);
        let context = eye::CycleContext {
            hardware: frame.hardware_interface,
            image: &mut frame.own.image,
            width: AdditionalOutput::new(
                frame.subscribed.cycler_instance_width,
                frame.cycle.number,
                &mut frame.additional_outputs.cycler_instance.width,
            ),
        };
        let outputs = self.eye.call(&frame.cycle, |node| node.cycle(context))?;
        *frame.capture_time = Some(outputs.taken_at.0);
        Ok(())
    }

    /// latest Control.pose (required), latest Control.pose.position (required), latest
    /// Control.target, latest Control.pose.heading -> horizon
    #[inline(always)]
    fn horizon_finder<Hardware>(
        &mut self,
        frame: &mut Frame<'_, Hardware>,
    ) -> Result<()> {
        let pose = frame.latest.control.written().map(|outputs| &outputs.pose);
        if let Some(pose) = pose
            && let Some(position) = frame.latest.control.pose.position.as_ref()
        {
            let context = horizon_finder::CycleContext {
                pose,
                position,
                target: frame.latest.control.target.as_ref(),
                whole_target: &frame.latest.control.target,
                heading: frame
                    .latest
                    .control
                    .latest(frame.cycle.time.start, |outputs| &outputs.pose.heading),
                latest_target: frame
                    .latest
                    .control
                    .latest(frame.cycle.time.start, |outputs| outputs.target.as_ref()),
            };
            let outputs = self
                .horizon_finder
                .call(&frame.cycle, |node| node.cycle(context))?;
            frame.own.horizon = outputs.horizon.value;
        } else {
            // A required input is absent: the main outputs take their defaults.
            self.horizon_finder.skip();
            frame.own.horizon = Default::default();
        }
        if let Some(injections) = frame.injections {
            injections.horizon.replace(&mut frame.own.horizon);
        }
        Ok(())
    }

    /// latest VisionTop.spots, latest VisionBottom.best, previous spots, previous agreement ->
    /// agreement
    #[inline(always)]
    fn other_eye<Hardware>(&mut self, frame: &mut Frame<'_, Hardware>) -> Result<()> {
        let context = other_eye::CycleContext {
            top: &frame.latest.vision_top.spots,
            bottom: frame
                .latest
                .vision_bottom
                .latest(frame.cycle.time.start, |outputs| outputs.best.as_ref()),
            last_spots: &frame.previous.shared.spots,
            last_agreement: &frame.previous.own.agreement,
        };
        let outputs = self.other_eye.call(&frame.cycle, |node| node.cycle(context))?;
        frame.own.agreement = outputs.agreement.value;
        if let Some(injections) = frame.injections {
            injections.agreement.replace(&mut frame.own.agreement);
        }
        Ok(())
    }

    /// image, horizon (required), state exposure -> spots, best; when subscribed: candidates
    #[inline(always)]
    fn spot_finder<Hardware>(&mut self, frame: &mut Frame<'_, Hardware>) -> Result<()> {
        self.spot_finder
            .renew_if_broken(|| Self::create_spot_finder(&mut frame.creation()))?;
        if let Some(horizon) = frame.own.horizon.as_ref() {
            let context = spot_finder::CycleContext {
                image: &frame.own.image,
                horizon,
                threshold: &frame.parameters.spot_finder.threshold,
                gain: &frame.instance_parameters.gain,
                exposure: &frame.cycler_state.exposure,
                candidates: AdditionalOutput::new(
                    frame.subscribed.candidates,
                    frame.cycle.number,
                    &mut frame.additional_outputs.candidates,
                ),
            };
            let outputs = self
                .spot_finder
                .call_or_skip(&frame.cycle, |node| node.cycle(context))?;
            if let Some(outputs) = outputs {
                frame.shared.spots = outputs.spots.value;
                frame.shared.best = outputs.best.value;
            } else {
                frame.shared.spots = Default::default();
                frame.shared.best = Default::default();
            }
        } else {
            // A required input is absent: the main outputs take their defaults.
            self.spot_finder.skip();
            frame.shared.spots = Default::default();
            frame.shared.best = Default::default();
        }
        if let Some(injections) = frame.injections {
            injections.spots.replace(&mut frame.shared.spots);
            injections.best.replace(&mut frame.shared.best);
        }
        Ok(())
    }

    fn create_counter(creation: &mut Creation<'_>) -> Result<counter::Counter> {
        let context = counter::CreationContext {
            count: &mut creation.cycler_state.count,
        };
        counter::Counter::new(context).in_node("zoo_nodes::shared::counter")
    }

    fn create_exposure() -> Result<exposure::Exposure> {
        let context = exposure::CreationContext {};
        exposure::Exposure::new(context).in_node("zoo_nodes::vision::exposure")
    }

    fn create_eye(creation: &mut Creation<'_>) -> Result<eye::Eye> {
        let context = eye::CreationContext {
            camera: &creation.instance_parameters.camera,
        };
        eye::Eye::new(context).in_node("zoo_nodes::vision::eye")
    }

    fn create_horizon_finder() -> Result<horizon_finder::HorizonFinder> {
        let context = horizon_finder::CreationContext {};
        horizon_finder::HorizonFinder::new(context)
            .in_node("zoo_nodes::vision::horizon_finder")
    }

    fn create_other_eye() -> Result<other_eye::OtherEye> {
        let context = other_eye::CreationContext {};
        other_eye::OtherEye::new(context).in_node("zoo_nodes::vision::other_eye")
    }

    fn create_spot_finder(
        creation: &mut Creation<'_>,
    ) -> Result<spot_finder::SpotFinder> {
        let context = spot_finder::CreationContext {
            brightest: &creation.parameters.spot_finder.brightest,
            gain: &creation.instance_parameters.gain,
        };
        spot_finder::SpotFinder::new(context).in_node("zoo_nodes::vision::spot_finder")
    }
}
