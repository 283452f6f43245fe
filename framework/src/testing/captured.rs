//! What `hulkgen capture` wrote of one call of a node, for the test beside it.

use std::time::Duration;

use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::Value;

use crate::buffer::Latest;
use crate::history::HistoricInput;
use crate::procedure::{Answerer, Call, procedure};
use crate::recorded::digest;
use crate::replay::{Command, SNAPSHOT_VERSION, first_difference, listen, noted};
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

/// Values of a historic input, with this cycle's.
#[derive(Clone, Debug)]
pub struct CapturedHistory<T> {
    past: Vec<(Timestamp, T)>,
    now: Timestamp,
    value: T,
}

/// What a procedure is asked, and what the node answers.
#[derive(Debug)]
pub struct CapturedCall<Request, Response> {
    answerer: Answerer<Request, Response>,
}

impl Captured {
    /// A file with this text; from here on commands to hardware that [`commanded!`](crate::commanded) is told of are noted.
    ///
    /// # Panics
    /// If it is no such file, or one of another version.
    pub fn new(text: &str) -> Self {
        listen();
        Self {
            all: load(text).unwrap_or_else(|why| panic!("{why}")),
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

    /// What the node saw in a field when it was created, or restored.
    ///
    /// # Panics
    /// If the field is of another type now.
    pub fn creation_value<T: DeserializeOwned>(&self, field: &str) -> T {
        read(&self.all["creation"][field], field)
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
        let part = |name: &str| entries(&self.all["fields"][field][name], field);
        CapturedSeries {
            persistent: part("persistent"),
            transient: part("transient"),
        }
    }

    /// The values of a historic input.
    ///
    /// # Panics
    /// If the field is of another type now.
    pub fn history<T: DeserializeOwned>(&self, field: &str) -> CapturedHistory<T> {
        let of_field = &self.all["fields"][field];
        CapturedHistory {
            past: entries(&of_field["past"], field),
            now: self.time().start,
            value: read(&of_field["value"], field),
        }
    }

    /// What a procedure is asked.
    ///
    /// # Panics
    /// If the request is of another type now.
    pub fn call<Request, Response>(&self, field: &str) -> CapturedCall<Request, Response>
    where
        Request: DeserializeOwned,
    {
        // That the client does not wait changes nothing for the node.
        let (_, mut answerer) = procedure();
        let request = &self.all["calls"][field]["request"];
        // A request may be `null` itself, so that there is one says another key.
        let is_asked: bool = read(&self.all["calls"][field]["is_asked"], field);
        answerer.ask(is_asked.then(|| read(request, field)));
        CapturedCall { answerer }
    }

    /// Compares an output with the recorded one, bit for bit.
    ///
    /// # Panics
    /// If they differ, with the first place and both values.
    pub fn assert_output<T: Serialize>(&self, output: &str, value: &T) {
        assert_same(&format!("`{output}`"), &self.all["outputs"][output], value);
    }

    /// Compares the node after the call with what it was then, bit for bit.
    ///
    /// # Panics
    /// As [`Self::assert_output`].
    pub fn assert_state<N: Serialize>(&self, node: &N) {
        assert_same("the state of the node", &self.all["state_after"], node);
    }

    /// Compares what a procedure was answered with the recorded answer, bit for bit.
    ///
    /// # Panics
    /// As [`Self::assert_output`].
    pub fn assert_answer<Request, Response: Serialize>(
        &self,
        field: &str,
        mut call: CapturedCall<Request, Response>,
    ) {
        call.answerer.close();
        let recorded = &self.all["calls"][field]["answer"];
        let what = format!("the answer of `{field}`");
        match call.answerer.answered() {
            Some(answer) => {
                let answer = answer.map_err(|refused| refused.0.to_string());
                assert_same(&what, recorded, &answer);
            }
            None => assert!(recorded.is_null(), "{what} does not come: {recorded}"),
        }
    }

    /// Compares what the node told the hardware with what it told it then: which commands in which order, and the bits of
    /// all arguments that can be serialised.
    ///
    /// # Panics
    /// If they differ, with the first command that does, or if the file is damaged.
    pub fn assert_commands(&self) {
        let recorded: Vec<Command> = read(&self.all["commands"], "the commands");
        let now = noted();
        let shown = |command: Option<&Command>| {
            let command = command.map(|command| {
                let arguments = command.arguments.iter().flatten();
                let arguments: Vec<_> = arguments.map(|one| one.value.to_string()).collect();
                format!("{}({})", command.command, arguments.join(", "))
            });
            command.unwrap_or_else(|| "nothing".to_owned())
        };
        let all = 0..recorded.len().max(now.len());
        for (place, recorded, now) in all.map(|place| (place, recorded.get(place), now.get(place)))
        {
            assert!(
                recorded == now,
                "command {place} to the hardware is not what was recorded\n  recorded: {}\n  now:      {}",
                shown(recorded),
                shown(now)
            );
        }
    }
}

/// What a file of this version says, or why nothing can be read from it.
fn load(text: &str) -> Result<Value, String> {
    let all: Value = serde_json::from_str(text)
        .map_err(|error| format!("the captured file is damaged: {error}"))?;
    match &all["version"] {
        version if version.as_u64() == Some(SNAPSHOT_VERSION.into()) => Ok(all),
        Value::Null => {
            Err("the file has no `version`: `hulkgen capture` did not write it".to_owned())
        }
        version => Err(format!(
            "the captured file has version {version}, and {SNAPSHOT_VERSION} is read here: \
             capture the cycle again with the `hulkgen` of this framework and `--replace`"
        )),
    }
}

/// Compares a value with its recorded bits.
fn assert_same(what: &str, recorded: &Value, value: &impl Serialize) {
    let bits = digest(value).unwrap_or_else(|error| panic!("{what}: {error}"));
    let bits = format!("{bits:016x}");
    if recorded["digest"] == bits {
        return;
    }
    let now = serde_json::to_value(value).unwrap_or_default();
    let path = first_difference(&recorded["value"], &now);
    panic!(
        "{what} is not what was recorded, first in `{path}`\n  recorded: {} {}\n  now:      \"{bits}\" {now}",
        recorded["digest"], recorded["value"]
    );
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

impl<T> CapturedHistory<T> {
    /// As the node sees it.
    pub fn seen(&self) -> CapturedHistory<&T> {
        self.each(|value| value)
    }

    fn each<'a, V>(&'a self, see: impl Fn(&'a T) -> V) -> CapturedHistory<V> {
        let past = self.past.iter();
        CapturedHistory {
            past: past.map(|(at, value)| (*at, see(value))).collect(),
            now: self.now,
            value: see(&self.value),
        }
    }
}

impl<T> CapturedHistory<Option<T>> {
    /// As the node sees it where its path has a `?`.
    pub fn seen_optional(&self) -> CapturedHistory<Option<&T>> {
        self.each(Option::as_ref)
    }
}

impl<V: Copy> CapturedHistory<V> {
    /// For the context.
    pub fn input(&self) -> HistoricInput<'_, V> {
        super::history(&self.past, self.now, self.value)
    }
}

impl<Request, Response> CapturedCall<Request, Response> {
    /// For the context.
    pub fn call(&mut self) -> Option<Call<'_, Request, Response>> {
        self.answerer.call()
    }
}

/// Values with their times.
fn entries<T: DeserializeOwned>(values: &Value, field: &str) -> Vec<(Timestamp, T)> {
    let values = values.as_array();
    let values = values.unwrap_or_else(|| panic!("`{field}` had no values by time"));
    let entry = |entry: &Value| {
        (
            timestamp(&entry["timestamp_ns"]),
            read(&entry["value"], field),
        )
    };
    values.iter().map(entry).collect()
}

fn timestamp(nanoseconds: &Value) -> Timestamp {
    Timestamp::from_nanos(read(nanoseconds, "a time"))
}

fn read<T: DeserializeOwned>(value: &Value, what: &str) -> T {
    T::deserialize(value).unwrap_or_else(|error| {
        panic!("`{what}` was captured with another type ({error}): capture the cycle again, with `--replace`")
    })
}

#[cfg(test)]
mod tests {
    use super::load;

    #[test]
    fn files_of_other_versions_are_refused() {
        assert!(load(r#"{ "version": 3 }"#).is_ok());
        for (text, why) in [
            (r#"{ "version": 1 }"#, "has version 1, and 3 is read here"),
            (r#"{ "version": 2 }"#, "has version 2, and 3 is read here"),
            (r#"{ "version": "3" }"#, r#"has version "3""#),
            ("{}", "has no `version`"),
            ("[2]", "has no `version`"),
            ("{", "is damaged"),
        ] {
            let refused = load(text).expect_err(text);
            assert!(refused.contains(why), "{refused}");
        }
    }
}
