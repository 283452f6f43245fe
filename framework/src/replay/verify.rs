//! Whether every recorded cycle gives the same bits again.

use hulkgen_recording::{Contents, Recording};

use super::difference::first_difference;
use super::output_channels::recorded_output;
use super::tolerance::{TOLERANCE, first_beyond, is_within};
use super::{Chunks, Divergence, Needed, Player, Players, Ran, Replayable, Shelf};
use crate::error::{Error, Result};
use crate::numerics;

/// How a recording is verified.
#[derive(Clone, Debug, Default)]
pub struct How {
    /// Of one node and what it needs; `None`: of all nodes.
    pub needed: Option<Needed>,
    /// How much numbers may differ where it was recorded with other numerics: relative, absolute below 1. 0: not at all, bits
    /// are compared. `None`: by [`TOLERANCE`] where [`crate::math`] gave other bits, else not at all.
    pub tolerance: Option<f64>,
    /// The digest of this robot's graph, as recordings have it; `None`: it does not matter.
    pub graph: Option<String>,
}

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
    /// The same of nodes that call std's elementary functions in place of [`crate::math`].
    pub numerics_of_std: Option<(String, String)>,
    /// Graphs where it was recorded and where it was replayed, if they are not the same.
    pub graph: Option<(String, String)>,
    /// That was asked for.
    pub tolerance: Option<f64>,
    /// Within which numbers were compared; `None`: bits were.
    pub compared_within: Option<f64>,
    /// By instance, if not all of it: which nodes were run.
    pub recomputed: Vec<(String, Vec<String>)>,
    /// Offsets of chunks that are damaged: nobody knows what they had.
    pub damaged: Vec<u64>,
    /// Whether the run ended and everything of it was recorded.
    pub is_complete: bool,
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
    /// Recorded, and left to younger ones when the file had its budget.
    pub overwritten: u64,
    /// Recomputed with the same digests, or within the tolerance in all that can be compared within it.
    pub verified: u64,
    pub diverged: u64,
    /// Digests that were compared.
    pub outputs: u64,
    /// Outputs with other bits, the same within the tolerance.
    pub within: u64,
    /// Outputs with other bits of which the recording has digests alone: they cannot be compared within the tolerance.
    pub not_compared: u64,
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
        self.record == "off" || self.was_never_asked_for()
    }

    /// Whether it is recorded while an output says so, which never did. A file that breaks off says so by having no frame.
    pub fn was_never_asked_for(&self) -> bool {
        let has_none = self.wanted.map_or(self.frames == 0, |wanted| wanted == 0);
        self.record.starts_with("while ") && has_none
    }

    /// Whether it had no cycle in this run that was to be recorded.
    pub fn had_no_cycle(&self) -> bool {
        self.wanted == Some(0) && self.frames == 0
    }

    /// Whether all of its frames left the file to younger ones of others.
    pub fn is_overwritten(&self) -> bool {
        let is_none_left = self.wanted == Some(self.overwritten + self.dropped);
        self.frames == 0 && self.overwritten > 0 && is_none_left
    }

    /// Whether the file has nothing of it, as it should be.
    fn has_nothing_to_verify(&self) -> bool {
        self.is_off() || self.had_no_cycle() || self.is_overwritten()
    }

    /// Whether all that could be compared is the same, and there was something, if the file should have something.
    pub fn is_good(&self) -> bool {
        let is_verified = self.verified > 0 || self.has_nothing_to_verify();
        self.diverged == 0 && self.unreadable.is_none() && is_verified
    }
}

impl Verification {
    /// The tolerance that applies.
    fn tolerance(&self) -> Option<f64> {
        let is_of_std = self.numerics_of_std.is_some();
        let applies = match (&self.numerics, self.tolerance) {
            (Some(_), asked) => asked.or(Some(TOLERANCE)),
            // Whoever calls no such function computes the same bits.
            (None, asked) => asked.filter(|_| is_of_std),
        };
        applies.filter(|tolerance| *tolerance > 0.0)
    }

    /// Whether every instance of which the file has frames, or should have, was verified, no cycle diverged, and no chunk is
    /// damaged. What was not recorded, or is behind the place where the file breaks off, is not judged.
    pub fn is_good(&self) -> bool {
        self.unknown.is_empty()
            && self.damaged.is_empty()
            && self.instances.iter().all(InstanceVerified::is_good)
            && self.instances.iter().any(|one| one.verified > 0)
    }
}

/// Recomputes every cycle of a recording that is in memory.
///
/// # Errors
/// If the recording is of another version, or damaged.
pub fn verify(recording: &Recording, replayables: &[Replayable]) -> Result<Verification> {
    verify_how(&Shelf::of(recording)?, replayables, &How::default())
}

/// Recomputes every cycle of a recording, or what one node needs of it.
///
/// # Errors
/// If a frame cannot be understood.
pub fn verify_how(
    recording: &Shelf,
    replayables: &[Replayable],
    how: &How,
) -> Result<Verification> {
    let mut players = Players::new(recording, replayables)?;
    let contents = recording.contents();
    let mut verification = Verification {
        unknown: players.unknown.clone(),
        numerics: other_numerics(contents, "numerics", numerics::fingerprint()),
        numerics_of_std: other_numerics(
            contents,
            "numerics_of_std",
            numerics::fingerprint_of_std(),
        ),
        graph: other_graph(contents, how),
        tolerance: how.tolerance,
        damaged: recording.damaged().to_vec(),
        is_complete: recording.is_complete(),
        ..Verification::default()
    };
    verification.compared_within = verification.tolerance();
    if let Some(needed) = &how.needed {
        players = players.only(needed);
        let all = needed.all();
        verification.recomputed = all
            .map(|(instance, nodes)| (instance.to_owned(), nodes.to_vec()))
            .collect();
    }
    for (verified, first) in compared(&mut players, how, verification.compared_within) {
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

/// What came of each instance, and its first divergence.
fn compared(
    players: &mut Players<'_>,
    how: &How,
    tolerance: Option<f64>,
) -> Vec<(InstanceVerified, Option<Divergence>)> {
    let chunks = players.chunks();
    let comparing = players.players.iter().map(|player| Comparing {
        chunks,
        node: how.needed.as_ref().map(|needed| needed.node.as_str()),
        tolerance,
        verified: InstanceVerified {
            frames: player.frames.len() as u64,
            ..described(chunks.shelf.contents(), player.instance)
        },
        first: None,
    });
    let mut comparing: Vec<_> = comparing.collect();
    // All cycles of a chunk, whosever they are, before the next chunk is read.
    for (index, position) in players.in_file_order() {
        let (player, comparing) = (&mut players.players[index], &mut comparing[index]);
        if comparing.verified.unreadable.is_some() {
            continue;
        }
        if let Err(error) = comparing.one(player, position) {
            let cycle = player.frames[position].head.number;
            let reason = error.context(format!("cycle {cycle}")).to_string();
            comparing.verified.unreadable = Some(reason);
        }
    }
    let all = comparing.into_iter().zip(&players.players);
    let all = all.map(|(comparing, player)| {
        let mut verified = comparing.verified;
        if !player.is_known {
            verified.unreadable = Some("the recording has no such instance".to_owned());
        }
        (verified, comparing.first)
    });
    all.collect()
}

/// The comparison of one instance.
struct Comparing<'a> {
    chunks: Chunks<'a>,
    /// The only node whose outputs are compared.
    node: Option<&'a str>,
    /// If it applies.
    tolerance: Option<f64>,
    verified: InstanceVerified,
    first: Option<Divergence>,
}

/// What there is to say of an output whose bits differ.
enum Differs {
    Within,
    /// Its value was not recorded.
    Unknown,
    Diverged(Box<Divergence>),
}

impl Comparing<'_> {
    /// Recomputes one cycle and compares.
    fn one(&mut self, player: &mut Player<'_>, position: usize) -> Result<()> {
        let frame = player.frames[position];
        let Some(recorded) = player.digests(position, self.chunks)? else {
            self.verified.unfinished += 1;
            return Ok(());
        };
        match player.play(position, self.chunks)? {
            Ran::NeedsHardware => {
                self.verified.needs_hardware += 1;
                return Ok(());
            }
            Ran::Failed(error) => {
                self.verified.diverged += 1;
                let failed = || Divergence::failed(player.instance, frame.head, error);
                self.first.get_or_insert_with(failed);
                return Ok(());
            }
            Ran::Finished => {}
        }
        let Some(replay) = player.replay() else {
            return Ok(());
        };
        let mut recorded = same_outputs(recorded, replay.instance().digested())?;
        let (mut diverged, mut outputs, mut not_compared) = (false, 0, 0);
        let mut unread = None;
        let digested = replay.instance().digests(&mut |node, output, digest| {
            let wanted = recorded.next();
            if self.node.is_some_and(|asked| asked != node) {
                return;
            }
            outputs += 1;
            // Where it diverged already, one output says enough.
            if wanted == Some(digest) || (diverged && self.tolerance.is_none()) {
                return;
            }
            let found = Divergence::of(player.instance, frame.head, (node, output), wanted, digest);
            match self.judged(found, replay) {
                Err(error) => unread = Some(error),
                Ok(Differs::Within) => self.verified.within += 1,
                Ok(Differs::Unknown) => not_compared += 1,
                Ok(Differs::Diverged(found)) => {
                    diverged = true;
                    self.first.get_or_insert(*found);
                }
            }
        });
        digested.map_err(|error| Error::new(error.to_string()))?;
        if let Some(error) = unread {
            return Err(error);
        }
        self.verified.outputs += outputs;
        self.verified.not_compared += not_compared;
        self.verified.diverged += u64::from(diverged);
        // That a cycle finishes is all there is to it where it writes nothing.
        let is_compared = outputs == 0 || not_compared < outputs;
        self.verified.verified += u64::from(!diverged && is_compared);
        Ok(())
    }

    fn judged(&self, mut found: Divergence, replay: &dyn super::Replay) -> Result<Differs> {
        if self.tolerance.is_some() || self.first.is_none() {
            compare(&mut found, replay, self.chunks.shelf)?;
        }
        if let (Some(recorded), Some(recomputed)) = (&found.recorded, &found.recomputed) {
            found.path = match self.tolerance {
                Some(tolerance) => first_beyond(recorded, recomputed, tolerance),
                None => first_difference(recorded, recomputed),
            };
        }
        Ok(match (self.tolerance, &found.recorded, &found.recomputed) {
            (Some(_), None, _) => Differs::Unknown,
            (Some(tolerance), Some(recorded), Some(recomputed))
                if is_within(recorded, recomputed, tolerance) =>
            {
                Differs::Within
            }
            _ => Differs::Diverged(Box::new(found)),
        })
    }
}

/// Adds both values, as far as they are known.
fn compare(
    divergence: &mut Divergence,
    replay: &dyn super::Replay,
    recording: &Shelf,
) -> Result<()> {
    let value = replay.instance().main_output(&divergence.output);
    divergence.recomputed = value.and_then(|value| serde_json::to_value(value.as_serialize()).ok());
    let Some(wanted) = divergence.digests.0 else {
        return Ok(());
    };
    let (instance, output, cycle) = (divergence.instance, &divergence.output, divergence.cycle);
    if let Some(channel) = recording.channel(instance) {
        // Whatever chunk has it: that of a cycle that read it.
        for place in recording.index().everywhere((channel, cycle as u32)) {
            let written = recording.bytes(place)?;
            divergence.recorded = replay.recorded(&written, output, wanted);
            if divergence.recorded.is_some() {
                return Ok(());
            }
        }
    }
    divergence.recorded = recorded_output(recording, (instance, output), cycle)?;
    if divergence.recorded.is_some() {
        // Text has another `f64` for an `f32` than the number itself: both were text.
        let text = value.and_then(|value| serde_json::to_vec(value.as_serialize()).ok());
        divergence.recomputed = text.and_then(|text| serde_json::from_slice(&text).ok());
    }
    Ok(())
}

/// The digests of a cycle, which are in the order of its outputs.
fn same_outputs(
    recorded: Vec<u64>,
    here: &[(&str, &str)],
) -> Result<impl Iterator<Item = u64> + use<>> {
    if recorded.len() != here.len() {
        return Err(Error::new(format!(
            "the recording has {} outputs of it, this robot {}: it is of another graph",
            recorded.len(),
            here.len()
        )));
    }
    Ok(recorded.into_iter())
}

/// What the recording itself says of an instance.
fn described(recording: &Contents, instance: &str) -> InstanceVerified {
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
        overwritten: count("overwritten"),
        ..InstanceVerified::default()
    }
}

/// What the recording says under `key`, and what is the case here, if that is something else.
fn other_numerics(recording: &Contents, key: &str, here: String) -> Option<(String, String)> {
    let run = &recording.metadata("run")?.entries;
    let (_, there) = run.iter().find(|(known, _)| known == key)?;
    (*there != here).then(|| (there.clone(), here))
}

fn other_graph(recording: &Contents, how: &How) -> Option<(String, String)> {
    let here = how.graph.clone()?;
    let run = &recording.metadata("run")?.entries;
    let (_, there) = run.iter().find(|(key, _)| key == "graph")?;
    (*there != here).then(|| (there.clone(), here))
}
