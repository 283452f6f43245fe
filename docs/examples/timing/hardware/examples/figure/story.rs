//! What a recording says about its cycles: when each began, how long it took, and what Localization was given.

use std::collections::BTreeMap;

use hulkgen_recording::Recording;
use serde::Deserialize;
use timing_nodes::types::Sets;

/// The perception cyclers, in the order of [`Sets`].
pub(crate) const PERCEPTION: [&str; 3] = ["Vision", "Odometry", "Radio"];
/// Who consumes them.
pub(crate) const CONSUMER: &str = "Localization";
/// The channel that `--record-output` makes.
const SETS: &str = "Localization.main_outputs.sets";

/// A run.
#[derive(Debug, Default)]
pub(crate) struct Story {
    /// When the cycles of each instance began, seconds of the run.
    pub(crate) begins: BTreeMap<String, Vec<f64>>,
    /// Seconds that a cycle takes in virtual time, as the manifest in the recording says.
    pub(crate) durations: BTreeMap<String, f64>,
    /// What each cycle of Localization was given.
    pub(crate) sets: Vec<Sets>,
}

#[derive(Deserialize)]
struct Manifest {
    cycler: Vec<Cycler>,
}

#[derive(Deserialize)]
struct Cycler {
    name: String,
    lockstep_duration: Option<String>,
}

/// Reads it.
///
/// # Errors
/// Says what the recording lacks.
pub(crate) fn of(recording: &Recording) -> Result<Story, String> {
    let mut story = Story {
        durations: durations(recording)?,
        ..Story::default()
    };
    let topics: BTreeMap<u16, &str> = recording
        .channels
        .iter()
        .map(|(number, channel)| (*number, channel.topic.as_str()))
        .collect();
    let messages = recording.chunks.iter().flat_map(|chunk| chunk.messages());
    for message in messages {
        let topic = topics.get(&message.channel).copied().unwrap_or_default();
        if topic == SETS {
            let sets = serde_json::from_slice(message.data).map_err(|error| error.to_string())?;
            story.sets.push(sets);
        } else if let Some(instance) = topic.strip_prefix("frames/") {
            // The first byte: 0 where a cycle begins, 1 where it ends.
            if message.data.first() == Some(&0) {
                let begins = story.begins.entry(instance.to_owned()).or_default();
                begins.push(message.time as f64 / 1e9);
            }
        }
    }
    if story.sets.is_empty() {
        return Err(format!(
            "nothing of {SETS}: run with `--record-output {SETS}`"
        ));
    }
    story.sets.sort_by(|one, other| one.at.total_cmp(&other.at));
    for begins in story.begins.values_mut() {
        begins.sort_by(f64::total_cmp);
    }
    Ok(story)
}

/// From the manifest beside the frames.
fn durations(recording: &Recording) -> Result<BTreeMap<String, f64>, String> {
    let mut attachments = recording.attachments.iter();
    let manifest = attachments.find(|attachment| attachment.name == "hulk.toml");
    let manifest = manifest.ok_or("no hulk.toml in it")?;
    let text = String::from_utf8_lossy(&manifest.data);
    let manifest: Manifest = toml::from_str(&text).map_err(|error| error.to_string())?;
    let cyclers = manifest.cycler.into_iter().map(|cycler| {
        let text = cycler.lockstep_duration.unwrap_or_else(|| "0ms".to_owned());
        let millis = text
            .strip_suffix("ms")
            .and_then(|text| text.parse::<f64>().ok());
        let millis = millis.ok_or_else(|| format!("`{text}` of {} is not in ms", cycler.name))?;
        Ok((cycler.name, millis / 1000.0))
    });
    cyclers.collect()
}
