//! A recording of a whole robot.

use std::collections::BTreeMap;
use std::io::{self, ErrorKind};
use std::path::Path;
use std::sync::Arc;

use hulkgen_mcap::layout::{self, Layouts};
use hulkgen_recording::{
    Attachment, Channel, ChannelId, Counts, Description, Ended, Metadata, Recorder, Settings,
};

use super::condition::Conditions;
use super::disk;
use super::logs::{self, LOGS, LogRecorder};
use super::output::{self, OutputChannels};
use super::recorder::{CycleObserver, CycleRecorder, Wanted};
use super::{InstanceRecorded, Missing, PARAMETERS, RecordingReport, Types, VERSION};
use crate::cycler::{Instance, InstanceDescription, Record};
use crate::driver::Observer;
use crate::error::{Error, Result};
use crate::numerics;
use crate::report::tell;
use crate::robot::Robot;
use crate::subscriptions::Subscriptions;

/// Encoding of frames, and of values that they name.
pub(crate) const FRAMES: &str = "hulkgen-frames";
pub(crate) const VALUES: &str = "hulkgen-values";

/// The metadata entry of a channel of frames that names their types.
pub(crate) const TYPES: &str = "types";

/// What a recording says of its run.
#[derive(Clone, Debug, Default)]
pub struct About {
    /// Names and values of the metadata `run`.
    pub run: Vec<(String, String)>,
    /// Files: name, media type, content.
    pub files: Vec<(String, String, String)>,
    /// Outputs that get a channel of their own, as clients name them.
    pub outputs: Vec<String>,
}

/// A recording of a robot that runs.
pub struct Recording {
    recorder: Recorder,
    observers: BTreeMap<&'static str, Box<dyn Observer>>,
    /// Those that may be recorded; behind their counts stand those of other tracks.
    instances: Vec<&'static str>,
    logs: Option<LogRecorder>,
}

impl Recording {
    /// Creates the file, which must not exist, for a robot that has not run yet.
    ///
    /// # Errors
    /// If the file cannot be created, or a `record = { while = … }` names what its instance never
    /// writes, or what is no `bool`: then nothing is created.
    pub fn start<P>(
        path: &Path,
        robot: &Robot<P>,
        about: About,
        settings: Settings,
    ) -> Result<Self> {
        Self::start_with(path, robot, about, settings, |instance| instance.record)
    }

    /// As [`Recording::start`], of the cycles that `record_of` chooses instead of the manifest.
    ///
    /// # Errors
    /// As [`Recording::start`].
    pub fn start_with<P>(
        path: &Path,
        robot: &Robot<P>,
        about: About,
        settings: Settings,
        record_of: impl Fn(&InstanceDescription) -> Record,
    ) -> Result<Self> {
        let instances = robot.instances.iter();
        let descriptions: Vec<_> = instances
            .map(|instance| {
                let mut description = *instance.description();
                description.record = record_of(&description);
                description
            })
            .collect();
        let names: Vec<_> = descriptions.iter().map(|one| one.name).collect();
        let written: Vec<_> = names.iter().chain(robot.left_out).copied().collect();
        let types = robot.instances.iter().map(|instance| instance.types());
        let types: Vec<_> = types.collect();
        let outputs = output::find(&about.outputs, described(robot))?;
        let mut conditions = Conditions::of_all(robot, &descriptions)?;
        let types_file = types_file(robot, &types);
        let digests: Vec<_> = types.iter().map(Types::digest).collect();
        let mut description = describe(&descriptions, &digests, &written, about, types_file);
        let outputs = OutputChannels::add(outputs, &mut description);
        let of_logs = logs::add_channel(&mut description);
        let of_outputs = outputs.track_names();
        let of_outputs = of_outputs.iter().map(String::as_str);
        let all = names.iter().copied().chain(of_outputs).chain([LOGS]);
        let all: Vec<_> = all.collect();
        let rewrites = outputs.rewrites(tell);
        let (recorder, mut tracks) = disk::start(path, description, &all, settings, rewrites)
            .map_err(|error| cannot_record(path, error))?;
        let logs = tracks
            .pop()
            .map(|track| LogRecorder::start(track, of_logs, robot.clock.clone()));
        let mut of_outputs = outputs.recorders(tracks.split_off(names.len()));
        // Channels: frames of all instances, then values.
        let values = (names.len()..).map(|index| ChannelId(index as u16));
        let sources = written.into_iter().chain([PARAMETERS]);
        let channels: Arc<[_]> = sources.zip(values).collect();
        let mut observers: BTreeMap<_, Box<dyn Observer>> = BTreeMap::new();
        for (index, (track, one)) in tracks.into_iter().zip(&descriptions).enumerate() {
            let asked = conditions.asked_of(one.name);
            let frames = Wanted::new(one.record, &conditions.of(one.name)).map(|which| {
                let own = ChannelId(index as u16);
                let digests = robot.instances[index].digested().len();
                CycleRecorder::new(track, own, channels.clone(), which, digests)
            });
            let observer = CycleObserver {
                frames,
                outputs: of_outputs.remove(one.name),
                conditions: asked,
            };
            if !observer.is_idle() {
                observers.insert(one.name, Box::new(observer));
            }
        }
        Ok(Self {
            recorder,
            observers,
            instances: names,
            logs: logs.transpose()?,
        })
    }

    /// The observer of an instance, once.
    pub fn observer(&mut self, instance: &InstanceDescription) -> Option<Box<dyn Observer>> {
        self.observers.remove(instance.name)
    }

    /// The file.
    pub fn path(&self) -> &Path {
        self.recorder.path()
    }

    /// What became of each instance's frames, then of values of outputs (`INSTANCE.outputs`) and of log messages (`logs`),
    /// to be read while the robot runs.
    pub fn shared_counts(&self) -> Vec<(String, Arc<Counts>)> {
        self.recorder
            .counts()
            .map(|(of, counts)| (of.to_owned(), counts.clone()))
            .collect()
    }

    /// What became of the cycles so far, to be asked while the robot runs.
    pub fn counts(&self) -> Vec<InstanceRecorded> {
        let counts = self.recorder.counts().zip(&self.instances);
        counts
            .map(|((_, counts), instance)| InstanceRecorded {
                instance,
                wanted: counts.wanted(),
                recorded: counts.recorded(),
                dropped: counts.dropped(),
                failed: counts.failed(),
                lost: counts.lost(),
                overwritten: counts.overwritten(),
            })
            .collect()
    }

    /// Ends the file; observers that are gone by now have handed over everything.
    pub fn end(self) -> RecordingReport {
        self.end_by(Recorder::end_with)
    }

    /// As [`Self::end`], but waits for the disk only as long as it is told to go on, which it asks again and again.
    pub(crate) fn end_while(self, goes_on: impl FnMut() -> bool) -> RecordingReport {
        self.end_by(|recorder, metadata| recorder.end_while(metadata, goes_on))
    }

    fn end_by(mut self, end: impl FnOnce(Recorder, Vec<Metadata>) -> Ended) -> RecordingReport {
        self.observers.clear();
        // It hands over what was said last.
        self.logs = None;
        let mut instances = self.counts();
        let wanted = Metadata {
            name: "wanted".to_owned(),
            entries: instances
                .iter()
                .map(|one| (one.instance.to_owned(), one.wanted.to_string()))
                .collect(),
        };
        let mut counts = self.shared_counts();
        let others = counts.split_off(instances.len());
        let ended = end(self.recorder, vec![wanted]);
        // What the disk did not take, and what had to go for it, is known when all was written.
        for (one, (_, counts)) in instances.iter_mut().zip(counts) {
            one.lost = counts.lost();
            one.overwritten = counts.overwritten();
        }
        let others = others.into_iter().map(|(of, counts)| Missing {
            of,
            dropped: counts.dropped(),
            failed: counts.failed(),
            lost: counts.lost(),
        });
        let missing = others.filter(|one| one.dropped + one.failed + one.lost > 0);
        RecordingReport {
            ended,
            instances,
            missing: missing.collect(),
        }
    }
}

fn cannot_record(path: &Path, error: io::Error) -> Error {
    let why = match error.kind() {
        ErrorKind::AlreadyExists => ": it is there, and nothing is written over; name another file",
        _ => "",
    };
    Error::from(error).context(format!("cannot record into {}{why}", path.display()))
}

/// The instances with who listens to their additional outputs.
fn described<P>(robot: &Robot<P>) -> impl Iterator<Item = (&dyn Instance, &Subscriptions)> + Clone {
    robot.instances.iter().filter_map(|instance| {
        let name = instance.description().name;
        let access = robot.access.iter().find(|access| access.instance == name)?;
        Some((&**instance as &dyn Instance, &access.subscriptions))
    })
}

fn describe(
    instances: &[InstanceDescription],
    types: &[String],
    written: &[&'static str],
    About { mut run, files, .. }: About,
    types_file: (String, String, String),
) -> Description {
    let channel = |topic: String, encoding: &str, once_per_chunk| Channel {
        topic,
        schema: None,
        encoding: encoding.to_owned(),
        metadata: vec![("version".to_owned(), VERSION.to_string())],
        once_per_chunk,
    };
    let frames = instances.iter().zip(types).map(|(one, types)| {
        let mut channel = channel(format!("frames/{}", one.name), FRAMES, false);
        channel.metadata.push((TYPES.to_owned(), types.clone()));
        channel
    });
    let values = written.iter().chain([&PARAMETERS]);
    let values = values.map(|name| channel(format!("values/{name}"), VALUES, true));
    run.push(("numerics".to_owned(), numerics::fingerprint()));
    let of_std = numerics::fingerprint_of_std();
    run.push(("numerics_of_std".to_owned(), of_std));
    let record = instances
        .iter()
        .map(|one| (one.name.to_owned(), text_of(one.record)));
    Description {
        library: format!("hulkgen {}", env!("CARGO_PKG_VERSION")),
        schemas: Vec::new(),
        channels: frames.chain(values).collect(),
        metadata: vec![
            Metadata {
                name: "run".to_owned(),
                entries: run,
            },
            Metadata {
                name: "record".to_owned(),
                entries: record.collect(),
            },
        ],
        attachments: files
            .into_iter()
            .chain([types_file])
            .map(|(name, media_type, text)| Attachment {
                name,
                media_type,
                data: text.into_bytes(),
            })
            .collect(),
    }
}

/// All types, once; which outputs are images, and which have digests.
fn types_file<P>(robot: &Robot<P>, types: &[Types]) -> (String, String, String) {
    let digested = robot.instances.iter().map(|instance| {
        let names = instance.digested().iter();
        let names = names.map(|(node, output)| ((*node).to_owned(), (*output).to_owned()));
        (instance.description().name.to_owned(), names.collect())
    });
    let mut layouts = Layouts {
        digests: digested.collect(),
        images: output::images(described(robot)),
        ..Layouts::default()
    };
    for one in types {
        layouts.frames.insert(one.digest(), one.parts.clone());
        let values = one.values.iter();
        let values = values.map(|(name, layout)| ((*name).to_owned(), layout.clone()));
        layouts.values.extend(values);
    }
    // Names and numbers alone: they can always be written.
    let text = serde_json::to_string(&layouts).unwrap_or_default();
    let name = layout::ATTACHMENT.to_owned();
    (name, "application/json".to_owned(), text)
}

fn text_of(record: Record) -> String {
    match record {
        Record::On => "on".to_owned(),
        Record::Off => "off".to_owned(),
        Record::Every(cycles) => format!("every {cycles}"),
        Record::While { instance, path } => format!("while {instance}.{path}"),
    }
}
