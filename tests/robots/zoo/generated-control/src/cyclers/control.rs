//! Cycler `Control` (real-time), one instance.
//!
//! Written by `hulkgen generate` from hulk.toml and the nodes it names. Do not edit.

use framework::AdditionalOutput;
use framework::Clear;
use framework::Guarded;
use framework::Held;
use framework::HistoricInput;
use framework::InNode;
use framework::Interleaved;
use framework::OnFailure;
use framework::PerceptionInput;
use framework::Result;
use zoo_nodes::control::body;
use zoo_nodes::control::gait;
use zoo_nodes::control::legs;
use zoo_nodes::control::pose_filter;
use zoo_nodes::control::spot_filter;
use zoo_nodes::control::watcher;
use zoo_nodes::interfaces::BodyInterface;
use zoo_nodes::interfaces::LegInterface;
use zoo_nodes::shared::counter;

use crate::databases::control::Creation;
use crate::databases::control::Frame;

/// The nodes of one instance; they keep their state between cycles.
pub struct Nodes {
    pub body: Guarded<body::Body>,
    pub counter: Guarded<counter::Counter>,
    pub gait: Guarded<gait::Gait>,
    pub legs: Guarded<legs::Legs>,
    pub pose_filter: Guarded<pose_filter::PoseFilter>,
    pub spot_filter: Guarded<spot_filter::SpotFilter>,
    pub watcher: Guarded<watcher::Watcher>,
}

impl Nodes {
    pub fn new(creation: &mut Creation<'_, impl BodyInterface>) -> Result<Self> {
        Ok(Self {
            body: Guarded::new(
                "zoo_nodes::control::body",
                OnFailure::Stop,
                Self::create_body()?,
            ),
            watcher: Guarded::new(
                "zoo_nodes::control::watcher",
                OnFailure::Stop,
                Self::create_watcher()?,
            ),
            pose_filter: Guarded::new(
                "zoo_nodes::control::pose_filter",
                OnFailure::Stop,
                Self::create_pose_filter()?,
            ),
            spot_filter: Guarded::new(
                "zoo_nodes::control::spot_filter",
                OnFailure::Hold,
                Self::create_spot_filter()?,
            ),
            gait: Guarded::new(
                "zoo_nodes::control::gait",
                OnFailure::Hold,
                Self::create_gait(creation)?,
            ),
            legs: Guarded::new(
                "zoo_nodes::control::legs",
                OnFailure::Skip,
                Self::create_legs(creation)?,
            ),
            counter: Guarded::new(
                "zoo_nodes::shared::counter",
                OnFailure::Stop,
                Self::create_counter(creation)?,
            ),
        })
    }

    /// Setup nodes: wait for the data this cycle is about.
    #[inline(always)]
    pub fn setup(&mut self, frame: &mut Frame<'_, impl BodyInterface>) -> Result<()> {
        self.body(frame)?;
        Ok(())
    }

    /// Clients' values in place of what setup nodes wrote.
    pub fn inject<Hardware>(frame: &mut Frame<'_, Hardware>) {
        if let Some(injections) = frame.injections {
            injections.joints.replace(&mut frame.own.joints);
        }
    }

    /// Nodes: each call reads only what a call above it, or another cycler, wrote.
    #[inline(always)]
    pub fn cycle(
        &mut self,
        frame: &mut Frame<'_, impl BodyInterface + LegInterface>,
    ) -> Result<()> {
        self.pose_filter(frame)?;
        self.spot_filter(frame)?;
        self.watcher(frame)?;
        self.gait(frame)?;
        self.legs(frame)?;
        self.counter(frame)?;
        Ok(())
    }

    /// As `cycle`, when it is timed or clients replace outputs.
    #[cold]
    #[inline(never)]
    pub fn cycle_closely(
        &mut self,
        frame: &mut Frame<'_, impl BodyInterface + LegInterface>,
    ) -> Result<()> {
        self.cycle(frame)
    }

    /// What the states of nodes do not hold is rebuilt, after they were loaded.
    pub fn restore<Hardware>(
        &mut self,
        creation: &mut Creation<'_, Hardware>,
    ) -> Result<()> {
        let context = gait::CreationContext {
            period: &creation.parameters.gait.period,
            phase: &mut creation.cycler_state.gait.phase,
        };
        self.gait.node_mut().restore(context).in_node("zoo_nodes::control::gait")?;
        Ok(())
    }

    /// hardware -> joints
    #[inline(always)]
    fn body(&mut self, frame: &mut Frame<'_, impl BodyInterface>) -> Result<()> {
        let context = body::CycleContext {
            hardware_interface: frame.hardware_interface,
        };
        let outputs = self.body.call(&frame.cycle, |node| node.cycle(context))?;
        frame.own.joints = outputs.joints.value;
        *frame.capture_time = Some(outputs.measured_at.0);
        Ok(())
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

    /// target, state gait.phase, procedure walk, procedure stop -> plan, speed
    #[inline(always)]
    fn gait<Hardware>(&mut self, frame: &mut Frame<'_, Hardware>) -> Result<()> {
        Clear::clear(&mut frame.own.plan);
        self.gait.renew_if_broken(|| Self::create_gait(&mut frame.creation()))?;
        let context = gait::CycleContext {
            target: frame.own.target.as_ref(),
            default_speed: &frame.parameters.walking_speed,
            phase: &mut frame.cycler_state.gait.phase,
            walk: frame.procedures.walk.call(),
            stop: frame.procedures.stop.call(),
            plan: &mut frame.own.plan,
        };
        let outputs = self.gait.call_or_hold(&frame.cycle, |node| node.cycle(context))?;
        match outputs {
            Held::Written(outputs) => {
                frame.own.speed = outputs.speed.value;
            }
            Held::Hold => {
                frame.own.plan.clone_from(&frame.previous.own.plan);
                frame.own.speed.clone_from(&frame.previous.own.speed);
            }
            Held::Skip => {
                Clear::clear(&mut frame.own.plan);
                frame.own.speed = Default::default();
            }
        }
        if let Some(injections) = frame.injections {
            let replaced = [
                injections.plan.replace(&mut frame.own.plan),
                injections.speed.replace(&mut frame.own.speed),
            ];
            self.gait.replaced(&replaced);
        }
        Ok(())
    }

    /// plan, target (required) -> hardware
    #[inline(always)]
    fn legs(
        &mut self,
        frame: &mut Frame<'_, impl BodyInterface + LegInterface>,
    ) -> Result<()> {
        self.legs.renew_if_broken(|| Self::create_legs(&mut frame.creation()))?;
        if let Some(target) = frame.own.target.as_ref() {
            let context = legs::CycleContext {
                plan: &frame.own.plan,
                target,
                hardware_interface: frame.hardware_interface,
            };
            self.legs.call_or_skip(&frame.cycle, |node| node.cycle(context))?;
        } else {
            // A required input is absent.
            self.legs.skip();
        }
        Ok(())
    }

    /// joints, state filter.gain, state filter.drift -> pose
    #[inline(always)]
    fn pose_filter<Hardware>(&mut self, frame: &mut Frame<'_, Hardware>) -> Result<()> {
        let context = pose_filter::CycleContext {
            cycle_time: frame.cycle.time,
            joints: &frame.own.joints,
            gain: &mut frame.cycler_state.filter.gain,
            drift: &mut frame.cycler_state.filter.drift,
        };
        let outputs = self.pose_filter.call(&frame.cycle, |node| node.cycle(context))?;
        frame.own.pose = outputs.pose.value;
        if let Some(injections) = frame.injections {
            injections.pose.replace(&mut frame.own.pose);
        }
        Ok(())
    }

    /// perception Vision.spots, perception Vision.best, perception VisionTop.best, perception
    /// Hearing.loudness, perception Hearing.whistle, historic pose, historic pose.position,
    /// historic pose.heading, previous target, previous report.best -> target, report
    #[inline(always)]
    fn spot_filter<Hardware>(&mut self, frame: &mut Frame<'_, Hardware>) -> Result<()> {
        self.spot_filter.renew_if_broken(Self::create_spot_filter)?;
        let spots = Interleaved {
            order: &frame.perception.vision,
            instances: [
                &frame.perception.vision_top.project(|outputs| &outputs.spots),
                &frame.perception.vision_bottom.project(|outputs| &outputs.spots),
            ],
        };
        let best = Interleaved {
            order: &frame.perception.vision,
            instances: [
                &frame.perception.vision_top.project(|outputs| outputs.best.as_ref()),
                &frame.perception.vision_bottom.project(|outputs| outputs.best.as_ref()),
            ],
        };
        let top = frame.perception.vision_top.project(|outputs| outputs.best.as_ref());
        let loudness = frame.perception.hearing.project(|outputs| &outputs.loudness);
        let whistle = frame.perception.hearing.project(|outputs| &outputs.whistle);
        let pose = frame.historic.pose.project(|pose| pose);
        let position = frame.historic.pose.project(|pose| pose.position.as_ref());
        let heading = frame.historic.pose.project(|pose| &pose.heading);
        let context = spot_filter::CycleContext {
            spots: PerceptionInput::new(&spots),
            best: PerceptionInput::new(&best),
            top: PerceptionInput::new(&top),
            loudness: PerceptionInput::new(&loudness),
            whistle: PerceptionInput::new(&whistle),
            pose: HistoricInput::new(&pose, frame.cycle.time.start, &frame.own.pose),
            position: HistoricInput::new(
                &position,
                frame.cycle.time.start,
                frame.own.pose.position.as_ref(),
            ),
            heading: HistoricInput::new(
                &heading,
                frame.cycle.time.start,
                &frame.own.pose.heading,
            ),
            last: frame.previous.own.target.as_ref(),
            last_best: frame.previous.own.report.best.as_ref(),
        };
        let outputs = self
            .spot_filter
            .call_or_hold(&frame.cycle, |node| node.cycle(context))?;
        match outputs {
            Held::Written(outputs) => {
                frame.own.target = outputs.target.value;
                frame.own.report = outputs.report.value;
            }
            Held::Hold => {
                frame.own.target.clone_from(&frame.previous.own.target);
                frame.own.report.clone_from(&frame.previous.own.report);
            }
            Held::Skip => {
                frame.own.target = Default::default();
                frame.own.report = Default::default();
            }
        }
        if let Some(injections) = frame.injections {
            let replaced = [
                injections.target.replace(&mut frame.own.target),
                injections.report.replace(&mut frame.own.report),
            ];
            self.spot_filter.replaced(&replaced);
        }
        Ok(())
    }

    /// report, report.certainty, report.best, report.best.brightness, report.nested (required),
    /// report.nested.plain, report.nested.deep, report.nested.plain (required), state
    /// filter.gain, state filter.drift -> seen; when subscribed: debug.watcher.seen,
    /// debug.certainty
    #[inline(always)]
    fn watcher<Hardware>(&mut self, frame: &mut Frame<'_, Hardware>) -> Result<()> {
        if let Some(nested) = frame.own.report.nested.as_ref()
            && let Some(outputs_input) = frame
                .own
                .report
                .nested
                .as_ref()
                .map(|nested| &nested.plain)
        {
            let context = watcher::CycleContext {
                report: &frame.own.report,
                certainty: &frame.own.report.certainty,
                best: frame.own.report.best.as_ref(),
                whole_best: &frame.own.report.best,
                brightness: frame.own.report.best.as_ref().map(|best| &best.brightness),
                nested,
                plain: frame.own.report.nested.as_ref().map(|nested| &nested.plain),
                deep: frame
                    .own
                    .report
                    .nested
                    .as_ref()
                    .and_then(|nested| nested.deep.as_ref()),
                outputs: outputs_input,
                gain: &frame.cycler_state.filter.gain,
                drift: &frame.cycler_state.filter.drift,
                seen: AdditionalOutput::new(
                    frame.subscribed.debug_watcher_seen,
                    frame.cycle.number,
                    &mut frame.additional_outputs.debug.watcher.seen,
                ),
                certainties: AdditionalOutput::new(
                    frame.subscribed.debug_certainty,
                    frame.cycle.number,
                    &mut frame.additional_outputs.debug.certainty,
                ),
            };
            let outputs = self.watcher.call(&frame.cycle, |node| node.cycle(context))?;
            frame.own.seen = outputs.seen.value;
        } else {
            // A required input is absent: the main outputs take their defaults.
            self.watcher.skip();
            frame.own.seen = Default::default();
        }
        if let Some(injections) = frame.injections {
            injections.seen.replace(&mut frame.own.seen);
        }
        Ok(())
    }

    fn create_body() -> Result<body::Body> {
        let context = body::CreationContext {};
        body::Body::new(context).in_node("zoo_nodes::control::body")
    }

    fn create_counter<Hardware>(
        creation: &mut Creation<'_, Hardware>,
    ) -> Result<counter::Counter> {
        let context = counter::CreationContext {
            count: &mut creation.cycler_state.count,
        };
        counter::Counter::new(context).in_node("zoo_nodes::shared::counter")
    }

    fn create_gait<Hardware>(
        creation: &mut Creation<'_, Hardware>,
    ) -> Result<gait::Gait> {
        let context = gait::CreationContext {
            period: &creation.parameters.gait.period,
            phase: &mut creation.cycler_state.gait.phase,
        };
        gait::Gait::new(context).in_node("zoo_nodes::control::gait")
    }

    fn create_legs(
        creation: &mut Creation<'_, impl BodyInterface>,
    ) -> Result<legs::Legs> {
        let context = legs::CreationContext {
            hardware_interface: creation.hardware_interface,
        };
        legs::Legs::new(context).in_node("zoo_nodes::control::legs")
    }

    fn create_pose_filter() -> Result<pose_filter::PoseFilter> {
        let context = pose_filter::CreationContext {};
        pose_filter::PoseFilter::new(context).in_node("zoo_nodes::control::pose_filter")
    }

    fn create_spot_filter() -> Result<spot_filter::SpotFilter> {
        let context = spot_filter::CreationContext {};
        spot_filter::SpotFilter::new(context).in_node("zoo_nodes::control::spot_filter")
    }

    fn create_watcher() -> Result<watcher::Watcher> {
        let context = watcher::CreationContext {};
        watcher::Watcher::new(context).in_node("zoo_nodes::control::watcher")
    }
}
