//! In the steady state a cycle allocates nothing, timed or not.

use std::time::Duration;

use framework::cycler::Reference;
use framework::recorded::{
    Describing, Digests, Loaded, Loading, Outputs, Recorded, SaveError, Saving, Stored, Values,
};
use framework::report::Allocations;
use framework::{
    Answerer, Body, Clock, Cycle, Cycler, Finished, Guarded, Injected, Injection, InjectionCell,
    InjectionTable, Instance, InstanceDescription, Kind, NodeReport, OnFailure, OutputVisitor,
    QueueReport, Reader, Reflect, Result, RobotReport, Scheduling, Slots, State, Subscriptions,
    Tap, Timestamp, Waited, buffer, procedure, timing,
};

use crate::counting::allocations;

const NODES: usize = 20;

#[derive(Clone, Default, Outputs)]
struct Injections {
    sums: Injection<f32>,
}

impl InjectionTable for Injections {
    fn get_mut(&mut self, _: &str) -> Option<&mut dyn InjectionCell> {
        Some(&mut self.sums)
    }
}

/// Twenty nodes that add one each.
struct Adding {
    nodes: [Guarded<f32>; NODES],
    /// The first node but one allocates so often.
    greed: usize,
    injections: Reader<Injected<Injections>>,
    subscriptions: Subscriptions,
    procedure: Answerer<u32, u32>,
    /// An output with memory of its own.
    trace: Vec<f32>,
}

impl Body for Adding {
    type Shared = [f32; NODES];

    fn create(&mut self) -> Result<()> {
        Ok(())
    }

    fn wait(&mut self, _: Slots<'_, Self::Shared>, _: Cycle) -> Result<Option<Timestamp>> {
        framework::blocking(|| Ok(None))
    }

    fn begin(&mut self, _: Slots<'_, Self::Shared>, _: Cycle) {
        self.injections.take();
        self.procedure.take();
        assert!(!self.subscriptions.changed());
    }

    fn run(&mut self, slots: Slots<'_, Self::Shared>, cycle: Cycle) -> Result<()> {
        for (index, node) in self.nodes.iter_mut().enumerate() {
            let greed = if index == 1 { self.greed } else { 0 };
            slots.current[index] = node.call(&cycle, |state| {
                (0..greed).for_each(|number| drop(std::hint::black_box(Box::new(number))));
                *state += 1.0;
                Ok::<_, framework::Error>(*state + slots.previous[index])
            })?;
            if let Some(injections) = self.injections.view().get() {
                injections.sums.replace(&mut slots.current[index]);
            }
        }
        Ok(())
    }

    fn finish(&mut self, _: &Self::Shared, _: Cycle) {
        self.procedure.close();
    }

    fn abandon(&mut self) {}

    fn references(&self, _: &mut dyn FnMut(Reference)) {}

    fn main_outputs(&self) -> &'static [&'static str] {
        &["sums", "trace"]
    }

    fn main_output<'a>(&'a self, _: &'a Self::Shared, _: &str) -> Option<&'a dyn Reflect> {
        None
    }

    fn additional_output(&self, _: &str, _: u64) -> Option<&dyn Reflect> {
        None
    }

    fn outputs<'a>(
        &'a self,
        shared: &'a Self::Shared,
        _: u64,
        visitor: &mut impl OutputVisitor<'a>,
    ) {
        visitor.output(Some(shared));
        visitor.output(Some(&self.trace));
    }

    fn nodes(&self, visit: &mut dyn FnMut(NodeReport)) {
        self.nodes.iter().for_each(|node| visit(node.report()));
    }

    fn queues(&self, _: &mut dyn FnMut(QueueReport)) {}

    fn states(&mut self, _: &mut dyn FnMut(&'static str, &mut dyn State)) {}

    fn restore(&mut self) -> Result<()> {
        Ok(())
    }
}

impl Recorded for Adding {
    type Outside = ();

    const DIGESTED: &'static [(&'static str, &'static str)] = &[("adding", "sums")];

    fn values(&self, _: &mut Values<'_, '_>) -> Result<(), SaveError> {
        Ok(())
    }

    fn save(
        &self,
        _: u64,
        slots: Slots<'_, Self::Shared>,
        _: Option<Timestamp>,
        out: &mut Saving<'_, '_>,
    ) {
        self.nodes.iter().for_each(|node| node.record(out));
        self.injections.save_injected(out);
        self.procedure.save(out);
        out.put(slots.previous);
    }

    fn describe(types: &mut Describing<Self>) {
        types.shared_previous("sums", |sums| sums);
    }

    fn load(
        &mut self,
        _: u64,
        _: Loaded<'_, Self::Shared>,
        (): &mut (),
        _: &mut Loading<'_>,
        _: &Stored<'_>,
    ) -> Result<()> {
        Err(framework::Error::new("nobody replays it"))
    }

    fn digests(&self, shared: &Self::Shared, digests: &mut Digests<'_, '_>) {
        digests.add(shared);
    }
}

const DESCRIPTION: InstanceDescription = InstanceDescription {
    name: "Adding",
    cycler: "Adding",
    kind: Kind::Perception,
    on_failure: OnFailure::Stop,
    deadline: Some(Duration::from_secs(60)),
    pending_timeout: Duration::from_secs(1),
    watchdog: Duration::from_secs(1),
    history: Duration::from_secs(1),
    lockstep_duration: None,
    scheduling: Scheduling {
        policy: None,
        priority: None,
        cores: &[],
    },
    record: framework::Record::On,
};

fn turn(instance: &mut dyn Instance, cycles: u64) {
    for _ in 0..cycles {
        assert_eq!(instance.wait().expect("no node fails"), Waited::Ready);
        instance.begin();
        instance.run();
        assert_eq!(
            instance.finish().expect("no node fails"),
            Finished::Completed
        );
    }
}

fn cycler(greed: usize) -> Cycler<Adding> {
    let (writer, [_reader], []) = buffer::<[f32; NODES], 1, 0>([]);
    let (_injector, [injections], []) = buffer([]);
    let (_caller, procedure) = procedure();
    let name = |index| match index {
        0 => "test::first",
        1 => "test::greedy",
        _ => "test::node",
    };
    let body = Adding {
        nodes: std::array::from_fn(|index| Guarded::new(name(index), OnFailure::Stop, 0.0)),
        greed,
        injections,
        subscriptions: Subscriptions::new(&["a"]),
        procedure,
        trace: vec![0.5; 1000],
    };
    Cycler::new(DESCRIPTION, body, writer, Clock::wall())
}

#[test]
fn a_cycle_allocates_nothing() {
    let mut cycler = cycler(0);
    turn(&mut cycler, 100);
    let before = allocations();
    turn(&mut cycler, 10_000);
    timing::set(timing::Timing::Complete);
    turn(&mut cycler, 1_000);
    assert_eq!(allocations() - before, 0);
    assert_eq!(cycler.counters().cycles.get(), 11_100);
}

#[test]
fn a_cycle_that_is_copied_for_a_server_allocates_nothing() {
    let mut cycler = cycler(0);
    let (mut taps, reports) = cycler.tap(&Subscriptions::new(&[]));
    assert_eq!(taps.len(), 2);
    taps.iter_mut().for_each(Tap::open);
    let mut taken = 0;
    let mut take_all = |taps: &mut [Tap]| {
        for tap in taps {
            while tap.take(|_| taken += 1) {}
        }
    };
    for _ in 0..10 {
        turn(&mut cycler, 15);
        take_all(&mut taps);
    }
    timing::set(timing::Timing::Complete);
    reports.ask(None);
    turn(&mut cycler, 15);
    take_all(&mut taps);
    let mut report = reports.take();
    let before = allocations();
    for _ in 0..100 {
        reports.ask(report.take());
        turn(&mut cycler, 15);
        take_all(&mut taps);
        report = reports.take();
        assert!(report.is_some());
    }
    assert_eq!(allocations() - before, 0);
    assert_eq!(taken, 2 * 111 * 15);
    // More than there is room for, with each node of each of the last cycles.
    turn(&mut cycler, timing::KEPT as u64 / NODES as u64);
    let spans: Vec<_> = std::iter::from_fn(|| reports.take_span()).collect();
    assert_eq!(spans.len(), timing::KEPT);
    assert_eq!(
        spans.last().map(|span| (span.node, span.cycle)),
        Some((None, cycler.cycle().number))
    );
}

#[test]
fn what_a_node_allocates_is_told_by_node() {
    timing::set(timing::Timing::Complete);
    let mut cycler = cycler(3);
    turn(&mut cycler, 50);
    let report = cycler.report();
    let all = |total, most| Allocations {
        looks: 50,
        total,
        most,
    };
    let [first, greedy, ..] = &report.nodes[..] else {
        panic!("there are twenty")
    };
    assert_eq!((first.node, first.allocations), ("test::first", all(0, 0)));
    let of_greedy = (greedy.node, greedy.allocations);
    assert_eq!(of_greedy, ("test::greedy", all(150, 3)));
    assert_eq!(greedy.allocations.mean(), Some(3.0));
    assert_eq!(report.allocations.cycle, all(150, 3));
    assert_eq!(report.allocations.framework, all(0, 0));
    let report = RobotReport {
        target: "test",
        duration: Duration::from_secs(1),
        instances: vec![report],
        recording: None,
    };
    let told = report.to_string();
    let line = "Adding: 3.0 allocations a cycle, 0.0 of the framework, most in `test::greedy`: 3.0";
    assert!(told.contains(line), "{told}");
    let json = report.to_json();
    let greedy = &json["instances"][0]["nodes"][1]["allocations"];
    assert_eq!(*greedy, serde_json::json!({ "mean": 3.0, "max": 3 }));
}
