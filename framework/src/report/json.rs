//! The report for programs: what `run --format json` ends with.

use std::time::Duration;

use serde_json::{Value, json};

use super::{Allocations, InstanceReport, NodeReport, QueueReport, RobotReport};
use crate::recorded::RecordingReport;
use crate::scheduling::{Granted, Policy};
use crate::timing::Histogram;

impl RobotReport {
    /// Version 1 of the report; durations in microseconds, null where nothing was timed.
    pub fn to_json(&self) -> Value {
        let instances = self
            .instances
            .iter()
            .map(|instance| instance_to_json(instance, self.duration));
        json!({
            "version": 1,
            "target": self.target,
            "duration_s": self.duration.as_secs_f64(),
            "instances": instances.collect::<Vec<_>>(),
            "recording": self.recording.as_ref().map(|one| one.ended.path.display().to_string()),
            "recording_state": self.recording.as_ref().map(RecordingReport::state),
            "recording_error": self.recording.as_ref().and_then(RecordingReport::error),
            "recorded": self.recording.as_ref().map(RecordingReport::to_json),
        })
    }
}

fn instance_to_json(instance: &InstanceReport, duration: Duration) -> Value {
    let InstanceReport {
        description,
        counts,
        durations,
        ..
    } = instance;
    json!({
        "instance": description.name,
        "cycler": description.cycler,
        "kind": description.kind.name(),
        "cycles": counts.cycles,
        "rate_hz": instance.rate(duration),
        "overruns": counts.overruns,
        "failures": counts.failures,
        "skipped": counts.skipped,
        "cycle_us": {
            "p50": quantile(&durations.cycle, 0.5),
            "p99": quantile(&durations.cycle, 0.99),
            "max": longest(&durations.cycle),
        },
        "lateness_us": quantiles(&durations.lateness),
        "wait_us": quantiles(&durations.wait),
        "setup_us": quantiles(&durations.setup),
        "framework_us": quantiles(&durations.framework),
        "allocations": allocations_to_json(&instance.allocations.cycle),
        "framework_allocations": allocations_to_json(&instance.allocations.framework),
        "slots": { "number": instance.slots.number, "bytes": instance.slots.bytes },
        "scheduling": instance.granted.as_ref().map(granted_to_json),
        "nodes": instance.nodes.iter().map(node_to_json).collect::<Vec<_>>(),
        "queues": instance.queues.iter().map(queue_to_json).collect::<Vec<_>>(),
    })
}

fn granted_to_json(granted: &Granted) -> Value {
    json!({
        "policy": granted.policy.map(Policy::name),
        "priority": granted.priority,
        "cores": granted.cores,
        "memory_locked": granted.memory_is_locked,
    })
}

fn node_to_json(node: &NodeReport) -> Value {
    json!({
        "node": node.node,
        "p50": quantile(&node.histogram, 0.5),
        "p99": quantile(&node.histogram, 0.99),
        "max": longest(&node.histogram),
        "calls": node.calls,
        "skipped": node.skipped,
        "failures": node.failures,
        "allocations": allocations_to_json(&node.allocations),
    })
}

fn allocations_to_json(allocations: &Allocations) -> Value {
    let mean = allocations.mean();
    mean.map_or(
        Value::Null,
        |mean| json!({ "mean": mean, "max": allocations.most }),
    )
}

fn queue_to_json(queue: &QueueReport) -> Value {
    json!({
        "from": queue.from,
        "delivered": queue.counts.delivered,
        "late": queue.counts.late,
        "expired": queue.counts.expired,
        "abandoned": queue.counts.abandoned,
        "dropped": queue.counts.dropped,
    })
}

fn quantiles(histogram: &Histogram) -> Value {
    json!({ "p50": quantile(histogram, 0.5), "p99": quantile(histogram, 0.99) })
}

fn quantile(histogram: &Histogram, share: f64) -> Option<f64> {
    (histogram.count() > 0).then(|| micros(histogram.quantile(share)))
}

fn longest(histogram: &Histogram) -> Option<f64> {
    (histogram.count() > 0).then(|| micros(histogram.longest()))
}

fn micros(duration: Duration) -> f64 {
    duration.as_nanos() as f64 / 1000.0
}
