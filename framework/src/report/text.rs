//! The report for people: a table at the end of a run.

use std::fmt;

use super::{InstanceReport, NodeReport, RobotReport};
use crate::timing::Histogram;

impl fmt::Display for RobotReport {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let names = self
            .instances
            .iter()
            .map(|instance| instance.description.name.len());
        let width = names.max().unwrap_or(0).max("instance".len());
        writeln!(
            formatter,
            "{} ran for {:.1} s",
            self.target,
            self.duration.as_secs_f64()
        )?;
        writeln!(
            formatter,
            "{:width$}  {:>8}  {:>9}  {:>10}  {:>10}  {:>8}  {:>8}  {:>8}",
            "instance", "cycles", "rate", "p50", "p99", "overruns", "failures", "skipped"
        )?;
        for instance in &self.instances {
            let InstanceReport {
                description,
                counts,
                durations,
                ..
            } = instance;
            writeln!(
                formatter,
                "{:width$}  {:>8}  {:>6.1} Hz  {:>10}  {:>10}  {:>8}  {:>8}  {:>8}",
                description.name,
                counts.cycles,
                instance.rate(self.duration),
                quantile(&durations.cycle, 0.5),
                quantile(&durations.cycle, 0.99),
                counts.overruns,
                counts.failures,
                counts.skipped,
            )?;
        }
        self.instances
            .iter()
            .try_for_each(|instance| write_remarks(instance, formatter))?;
        match &self.recording {
            Some(recording) => write!(formatter, "{recording}"),
            None => Ok(()),
        }
    }
}

/// What is worth a line only where it happened.
fn write_remarks(instance: &InstanceReport, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
    let name = instance.description.name;
    let counts = &instance.counts;
    let happened = [
        (counts.abandoned, "cycle", "abandoned"),
        (counts.restarts, "restart", ""),
        (counts.no_events, "wait", "without an event"),
        (counts.corrected, "capture time", "replaced"),
        (counts.missed, "event", "missed"),
    ];
    for (count, what, how) in happened.into_iter().filter(|(count, ..)| *count > 0) {
        let line = format!("{name}: {} {how}", plural(count, what));
        writeln!(formatter, "{}", line.trim_end())?;
    }
    for (node, overruns) in &instance.slowest {
        writeln!(
            formatter,
            "{name}: `{node}` took longest in {}",
            plural(*overruns, "overrun")
        )?;
    }
    if let Some(mean) = instance.allocations.cycle.mean().filter(|mean| *mean > 0.0) {
        let per_call = |node: &NodeReport| node.allocations.mean().unwrap_or_default();
        let nodes = instance.nodes.iter().filter(|node| per_call(node) > 0.0);
        let most = nodes.max_by(|one, other| per_call(one).total_cmp(&per_call(other)));
        let most = most.map_or_else(String::new, |node| {
            format!(", most in `{}`: {:.1}", node.node, per_call(node))
        });
        let framework = instance.allocations.framework.mean().unwrap_or_default();
        writeln!(
            formatter,
            "{name}: {mean:.1} allocations a cycle, {framework:.1} of the framework{most}"
        )?;
    }
    for node in instance.nodes.iter().filter(|node| node.failures > 0) {
        writeln!(
            formatter,
            "{name}: `{}` failed in {} of {}",
            node.node,
            node.failures,
            plural(node.calls, "call")
        )?;
    }
    for queue in instance
        .queues
        .iter()
        .filter(|queue| queue.counts.dropped + queue.counts.expired > 0)
    {
        let counts = &queue.counts;
        writeln!(
            formatter,
            "{name}: from {}, {} expired, {} dropped, {} delivered",
            queue.from, counts.expired, counts.dropped, counts.delivered
        )?;
    }
    Ok(())
}

/// A count with its word, which takes an `s` where it has to.
pub(crate) fn plural(count: u64, what: &str) -> String {
    let ending = if count == 1 { "" } else { "s" };
    format!("{count} {what}{ending}")
}

fn quantile(histogram: &Histogram, share: f64) -> String {
    if histogram.count() == 0 {
        return "-".to_owned();
    }
    format!(
        "{:.1} us",
        histogram.quantile(share).as_nanos() as f64 / 1000.0
    )
}
