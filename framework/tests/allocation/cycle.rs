//! In the steady state a cycle allocates nothing, timed or not.

use std::time::Duration;

use framework::cycler::Reference;
use framework::{
    Answerer, Body, Clock, Cycle, Cycler, Finished, Guarded, Injected, Injection, InjectionCell,
    InjectionTable, Instance, InstanceDescription, Kind, NodeReport, OnFailure, QueueReport,
    Reader, Reflect, Result, Scheduling, Slots, State, Subscriptions, Timestamp, Waited, buffer,
    procedure, timing,
};

use crate::counting::allocations;

const NODES: usize = 20;

#[derive(Clone, Default)]
struct Injections(Injection<f32>);

impl InjectionTable for Injections {
    fn get_mut(&mut self, _: &str) -> Option<&mut dyn InjectionCell> {
        Some(&mut self.0)
    }
}

/// Twenty nodes that add one each.
struct Adding {
    nodes: [Guarded<f32>; NODES],
    injections: Reader<Injected<Injections>>,
    subscriptions: Subscriptions,
    procedure: Answerer<u32, u32>,
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
            slots.current[index] = node.call(&cycle, |state| {
                *state += 1.0;
                Ok::<_, framework::Error>(*state + slots.previous[index])
            })?;
            if let Some(injections) = self.injections.view().get() {
                injections.0.replace(&mut slots.current[index]);
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
        &[]
    }

    fn main_output<'a>(&'a self, _: &'a Self::Shared, _: &str) -> Option<&'a dyn Reflect> {
        None
    }

    fn additional_output(&self, _: &str, _: u64) -> Option<&dyn Reflect> {
        None
    }

    fn nodes(&self, _: &mut dyn FnMut(NodeReport)) {}

    fn queues(&self, _: &mut dyn FnMut(QueueReport)) {}

    fn states(&mut self, _: &mut dyn FnMut(&'static str, &mut dyn State)) {}

    fn restore(&mut self) -> Result<()> {
        Ok(())
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

#[test]
fn a_cycle_allocates_nothing() {
    let (writer, [_reader], []) = buffer::<[f32; NODES], 1, 0>([]);
    let (_injector, [injections], []) = buffer([]);
    let (_caller, procedure) = procedure();
    let body = Adding {
        nodes: std::array::from_fn(|_| Guarded::new("test::node", OnFailure::Stop, 0.0)),
        injections,
        subscriptions: Subscriptions::new(&["a"]),
        procedure,
    };
    let mut cycler = Cycler::new(DESCRIPTION, body, writer, Clock::wall());
    turn(&mut cycler, 100);
    let before = allocations();
    turn(&mut cycler, 10_000);
    timing::set(timing::Timing::Complete);
    turn(&mut cycler, 1_000);
    assert_eq!(allocations() - before, 0);
    assert_eq!(cycler.counters().cycles.get(), 11_100);
}
