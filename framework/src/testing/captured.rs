//! What `hulkgen capture` wrote of one call of a node, for the test beside it.

use std::time::Duration;

use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::Value;

use crate::buffer::Latest;
use crate::recorded::digest;
use crate::replay::first_difference;
use crate::temporal::PerceptionInput;
use crate::time::{CycleTime, Timestamp};

/// The file of one call.
#[derive(Clone, Debug)]
pub struct Captured {
    all: Value,
}

/// Values of perception inputs, each with its time.
#[derive(Clone, Debug)]
pub struct CapturedSeries<T> {
    persistent: Vec<(Timestamp, T)>,
    transient: Vec<(Timestamp, T)>,
}

impl Captured {
    /// A file with this text.
    ///
    /// # Panics
    /// If it is no such file.
    pub fn new(text: &str) -> Self {
        let all = serde_json::from_str(text);
        Self {
            all: all.unwrap_or_else(|error| panic!("the captured file is damaged: {error}")),
        }
    }

    /// The node as it was before the call.
    ///
    /// # Panics
    /// If the node has other fields now.
    pub fn state<N: DeserializeOwned>(&self) -> N {
        read(&self.all["state"], "the state of the node")
    }

    /// The time of the cycle.
    ///
    /// # Panics
    /// If the file is damaged.
    pub fn time(&self) -> CycleTime {
        CycleTime {
            start: timestamp(&self.all["start_ns"]),
            since_last: Duration::from_nanos(read(&self.all["since_last_ns"], "the time")),
        }
    }

    /// What the node saw in a field.
    ///
    /// # Panics
    /// If the field is of another type now.
    pub fn value<T: DeserializeOwned>(&self, field: &str) -> T {
        read(&self.all["fields"][field], field)
    }

    /// A latest input; `value` is what [`Self::value`] gave for its field, or `None` of it.
    ///
    /// # Panics
    /// If the file is damaged.
    pub fn latest<V>(&self, field: &str, value: V) -> Option<Latest<V>> {
        let of_field = &self.all["latest"][field];
        let written = timestamp(&of_field["timestamp_ns"]);
        Some(Latest {
            value,
            timestamp: written,
            cycle: read(&of_field["cycle"], field),
            age: self.time().start - written,
            is_new: read(&of_field["is_new"], field),
        })
    }

    /// The values of a perception input.
    ///
    /// # Panics
    /// If the field is of another type now.
    pub fn series<T: DeserializeOwned>(&self, field: &str) -> CapturedSeries<T> {
        let part = |name: &str| {
            let values = self.all["fields"][field][name].as_array();
            let values = values.unwrap_or_else(|| panic!("`{field}` was no perception input"));
            let entry = |entry: &Value| {
                (
                    timestamp(&entry["timestamp_ns"]),
                    read(&entry["value"], field),
                )
            };
            values.iter().map(entry).collect()
        };
        CapturedSeries {
            persistent: part("persistent"),
            transient: part("transient"),
        }
    }

    /// Compares an output with the recorded one, bit for bit.
    ///
    /// # Panics
    /// If they differ, with the first place and both values.
    pub fn assert_output<T: Serialize>(&self, output: &str, value: &T) {
        let recorded = &self.all["outputs"][output];
        let bits = digest(value).unwrap_or_else(|error| panic!("`{output}`: {error}"));
        if recorded["digest"] == format!("{bits:016x}") {
            return;
        }
        let now = serde_json::to_value(value).unwrap_or_default();
        let path = first_difference(&recorded["value"], &now);
        panic!(
            "`{output}` is not what was recorded, first in `{path}`\n  recorded: {}\n  now:      {now}",
            recorded["value"]
        );
    }
}

impl<T> CapturedSeries<T> {
    /// As the node sees it.
    pub fn seen(&self) -> CapturedSeries<&T> {
        self.each(|value| value)
    }

    fn each<'a, V>(&'a self, see: impl Fn(&'a T) -> V) -> CapturedSeries<V> {
        let all =
            |part: &'a [(Timestamp, T)]| part.iter().map(|(at, value)| (*at, see(value))).collect();
        CapturedSeries {
            persistent: all(&self.persistent),
            transient: all(&self.transient),
        }
    }
}

impl<T> CapturedSeries<Option<T>> {
    /// As the node sees it where its path has a `?`.
    pub fn seen_optional(&self) -> CapturedSeries<Option<&T>> {
        self.each(Option::as_ref)
    }
}

impl<V: Copy> CapturedSeries<V> {
    /// For the context.
    pub fn input(&self) -> PerceptionInput<'_, V> {
        super::perception(&self.persistent, &self.transient)
    }
}

fn timestamp(nanoseconds: &Value) -> Timestamp {
    Timestamp::from_nanos(read(nanoseconds, "a time"))
}

fn read<T: DeserializeOwned>(value: &Value, what: &str) -> T {
    T::deserialize(value).unwrap_or_else(|error| {
        panic!("`{what}` was captured with another type ({error}): capture the cycle again")
    })
}
