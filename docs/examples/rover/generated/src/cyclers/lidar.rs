//! Cycler `Lidar` (perception), one instance.
//!
//! Written by `hulkgen generate` from hulk.toml and the nodes it names. Do not edit.

use framework::Clear;
use framework::Guarded;
use framework::InNode;
use framework::OnFailure;
use framework::Result;
use rover_nodes::interfaces::Lidar;
use rover_nodes::lidar::freeway_detection;
use rover_nodes::lidar::scan_receiver;

use crate::databases::lidar::Frame;

/// The nodes of one instance; they keep their state between cycles.
pub struct Nodes {
    pub freeway_detection: Guarded<freeway_detection::FreewayDetection>,
    pub scan_receiver: Guarded<scan_receiver::ScanReceiver>,
}

impl Nodes {
    pub fn new() -> Result<Self> {
        Ok(Self {
            scan_receiver: Guarded::new(
                "rover_nodes::lidar::scan_receiver",
                OnFailure::Restart,
                Self::create_scan_receiver()?,
            ),
            freeway_detection: Guarded::new(
                "rover_nodes::lidar::freeway_detection",
                OnFailure::Restart,
                Self::create_freeway_detection()?,
            ),
        })
    }

    /// Setup nodes: wait for the data this cycle is about.
    #[inline(always)]
    pub fn setup(&mut self, frame: &mut Frame<'_, impl Lidar>) -> Result<()> {
        self.scan_receiver(frame)?;
        Ok(())
    }

    /// Clients' values in place of what setup nodes wrote.
    pub fn inject<Hardware>(frame: &mut Frame<'_, Hardware>) {
        if let Some(injections) = frame.injections {
            injections.scan.replace(&mut frame.own.scan);
        }
    }

    /// Nodes: each call reads only what a call above it, or another cycler, wrote.
    #[inline(always)]
    pub fn cycle<Hardware>(&mut self, frame: &mut Frame<'_, Hardware>) -> Result<()> {
        self.freeway_detection(frame)?;
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

    /// scan -> freeways
    #[inline(always)]
    fn freeway_detection<Hardware>(
        &mut self,
        frame: &mut Frame<'_, Hardware>,
    ) -> Result<()> {
        Clear::clear(&mut frame.shared.freeways);
        let context = freeway_detection::CycleContext {
            scan: &frame.own.scan,
            freeways: &mut frame.shared.freeways,
            half_width: &frame.parameters.freeway_detection.half_width,
            directions: &frame.parameters.freeway_detection.directions,
        };
        self.freeway_detection.call(&frame.cycle, |node| node.cycle(context))?;
        if let Some(injections) = frame.injections {
            injections.freeways.replace(&mut frame.shared.freeways);
        }
        Ok(())
    }

    /// hardware -> scan
    #[inline(always)]
    fn scan_receiver(&mut self, frame: &mut Frame<'_, impl Lidar>) -> Result<()> {
        Clear::clear(&mut frame.own.scan);
        let context = scan_receiver::CycleContext {
            hardware_interface: frame.hardware_interface,
            scan: &mut frame.own.scan,
        };
        let outputs = self.scan_receiver.call(&frame.cycle, |node| node.cycle(context))?;
        *frame.capture_time = Some(outputs.captured_at.0);
        Ok(())
    }

    fn create_freeway_detection() -> Result<freeway_detection::FreewayDetection> {
        let context = freeway_detection::CreationContext {};
        freeway_detection::FreewayDetection::new(context)
            .in_node("rover_nodes::lidar::freeway_detection")
    }

    fn create_scan_receiver() -> Result<scan_receiver::ScanReceiver> {
        let context = scan_receiver::CreationContext {};
        scan_receiver::ScanReceiver::new(context)
            .in_node("rover_nodes::lidar::scan_receiver")
    }
}
