//! What recording costs a cycler: no allocation; and what others make of the file.

use std::io::ErrorKind;
use std::process::Command;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use framework::driver::Observer;
use framework::recorded::Settings;
use framework::{CountingAllocator, Instance};
use serde_json::Value;

use super::{INSTANCES, SMALL, Tape, on, record_in_lockstep};

#[global_allocator]
static ALLOCATOR: CountingAllocator = CountingAllocator;

/// Lists what Python's `mcap` finds, with all check sums.
const READER: &str = r#"
import json, sys
from mcap.reader import make_reader
with open(sys.argv[1], "rb") as file:
    reader = make_reader(file, validate_crcs=True)
    counts = {}
    for _, channel, message in reader.iter_messages():
        counts[channel.topic] = counts.get(channel.topic, 0) + 1
    print(json.dumps({
        "counts": counts,
        "state": {entry.name: entry.metadata for entry in reader.iter_metadata()}["end"]["state"],
    }))
"#;

/// Counts what the recording allocates once it has its memory.
struct Counting {
    observer: Box<dyn Observer>,
    allocations: Arc<AtomicU64>,
    cycles: Arc<AtomicU64>,
}

impl Counting {
    fn count(&mut self, cycle: u64, observe: impl FnOnce(&mut dyn Observer)) {
        let so_far = || CountingAllocator::of_this_thread().expect("it is installed");
        let before = so_far();
        observe(self.observer.as_mut());
        let after = so_far();
        if cycle > 10 {
            self.allocations
                .fetch_add(after - before, Ordering::Relaxed);
            self.cycles.fetch_add(1, Ordering::Relaxed);
        }
    }
}

impl Observer for Counting {
    fn begun(&mut self, instance: &mut dyn Instance) {
        let cycle = instance.cycle().number;
        self.count(cycle, |observer| observer.begun(instance));
    }

    fn finished(&mut self, instance: &dyn Instance) {
        let cycle = instance.cycle().number;
        self.count(cycle, |observer| observer.finished(instance));
    }
}

#[test]
fn recording_allocates_nothing_on_the_cycler() {
    let tape = Tape::new();
    let (allocations, cycles) = <(Arc<AtomicU64>, Arc<AtomicU64>)>::default();
    record_in_lockstep(&tape.path, Settings::default(), on, &|_, observer| {
        Box::new(Counting {
            observer,
            allocations: allocations.clone(),
            cycles: cycles.clone(),
        })
    });
    assert!(cycles.load(Ordering::Relaxed) > 500);
    assert_eq!(allocations.load(Ordering::Relaxed), 0);
}

#[test]
fn python_reads_what_the_zoo_records() {
    let tape = Tape::new();
    let report = record_in_lockstep(&tape.path, SMALL, on, &super::as_it_is);
    let mut python = Command::new("python3");
    let output = match python.args(["-c", READER]).arg(&tape.path).output() {
        Err(error) if error.kind() == ErrorKind::NotFound => None,
        output => Some(output.expect("Python can be started")),
    };
    let output = output.filter(|output| {
        let said = String::from_utf8_lossy(&output.stderr);
        !said.contains("No module named 'mcap'")
    });
    let Some(output) = output else {
        return framework::testing::skip("python_reads_what_the_zoo_records", "pip install mcap");
    };
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{said}");
    let found: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    assert_eq!(found["state"], report.state());
    for (instance, told) in INSTANCES.into_iter().zip(&report.instances) {
        let frames = found["counts"][format!("frames/{instance}")].as_u64();
        // Most cycles have an end, too.
        let frames = frames.expect("there is such a channel");
        assert!(
            (told.recorded..=2 * told.recorded).contains(&frames),
            "{instance}: {frames} messages, {} frames",
            told.recorded
        );
    }
    for values in ["VisionTop", "VisionBottom", "Hearing", "parameters"] {
        assert!(
            found["counts"][format!("values/{values}")].as_u64() > Some(0),
            "{values}"
        );
    }
}
