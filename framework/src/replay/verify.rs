//! Whether every recorded cycle gives the same bits again.

use hulkgen_recording::Recording;

use super::difference::first_difference;
use super::play::{self, Player, Players};
use super::{Divergence, Ran, Replayable};
use crate::error::Result;
use crate::recorded::Stored;

/// What came of it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Verification {
    /// In manifest order.
    pub instances: Vec<InstanceVerified>,
    /// The earliest one.
    pub divergence: Option<Divergence>,
    /// Instances of the recording that this robot does not have or cannot replay.
    pub unknown: Vec<String>,
    /// Where it was recorded and where it was replayed, if numbers may differ.
    pub numerics: Option<(String, String)>,
}

/// What came of one instance.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct InstanceVerified {
    pub instance: String,
    /// What its `record` said.
    pub record: String,
    /// Cycles that were to be recorded; `None`: the recording did not end.
    pub wanted: Option<u64>,
    /// In the file.
    pub frames: u64,
    /// Not recorded, for whatever reason, although wanted.
    pub dropped: u64,
    /// Recomputed with the same digests.
    pub verified: u64,
    pub diverged: u64,
    /// Digests that were compared.
    pub outputs: u64,
    /// Cycles that were abandoned when they were recorded: there is nothing to compare.
    pub unfinished: u64,
    /// Cycles in which a node asked the hardware for something.
    pub needs_hardware: u64,
    /// Why a frame could not be replayed; those after it were not.
    pub unreadable: Option<String>,
}

impl InstanceVerified {
    /// Whether nothing of it was to be recorded.
    pub fn is_off(&self) -> bool {
        self.record == "off" || (self.record.starts_with("while ") && self.wanted == Some(0))
    }

    /// Whether all that could be compared is the same, and there was something.
    pub fn is_good(&self) -> bool {
        self.diverged == 0 && self.unreadable.is_none() && (self.verified > 0 || self.is_off())
    }
}

impl Verification {
    /// Whether every instance that is recorded was verified, and no cycle diverged.
    pub fn is_good(&self) -> bool {
        self.unknown.is_empty()
            && self.instances.iter().all(InstanceVerified::is_good)
            && self.instances.iter().any(|one| one.verified > 0)
    }
}

/// Recomputes every cycle of a recording.
///
/// # Errors
/// If the recording is of another version, or damaged.
pub fn verify(recording: &Recording, replayables: &[Replayable]) -> Result<Verification> {
    let values = play::value_channels(recording)?;
    let mut players = Players::new(recording, &values, replayables)?;
    let mut verification = Verification {
        unknown: players.unknown.clone(),
        numerics: other_numerics(recording),
        ..Verification::default()
    };
    for (player, chunks) in players.each() {
        let mut verified = described(recording, player.instance);
        let mut first = None;
        for position in 0..player.frames.len() {
            verified.frames += 1;
            if let Err(error) = one(player, position, chunks, &mut verified, &mut first) {
                let cycle = player.frames[position].head.number;
                verified.unreadable = Some(error.context(format!("cycle {cycle}")).to_string());
                break;
            }
        }
        verification.instances.push(verified);
        let earlier = |other: &Divergence| {
            verification
                .divergence
                .as_ref()
                .is_none_or(|known| other.at < known.at)
        };
        if let Some(divergence) = first.filter(earlier) {
            verification.divergence = Some(divergence);
        }
    }
    Ok(verification)
}

/// Recomputes one cycle and compares.
fn one(
    player: &mut Player<'_>,
    position: usize,
    chunks: &[Stored<'_>],
    verified: &mut InstanceVerified,
    first: &mut Option<Divergence>,
) -> Result<()> {
    let frame = player.frames[position];
    let Some(digests) = frame.digests() else {
        verified.unfinished += 1;
        return Ok(());
    };
    match player.play(position, chunks)? {
        Ran::NeedsHardware => verified.needs_hardware += 1,
        Ran::Failed(error) => {
            verified.diverged += 1;
            first.get_or_insert_with(|| Divergence::failed(player.instance, frame.head, error));
        }
        Ran::Finished => {
            let Some(replay) = player.replay() else {
                return Ok(());
            };
            let mut recorded = digests;
            let (mut same, mut outputs) = (true, 0);
            let digested = replay.instance().digests(&mut |node, output, digest| {
                outputs += 1;
                let wanted = recorded.next();
                if wanted == Some(digest) {
                    return;
                }
                same = false;
                first.get_or_insert_with(|| {
                    let mut divergence =
                        Divergence::of(player.instance, frame.head, (node, output), wanted, digest);
                    compare(&mut divergence, replay, chunks);
                    divergence
                });
            });
            if let Err(error) = digested {
                return Err(crate::error::Error::new(error.to_string()));
            }
            verified.outputs += outputs;
            *(if same {
                &mut verified.verified
            } else {
                &mut verified.diverged
            }) += 1;
        }
    }
    Ok(())
}

/// Adds both values, as far as they are known.
fn compare(divergence: &mut Divergence, replay: &dyn super::Replay, chunks: &[Stored<'_>]) {
    let value = replay.instance().main_output(&divergence.output);
    divergence.recomputed = value.and_then(|value| serde_json::to_value(value.as_serialize()).ok());
    let Some(wanted) = divergence.digests.0 else {
        return;
    };
    let mut written = chunks
        .iter()
        .filter_map(|chunk| chunk.bytes(divergence.instance, divergence.cycle));
    divergence.recorded =
        written.find_map(|bytes| replay.recorded(bytes, &divergence.output, wanted));
    if let (Some(recorded), Some(recomputed)) = (&divergence.recorded, &divergence.recomputed) {
        divergence.path = first_difference(recorded, recomputed);
    }
}

/// What the recording itself says of an instance.
fn described(recording: &Recording, instance: &str) -> InstanceVerified {
    let said = |metadata: &str, key: &str| {
        let entries = &recording.metadata(metadata)?.entries;
        let entry = entries.iter().find(|(known, _)| known == key);
        entry.map(|(_, value)| value.clone())
    };
    let count = |what: &str| -> u64 {
        let said = said("end", &format!("{instance}.{what}"));
        said.and_then(|count| count.parse().ok())
            .unwrap_or_default()
    };
    InstanceVerified {
        instance: instance.to_owned(),
        record: said("record", instance).unwrap_or_default(),
        wanted: said("wanted", instance).and_then(|count| count.parse().ok()),
        dropped: count("dropped") + count("failed") + count("lost"),
        ..InstanceVerified::default()
    }
}

fn other_numerics(recording: &Recording) -> Option<(String, String)> {
    let here = crate::numerics::fingerprint();
    let run = &recording.metadata("run")?.entries;
    let (_, there) = run.iter().find(|(key, _)| key == "numerics")?;
    (*there != here).then(|| (there.clone(), here))
}
