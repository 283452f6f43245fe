//! Recorded cycles run again: each instance alone, each cycle from its frame, without hardware.
//!
//! ```text
//! file -> shelf of chunks -> frames of one instance -> states, inputs -> run, finish -> digests, beside those of the recording
//! ```
//! Setup nodes are not called; what they wrote stands in the frame. What nodes command goes nowhere; [`commanded!`](crate::commanded) notes it for whoever listens. A node that asks the
//! hardware for something in a cycle cannot be replayed in that cycle; it is counted.

mod carry;
mod commands;
mod compare;
mod compared;
mod difference;
mod elsewhere;
mod events;
mod graph;
mod needed;
mod other;
mod output_channels;
mod play;
mod report;
mod shelf;
mod snapshot;
mod source;
mod timeline;
mod tolerance;
mod types;
mod verify;

use std::cell::Cell;

use serde::de::DeserializeOwned;
use serde_json::Value;

use crate::cycler::{Cycler, Finished, Instance};
use crate::error::Result;
use crate::recorded::{self, Head, Loading, Recorded, Stored, Taken, Types, digest};
use crate::subscriptions::Subscriptions;

pub use carry::Setup;
pub use commands::{Argument, Command, is_listening, note, telling};
pub(crate) use commands::{listen, noted};
pub use compare::{Change, Comparison, InstanceCompared, compare};
pub(crate) use difference::first_difference;
pub use elsewhere::{Elsewhere, answer};
pub use events::{Happened, MOST_EVENTS, What};
pub use needed::Needed;
pub(crate) use other::recorded_parameters;
pub use other::{Changed, OtherParameters, first_parameters, read_in_new_alone, with_settings};
pub use play::{Chunks, Player, Players};
pub use report::Divergence;
pub use shelf::{Frame, Shelf};
pub use snapshot::{Call, ParametersAsJson, SNAPSHOT_VERSION, snapshot};
pub use source::{Digested, Played, Source};
pub use timeline::{InstancePlace, Move, PROCEDURE, Place, TIMELINE, Timeline};
pub use tolerance::TOLERANCE;
pub use verify::{How, InstanceVerified, Verification, verify, verify_how};

/// An instance that can be replayed; a constant of the generated crate lists them.
#[derive(Clone, Copy, Debug)]
pub struct Replayable {
    pub instance: &'static str,
    /// Makes it, with the states of its nodes as in a frame.
    pub create: fn(&mut Loading<'_>, &Stored<'_>) -> Result<Box<dyn Replay>>,
    /// The types of its frames.
    pub types: fn() -> Types,
}

/// One instance whose cycles come from a recording.
pub trait Replay {
    /// Makes a recorded cycle the one that has just begun.
    ///
    /// # Errors
    /// If the bytes are none of such a frame, or a value is not found.
    fn load(&mut self, head: Head, from: &mut Loading<'_>, stored: &Stored<'_>) -> Result<()>;

    /// Runs its nodes, up to the first that is none of these if some are named, and finishes it.
    fn run(&mut self, nodes: Option<&[String]>) -> Ran;

    /// What the loaded cycle has taken beside inputs; once it ran, its answers.
    fn taken(&self) -> Taken;

    /// Who listens to its additional outputs. A cycle that runs has those that somebody listens to, beside those that it had
    /// when it was recorded: from the next [`Replay::load`] on.
    fn subscriptions(&self) -> &Subscriptions;

    /// The instance.
    fn instance(&self) -> &dyn Instance;

    /// The instance, for its states.
    fn instance_mut(&mut self) -> &mut dyn Instance;

    /// What others read of a cycle, by the names of the outputs, out of its bytes; of outputs that they do not read, anything.
    ///
    /// # Errors
    /// If the bytes are of another instance.
    fn shared(&self, bytes: &[u8]) -> Result<Vec<(String, Value)>>;

    /// An output out of the bytes of all that others read of a cycle, if it is the one with this digest.
    fn recorded(&self, shared: &[u8], output: &str, digest: u64) -> Option<Value>;
}

/// How a replayed cycle ended.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Ran {
    Finished,
    /// A node asked the hardware for something.
    NeedsHardware,
    /// It would have been abandoned.
    Failed(String),
}

/// One instance, with the writing ends of all that it reads.
pub struct Alone<B: Recorded> {
    cycler: Cycler<B>,
    outside: B::Outside,
    subscriptions: Subscriptions,
}

impl<B: Recorded> Alone<B> {
    /// An instance that was just created; its body listens to these subscriptions.
    pub fn new(cycler: Cycler<B>, outside: B::Outside, subscriptions: Subscriptions) -> Self {
        Self {
            cycler,
            outside,
            subscriptions,
        }
    }
}

impl<B: Recorded> Replay for Alone<B>
where
    B::Shared: DeserializeOwned,
{
    fn load(&mut self, head: Head, from: &mut Loading<'_>, stored: &Stored<'_>) -> Result<()> {
        self.cycler.load(&mut self.outside, head, from, stored)
    }

    fn run(&mut self, nodes: Option<&[String]>) -> Ran {
        HARDWARE_WAS_READ.set(false);
        self.cycler.run_only(nodes);
        let failure = self.cycler.failure().map(ToString::to_string);
        let finished = self.cycler.finish();
        match finished {
            _ if HARDWARE_WAS_READ.get() => Ran::NeedsHardware,
            Ok(Finished::Completed | Finished::Recovered) => Ran::Finished,
            Ok(Finished::Abandoned | Finished::Restarting { .. } | Finished::Stopped) => {
                Ran::Failed(failure.unwrap_or_else(|| "it was abandoned".to_owned()))
            }
            Err(error) => Ran::Failed(error.to_string()),
        }
    }

    fn taken(&self) -> Taken {
        recorded::taken(self.cycler.body())
    }

    fn subscriptions(&self) -> &Subscriptions {
        &self.subscriptions
    }

    fn instance(&self) -> &dyn Instance {
        &self.cycler
    }

    fn instance_mut(&mut self) -> &mut dyn Instance {
        &mut self.cycler
    }

    fn shared(&self, bytes: &[u8]) -> Result<Vec<(String, Value)>> {
        let shared: B::Shared = Loading::new(bytes).take()?;
        let body = self.cycler.body();
        let names = body.main_outputs().iter();
        let values = names.filter_map(|name| {
            let value = body.main_output(&shared, name)?;
            Some(((*name).to_owned(), as_json(value.as_serialize())?))
        });
        Ok(values.collect())
    }

    fn recorded(&self, shared: &[u8], output: &str, wanted: u64) -> Option<Value> {
        let shared: B::Shared = Loading::new(shared).take().ok()?;
        let value = self
            .cycler
            .body()
            .main_output(&shared, output)?
            .as_serialize();
        (digest(&value).ok()? == wanted).then(|| serde_json::to_value(value).ok())?
    }
}

/// A value as JSON; `None`: JSON cannot say it.
fn as_json(value: &dyn erased_serde::Serialize) -> Option<Value> {
    serde_json::to_value(value).ok()
}

thread_local! {
    static HARDWARE_WAS_READ: Cell<bool> = const { Cell::new(false) };
}

/// What the hardware of a replay does where it is asked for something.
///
/// # Panics
/// Always: the node that asks ends here, and its cycle counts as one that needs hardware.
pub fn no_hardware() -> ! {
    HARDWARE_WAS_READ.set(true);
    panic!("a replay has no hardware to ask")
}
