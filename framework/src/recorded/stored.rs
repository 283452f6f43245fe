//! What other instances wrote, as a chunk has it.

use std::collections::BTreeMap;

use serde::de::DeserializeOwned;

use super::{Loading, PARAMETERS};
use crate::error::{Error, Result};

/// Values of other instances in one chunk, by channel and cycle.
#[derive(Clone, Copy, Debug)]
pub struct Stored<'chunk> {
    /// By the names of instances.
    pub(crate) channels: &'chunk [(String, u16)],
    /// Where they lie.
    pub(crate) values: &'chunk ValuePlaces,
    /// Of the chunk.
    pub(crate) bytes: &'chunk [u8],
    /// What stands in place of versions of the parameters.
    pub(crate) other: Option<&'chunk BTreeMap<u32, Vec<u8>>>,
}

/// Where the values of a chunk lie among its bytes.
#[derive(Clone, Debug, Default)]
pub(crate) struct ValuePlaces(Box<[ValuePlace]>);

/// Where one of them lies.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ValuePlace {
    pub(crate) channel: u16,
    /// Of the cycle, or the version.
    pub(crate) sequence: u32,
    pub(crate) start: u32,
    pub(crate) length: u32,
}

impl ValuePlace {
    fn key(&self) -> (u16, u32) {
        (self.channel, self.sequence)
    }
}

impl ValuePlaces {
    /// Of places in the order of the chunk.
    pub(crate) fn new(mut places: Vec<ValuePlace>) -> Self {
        places.sort_by_key(ValuePlace::key);
        Self(places.into())
    }

    /// In the order of channels, and there of their numbers.
    pub(crate) fn iter(&self) -> impl Iterator<Item = &ValuePlace> {
        self.0.iter()
    }

    /// The last one of this number.
    pub(crate) fn find(&self, channel: u16, sequence: u32) -> Option<&ValuePlace> {
        let wanted = (channel, sequence);
        let behind = self.0.partition_point(|place| place.key() <= wanted);
        let last = self.0.get(behind.checked_sub(1)?)?;
        (last.key() == wanted).then_some(last)
    }
}

/// The channel of the values of an instance.
pub(crate) fn channel_of(channels: &[(String, u16)], instance: &str) -> Option<u16> {
    let mut channels = channels.iter();
    let (_, channel) = channels.find(|(known, _)| known == instance)?;
    Some(*channel)
}

impl<'chunk> Stored<'chunk> {
    /// The bytes of what an instance wrote in a cycle.
    pub(crate) fn bytes(&self, instance: &str, cycle: u64) -> Option<&'chunk [u8]> {
        let channel = channel_of(self.channels, instance)?;
        let place = self.values.find(channel, cycle as u32)?;
        if instance == PARAMETERS
            && let Some(bytes) = self.other.and_then(|other| other.get(&place.sequence))
        {
            return Some(bytes);
        }
        let start = place.start as usize;
        self.bytes.get(start..start + place.length as usize)
    }

    /// What an instance wrote in a cycle.
    ///
    /// # Errors
    /// If the chunk does not have it, or it is of another type.
    pub fn value<T: DeserializeOwned>(&self, instance: &str, cycle: u64) -> Result<T> {
        let bytes = self.bytes(instance, cycle).ok_or_else(|| {
            Error::new(format!(
                "the chunk has no cycle {cycle} of `{instance}`, which a frame in it names"
            ))
        })?;
        Loading::new(bytes).take()
    }

    /// The parameters that a frame names.
    ///
    /// # Errors
    /// As [`Self::value`].
    pub fn parameters<P: DeserializeOwned>(&self, from: &mut Loading<'_>) -> Result<P> {
        self.value(PARAMETERS, from.take()?)
    }
}
