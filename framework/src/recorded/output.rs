//! Outputs in channels of their own, for whoever reads the recording without hulkgen.
//!
//! The cycler writes the value as frames are written; the thread that owns the file makes JSON of it.

use std::collections::BTreeMap;
use std::fmt::Arguments;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use hulkgen_recording::{
    Channel, ChannelId, Description, Recorded, Rewrite, Rewrites, Rewritten, Schema, Track,
};
use serde_json::Value;

use super::{SaveError, Saving};
use crate::cycler::Instance;
use crate::data::Data;
use crate::error::{Error, Result};
use crate::reflect::{Reflect, Shape};
use crate::subscriptions::Subscriptions;
use crate::tap::{OutputKind, OutputVisitor};
use crate::time::Timestamp;

/// Encoding of channels of outputs.
pub(crate) const JSON: &str = "json";

/// Tells how each output of an instance is written, whatever its type.
#[derive(Default)]
pub struct Forms {
    forms: Vec<Form>,
}

#[derive(Clone, Copy)]
struct Form {
    schema: fn() -> Schema,
    rewrite: fn(u64, &[u8], &mut Vec<u8>) -> Result<bool>,
    shape: fn() -> Shape,
}

impl<'a> OutputVisitor<'a> for Forms {
    fn output<T: Data>(&mut self, _: Option<&'a T>) {
        self.forms.push(Form {
            schema: schema::<T>,
            rewrite: rewrite::<T>,
            shape: T::shape,
        });
    }
}

fn schema<T: Data>() -> Schema {
    let (name, json): (String, Value) = match T::foxglove() {
        Some(form) => (form.schema.name.to_owned(), (form.schema.json)()),
        None => {
            let shape = T::shape();
            (shape.type_name.to_owned(), shape.json_schema())
        }
    };
    Schema {
        name,
        encoding: "jsonschema".to_owned(),
        data: json.to_string().into_bytes(),
    }
}

/// Makes JSON of a recorded value; false: it has no such form now.
fn rewrite<T: Data>(time: u64, recorded: &[u8], json: &mut Vec<u8>) -> Result<bool> {
    let value: T = postcard::from_bytes(recorded)
        .map_err(|error| Error::new(format!("it cannot be read back ({error})")))?;
    match T::foxglove() {
        None => serde_json::to_writer(json, &value)?,
        Some(form) => match (form.write)(&value, Timestamp::from_nanos(time)) {
            Some(form) => serde_json::to_writer(json, &form)?,
            None => return Ok(false),
        },
    }
    Ok(true)
}

/// The channels of all outputs that are to be recorded.
pub(super) struct OutputChannels {
    channels: Vec<(ChannelId, Wanted)>,
    /// Sorted, once.
    instances: Vec<&'static str>,
}

impl OutputChannels {
    /// Behind the channels that there are.
    pub(super) fn add(outputs: Vec<Wanted>, description: &mut Description) -> Self {
        let mut instances: Vec<_> = outputs.iter().map(|output| output.instance).collect();
        instances.sort_unstable();
        instances.dedup();
        let mut channels = Vec::new();
        for output in outputs {
            let schema = description.schemas.len() as u16;
            let channel = ChannelId(description.channels.len() as u16);
            description.schemas.push((output.form.schema)());
            description.channels.push(Channel {
                topic: output.topic(),
                schema: Some(schema),
                encoding: JSON.to_owned(),
                metadata: Vec::new(),
                once_per_chunk: false,
            });
            channels.push((channel, output));
        }
        Self {
            channels,
            instances,
        }
    }

    /// What the tracks of outputs are called, one for each instance that has some.
    pub(super) fn track_names(&self) -> Vec<String> {
        let instances = self.instances.iter();
        instances.map(|name| format!("{name}.outputs")).collect()
    }

    /// What makes JSON of each; where it cannot, that is told once.
    pub(super) fn rewrites(&self, told: fn(Arguments<'_>)) -> Rewrites {
        let channels = self.channels.iter();
        channels
            .map(|(channel, output)| (*channel, output.rewrite(told)))
            .collect()
    }

    /// By instance, with their tracks.
    pub(super) fn recorders(self, tracks: Vec<Track>) -> BTreeMap<&'static str, OutputRecorder> {
        let Self {
            channels,
            instances,
        } = self;
        let instances = instances.into_iter().zip(tracks);
        let recorders = instances.map(|(name, track)| {
            let own = channels
                .iter()
                .filter(|(_, output)| output.instance == name);
            let outputs = own.map(|(channel, output)| (output.clone(), *channel));
            let outputs = outputs.collect();
            (name, OutputRecorder { track, outputs })
        });
        recorders.collect()
    }
}

/// Some outputs of one instance on their way into the recording.
pub(super) struct OutputRecorder {
    track: Track,
    /// With the channel of each.
    outputs: Arc<[(Wanted, ChannelId)]>,
}

/// An output that is to be recorded.
#[derive(Clone)]
pub(super) struct Wanted {
    instance: &'static str,
    name: &'static str,
    kind: OutputKind,
    form: Form,
}

/// The outputs that these paths name: `Control.main_outputs.steps`.
///
/// # Errors
/// If there is no such output.
pub(super) fn find<'a>(
    paths: &[String],
    instances: impl Iterator<Item = (&'a dyn Instance, &'a Subscriptions)> + Clone,
) -> Result<Vec<Wanted>> {
    let mut found: Vec<Wanted> = Vec::new();
    for path in paths {
        if found.iter().any(|one| one.topic() == *path) {
            continue;
        }
        let mut known = Vec::new();
        for (instance, subscriptions) in instances.clone() {
            known.extend(all(instance, subscriptions));
        }
        let place = known.iter().position(|one| one.topic() == *path);
        let wanted = place.map(|place| known.swap_remove(place)).ok_or_else(|| {
            let mut names: Vec<_> = known.iter().map(Wanted::topic).collect();
            names.sort();
            Error::new(format!(
                "no output is called `{path}`; there are {}",
                names.join(", ")
            ))
        })?;
        if wanted.kind == OutputKind::Additional {
            let mut instances = instances.clone();
            let own = instances.find(|(one, _)| one.description().name == wanted.instance);
            if let Some((_, subscriptions)) = own {
                subscriptions.subscribe(wanted.name);
            }
        }
        found.push(wanted);
    }
    Ok(found)
}

/// Main outputs that are images, as clients name them, and what their pixels are called.
pub(super) fn images<'a>(
    instances: impl Iterator<Item = (&'a dyn Instance, &'a Subscriptions)>,
) -> BTreeMap<String, String> {
    let outputs = instances.flat_map(|(instance, subscriptions)| all(instance, subscriptions));
    let main = outputs.filter(|output| output.kind == OutputKind::Main);
    main.filter_map(|output| {
        Some((
            output.topic(),
            (output.form.shape)().image()?.name().to_owned(),
        ))
    })
    .collect()
}

/// What values of the output look like with which a path begins, and the rest of the path.
pub(crate) fn shape_of<'p>(
    instance: &dyn Instance,
    subscriptions: &Subscriptions,
    path: &'p str,
) -> Option<(Shape, &'p str)> {
    let outputs = all(instance, subscriptions).into_iter();
    let found = outputs.filter_map(|output| {
        let below = path.strip_prefix(&output.topic())?;
        (below.is_empty() || below.starts_with('.')).then_some((output, below))
    });
    // Names of outputs may have dots themselves, so the longest is the output.
    let (output, below) = found.min_by_key(|(_, below)| below.len())?;
    Some(((output.form.shape)(), below.trim_start_matches('.')))
}

fn all(instance: &dyn Instance, subscriptions: &Subscriptions) -> Vec<Wanted> {
    let mut forms = Forms::default();
    instance.forms(&mut forms);
    let main = instance.main_outputs().iter();
    let main = main.map(|name| (*name, OutputKind::Main));
    let additional = subscriptions.names().iter();
    let names = main.chain(additional.map(|name| (*name, OutputKind::Additional)));
    names
        .zip(forms.forms)
        .map(|((name, kind), form)| Wanted {
            instance: instance.description().name,
            name,
            kind,
            form,
        })
        .collect()
}

impl Wanted {
    /// What its channel is called, as clients name it.
    fn topic(&self) -> String {
        let kind = match self.kind {
            OutputKind::Main => "main_outputs",
            OutputKind::Additional => "additional_outputs",
        };
        format!("{}.{kind}.{}", self.instance, self.name)
    }

    /// As [`OutputChannels::rewrites`].
    fn rewrite(&self, told: fn(Arguments<'_>)) -> Rewrite {
        let (topic, rewrite) = (self.topic(), self.form.rewrite);
        let is_told = AtomicBool::new(false);
        Arc::new(
            move |time, recorded, json| match rewrite(time, recorded, json) {
                Ok(true) => Rewritten::Whole,
                Ok(false) => Rewritten::Absent,
                Err(error) => {
                    if !is_told.swap(true, Ordering::Relaxed) {
                        told(format_args!(
                            "recording: `{topic}` cannot be written, its values are lost: {error}; what its type's `Serialize` gives must be readable by its `Deserialize` (no `untagged`, no `flatten`), and be JSON"
                        ));
                    }
                    Rewritten::Lost
                }
            },
        )
    }

    fn value<'i>(&self, instance: &'i dyn Instance) -> Option<&'i dyn Reflect> {
        match self.kind {
            OutputKind::Main => instance.main_output(self.name),
            OutputKind::Additional => instance.additional_output(self.name),
        }
    }
}

impl OutputRecorder {
    /// Writes the outputs of the cycle that has just finished, each in a frame of its own.
    pub(super) fn finished(&mut self, instance: &dyn Instance) {
        let cycle = instance.cycle();
        let time = cycle.time.start.as_nanos();
        for (wanted, channel) in self.outputs.iter() {
            let Some(value) = wanted.value(instance) else {
                self.track.pass(time);
                continue;
            };
            // Counted where it is dropped or cannot be written.
            let _: Recorded<SaveError> = self.track.frame(time, 0, |frame| {
                frame.message(*channel, cycle.number as u32, time, |writing| {
                    let mut saving = Saving::new(writing);
                    if !saving.leave(value.handle()) {
                        saving.put(value.as_serialize());
                    }
                    saving.end()
                })
            });
        }
    }
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::AtomicUsize;

    use serde::{Deserialize, Serialize};

    use super::*;
    use framework_macros::Reflect;

    /// Written without a word of which it is, and so not to be read back.
    #[derive(Clone, Debug, Deserialize, PartialEq, Reflect, Serialize)]
    #[serde(untagged)]
    enum Untagged {
        Number(u32),
        Text(String),
    }

    impl Default for Untagged {
        fn default() -> Self {
            Self::Text("none".to_owned())
        }
    }

    static TOLD: AtomicUsize = AtomicUsize::new(0);

    fn rewrite<T: Data>(told: fn(Arguments<'_>)) -> Rewrite {
        let mut forms = Forms::default();
        forms.output::<T>(None);
        let wanted = Wanted {
            instance: "Control",
            name: "steps",
            kind: OutputKind::Main,
            form: forms.forms[0],
        };
        wanted.rewrite(told)
    }

    #[test]
    fn what_cannot_be_read_back_is_lost_and_told_once() {
        let rewrite = rewrite::<Untagged>(|message| {
            let message = message.to_string();
            assert!(
                message.contains("`Control.main_outputs.steps`"),
                "{message}"
            );
            assert!(message.contains("untagged"), "{message}");
            TOLD.fetch_add(1, Ordering::Relaxed);
        });
        let recorded = postcard::to_allocvec(&Untagged::Number(3)).expect("it has a form");
        for _ in 0..3 {
            assert_eq!(rewrite(0, &recorded, &mut Vec::new()), Rewritten::Lost);
            assert_eq!(TOLD.load(Ordering::Relaxed), 1);
        }
    }

    #[test]
    fn what_can_be_is_json() {
        let rewrite = rewrite::<Option<u32>>(|message| panic!("{message}"));
        let recorded = postcard::to_allocvec(&Some(3_u32)).expect("it has a form");
        let mut json = Vec::new();
        assert_eq!(rewrite(0, &recorded, &mut json), Rewritten::Whole);
        assert_eq!(json, b"3");
    }
}
