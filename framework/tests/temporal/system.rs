//! Writers, one consumer for each and the model, driven by the same operations.

use std::time::Duration;

use framework::{
    Consumer, Horizon, Interleaved, Interleaving, Item, PerceptionInput, QueueCounts, Reference,
    ReferenceKind, Timestamp, Writer, buffer, interleave,
};

use super::model::{Counts, Instance, Model, Shown};

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Operation {
    /// Announces a cycle of an instance with a timestamp this much before now.
    Announce(usize, u64),
    Complete(usize),
    Abandon(usize),
    /// Begins a cycle of the consumer with a timestamp this much before now.
    Consume(u64),
}

pub(crate) type Value = (usize, u64);

pub(crate) struct System<const N: usize> {
    writers: [Writer<Value>; N],
    consumers: [Consumer<Value>; N],
    horizon: Horizon,
    interleaving: Interleaving,
    now: u64,
    t0: u64,
    /// Timestamp of each instance's last announcement.
    announced: [u64; N],
    completed: [u64; N],
    last_order: u64,
    pub(crate) model: Model,
}

impl<const N: usize> System<N> {
    /// Instances by window and pending timeout.
    pub(crate) fn new(instances: [(usize, u64); N]) -> Self {
        let (writers, consumers): (Vec<_>, Vec<_>) = instances
            .iter()
            .map(|(window, pending_timeout)| {
                let (writer, [], [queue]) = buffer([*window]);
                (
                    writer,
                    Consumer::new(queue, Duration::from_nanos(*pending_timeout)),
                )
            })
            .unzip();
        let exact = "one for each instance";
        Self {
            writers: writers.try_into().ok().expect(exact),
            consumers: consumers.try_into().ok().expect(exact),
            horizon: Horizon::new(),
            interleaving: Interleaving::new(),
            now: 10,
            t0: 0,
            announced: [0; N],
            completed: [0; N],
            last_order: 0,
            model: Model {
                instances: instances
                    .map(|(window, timeout)| Instance::new(window, timeout))
                    .into(),
                horizon: 0,
            },
        }
    }

    /// Applies what is possible now.
    pub(crate) fn apply(&mut self, operation: Operation) {
        self.now += 1;
        match operation {
            Operation::Announce(instance, age) => self.announce(instance, self.now - age.min(10)),
            Operation::Complete(instance) => self.complete(instance),
            Operation::Abandon(instance) => self.abandon(instance),
            Operation::Consume(age) => {
                self.t0 = (self.now - age).max(self.t0 + 1);
                self.consume();
            }
        }
    }

    fn announce(&mut self, instance: usize, timestamp: u64) {
        let model = &mut self.model.instances[instance];
        // No cycle of an instance has the timestamp of the one before.
        if model.pending.is_none() && self.announced[instance] != timestamp {
            self.announced[instance] = timestamp;
            model.announce(timestamp);
            self.writers[instance].announce(Timestamp::from_nanos(timestamp));
        }
    }

    fn complete(&mut self, instance: usize) {
        let model = &mut self.model.instances[instance];
        if let Some(timestamp) = model.pending {
            self.completed[instance] += 1;
            let number = self.completed[instance];
            model.complete(number);
            *self.writers[instance].slots().0 = (instance, number);
            self.writers[instance].complete(number, Timestamp::from_nanos(timestamp));
        }
    }

    fn abandon(&mut self, instance: usize) {
        let model = &mut self.model.instances[instance];
        if model.pending.is_some() {
            model.abandon();
            self.writers[instance].abandon();
        }
    }

    fn consume(&mut self) {
        let t0 = Timestamp::from_nanos(self.t0);
        self.horizon
            .consume(t0, self.consumers.each_mut().map(|each| each as _));
        self.interleaving
            .merge(self.consumers.each_ref().map(|each| each as _));
        let (persistent, transient) = self.model.consume(self.t0);
        assert_eq!(self.horizon.delivered().as_nanos(), self.model.horizon);
        self.check_views(&persistent, &transient);
        self.check_references(&persistent, &transient);
        self.check_counts();
        for shown in persistent {
            assert!(shown.order >= self.last_order, "delivered out of order");
            self.last_order = shown.order;
        }
    }

    /// All instances in one order, by cycler and by hand, and each alone.
    fn check_views(&self, persistent: &[Shown], transient: &[Shown]) {
        let projections = self
            .consumers
            .each_ref()
            .map(|each| each.project(|value| value));
        let interleaved = Interleaved {
            order: &self.interleaving,
            instances: projections.each_ref().map(|each| each as _),
        };
        let all = PerceptionInput::new(&interleaved);
        assert_eq!(
            all.persistent.items().map(shown).collect::<Vec<_>>(),
            persistent
        );
        assert_eq!(
            all.transient.items().map(shown).collect::<Vec<_>>(),
            transient
        );

        let each = projections
            .each_ref()
            .map(|each| PerceptionInput::new(each));
        let values = |shown: &[Shown]| -> Vec<_> {
            let value = |shown: &Shown| {
                (
                    Timestamp::from_nanos(shown.timestamp),
                    (shown.instance, shown.number),
                )
            };
            shown.iter().map(value).collect()
        };
        let by_hand = interleave(each.map(|input| input.persistent));
        assert_eq!(
            by_hand.map(|(t, value)| (t, *value)).collect::<Vec<_>>(),
            values(persistent)
        );
        let by_hand = interleave(each.map(|input| input.transient));
        assert_eq!(
            by_hand.map(|(t, value)| (t, *value)).collect::<Vec<_>>(),
            values(transient)
        );
        for (instance, input) in each.iter().enumerate() {
            let own = |all: &[Shown]| {
                all.iter()
                    .filter(|shown| shown.instance == instance)
                    .copied()
                    .collect::<Vec<_>>()
            };
            assert_eq!(
                input.persistent.items().map(shown).collect::<Vec<_>>(),
                own(persistent)
            );
            assert_eq!(
                input.transient.items().map(shown).collect::<Vec<_>>(),
                own(transient)
            );
        }
    }

    fn check_references(&self, persistent: &[Shown], transient: &[Shown]) {
        const NAMES: [&str; 3] = ["A", "B", "C"];
        for (instance, consumer) in self.consumers.iter().enumerate() {
            let mut references = Vec::new();
            consumer.references(NAMES[instance], &mut |reference| references.push(reference));
            let expected = |all: &[Shown], kind: fn(Timestamp) -> ReferenceKind| {
                all.iter()
                    .filter(|shown| shown.instance == instance)
                    .map(|shown| Reference {
                        instance: NAMES[instance],
                        cycle: shown.number,
                        kind: kind(Timestamp::from_nanos(shown.order)),
                    })
                    .collect::<Vec<_>>()
            };
            let mut all = expected(persistent, |order| ReferenceKind::Persistent { order });
            all.extend(expected(transient, |order| ReferenceKind::Transient {
                order,
            }));
            assert_eq!(references, all);
        }
    }

    fn check_counts(&self) {
        for (instance, model) in self.model.instances.iter().enumerate() {
            let QueueCounts {
                delivered,
                late,
                expired,
                abandoned,
                dropped,
            } = self.consumers[instance].report();
            let counts = Counts {
                delivered,
                late,
                expired,
                abandoned,
                dropped,
            };
            assert_eq!(counts, model.counts);
            let completed = self.completed[instance];
            assert_eq!(self.writers[instance].abandoned(), abandoned);
            let pending = u64::from(model.pending.is_some());
            assert_eq!(model.announced, completed + abandoned + pending);
            assert_eq!(
                completed,
                delivered + dropped + model.completed.len() as u64
            );
        }
    }
}

fn shown(item: Item<&Value>) -> Shown {
    let (instance, number) = *item.value;
    assert_eq!(item.cycle, number);
    Shown {
        order: item.order.as_nanos(),
        instance,
        number,
        timestamp: item.timestamp.as_nanos(),
    }
}
