//! What two recomputations of the same cycles differ in.

use std::collections::BTreeMap;

use serde_json::Value;

use super::difference::first_difference;
use super::{Digested, Needed, Played, Players, Source};
use crate::error::Result;
use crate::recorded::Head;
use crate::time::Timestamp;

/// What came of it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Comparison {
    /// Who recomputed first, and who then.
    pub names: (String, String),
    /// By instance, if not all of it: which nodes were run.
    pub recomputed: Vec<(String, Vec<String>)>,
    /// In manifest order.
    pub instances: Vec<InstanceCompared>,
    /// The earliest first.
    pub changes: Vec<Change>,
    /// Instances of the recording that this robot does not have or cannot replay.
    pub unknown: Vec<String>,
    /// What else there is to know.
    pub notes: Vec<String>,
}

/// What came of one instance.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct InstanceCompared {
    pub instance: String,
    /// Cycles that both recomputed.
    pub cycles: u64,
    /// Those of them in which an output differs, or that only one of them finished.
    pub changed: u64,
    /// Outputs that were compared.
    pub outputs: u64,
    /// Of the second, cycles that went on with what the one before them left behind; `None`: that was not asked.
    pub carried: Option<u64>,
    /// Cycles in which a node asked the hardware for something.
    pub needs_hardware: u64,
    /// Outputs that one of the two does not have: of the first, of the second.
    pub alone: (Vec<String>, Vec<String>),
    /// Why the frames could not be replayed.
    pub unfit: Option<String>,
}

/// An output that differs.
#[derive(Clone, Debug, PartialEq)]
pub struct Change {
    pub instance: String,
    /// Empty: cycles fail, or do no longer.
    pub node: String,
    pub output: String,
    /// In so many cycles.
    pub cycles: u64,
    /// The first of them.
    pub cycle: u64,
    pub at: Timestamp,
    /// What in the output differs there first; empty for all of it.
    pub path: String,
    pub before: Option<Value>,
    pub after: Option<Value>,
}

impl Comparison {
    /// Whether there was anything to compare.
    pub fn is_good(&self) -> bool {
        self.instances.iter().any(|one| one.cycles > 0)
    }
}

/// Both recompute every cycle; `after` knows which there are.
///
/// # Errors
/// If one of the two has no answer any more.
pub fn compare(
    before: &mut dyn Source,
    after: &mut Players<'_>,
    needed: Option<&Needed>,
) -> Result<Comparison> {
    let needed_nodes = needed.into_iter().flat_map(Needed::all);
    let mut comparison = Comparison {
        unknown: after.unknown.clone(),
        recomputed: needed_nodes
            .map(|(instance, nodes)| (instance.to_owned(), nodes.to_vec()))
            .collect(),
        ..Comparison::default()
    };
    let players = after.players.iter();
    let all = players.map(|player| {
        let mut compared = Compared::new(player.instance, needed);
        if !player.is_known {
            compared.counts.unfit = Some("the recording has no such instance".to_owned());
        }
        compared
    });
    let mut all: Vec<_> = all.collect();
    for (index, position) in after.in_file_order() {
        let compared = &mut all[index];
        if compared.counts.unfit.is_none() {
            let head = after.players[index].frames[position].head;
            compared.add(position, head, before, after)?;
        }
    }
    for (mut compared, player) in all.into_iter().zip(&after.players) {
        compared.counts.carried = player.carried();
        comparison.instances.push(compared.counts);
        comparison.changes.extend(compared.changes.into_values());
    }
    comparison
        .changes
        .sort_by_key(|change| (change.at, change.instance.clone()));
    Ok(comparison)
}

/// One instance.
struct Compared<'n> {
    counts: InstanceCompared,
    /// By the place of the output among the calls.
    changes: BTreeMap<usize, Change>,
    needed: Option<&'n Needed>,
}

impl<'n> Compared<'n> {
    fn new(instance: &str, needed: Option<&'n Needed>) -> Self {
        Self {
            counts: InstanceCompared {
                instance: instance.to_owned(),
                ..InstanceCompared::default()
            },
            changes: BTreeMap::new(),
            needed,
        }
    }

    fn add(
        &mut self,
        position: usize,
        head: Head,
        before: &mut dyn Source,
        after: &mut Players<'_>,
    ) -> Result<()> {
        let instance = self.counts.instance.clone();
        let here = after.play(&instance, position)?;
        let there = before.play(&instance, position)?;
        let is_same = match (there, here) {
            (Played::Unfit(reason), _) | (_, Played::Unfit(reason)) => {
                let cycle = head.number;
                self.counts.unfit = Some(format!("cycle {cycle}: {reason}"));
                return Ok(());
            }
            (Played::NeedsHardware, _) | (_, Played::NeedsHardware) => {
                self.counts.needs_hardware += 1;
                return Ok(());
            }
            (Played::Outputs(there), Played::Outputs(here)) => {
                self.outputs(head, &there, &here, before, after)?
            }
            (there, here) => {
                let said = |played: &Played| match played {
                    Played::Failed(reason) => Value::from(reason.as_str()),
                    _ => Value::from("finished"),
                };
                let is_same = there == here;
                if !is_same {
                    let values = (Some(said(&there)), Some(said(&here)));
                    self.change(usize::MAX, ("", ""), head, || Ok(values))?;
                }
                is_same
            }
        };
        self.counts.cycles += 1;
        self.counts.changed += u64::from(!is_same);
        Ok(())
    }

    /// Whether all that both have is the same.
    fn outputs(
        &mut self,
        head: Head,
        there: &[Digested],
        here: &[Digested],
        before: &mut dyn Source,
        after: &mut Players<'_>,
    ) -> Result<bool> {
        let is_asked = |one: &&Digested| self.needed.is_none_or(|needed| needed.node == one.node);
        let there: Vec<_> = there.iter().filter(is_asked).collect();
        let here: Vec<_> = here.iter().filter(is_asked).collect();
        self.alone(&there, &here);
        let mut is_same = true;
        for (place, one) in here.into_iter().enumerate() {
            let name = |one: &&Digested| (one.node.clone(), one.output.clone());
            let Some(other) = there.iter().find(|other| name(other) == name(&one)) else {
                continue;
            };
            self.counts.outputs += 1;
            if other.digest == one.digest {
                continue;
            }
            is_same = false;
            let instance = self.counts.instance.clone();
            self.change(place, (&one.node, &one.output), head, || {
                Ok((
                    before.value(&instance, &one.output)?,
                    after.value(&instance, &one.output)?,
                ))
            })?;
        }
        Ok(is_same)
    }

    /// Which outputs only one of the two has: the same in every cycle.
    fn alone(&mut self, there: &[&Digested], here: &[&Digested]) {
        if self.counts.cycles > 0 {
            return;
        }
        let missing = |these: &[&Digested], those: &[&Digested]| {
            let is_missing = |one: &&&Digested| {
                let mut those = those.iter();
                !those.any(|other| (&other.node, &other.output) == (&one.node, &one.output))
            };
            let alone = these.iter().filter(is_missing);
            alone
                .map(|one| format!("{} of {}", one.output, one.node))
                .collect()
        };
        self.counts.alone = (missing(there, here), missing(here, there));
    }

    fn change(
        &mut self,
        place: usize,
        (node, output): (&str, &str),
        head: Head,
        values: impl FnOnce() -> Result<(Option<Value>, Option<Value>)>,
    ) -> Result<()> {
        if let Some(known) = self.changes.get_mut(&place) {
            known.cycles += 1;
            return Ok(());
        }
        let (before, after) = values()?;
        let path = match (&before, &after) {
            (Some(before), Some(after)) => first_difference(before, after),
            _ => String::new(),
        };
        self.changes.insert(
            place,
            Change {
                instance: self.counts.instance.clone(),
                node: node.to_owned(),
                output: output.to_owned(),
                cycles: 1,
                cycle: head.number,
                at: head.start,
                path,
                before,
                after,
            },
        );
        Ok(())
    }
}
