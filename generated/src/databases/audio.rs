//! What cycler `Audio` writes, and what its nodes see.
//!
//! Written by `hulkgen generate` from hulk.toml and the nodes it names. Do not edit.

use std::sync::Arc;

use audio::whistle_detection::SpectralPeak;
use framework::AdditionalSlot;
use framework::Cycle;
use framework::Injection;
use framework::InjectionCell;
use framework::InjectionTable;
use framework::Reflect;
use framework::Timestamp;
use framework::pool::Leased;
use framework::recorded::Outputs;
use serde::Deserialize;
use serde::Serialize;
use types::audio::AudioBlock;
use types::audio::MICROPHONE_COUNT;
use types::audio::WhistleEvidence;

use crate::parameters::Parameters;

/// Main outputs that only nodes of `Audio` read: they stay with the instance.
#[derive(Clone, Debug, Default, Deserialize, Reflect, Serialize)]
pub struct OwnOutputs {
    /// audio::microphone_recorder
    pub audio_block: Option<Leased<AudioBlock>>,
}

/// Main outputs that other instances read, too: written in the slot that those will read.
#[derive(Clone, Debug, Default, Deserialize, Outputs, Reflect, Serialize)]
pub struct SharedOutputs {
    /// audio::whistle_detection
    pub whistle_evidence: WhistleEvidence,
}

/// Computed only while somebody listens.
#[derive(Debug, Default)]
pub struct AdditionalOutputs {
    pub whistle_detection: AdditionalOutputsWhistleDetection,
}

#[derive(Debug, Default)]
pub struct AdditionalOutputsWhistleDetection {
    /// audio::whistle_detection
    pub peaks: AdditionalSlot<[SpectralPeak; MICROPHONE_COUNT]>,
}

/// Who listens to which additional output, decided once per cycle.
#[derive(Clone, Copy, Debug, Default, Deserialize, Serialize)]
pub struct Subscribed {
    pub whistle_detection_peaks: bool,
}

/// Values of clients in place of main outputs.
#[derive(Clone, Debug, Default, Deserialize, Outputs, Serialize)]
pub struct Injections {
    pub audio_block: Injection<Option<Leased<AudioBlock>>>,
    pub whistle_evidence: Injection<WhistleEvidence>,
}

impl InjectionTable for Injections {
    fn get_mut(&mut self, output: &str) -> Option<&mut dyn InjectionCell> {
        match output {
            "audio_block" => Some(&mut self.audio_block),
            "whistle_evidence" => Some(&mut self.whistle_evidence),
            _ => None,
        }
    }
}

/// Everything the nodes of one cycle may touch, borrowed.
pub struct Frame<'a, Hardware> {
    pub additional_outputs: &'a mut AdditionalOutputs,
    pub capture_time: &'a mut Option<Timestamp>,
    pub cycle: Cycle,
    pub hardware_interface: &'a Arc<Hardware>,
    pub injections: Option<&'a Injections>,
    pub own: &'a mut OwnOutputs,
    pub parameters: &'a Parameters,
    pub shared: &'a mut SharedOutputs,
    pub subscribed: Subscribed,
}
