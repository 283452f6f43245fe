//! Reports of instances in the words of the protocol.

use std::time::Duration;

use framework::recorded::Counts;
use framework::report::{InstanceReport, NodeReport, QueueReport};
use framework::timing::Histogram;
use protocol::{
    Durations, Granted, InstanceTimings, NodeTimings, QueueTimings, RecordingCounts, RemoteTimings,
    Timings,
};

use crate::hub::Hub;

/// What all instances did; of one that did not report there are counts alone.
pub(crate) fn describe(hub: &Hub, reports: &[Option<Box<InstanceReport>>]) -> Timings {
    let instances = hub.link.instances.iter();
    let described = instances.zip(reports).map(|(instance, report)| {
        let counts = instance.counters.read();
        let report = report.as_deref();
        let nodes = report.map(|report| &report.nodes[..]).unwrap_or_default();
        let queues = report.map(|report| &report.queues[..]).unwrap_or_default();
        InstanceTimings {
            name: instance.description.name.to_owned(),
            cycles: counts.cycles,
            overruns: counts.overruns,
            failures: counts.failures,
            deadline: instance.description.deadline.map(micros),
            cycle: report.and_then(|report| durations(&report.durations.cycle)),
            lateness: report.and_then(|report| durations(&report.durations.lateness)),
            framework: report.and_then(|report| durations(&report.durations.framework)),
            scheduling: instance.counters.granted().map(granted),
            nodes: nodes.iter().map(node).collect(),
            queues: queues.iter().map(queue).collect(),
        }
    });
    let remotes = hub.link.remotes.iter().enumerate();
    let remotes = remotes.map(|(index, remote)| {
        let counts = remote.counts();
        RemoteTimings {
            name: remote.instance().to_owned(),
            is_fed: hub.is_fed(index),
            completed: counts.completed,
            unannounced: counts.unannounced,
            abandoned: counts.abandoned,
            refused: counts.refused,
        }
    });
    let recorded = hub.link.recorded.iter();
    Timings {
        time: hub.link.clock.now().as_nanos(),
        instances: described.collect(),
        remotes: remotes.collect(),
        recording: recorded.map(|(of, counts)| recording(of, counts)).collect(),
    }
}

fn granted(granted: &framework::Granted) -> Granted {
    let cores = granted
        .cores
        .iter()
        .map(|core| u32::try_from(*core).unwrap_or(u32::MAX));
    Granted {
        policy: granted.policy.map(|policy| policy.name().to_owned()),
        priority: granted.priority,
        cores: cores.collect(),
        memory_locked: granted.memory_is_locked,
    }
}

fn node(report: &NodeReport) -> NodeTimings {
    NodeTimings {
        node: report.node.to_owned(),
        calls: report.calls,
        skipped: report.skipped,
        failures: report.failures,
        durations: durations(&report.histogram),
    }
}

fn queue(report: &QueueReport) -> QueueTimings {
    QueueTimings {
        from: report.from.to_owned(),
        delivered: report.counts.delivered,
        late: report.counts.late,
        dropped: report.counts.dropped,
    }
}

fn recording(of: &str, counts: &Counts) -> RecordingCounts {
    RecordingCounts {
        of: of.to_owned(),
        recorded: counts.recorded(),
        dropped: counts.dropped(),
        failed: counts.failed(),
        lost: counts.lost(),
        overwritten: counts.overwritten(),
    }
}

fn durations(histogram: &Histogram) -> Option<Durations> {
    (histogram.count() > 0).then(|| Durations {
        p50: micros(histogram.quantile(0.5)),
        p99: micros(histogram.quantile(0.99)),
        max: micros(histogram.longest()),
    })
}

fn micros(duration: Duration) -> f64 {
    duration.as_nanos() as f64 / 1000.0
}
