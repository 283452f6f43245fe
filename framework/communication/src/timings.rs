//! Reports of instances in the words of the protocol.

use std::time::Duration;

use framework::link::InstanceLink;
use framework::recorded::Counts;
use framework::report::{InstanceReport, NodeReport, QueueReport};
use framework::timing::Histogram;
use protocol::{
    Durations, Granted, InstanceTimings, NodeTimings, QueueTimings, RecordingCounts, RemoteTimings,
    Timings,
};

use crate::hub::Hub;

/// What instances told of themselves, for all requests that wait for it.
pub(crate) struct Told {
    instances: Vec<Instance>,
    /// How many requests there were.
    requests: u64,
}

#[derive(Default)]
struct Instance {
    last: Option<Box<InstanceReport>>,
    /// What it may write the next one on. The last one is kept meanwhile: other requests may be answered with it.
    blank: Option<Box<InstanceReport>>,
    /// Requests up to this one were made before the last report was written.
    answers: u64,
}

impl Told {
    pub(crate) fn new(instances: usize) -> Self {
        Self {
            instances: (0..instances).map(|_| Instance::default()).collect(),
            requests: 0,
        }
    }

    /// Takes what instances told meanwhile.
    pub(crate) fn fetch(&mut self, links: &[InstanceLink]) {
        for (instance, link) in self.instances.iter_mut().zip(links) {
            if let Some(new) = link.reports.take() {
                // The instance does not allocate: so it gets one that has room for all that it tells.
                let blank = instance.last.take().unwrap_or_else(|| new.clone());
                instance.last = Some(new);
                instance.blank = Some(blank);
                instance.answers = self.requests;
            }
        }
    }

    /// Asks all instances; the number of the request.
    pub(crate) fn ask(&mut self, links: &[InstanceLink]) -> u64 {
        // What was told until now is no answer.
        self.fetch(links);
        self.requests += 1;
        for (instance, link) in self.instances.iter_mut().zip(links) {
            link.reports.ask(instance.blank.take());
        }
        self.requests
    }

    /// Whether all instances have answered a request.
    pub(crate) fn have_answered(&self, request: u64, links: &[InstanceLink]) -> bool {
        let mut answers = self.answers(request, links);
        answers.all(|(_, answer)| answer.is_some())
    }

    /// What each tells; an instance that has finished no cycle since it told something has nothing to add.
    fn answers<'a>(
        &'a self,
        request: u64,
        links: &'a [InstanceLink],
    ) -> impl Iterator<Item = (&'a InstanceLink, Option<&'a InstanceReport>)> {
        links.iter().zip(&self.instances).map(move |(link, told)| {
            let is_current = |last: &&InstanceReport| {
                told.answers >= request || last.counts.cycles == link.counters.read().cycles
            };
            (link, told.last.as_deref().filter(is_current))
        })
    }
}

/// What all instances did; of one that has not answered there are counts alone.
pub(crate) fn describe(hub: &Hub, told: &Told, request: u64) -> Timings {
    let answers = told.answers(request, &hub.link.instances);
    let described = answers.map(|(instance, report)| {
        let counts = instance.counters.read();
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
