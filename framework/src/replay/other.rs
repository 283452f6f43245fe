//! Other parameters than those that were recorded.

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;

use super::{Shelf, types};
use crate::buffer::buffer_of;
use crate::clock::Clock;
use crate::data::ParameterData;
use crate::error::{Error, Result};
use crate::parameters::LiveParameters;
use crate::recorded::{Loading, PARAMETERS};

/// What stands in place of each version of the parameters that a recording has.
#[derive(Clone, Debug, Default)]
pub struct OtherParameters {
    versions: BTreeMap<u32, Vec<u8>>,
}

/// A version of the parameters as it was recorded, and as it is to be.
pub type Changed<'a> = &'a mut dyn FnMut(&[u8]) -> Result<Vec<u8>>;

impl OtherParameters {
    /// Every version of a recording, changed.
    ///
    /// # Errors
    /// If one cannot be changed: the first reason, which mostly is that of all.
    pub fn new(recording: &Shelf, changed: Changed<'_>) -> Result<Self> {
        let channel = recording.channel(PARAMETERS);
        let channel = channel.ok_or_else(|| Error::new("the recording has no parameters"))?;
        let mut versions = BTreeMap::new();
        for (version, place) in recording.index().values(channel) {
            // Each chunk that refers to a version has it, and all have the same.
            if let Entry::Vacant(new) = versions.entry(version) {
                new.insert(changed(&recording.bytes(place)?)?);
            }
        }
        Ok(Self { versions })
    }

    /// By their numbers.
    pub(super) fn versions(&self) -> &BTreeMap<u32, Vec<u8>> {
        &self.versions
    }
}

/// The first version of the parameters that a recording has; `None`: it has none.
///
/// # Errors
/// If its chunk can no longer be read.
pub fn first_parameters(recording: &Shelf) -> Result<Option<Vec<u8>>> {
    let channel = recording.channel(PARAMETERS);
    let first = channel.and_then(|channel| recording.index().values(channel).next());
    first.map(|(_, place)| recording.bytes(place)).transpose()
}

/// The same, as this robot has them.
///
/// # Errors
/// If the recording has none, or they are of other types.
pub(crate) fn recorded_parameters<P: ParameterData>(recording: &Shelf) -> Result<P> {
    let first = first_parameters(recording)?
        .ok_or_else(|| Error::new("the recording has no parameters"))?;
    match types::of_parameters::<P>(recording.contents()) {
        Some(difference) => Err(Error::new(format!(
            "the recorded parameters are of other types: {difference}"
        ))),
        None => Loading::new(&first).take(),
    }
}

/// Recorded parameters with some values replaced: paths, and values as the parameter files write them.
///
/// # Errors
/// If the bytes are none of these parameters, or a live change would be refused, too: with what would be right.
pub fn with_settings<P: ParameterData>(
    recorded: &[u8],
    settings: &[(String, String)],
) -> Result<Vec<u8>> {
    let start: P = Loading::new(recorded).take().map_err(|error| {
        error.context("the recorded parameters are not those of this robot: --set needs a build that has the same ones")
    })?;
    let (writer, [mut reader], []) = buffer_of(|| start.clone(), []);
    let parameters = LiveParameters::new(writer, start.clone(), Clock::stepped());
    parameters
        .set(settings)
        .map_err(|refusals| Error::new(format!("--set: {refusals}")))?;
    reader.take();
    Ok(postcard::to_stdvec(reader.view().value())?)
}

/// Those of these paths that only `new` reads, which no replay calls.
pub fn read_in_new_alone<'s, P: ParameterData>(
    recorded: &[u8],
    settings: &'s [(String, String)],
) -> Result<Vec<&'s str>> {
    let start: P = Loading::new(recorded).take()?;
    let (writer, [], []) = buffer_of(|| start.clone(), []);
    let parameters = LiveParameters::new(writer, start.clone(), Clock::stepped());
    let creation_only = parameters.creation_only();
    let within = |path: &str, other: &str| {
        path == other
            || path
                .strip_prefix(other)
                .is_some_and(|rest| rest.starts_with('.'))
    };
    let paths = settings.iter().map(|(path, _)| path.as_str());
    Ok(paths
        .filter(|path| creation_only.iter().any(|other| within(path, other)))
        .collect())
}
