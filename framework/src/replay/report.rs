//! A verification in words, and for programs.

use std::fmt;

use serde_json::{Value, json};

use super::{InstanceVerified, Verification};
use crate::recorded::Head;
use crate::time::Timestamp;

/// Bytes of a value that are shown.
const SHOWN: usize = 400;

/// The first output that is not what it was.
#[derive(Clone, Debug, PartialEq)]
pub struct Divergence {
    pub instance: &'static str,
    pub cycle: u64,
    /// When the cycle started.
    pub at: Timestamp,
    /// Empty: the cycle itself failed.
    pub node: String,
    pub output: String,
    /// What in the output differs first; empty for all of it, or where only digests are known.
    pub path: String,
    /// Of the recording, where it has the value.
    pub recorded: Option<Value>,
    pub recomputed: Option<Value>,
    /// Of the recording, where it has one, and of the replay.
    pub digests: (Option<u64>, u64),
    /// Why the cycle failed.
    pub failure: Option<String>,
}

impl Divergence {
    pub(super) fn of(
        instance: &'static str,
        head: Head,
        (node, output): (&str, &str),
        recorded: Option<u64>,
        recomputed: u64,
    ) -> Self {
        Self {
            instance,
            cycle: head.number,
            at: head.start,
            node: node.to_owned(),
            output: output.to_owned(),
            path: String::new(),
            recorded: None,
            recomputed: None,
            digests: (recorded, recomputed),
            failure: None,
        }
    }

    pub(super) fn failed(instance: &'static str, head: Head, failure: String) -> Self {
        Self {
            failure: Some(failure),
            ..Self::of(instance, head, ("", ""), None, 0)
        }
    }

    fn to_json(&self) -> Value {
        let digest = |digest: u64| format!("{digest:016x}");
        json!({
            "instance": self.instance,
            "cycle": self.cycle,
            "at_ns": self.at.as_nanos(),
            "node": self.node,
            "output": self.output,
            "path": self.path,
            "recorded": self.recorded,
            "recomputed": self.recomputed,
            "recorded_digest": self.digests.0.map(digest),
            "recomputed_digest": digest(self.digests.1),
            "failure": self.failure,
        })
    }
}

impl fmt::Display for Divergence {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            instance,
            cycle,
            at,
            node,
            output,
            ..
        } = self;
        write!(
            out,
            "the first divergence is in cycle {cycle} of {instance} at {at}"
        )?;
        if let Some(failure) = &self.failure {
            return write!(
                out,
                ": it finished when it was recorded, and fails now: {failure}"
            );
        }
        write!(out, ": `{output}` of `{node}`")?;
        if !self.path.is_empty() {
            write!(out, ", first in `{}`", self.path)?;
        }
        let (recorded, recomputed) = self.digests;
        let recorded = recorded.map_or("none".to_owned(), |digest| format!("digest {digest:016x}"));
        let recorded = shown(&self.recorded).unwrap_or(recorded);
        let value = shown(&self.recomputed).unwrap_or_default();
        let recomputed = match self.recorded {
            Some(_) => value,
            None => format!("{value} (digest {recomputed:016x})"),
        };
        write!(
            out,
            "\n  recorded:   {recorded}\n  recomputed: {recomputed}"
        )
    }
}

/// As much of a value as fits.
pub(super) fn shown(value: &Option<Value>) -> Option<String> {
    let mut text = value.as_ref().map(Value::to_string)?;
    if text.len() > SHOWN {
        let end = (0..=SHOWN).rev().find(|end| text.is_char_boundary(*end));
        text.truncate(end.unwrap_or_default());
        text.push('…');
    }
    Some(text)
}

/// Which nodes were run, where it was not all of them.
pub(super) fn recomputed(
    out: &mut fmt::Formatter<'_>,
    recomputed: &[(String, Vec<String>)],
) -> fmt::Result {
    recomputed.iter().try_for_each(|(instance, nodes)| {
        writeln!(out, "recomputed of {instance}: {}", nodes.join(", "))
    })
}

impl Verification {
    /// Version 1 of what `--format json` gives.
    pub fn to_json(&self) -> Value {
        json!({
            "version": 1,
            "good": self.is_good(),
            "complete": self.is_complete,
            "damaged": self.damaged,
            "instances": self.instances.iter().map(|one| json!({
                "instance": one.instance,
                "record": one.record,
                "wanted": one.wanted,
                "frames": one.frames,
                "dropped": one.dropped,
                "overwritten": one.overwritten,
                "verified": one.verified,
                "diverged": one.diverged,
                "outputs": one.outputs,
                "within_tolerance": one.within,
                "not_compared": one.not_compared,
                "unfinished": one.unfinished,
                "needs_hardware": one.needs_hardware,
                "unreadable": one.unreadable,
                "good": one.is_good(),
            })).collect::<Vec<_>>(),
            "divergence": self.divergence.as_ref().map(Divergence::to_json),
            "unknown": self.unknown,
            "recomputed": self.recomputed.iter().map(|(instance, nodes)| {
                json!({ "instance": instance, "nodes": nodes })
            }).collect::<Vec<_>>(),
            "tolerance": self.tolerance,
            "compared_within": self.compared_within,
            "graph": self.graph.as_ref().map(|(there, here)| json!({ "recorded": there, "here": here })),
            "numerics": self.numerics.as_ref().map(|(there, here)| json!({ "recorded": there, "here": here })),
            "numerics_of_std": self.numerics_of_std.as_ref().map(|(there, here)| json!({ "recorded": there, "here": here })),
        })
    }
}

impl Verification {
    /// What has to be said of other numerics, or of a tolerance in vain.
    fn of_numerics(&self) -> Option<String> {
        let other = |(there, here): &(String, String)| {
            format!("recorded with other numerics ({there}, here {here})")
        };
        let numerics = self.numerics.as_ref().or(self.numerics_of_std.as_ref());
        match (numerics, self.compared_within, self.tolerance) {
            (Some(numerics), Some(within), asked) => {
                let instead = match asked {
                    Some(_) => "",
                    None => " (`--tolerance NUMBER`: within another one, 0: bit for bit)",
                };
                Some(format!(
                    "{}: compared within {within:e} where the recording has values, else bit for bit{instead}",
                    other(numerics)
                ))
            }
            (Some(numerics), None, Some(_)) => Some(format!(
                "{}: compared bit for bit, as was asked for; results may differ in their last bits",
                other(numerics)
            )),
            // Nobody need know who calls no such function.
            (Some(_), None, None) => self.divergence.is_some().then(|| {
                "recorded where std's elementary functions give other bits: nodes that call them differ, those that call `framework::math` do not; `--tolerance 1e-6` compares within a tolerance".to_owned()
            }),
            (None, _, Some(_)) => Some(
                "recorded with the same numerics: compared bit for bit, without a tolerance".to_owned(),
            ),
            (None, _, None) => None,
        }
    }
}

impl fmt::Display for Verification {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        recomputed(out, &self.recomputed)?;
        writeln!(
            out,
            "{:<16} {:>8} {:>8} {:>9} {:>9}",
            "instance", "frames", "dropped", "verified", "outputs"
        )?;
        for one in &self.instances {
            writeln!(
                out,
                "{:<16} {:>8} {:>8} {:>9} {:>9}{}",
                one.instance,
                one.frames,
                one.dropped,
                one.verified,
                one.outputs,
                Remarks(one)
            )?;
        }
        for unknown in &self.unknown {
            writeln!(
                out,
                "{unknown}: this robot has no such instance, or cannot replay it"
            )?;
        }
        if self.graph.is_some() {
            writeln!(
                out,
                "recorded with another graph: instances that it changed do not fit, the others were replayed; `hulkgen diff REV` says what changed"
            )?;
        }
        if let Some(numerics) = self.of_numerics() {
            writeln!(out, "{numerics}")?;
        }
        if let Some(divergence) = &self.divergence {
            writeln!(out, "{divergence}")?;
        }
        Ok(())
    }
}

/// What there is to say of an instance beside its counts.
struct Remarks<'a>(&'a InstanceVerified);

impl fmt::Display for Remarks<'_> {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let one = self.0;
        let mut remarks = Vec::new();
        if one.was_never_asked_for() {
            remarks.push(format!("not recorded: never asked for ({})", one.record));
        } else if one.is_off() {
            remarks.push("off".to_owned());
        } else if one.had_no_cycle() {
            remarks.push("not recorded: it had no cycle".to_owned());
        } else if one.is_overwritten() {
            remarks.push("nothing left in the file".to_owned());
        } else if one.verified == 0 {
            remarks.push("nothing verified".to_owned());
        }
        if one.record.starts_with("every ") {
            remarks.push(one.record.clone());
        }
        for (count, what) in [
            (one.overwritten, "older ones overwritten"),
            (one.diverged, "diverged"),
            (one.within, "outputs within the tolerance"),
            (one.unfinished, "unfinished"),
            (one.needs_hardware, "needing hardware"),
        ] {
            if count > 0 {
                remarks.push(format!("{count} {what}"));
            }
        }
        if one.not_compared > 0 {
            remarks.push(not_comparable(one.not_compared));
        }
        remarks.extend(one.unreadable.clone());
        match remarks.as_slice() {
            [] => Ok(()),
            remarks => write!(out, "  {}", remarks.join(", ")),
        }
    }
}

fn not_comparable(outputs: u64) -> String {
    let (plural, whose) = if outputs == 1 {
        ("", "its digest was")
    } else {
        ("s", "their digests were")
    };
    format!("{outputs} output{plural} not comparable: only {whose} recorded")
}
