//! Of which types the frames of an instance are.

use hulkgen_mcap::Layout;
use hulkgen_mcap::layout::{Part, PartKind, first_difference};
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::{Map, Value, json};

use super::trace::layout_of;
use super::{Foreign, Head, PARAMETERS, Recorded, digest};
use crate::buffer::Reader;
use crate::context::AdditionalSlot;
use crate::guarded::{Condition, Guarded};
use crate::history::{History, Past};
use crate::injection::Injected;
use crate::procedure::Answerer;
use crate::time::Timestamp;

/// The parts of a frame, and the values that it names.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Types {
    /// In the order of the frame.
    pub parts: Vec<Part>,
    /// Of other instances that are read, by name.
    pub values: Vec<(&'static str, Layout)>,
}

/// Takes down the types of a body's fields; generated beside what saves and loads them.
#[derive(Debug)]
pub struct Describing<'body, B: ?Sized> {
    types: Types,
    /// Of which values are wanted, too.
    body: Option<&'body B>,
    taken: Taken,
}

/// What a cycle has that neither outputs nor states are, as JSON by name; `null` where JSON cannot say it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Taken {
    /// Of each output by time: `{"timestamp_ns", "value"}`, oldest first, without this cycle's.
    pub histories: Map<String, Value>,
    /// What each procedure is asked; only those that are.
    pub calls: Map<String, Value>,
    /// What was answered, `{"Ok": response}` or `{"Err": reason}`, with its digest; only where there was a call.
    pub answers: Map<String, Value>,
}

/// The types of what a recording takes of this body.
pub fn describe<B: Recorded>() -> Types {
    let mut describing = Describing::of(None);
    describing.add(PartKind::Other, "head", layout_of::<Head>());
    B::describe(&mut describing);
    describing.types
}

/// What the cycle of a body has taken.
pub(crate) fn taken<B: Recorded>(body: &B) -> Taken {
    let mut describing = Describing::of(Some(body));
    B::describe(&mut describing);
    describing.taken
}

impl Types {
    /// The same for the same parts.
    pub fn digest(&self) -> String {
        format!("{:016x}", Layout::digest(&self.parts))
    }

    /// What is of another type than it was, in words.
    pub fn difference(&self, recorded: &[Part]) -> Option<String> {
        first_difference(recorded, &self.parts)
    }
}

impl<'body, B: Recorded> Describing<'body, B> {
    fn of(body: Option<&'body B>) -> Self {
        Self {
            types: Types::default(),
            body,
            taken: Taken::default(),
        }
    }

    fn add(&mut self, kind: PartKind, name: &str, layout: Layout) {
        self.types.parts.push(Part {
            name: name.to_owned(),
            kind,
            layout,
        });
    }

    /// What another instance wrote, for whoever reads the recording.
    fn value<T: DeserializeOwned>(&mut self, name: &'static str) {
        let mut known = self.types.values.iter();
        if !known.any(|(known, _)| *known == name) {
            self.types.values.push((name, layout_of::<T>()));
        }
    }

    /// The version of the parameters.
    pub fn parameters<P: DeserializeOwned>(&mut self, _: fn(&B) -> &Reader<P>) {
        self.add(PartKind::Other, PARAMETERS, layout_of::<u64>());
        self.value::<P>(PARAMETERS);
    }

    /// A node's state, and what its failures left behind.
    pub fn node<N: DeserializeOwned>(&mut self, path: &str, _: fn(&B) -> &Guarded<N>) {
        // Each for itself: a state that refuses what it is offered hides nothing.
        let layouts = vec![layout_of::<N>(), layout_of::<Condition>()];
        self.add(PartKind::Node, path, Layout::Tuple(layouts));
    }

    /// What nodes share.
    pub fn state<T: DeserializeOwned>(&mut self, _: fn(&B) -> &T) {
        self.add(PartKind::State, "cycler_state", layout_of::<T>());
    }

    /// An output of the cycle, as setup nodes wrote it.
    pub fn output<T: DeserializeOwned>(&mut self, name: &str, _: fn(&B) -> &T) {
        self.add(PartKind::Output, name, layout_of::<T>());
    }

    /// As [`Self::output`], of what others read.
    pub fn shared_output<T: DeserializeOwned>(&mut self, name: &str, _: fn(&B::Shared) -> &T) {
        self.add(PartKind::Output, name, layout_of::<T>());
    }

    /// An additional output of the cycle, where a setup node filled it.
    pub fn additional_output<T: DeserializeOwned>(
        &mut self,
        name: &str,
        _: fn(&B) -> &AdditionalSlot<T>,
    ) {
        let name = format!("additional_outputs.{name}");
        self.add(PartKind::Other, &name, layout_of::<Option<T>>());
    }

    /// An output of the cycle before.
    pub fn previous<T: DeserializeOwned>(&mut self, name: &str, _: fn(&B) -> &T) {
        self.add(PartKind::Previous, name, layout_of::<T>());
    }

    /// As [`Self::previous`], of what others read.
    pub fn shared_previous<T: DeserializeOwned>(&mut self, name: &str, _: fn(&B::Shared) -> &T) {
        self.add(PartKind::Previous, name, layout_of::<T>());
    }

    /// An output by time.
    pub fn history<T: Clone + Serialize + DeserializeOwned>(
        &mut self,
        name: &str,
        of: fn(&B) -> &History<T>,
    ) {
        let layout = layout_of::<(bool, Vec<(Timestamp, T)>)>();
        self.add(PartKind::History, name, layout);
        if let Some(body) = self.body {
            let all = of(body).project(|value| value);
            let all = (0..all.len()).map(|index| {
                let (timestamp, value) = all.value(index);
                json!({ "timestamp_ns": timestamp.as_nanos(), "value": as_json(value) })
            });
            let all = all.collect::<Vec<_>>().into();
            self.taken.histories.insert(name.to_owned(), all);
        }
    }

    /// What is read of another instance.
    pub fn foreign<T: DeserializeOwned, F: Foreign<T>>(
        &mut self,
        instance: &'static str,
        _: fn(&B) -> &F,
    ) {
        self.add(PartKind::Input, instance, F::layout());
        self.value::<T>(instance);
    }

    /// What clients replaced.
    pub fn injections<I: DeserializeOwned>(&mut self, _: fn(&B) -> &Reader<Injected<I>>) {
        self.add(PartKind::Other, "injections", layout_of::<Option<I>>());
    }

    /// The call of a procedure.
    pub fn procedure<Request: Serialize + DeserializeOwned, Response: Serialize>(
        &mut self,
        name: &str,
        of: fn(&B) -> &Answerer<Request, Response>,
    ) {
        self.add(PartKind::Other, name, layout_of::<Option<Request>>());
        if let Some(body) = self.body {
            let answerer = of(body);
            let Taken { calls, answers, .. } = &mut self.taken;
            if let Some(request) = answerer.request() {
                calls.insert(name.to_owned(), as_json(request));
            }
            if let Some(answer) = answerer.answered() {
                let answer = answer.map_err(|refused| refused.0.to_string());
                let digest = digest(&answer)
                    .map_or_else(|error| error.to_string(), |digest| format!("{digest:016x}"));
                let answer = json!({ "value": as_json(&answer), "digest": digest });
                answers.insert(name.to_owned(), answer);
            }
        }
    }

    /// Who listens to additional outputs.
    pub fn subscribed<T: DeserializeOwned>(&mut self, _: fn(&B) -> &T) {
        self.add(PartKind::Other, "subscribed", layout_of::<T>());
    }
}

fn as_json(value: &impl Serialize) -> Value {
    serde_json::to_value(value).unwrap_or_default()
}
