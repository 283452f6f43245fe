//! The last seconds as a trace: the Trace Event Format of Chrome, which Perfetto opens, too.

use std::collections::VecDeque;
use std::time::Duration;

use framework::link::{InstanceLink, Link};
use framework::timing::{KEPT, Span};
use serde_json::{Value, json};

/// All events lie in one process: the robot.
const PROCESS: u32 = 1;

/// What instances left of their timed cycles and was fetched so far, oldest first.
pub(crate) struct Traces(Vec<VecDeque<Span>>);

impl Traces {
    pub(crate) fn new(instances: usize) -> Self {
        Self((0..instances).map(|_| VecDeque::new()).collect())
    }

    /// The cycles and node calls that ended within that time before now; where there are more, so many of the newest.
    pub(crate) fn describe(&mut self, link: &Link, time: Duration, most: usize) -> Value {
        let since = link.clock.now().as_nanos();
        let since = since.saturating_sub(u64::try_from(time.as_nanos()).unwrap_or(u64::MAX));
        for (instance, spans) in link.instances.iter().zip(&mut self.0) {
            fetch(instance, spans);
        }
        let since = since.max(self.newest(most));
        let mut events = vec![named("process_name", 0, link.robot)];
        for ((thread, instance), spans) in (1..).zip(&link.instances).zip(&self.0) {
            let name = instance.description.name;
            events.push(named("thread_name", thread, name));
            let mut newest: Vec<_> = spans.iter().filter(|span| end(span) >= since).collect();
            // A cycle before the nodes in it.
            newest.sort_by_key(|span| (span.begins, span.node.is_some()));
            events.extend(newest.into_iter().map(|span| event(thread, name, span)));
        }
        json!({ "displayTimeUnit": "ms", "traceEvents": events })
    }

    /// When the oldest of so many spans of all instances ended.
    fn newest(&self, most: usize) -> u64 {
        let mut ends: Vec<_> = self.0.iter().flatten().map(end).collect();
        if ends.len() <= most {
            return 0;
        }
        let oldest = ends.len() - most;
        *ends.select_nth_unstable(oldest).1
    }
}

fn end(span: &Span) -> u64 {
    (span.begins + span.duration).as_nanos()
}

/// Takes what is new, and forgets as much of the oldest as the instance would.
fn fetch(instance: &InstanceLink, spans: &mut VecDeque<Span>) {
    // No more than there is room for: the instance goes on meanwhile.
    let new = (0..KEPT).map_while(|_| instance.reports.take_span());
    spans.extend(new);
    let surplus = spans.len().saturating_sub(KEPT);
    spans.drain(..surplus);
}

/// The name of the process, or of a thread in it.
fn named(what: &str, thread: u32, name: &str) -> Value {
    json!({ "name": what, "ph": "M", "pid": PROCESS, "tid": thread, "args": { "name": name } })
}

/// Times are in microseconds.
fn event(thread: u32, instance: &str, span: &Span) -> Value {
    let micros = |nanos: u64| nanos as f64 / 1000.0;
    let category = if span.node.is_some() { "node" } else { "cycle" };
    json!({
        "name": span.node.unwrap_or(instance),
        "cat": category,
        "ph": "X",
        "ts": micros(span.begins.as_nanos()),
        "dur": micros(u64::try_from(span.duration.as_nanos()).unwrap_or(u64::MAX)),
        "pid": PROCESS,
        "tid": thread,
        "args": { "cycle": span.cycle },
    })
}
