//! Cycler `Audio` (perception), one instance.
//!
//! Written by `hulkgen generate` from hulk.toml and the nodes it names. Do not edit.

use audio::microphone_recorder;
use audio::whistle_detection;
use framework::AdditionalOutput;
use framework::Guarded;
use framework::InNode;
use framework::OnFailure;
use framework::Result;
use hardware::MicrophoneInterface;

use crate::databases::audio::Frame;

/// The nodes of one instance; they keep their state between cycles.
pub struct Nodes {
    pub microphone_recorder: Guarded<microphone_recorder::MicrophoneRecorder>,
    pub whistle_detection: Guarded<whistle_detection::WhistleDetection>,
}

impl Nodes {
    pub fn new() -> Result<Self> {
        Ok(Self {
            microphone_recorder: Guarded::new(
                "audio::microphone_recorder",
                OnFailure::Restart,
                Self::create_microphone_recorder()?,
            ),
            whistle_detection: Guarded::new(
                "audio::whistle_detection",
                OnFailure::Restart,
                Self::create_whistle_detection()?,
            ),
        })
    }

    /// Setup nodes: wait for the data this cycle is about.
    #[inline(always)]
    pub fn setup(
        &mut self,
        frame: &mut Frame<'_, impl MicrophoneInterface>,
    ) -> Result<()> {
        self.microphone_recorder(frame)?;
        Ok(())
    }

    /// Clients' values in place of what setup nodes wrote.
    pub fn inject<Hardware>(frame: &mut Frame<'_, Hardware>) {
        if let Some(injections) = frame.injections {
            injections.audio_block.replace(&mut frame.own.audio_block);
        }
    }

    /// Nodes: each call reads only what a call above it, or another cycler, wrote.
    #[inline(always)]
    pub fn cycle<Hardware>(&mut self, frame: &mut Frame<'_, Hardware>) -> Result<()> {
        self.whistle_detection(frame)?;
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

    /// What the states of nodes do not hold is rebuilt, after they were loaded.
    pub fn restore(&mut self) -> Result<()> {
        let context = whistle_detection::CreationContext {};
        self.whistle_detection
            .node_mut()
            .restore(context)
            .in_node("audio::whistle_detection")?;
        Ok(())
    }

    /// hardware -> audio_block
    #[inline(always)]
    fn microphone_recorder(
        &mut self,
        frame: &mut Frame<'_, impl MicrophoneInterface>,
    ) -> Result<()> {
        let context = microphone_recorder::CycleContext {
            hardware_interface: frame.hardware_interface,
        };
        let outputs = self
            .microphone_recorder
            .call(&frame.cycle, |node| node.cycle(context))?;
        frame.own.audio_block = outputs.audio_block.value;
        *frame.capture_time = Some(outputs.captured_at.0);
        Ok(())
    }

    /// audio_block (required) -> whistle_evidence; when subscribed: whistle_detection.peaks
    #[inline(always)]
    fn whistle_detection<Hardware>(
        &mut self,
        frame: &mut Frame<'_, Hardware>,
    ) -> Result<()> {
        if let Some(audio_block) = frame.own.audio_block.as_ref() {
            let context = whistle_detection::CycleContext {
                audio_block,
                parameters: &frame.parameters.whistle_detection,
                peaks: AdditionalOutput::new(
                    frame.subscribed.whistle_detection_peaks,
                    frame.cycle.number,
                    &mut frame.additional_outputs.whistle_detection.peaks,
                ),
            };
            let outputs = self
                .whistle_detection
                .call(&frame.cycle, |node| node.cycle(context))?;
            frame.shared.whistle_evidence = outputs.whistle_evidence.value;
        } else {
            // A required input is absent: the main outputs take their defaults.
            self.whistle_detection.skip();
            frame.shared.whistle_evidence = Default::default();
        }
        if let Some(injections) = frame.injections {
            injections.whistle_evidence.replace(&mut frame.shared.whistle_evidence);
        }
        Ok(())
    }

    fn create_microphone_recorder() -> Result<microphone_recorder::MicrophoneRecorder> {
        let context = microphone_recorder::CreationContext {};
        microphone_recorder::MicrophoneRecorder::new(context)
            .in_node("audio::microphone_recorder")
    }

    fn create_whistle_detection() -> Result<whistle_detection::WhistleDetection> {
        let context = whistle_detection::CreationContext {};
        whistle_detection::WhistleDetection::new(context)
            .in_node("audio::whistle_detection")
    }
}
