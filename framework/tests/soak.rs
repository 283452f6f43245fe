//! Writers at full speed, greedy readers and several queues on threads, for `HULKGEN_SOAK` seconds (one by default):
//! nothing is torn, nothing comes twice, and the counters agree in the end.

use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use framework::{
    Consumer, Horizon, PerceptionInput, QueueCounts, Reader, Timestamp, Writer, buffer,
};

/// As many words as the cycle's number says, each with that number.
type Pages = Vec<u64>;

const INSTANCES: usize = 2;
const READERS: usize = 2;
/// Two cycle as fast as they can, one takes its time, one does not cycle at all.
const WINDOWS: [usize; 4] = [1, 8, 32, 4];
const PAUSES: [Option<Duration>; 4] = [
    Some(Duration::ZERO),
    Some(Duration::ZERO),
    Some(Duration::from_millis(5)),
    None,
];
/// After a wait for a processor that is busy with everything else.
const PENDING_TIMEOUT: Duration = Duration::from_secs(3600);

fn seconds() -> f64 {
    let seconds = std::env::var("HULKGEN_SOAK").ok();
    seconds.map_or(1.0, |text| text.parse().expect("HULKGEN_SOAK in seconds"))
}

fn length(cycle: u64) -> usize {
    1 + (cycle % 61) as usize
}

fn assert_whole(pages: &Pages, cycle: u64) {
    assert_eq!(pages.len(), length(cycle), "cycle {cycle}");
    assert!(pages.iter().all(|word| *word == cycle), "cycle {cycle}");
}

/// One perception instance and what it did.
struct Producer {
    writer: Writer<Pages>,
    announced: u64,
    completed: u64,
    last: Timestamp,
}

impl Producer {
    fn announce(&mut self, now: Timestamp) -> Timestamp {
        self.last = now.max(self.last.next());
        self.writer.announce(self.last);
        self.announced += 1;
        self.last
    }

    fn complete(&mut self) {
        self.completed += 1;
        let cycle = self.completed;
        *self.writer.slots().0 = vec![cycle; length(cycle)];
        self.writer.complete(cycle, self.last);
    }

    fn run(&mut self, clock: Instant, is_over: &AtomicBool) {
        while !is_over.load(Ordering::Relaxed) {
            let captured = now(clock);
            self.announce(captured);
            match self.announced % 17 {
                // Others get ahead of what was announced.
                0 => std::thread::yield_now(),
                1 => {
                    self.writer.abandon();
                    continue;
                }
                _ => {}
            }
            self.complete();
        }
    }
}

fn now(clock: Instant) -> Timestamp {
    Timestamp::ZERO + clock.elapsed()
}

/// Reads as fast as it can; every other look lasts.
fn read(mut reader: Reader<Pages>, is_over: &AtomicBool) -> u64 {
    let (mut looks, mut last) = (0, 0);
    while !is_over.load(Ordering::Relaxed) {
        reader.take();
        let view = reader.view();
        assert!(view.cycle() >= last, "back from {last} to {}", view.cycle());
        last = view.cycle();
        if let Some(pages) = view.written() {
            assert_whole(pages, last);
            if looks % 2 == 0 {
                std::thread::yield_now();
                assert_whole(pages, last);
            }
        }
        looks += 1;
    }
    looks
}

/// A real-time instance that consumes both.
struct Customer {
    consumers: [Consumer<Pages>; INSTANCES],
    horizon: Horizon,
    t0: Timestamp,
    order: Timestamp,
    cycles: [u64; INSTANCES],
    delivered: [u64; INSTANCES],
    transient: [u64; INSTANCES],
}

impl Customer {
    fn cycle(&mut self, now: Timestamp) {
        self.t0 = now.max(self.t0.next());
        let consumers = self.consumers.each_mut().map(|each| each as _);
        self.horizon.consume(self.t0, consumers);
        let before = self.order;
        for (instance, consumer) in self.consumers.iter().enumerate() {
            let projection = consumer.project(|pages| pages);
            let input = PerceptionInput::new(&projection);
            let mut order = before;
            for item in input.persistent.items() {
                assert_whole(item.value, item.cycle);
                assert!(item.order >= order && item.order >= item.timestamp);
                assert!(item.cycle > self.cycles[instance], "delivered twice");
                order = item.order;
                self.cycles[instance] = item.cycle;
                self.delivered[instance] += 1;
            }
            self.order = self.order.max(order);
            for item in input.transient.items() {
                assert_whole(item.value, item.cycle);
                assert!(item.order >= order && item.cycle > self.cycles[instance]);
            }
            self.transient[instance] = input.transient.len() as u64;
        }
    }

    /// completed = delivered + dropped + not yet persistent.
    fn assert_consistent(&self, producers: &[Producer; INSTANCES]) {
        for (instance, producer) in producers.iter().enumerate() {
            let QueueCounts {
                delivered, dropped, ..
            } = self.consumers[instance].report();
            assert_eq!(delivered, self.delivered[instance]);
            let accounted = delivered + dropped + self.transient[instance];
            assert_eq!(producer.completed, accounted, "{delivered} + {dropped} + …");
        }
    }
}

type Parts = (
    [Producer; INSTANCES],
    Vec<Reader<Pages>>,
    [Customer; WINDOWS.len()],
);

fn parts() -> Parts {
    let mut lanes = WINDOWS.map(|_| Vec::new());
    let mut readers = Vec::new();
    let producers = [(); INSTANCES].map(|()| {
        let (writer, of_readers, queues) = buffer::<Pages, READERS, { WINDOWS.len() }>(WINDOWS);
        readers.extend(of_readers);
        for (lane, queue) in lanes.iter_mut().zip(queues) {
            lane.push(Consumer::new(queue, PENDING_TIMEOUT));
        }
        Producer {
            writer,
            announced: 0,
            completed: 0,
            last: Timestamp::ZERO,
        }
    });
    let customers = lanes.map(|lane| Customer {
        consumers: lane.try_into().ok().expect("one of each instance"),
        horizon: Horizon::new(),
        t0: Timestamp::ZERO,
        order: Timestamp::ZERO,
        cycles: [0; INSTANCES],
        delivered: [0; INSTANCES],
        transient: [0; INSTANCES],
    });
    (producers, readers, customers)
}

#[test]
fn at_full_speed_nothing_is_torn_and_the_counters_agree() {
    let (mut producers, readers, mut customers) = parts();
    let (clock, is_over) = (Instant::now(), AtomicBool::new(false));
    let is_over = &is_over;
    let looks: u64 = std::thread::scope(|scope| {
        for producer in &mut producers {
            scope.spawn(move || producer.run(clock, is_over));
        }
        for (customer, pause) in customers.iter_mut().zip(PAUSES) {
            let Some(pause) = pause else { continue };
            scope.spawn(move || {
                while !is_over.load(Ordering::Relaxed) {
                    customer.cycle(now(clock));
                    match pause {
                        Duration::ZERO => std::thread::yield_now(),
                        pause => std::thread::sleep(pause),
                    }
                }
            });
        }
        let readers = readers.into_iter();
        let readers: Vec<_> = readers
            .map(|reader| scope.spawn(move || read(reader, is_over)))
            .collect();
        std::thread::sleep(Duration::from_secs_f64(seconds()));
        is_over.store(true, Ordering::Relaxed);
        let looks = readers.into_iter().map(|reader| reader.join());
        looks.map(|looks| looks.expect("nothing was torn")).sum()
    });

    // The first is on its way again, and what the second completes waits for it.
    producers[0].announce(now(clock));
    producers[1].announce(now(clock));
    producers[1].complete();
    // Who has room for one takes one in a cycle, of at most as many as there are slots.
    let (slots, _) = producers[0].writer.size();
    let settle = |customers: &mut [Customer]| {
        for customer in customers {
            (0..slots).for_each(|_| customer.cycle(now(clock)));
        }
    };
    settle(&mut customers);
    for (producer, pending) in producers.iter().zip([1, 0]) {
        let abandoned = producer.writer.abandoned();
        assert_eq!(producer.announced, producer.completed + abandoned + pending);
        assert!(producer.completed > 0 && abandoned > 0);
    }
    for (customer, window) in customers.iter().zip(WINDOWS) {
        customer.assert_consistent(&producers);
        // With room for one alone it does not wait, that there is room for the next.
        assert_eq!(customer.transient, [0, u64::from(window > 1)]);
    }
    producers[0].writer.abandon();
    settle(&mut customers);
    for (customer, pause) in customers.iter().zip(PAUSES) {
        customer.assert_consistent(&producers);
        assert_eq!(customer.transient, [0; INSTANCES]);
        let counts = customer.consumers.each_ref().map(Consumer::report);
        assert!(pause.is_some() || counts.iter().all(|counts| counts.dropped > 0));
        eprintln!("{counts:?}");
    }
    for producer in &producers {
        let (announced, completed) = (producer.announced, producer.completed);
        let abandoned = producer.writer.abandoned();
        assert_eq!(announced, completed + abandoned);
        eprintln!("announced {announced}, completed {completed}, abandoned {abandoned}");
    }
    eprintln!("{looks} looks in {:.1} s", clock.elapsed().as_secs_f64());
}
