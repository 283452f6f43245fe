//! A comparison in words, and for programs.

use std::fmt;

use serde_json::{Value, json};

use super::report::shown;
use super::{Change, Comparison, InstanceCompared};

impl Comparison {
    /// Version 1 of what `--format json` gives.
    pub fn to_json(&self) -> Value {
        let (before, after) = &self.names;
        json!({
            "version": 1,
            "before": before,
            "after": after,
            "good": self.is_good(),
            "recomputed": self.recomputed.iter().map(|(instance, nodes)| {
                json!({ "instance": instance, "nodes": nodes })
            }).collect::<Vec<_>>(),
            "instances": self.instances.iter().map(InstanceCompared::to_json).collect::<Vec<_>>(),
            "changes": self.changes.iter().map(Change::to_json).collect::<Vec<_>>(),
            "unknown": self.unknown,
            "notes": self.notes,
        })
    }
}

impl InstanceCompared {
    fn to_json(&self) -> Value {
        json!({
            "instance": self.instance,
            "cycles": self.cycles,
            "changed": self.changed,
            "outputs": self.outputs,
            "carried": self.carried,
            "needs_hardware": self.needs_hardware,
            "only_before": self.alone.0,
            "only_after": self.alone.1,
            "unfit": self.unfit,
        })
    }
}

impl Change {
    fn to_json(&self) -> Value {
        json!({
            "instance": self.instance,
            "node": self.node,
            "output": self.output,
            "cycles": self.cycles,
            "first": {
                "cycle": self.cycle,
                "at_ns": self.at.as_nanos(),
                "path": self.path,
                "before": self.before,
                "after": self.after,
            },
        })
    }
}

impl fmt::Display for Comparison {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        super::report::recomputed(out, &self.recomputed)?;
        writeln!(
            out,
            "{:<16} {:>8} {:>8} {:>9}",
            "instance", "cycles", "changed", "outputs"
        )?;
        for one in &self.instances {
            let InstanceCompared {
                instance,
                cycles,
                changed,
                outputs,
                ..
            } = one;
            write!(out, "{instance:<16} {cycles:>8} {changed:>8} {outputs:>9}")?;
            if let Some(carried) = one.carried {
                write!(out, "  {carried} carried on")?;
            }
            if one.needs_hardware > 0 {
                write!(out, "  {} needing hardware", one.needs_hardware)?;
            }
            if let Some(unfit) = &one.unfit {
                write!(out, "  does not fit: {unfit}")?;
            }
            writeln!(out)?;
            let (before, after) = &self.names;
            for (alone, name) in [(&one.alone.0, before), (&one.alone.1, after)] {
                if !alone.is_empty() {
                    writeln!(out, "  only {name}: {}", alone.join(", "))?;
                }
            }
        }
        for unknown in &self.unknown {
            writeln!(
                out,
                "{unknown}: this robot has no such instance, or cannot replay it"
            )?;
        }
        for note in &self.notes {
            writeln!(out, "{note}")?;
        }
        if self.changes.is_empty() && self.is_good() {
            writeln!(out, "no output changes")?;
        }
        for change in &self.changes {
            write(out, change, &self.names)?;
        }
        Ok(())
    }
}

fn write(
    out: &mut fmt::Formatter<'_>,
    change: &Change,
    (before, after): &(String, String),
) -> fmt::Result {
    let Change {
        instance,
        node,
        output,
        cycles,
        cycle,
        at,
        path,
        ..
    } = change;
    match node.as_str() {
        "" => write!(out, "how cycles of {instance} end")?,
        node => write!(out, "`{output}` of `{node}` in {instance}")?,
    }
    let plural = if *cycles == 1 { "" } else { "s" };
    write!(
        out,
        " changes in {cycles} cycle{plural}, first in cycle {cycle} at {at}"
    )?;
    if !path.is_empty() {
        write!(out, ", there first in `{path}`")?;
    }
    let value = |value: &Option<Value>| shown(value).unwrap_or_else(|| "none".to_owned());
    let width = before.chars().count().max(after.chars().count()) + 1;
    writeln!(
        out,
        "\n  {:width$} {}\n  {:width$} {}",
        format!("{before}:"),
        value(&change.before),
        format!("{after}:"),
        value(&change.after)
    )
}
