//! Cycler `Audio` in a recording: what its cycles take, saved and given back.
//!
//! Written by `hulkgen generate` from hulk.toml and the nodes it names. Do not edit.

use std::sync::Arc;

use framework::Body;
use framework::Clock;
use framework::Cycler;
use framework::Guarded;
use framework::Injected;
use framework::OnFailure;
use framework::Result;
use framework::Slots;
use framework::Subscriptions;
use framework::Swap;
use framework::Timestamp;
use framework::Writer;
use framework::buffer;
use framework::buffer_of;
use framework::recorded::Describing;
use framework::recorded::Digests;
use framework::recorded::Loaded;
use framework::recorded::Loading;
use framework::recorded::Recorded;
use framework::recorded::SaveError;
use framework::recorded::Saving;
use framework::recorded::Stored;
use framework::recorded::Values;
use framework::replay::Alone;
use framework::replay::Replay;
use hardware::MicrophoneInterface;

use crate::cyclers::audio::Nodes;
use crate::databases::audio::AdditionalOutputs;
use crate::databases::audio::Injections;
use crate::databases::audio::SharedOutputs;
use crate::databases::audio::Subscribed;
use crate::parameters::Parameters;
use crate::recording::Sink;
use crate::runtime::audio::ADDITIONAL_OUTPUTS;
use crate::runtime::audio::AUDIO;
use crate::runtime::audio::Audio;

/// In a replay: who writes what an instance reads.
pub struct Outside {
    pub injections: Writer<Injected<Injections>>,
    pub parameters: Writer<Parameters>,
}

impl<Hardware: MicrophoneInterface + Send + Sync> Recorded for Audio<Hardware> {
    type Outside = Outside;
    const DIGESTED: &'static [(&'static str, &'static str)] = &[
        ("audio::whistle_detection", "whistle_evidence"),
    ];

    fn values(&self, values: &mut Values<'_, '_>) -> Result<(), SaveError> {
        values.parameters(&self.parameters)?;
        Ok(())
    }

    fn save(
        &self,
        _cycle: u64,
        _slots: Slots<'_, SharedOutputs>,
        _since: Option<Timestamp>,
        out: &mut Saving<'_, '_>,
    ) {
        self.parameters.save_version(out);
        self.nodes.microphone_recorder.record(out);
        self.nodes.whistle_detection.record(out);
        self.injections.save_injected(out);
        out.output(&self.own.current().audio_block);
        out.put(&self.subscribed);
    }

    fn describe(types: &mut Describing<Self>) {
        types.parameters(|body| &body.parameters);
        types.node("audio::microphone_recorder", |body| &body.nodes.microphone_recorder);
        types.node("audio::whistle_detection", |body| &body.nodes.whistle_detection);
        types.injections(|body| &body.injections);
        types.output("audio_block", |body| &body.own.current().audio_block);
        types.subscribed(|body| &body.subscribed);
    }

    fn load(
        &mut self,
        _cycle: u64,
        _slots: Loaded<'_, SharedOutputs>,
        outside: &mut Outside,
        from: &mut Loading<'_>,
        stored: &Stored<'_>,
    ) -> Result<()> {
        self.parameters.load_version(from, &mut outside.parameters, stored)?;
        self.nodes = load_nodes(from)?;
        self.injections.load_injected(from, &mut outside.injections)?;
        self.own.both_to_load().0.audio_block = from.take()?;
        let recorded: Subscribed = from.take()?;
        let mut wanted = self.subscriptions.wanted();
        self.subscribed = Subscribed {
            whistle_detection_peaks: wanted.next_one()
                || recorded.whistle_detection_peaks,
        };
        Body::restore(self)?;
        Ok(())
    }

    fn digests(&self, shared: &SharedOutputs, digests: &mut Digests<'_, '_>) {
        digests.add(&shared.whistle_evidence);
    }
}

/// The nodes as `save` wrote them, in manifest order.
fn load_nodes(from: &mut Loading<'_>) -> Result<Nodes> {
    Ok(Nodes {
        microphone_recorder: Guarded::recorded(
            "audio::microphone_recorder",
            OnFailure::Restart,
            from,
        )?,
        whistle_detection: Guarded::recorded(
            "audio::whistle_detection",
            OnFailure::Restart,
            from,
        )?,
    })
}

/// `Audio` alone, with the nodes of the frame that is loaded first.
pub fn replay_audio(
    from: &mut Loading<'_>,
    stored: &Stored<'_>,
) -> Result<Box<dyn Replay>> {
    let start: Parameters = stored.parameters(from)?;
    let (parameters_writer, [parameters_for_audio], []) = buffer_of(
        || start.clone(),
        [],
    );
    let hardware = Arc::new(Sink);
    let (injections_writer, [audio_injected], []) = buffer([]);
    let audio_subscriptions = Subscriptions::new(ADDITIONAL_OUTPUTS);
    let (writer, [], []) = buffer([]);
    let cycler = Cycler::new(
        AUDIO,
        Audio {
            nodes: load_nodes(from)?,
            additional_outputs: AdditionalOutputs::default(),
            capture_time: None,
            hardware_interface: hardware.clone(),
            injections: audio_injected,
            own: Swap::default(),
            parameters: parameters_for_audio,
            subscribed: Subscribed::default(),
            subscriptions: audio_subscriptions.clone(),
        },
        writer,
        Clock::stepped(),
    );
    Ok(
        Box::new(
            Alone::new(
                cycler,
                Outside {
                    injections: injections_writer,
                    parameters: parameters_writer,
                },
                audio_subscriptions,
            ),
        ),
    )
}
