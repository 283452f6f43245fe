//! Values of a recording by path: outputs, states of nodes, parameters.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

use camino::Utf8Path;
use hulkgen_mcap::layout::{Layout, Layouts, Part, PartKind, Values};
use hulkgen_mcap::{Channel, Message, ReadError, RecordingFile};
use serde_json::Value;

use super::{FRAMES, JSON, LOGS, TYPES, VALUES};
use crate::diagnostics::suggestion;
use crate::outcome::Refusal;

/// What is wanted of a recording.
#[derive(Clone, Debug, Default)]
pub struct Selection {
    /// Outputs or parts of them; none: all outputs.
    pub paths: Vec<String>,
    pub span: Span,
}

/// Cycles and times that are wanted.
#[derive(Clone, Debug, Default)]
pub struct Span {
    /// By the cycles of each instance.
    pub cycles: Option<Range<u64>>,
    /// In nanoseconds of the run.
    pub times: Option<Range<u64>>,
}

/// One value.
#[derive(Clone, Debug, PartialEq)]
pub struct Found {
    /// `Control.main_outputs.ball.position`.
    pub path: String,
    /// Of the instance; of parameters their version.
    pub cycle: u64,
    /// In nanoseconds of the run.
    pub time: u64,
    pub value: Value,
}

/// What became of a selection.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[must_use]
pub struct Shown {
    /// Paths that had no value.
    silent: Vec<String>,
    /// Offsets of chunks that are damaged: what they had is missing.
    damaged: Vec<u64>,
}

impl Shown {
    /// The paths that had no value; `into`: where the values are.
    ///
    /// # Errors
    /// If chunks are damaged: what was asked for may have been in them.
    pub fn complete(self, into: Option<&Utf8Path>) -> Result<Vec<String>, Refusal> {
        let Some(offset) = self.damaged.first() else {
            return Ok(self.silent);
        };
        let what = match self.damaged.len() - 1 {
            0 => format!("the chunk at byte {offset} is damaged: what it had"),
            more => {
                format!("the chunk at byte {offset} and {more} more are damaged: what they had")
            }
        };
        let place = into.map_or(String::new(), |into| format!(" in `{into}`"));
        Err(Refusal::bad(format!(
            "{what} is missing{place}, everything else is there"
        )))
    }
}

/// `Control` of `frames/Control`.
pub(super) fn instance_of(topic: &str) -> &str {
    topic
        .split_once('/')
        .map_or(topic, |(_, instance)| instance)
}

/// Shows every value that is wanted, in the order of the file, until nobody wants more. Damaged chunks are passed over: [`Shown::complete`] tells of them.
///
/// # Errors
/// If a path names nothing that is recorded, or the file cannot be read.
pub fn cat(
    file: &RecordingFile,
    selection: &Selection,
    show: &mut dyn FnMut(Found) -> Result<bool, Refusal>,
) -> Result<Shown, Refusal> {
    let contents = file.contents();
    let layouts = Layouts::of(&contents.attachments);
    let mut channels = BTreeMap::new();
    for (number, channel) in &contents.channels {
        let sources = sources(channel, &layouts);
        channels.insert(*number, Read::new(channel, sources));
    }
    // What has a channel of its own is not shown twice.
    let own: BTreeSet<String> = channels
        .values()
        .filter(|read| read.encoding == JSON)
        .flat_map(|read| read.sources.iter().map(|source| source.path.clone()))
        .collect();
    for read in channels.values_mut().filter(|read| read.encoding != JSON) {
        for source in &mut read.sources {
            source.is_elsewhere = own.contains(&source.path);
        }
    }
    let known: Vec<&Source> = channels.values().flat_map(|read| &read.sources).collect();
    check(&selection.paths, &known, &layouts)?;
    let mut silent = selection.paths.clone();
    let show = &mut |found: Found| {
        silent.retain(|path| !below(&found.path, path));
        show(found)
    };
    // Without an index all were looked at, and these are not among the chunks; when they were is not known.
    let mut damaged = contents.damaged.clone();
    for place in &contents.chunks {
        if !overlaps(&selection.span.times, place.times) {
            continue;
        }
        let chunk = match file.chunk(place) {
            Ok(chunk) => chunk,
            Err(ReadError::Damaged { offset }) => {
                damaged.push(offset);
                continue;
            }
            Err(error) => return Err(Refusal::bad(error.to_string())),
        };
        for message in chunk.messages() {
            let Some(read) = channels.get_mut(&message.channel) else {
                continue;
            };
            if !read.show(&message, selection, show)? {
                return Ok(Shown::default());
            }
        }
    }
    Ok(Shown { silent, damaged })
}

fn overlaps(wanted: &Option<Range<u64>>, (first, last): (u64, u64)) -> bool {
    let Some(wanted) = wanted else {
        return true;
    };
    wanted.start <= last && first < wanted.end
}

/// Every path must lead to something.
fn check(paths: &[String], known: &[&Source], layouts: &Layouts) -> Result<(), Refusal> {
    for path in paths {
        let mut around = known.iter().filter(|source| below(path, &source.path));
        let is_above = known.iter().any(|source| below(&source.path, path));
        if is_above || around.any(|source| names_beside(source, path).is_none()) {
            continue;
        }
        let refusal = Refusal::wrong_usage(format!("the recording has no values of `{path}`"));
        let is_recorded = known.iter().any(|source| below(path, &source.path));
        if !is_recorded && is_computed(path, layouts) {
            return Err(refusal.help(
                "the robot has this output, but no other instance reads it: `hulkgen replay FILE` computes it and shows it to \
                 clients, `hulkgen run --record-output PATH` records it",
            ));
        }
        let parts = known.iter().filter(|source| below(path, &source.path));
        let parts: Vec<String> = parts
            .filter_map(|source| names_beside(source, path))
            .flatten()
            .collect();
        let near = match parts.is_empty() {
            true => suggestion(
                path,
                known.iter().map(|source| &*source.path),
                "outputs that no other instance reads are recorded with `hulkgen run --record-output PATH`; the recording has",
            ),
            false => suggestion(path, parts.iter().map(String::as_str), "there are"),
        };
        return Err(refusal.help(near));
    }
    Ok(())
}

/// Whether it is, or is in, an output of which the recording has digests alone.
fn is_computed(path: &str, layouts: &Layouts) -> bool {
    let mut digests = layouts.digests.iter();
    digests.any(|(instance, outputs)| {
        let mut outputs = outputs.iter();
        outputs.any(|(_, output)| below(path, &format!("{instance}.main_outputs.{output}")))
    })
}

/// The paths that lead on where this one does not; `None`: it leads to something, or that cannot be known.
fn names_beside(source: &Source, path: &str) -> Option<Vec<String>> {
    let (mut layout, mut been) = (&source.layout, source.path.clone());
    let rest = path[source.path.len()..].trim_start_matches('.');
    for name in rest.split('.').filter(|name| !name.is_empty()) {
        while let Layout::Option(inner) = layout {
            layout = inner;
        }
        let named = match layout {
            Layout::Struct(of) => &*of.fields,
            Layout::Enum(of) => &*of.variants,
            Layout::Unknown | Layout::Again(_) => return None,
            _ => &[],
        };
        let next = match layout {
            Layout::Bytes => position(name).map(|_| layout),
            Layout::List(item) => position(name).map(|_| &**item),
            Layout::Tuple(items) => position(name).and_then(|place| items.get(place)),
            Layout::Map(both) => Some(&both.1),
            _ => named
                .iter()
                .find(|(known, _)| known == name)
                .map(|(_, next)| next),
        };
        let Some(next) = next else {
            let names = named.iter().map(|(name, _)| format!("{been}.{name}"));
            return Some(names.collect());
        };
        layout = next;
        been = format!("{been}.{name}");
    }
    None
}

/// Whether a path is `above` or lies below it.
fn below(path: &str, above: &str) -> bool {
    path.strip_prefix(above)
        .is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
}

/// What one channel holds under a path.
struct Source {
    path: String,
    /// Whether it is shown where no path is named.
    is_output: bool,
    /// Whether another channel is for it: here its bytes are passed over.
    is_elsewhere: bool,
    layout: Layout,
}

/// The paths of a channel, in the order of its messages' bytes.
fn sources(channel: &Channel, layouts: &Layouts) -> Vec<Source> {
    let instance = instance_of(&channel.topic);
    match &*channel.encoding {
        JSON => vec![Source {
            path: channel.topic.clone(),
            is_output: channel.topic != LOGS,
            is_elsewhere: false,
            layout: Layout::Unknown,
        }],
        VALUES => match layouts.values.get(instance) {
            Some(Layout::Struct(shared)) if instance != "parameters" => shared
                .fields
                .iter()
                .map(|(name, layout)| Source {
                    path: format!("{instance}.main_outputs.{name}"),
                    is_output: true,
                    is_elsewhere: false,
                    layout: layout.clone(),
                })
                .collect(),
            Some(layout) => vec![Source {
                path: instance.to_owned(),
                is_output: false,
                is_elsewhere: false,
                layout: layout.clone(),
            }],
            None => Vec::new(),
        },
        FRAMES => {
            let types = channel.metadata.iter().find(|(key, _)| key == TYPES);
            let parts = types.and_then(|(_, types)| layouts.frames.get(types));
            let parts = parts.map_or(&[][..], Vec::as_slice);
            parts
                .iter()
                .map(|part| frame_source(instance, part))
                .collect()
        }
        _ => Vec::new(),
    }
}

fn frame_source(instance: &str, part: &Part) -> Source {
    let name = &part.name;
    let path = match part.kind {
        PartKind::Output => format!("{instance}.main_outputs.{name}"),
        PartKind::Node => format!("{instance}.states.{name}"),
        PartKind::State => format!("{instance}.{name}"),
        PartKind::Previous => format!("{instance}.previous.{name}"),
        PartKind::History => format!("{instance}.history.{name}"),
        PartKind::Input => format!("{instance}.inputs.{name}"),
        PartKind::Other => format!("{instance}.frame.{name}"),
    };
    Source {
        path,
        is_output: part.kind == PartKind::Output,
        is_elsewhere: false,
        layout: part.layout.clone(),
    }
}

/// A channel while it is read.
struct Read {
    encoding: String,
    sources: Vec<Source>,
    /// Cycles of values that were shown: other chunks have them, too.
    seen: BTreeSet<u32>,
}

impl Read {
    fn new(channel: &Channel, sources: Vec<Source>) -> Self {
        Self {
            encoding: channel.encoding.clone(),
            sources,
            seen: BTreeSet::new(),
        }
    }

    /// Whether more is wanted.
    fn show(
        &mut self,
        message: &Message<'_>,
        selection: &Selection,
        show: &mut dyn FnMut(Found) -> Result<bool, Refusal>,
    ) -> Result<bool, Refusal> {
        let (cycle, time) = (u64::from(message.sequence), message.time);
        let Span { cycles, times } = &selection.span;
        let is_in = |wanted: &Option<Range<u64>>, number: &u64| {
            wanted.as_ref().is_none_or(|wanted| wanted.contains(number))
        };
        if !is_in(cycles, &cycle) || !is_in(times, &time) {
            return Ok(true);
        }
        let data = match &*self.encoding {
            JSON => return self.show_json(message, selection, show),
            VALUES if self.seen.insert(message.sequence) => message.data,
            FRAMES => match message.data.split_first() {
                Some((0, frame)) => frame,
                _ => return Ok(true),
            },
            _ => return Ok(true),
        };
        let mut values = Values::new(data);
        let last = self
            .sources
            .iter()
            .rposition(|one| is_wanted(one, selection));
        for source in self.sources.iter().take(last.map_or(0, |last| last + 1)) {
            let unreadable = |error| {
                Refusal::bad(format!(
                    "cycle {cycle} of `{}` cannot be read: {error}",
                    source.path
                ))
            };
            if !is_wanted(source, selection) {
                values.skip(&source.layout).map_err(unreadable)?;
                continue;
            }
            let value = values.take(&source.layout).map_err(unreadable)?;
            for found in select(source, value, selection) {
                let found = Found {
                    cycle,
                    time,
                    ..found
                };
                if !show(found)? {
                    return Ok(false);
                }
            }
        }
        Ok(true)
    }

    fn show_json(
        &self,
        message: &Message<'_>,
        selection: &Selection,
        show: &mut dyn FnMut(Found) -> Result<bool, Refusal>,
    ) -> Result<bool, Refusal> {
        let Some(source) = self.sources.first().filter(|one| is_wanted(one, selection)) else {
            return Ok(true);
        };
        let value = serde_json::from_slice(message.data)
            .map_err(|error| Refusal::bad(format!("a value of `{}`: {error}", source.path)))?;
        for found in select(source, value, selection) {
            let found = Found {
                cycle: u64::from(message.sequence),
                time: message.time,
                ..found
            };
            if !show(found)? {
                return Ok(false);
            }
        }
        Ok(true)
    }
}

fn is_wanted(source: &Source, selection: &Selection) -> bool {
    let mut paths = selection.paths.iter();
    let is_asked_for = match selection.paths.is_empty() {
        true => source.is_output,
        false => paths.any(|path| below(path, &source.path) || below(&source.path, path)),
    };
    is_asked_for && !source.is_elsewhere
}

/// The parts of a value that paths name.
fn select(source: &Source, value: Value, selection: &Selection) -> Vec<Found> {
    let found = |path: &str, value: Value| Found {
        path: path.to_owned(),
        cycle: 0,
        time: 0,
        value,
    };
    let is_whole = |path: &String| below(&source.path, path);
    if selection.paths.is_empty() || selection.paths.iter().any(is_whole) {
        return vec![found(&source.path, value)];
    }
    let mut parts = Vec::new();
    for path in selection
        .paths
        .iter()
        .filter(|path| below(path, &source.path))
    {
        let rest = path[source.path.len()..].trim_start_matches('.');
        // What is absent now has no value.
        if let Some(part) = part(&value, rest) {
            parts.push(found(path, part.clone()));
        }
    }
    parts
}

/// The part of a value at a path, whose names may be positions in lists; without a name all of it.
pub(crate) fn part<'value>(value: &'value Value, path: &str) -> Option<&'value Value> {
    let mut names = path.split('.').filter(|name| !name.is_empty());
    names.try_fold(value, |value, name| match value {
        Value::Array(items) => items.get(position(name)?),
        value => value.get(name),
    })
}

/// Points, vectors and quaternions are lists when they are written; clients name their axes.
fn position(name: &str) -> Option<usize> {
    let axis = match name {
        "x" | "i" | "re" => 0,
        "y" | "j" | "im" => 1,
        "z" | "k" => 2,
        "w" => 3,
        _ => return name.parse().ok(),
    };
    Some(axis)
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::part;

    #[test]
    fn names_positions_and_axes_lead_on() {
        let value = json!({"position": [1.5, 2.5], "orientation": [0.0, 0.1, 0.2, 0.9], "gains": [{ "p": 3.5 }]});
        for (path, expected) in [
            ("position.x", 1.5),
            ("position.1", 2.5),
            ("orientation.w", 0.9),
            ("gains.0.p", 3.5),
        ] {
            assert_eq!(part(&value, path), Some(&json!(expected)), "{path}");
        }
        assert_eq!(part(&value, "position.z"), None);
        assert_eq!(part(&value, "gains.1.p"), None);
        assert_eq!(part(&value, ""), Some(&value));
    }
}
