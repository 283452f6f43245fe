//! Who can recompute the cycles of a recording: this build, perhaps under other parameters, or another one.

use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::{Players, Ran};
use crate::error::{Error, Result};

/// Recomputes cycles of a recording.
pub trait Source {
    /// Runs the cycle at this place among the frames of an instance.
    ///
    /// # Errors
    /// If there is nobody any more who could answer.
    fn play(&mut self, instance: &str, position: usize) -> Result<Played>;

    /// An output of the cycle of an instance that ran last.
    ///
    /// # Errors
    /// As [`Self::play`].
    fn value(&mut self, instance: &str, output: &str) -> Result<Option<Value>>;
}

/// What came of one cycle.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Played {
    /// What its nodes wrote, in the order of their calls.
    Outputs(Vec<Digested>),
    /// A node asked the hardware for something.
    NeedsHardware,
    /// It was abandoned; why.
    Failed(String),
    /// The frame is none of such an instance; why.
    Unfit(String),
}

/// One output.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Digested {
    pub node: String,
    pub output: String,
    pub digest: u64,
}

impl Source for Players<'_> {
    fn play(&mut self, instance: &str, position: usize) -> Result<Played> {
        let Some((player, chunks)) = self.of(instance) else {
            return Ok(Played::Unfit("there is no such instance".to_owned()));
        };
        if player.frames.len() <= position {
            return Ok(Played::Unfit("there is no such frame".to_owned()));
        }
        match player.play(position, chunks) {
            Err(error) => return Ok(Played::Unfit(error.to_string())),
            Ok(Ran::NeedsHardware) => return Ok(Played::NeedsHardware),
            Ok(Ran::Failed(reason)) => return Ok(Played::Failed(reason)),
            Ok(Ran::Finished) => {}
        }
        let mut outputs = Vec::new();
        let Some(replay) = player.replay() else {
            return Ok(Played::Outputs(outputs));
        };
        let visited = replay.instance().digests(&mut |node, output, digest| {
            if player.runs(node) {
                outputs.push(Digested {
                    node: node.to_owned(),
                    output: output.to_owned(),
                    digest,
                });
            }
        });
        visited.map_err(|error| Error::new(error.to_string()))?;
        Ok(Played::Outputs(outputs))
    }

    fn value(&mut self, instance: &str, output: &str) -> Result<Option<Value>> {
        let player = self.of(instance).map(|(player, _)| player);
        let value = player.and_then(|player| player.replay()?.instance().main_output(output));
        Ok(value.and_then(|value| serde_json::to_value(value.as_serialize()).ok()))
    }
}
