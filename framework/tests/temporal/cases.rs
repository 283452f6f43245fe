//! The rules one by one, as they read.

use std::time::Duration;

use framework::{
    Consumer, Horizon, Interleaved, Interleaving, PerceptionInput, QueueCounts, Timestamp, Writer,
    buffer,
};

const PATIENT: Duration = Duration::MAX;

fn time(nanos: u64) -> Timestamp {
    Timestamp::from_nanos(nanos)
}

fn instance(window: usize, pending_timeout: Duration) -> (Writer<u64>, Consumer<u64>) {
    let (writer, [], [queue]) = buffer([window]);
    (writer, Consumer::new(queue, pending_timeout))
}

/// Announces and completes a cycle; its number is its value.
fn perceive(writer: &mut Writer<u64>, number: u64, timestamp: u64) {
    writer.announce(time(timestamp));
    complete(writer, number, timestamp);
}

fn complete(writer: &mut Writer<u64>, number: u64, timestamp: u64) {
    *writer.slots().0 = number;
    writer.complete(number, time(timestamp));
}

/// Persistent and transient values.
fn seen(consumer: &Consumer<u64>) -> (Vec<u64>, Vec<u64>) {
    let projection = consumer.project(|value| *value);
    let input = PerceptionInput::new(&projection);
    let values = |timeline: framework::Timeline<'_, u64>| -> Vec<_> {
        timeline.iter().map(|(_, value)| value).collect()
    };
    (values(input.persistent), values(input.transient))
}

#[test]
fn what_nobody_precedes_is_persistent_at_once_and_only_once() {
    let (mut writer, mut consumer) = instance(4, PATIENT);
    let mut horizon = Horizon::new();
    perceive(&mut writer, 1, 10);
    horizon.consume(time(20), [&mut consumer]);
    assert_eq!(seen(&consumer), (vec![1], vec![]));
    horizon.consume(time(30), [&mut consumer]);
    assert_eq!(seen(&consumer), (vec![], vec![]));
    assert_eq!(horizon.delivered(), time(10));
}

#[test]
fn what_follows_a_pending_announcement_is_transient_until_that_completes() {
    let (mut top, mut for_top) = instance(4, PATIENT);
    let (mut bottom, mut for_bottom) = instance(4, PATIENT);
    let mut horizon = Horizon::new();
    top.announce(time(10));
    perceive(&mut bottom, 1, 9);
    perceive(&mut bottom, 2, 10);
    perceive(&mut bottom, 3, 11);
    for now in [20, 21] {
        horizon.consume(time(now), [&mut for_top, &mut for_bottom]);
        let persistent = if now == 20 { vec![1] } else { vec![] };
        assert_eq!(seen(&for_bottom), (persistent, vec![2, 3]));
    }
    complete(&mut top, 1, 10);
    horizon.consume(time(22), [&mut for_top, &mut for_bottom]);
    assert_eq!(seen(&for_top), (vec![1], vec![]));
    assert_eq!(seen(&for_bottom), (vec![2, 3], vec![]));
}

#[test]
fn an_abandoned_announcement_holds_nothing_back() {
    let (mut top, mut for_top) = instance(4, PATIENT);
    let (mut bottom, mut for_bottom) = instance(4, PATIENT);
    let mut horizon = Horizon::new();
    top.announce(time(10));
    perceive(&mut bottom, 1, 11);
    top.abandon();
    horizon.consume(time(20), [&mut for_top, &mut for_bottom]);
    assert_eq!(seen(&for_bottom), (vec![1], vec![]));
    assert_eq!(
        for_top.report(),
        QueueCounts {
            abandoned: 1,
            ..QueueCounts::default()
        }
    );
}

#[test]
fn what_lies_after_the_consuming_cycle_waits_unseen() {
    let (mut writer, mut consumer) = instance(4, PATIENT);
    let mut horizon = Horizon::new();
    perceive(&mut writer, 1, 20);
    perceive(&mut writer, 2, 21);
    horizon.consume(time(20), [&mut consumer]);
    assert_eq!(seen(&consumer), (vec![1], vec![]));
    assert_eq!(horizon.delivered(), time(20));
    horizon.consume(time(21), [&mut consumer]);
    assert_eq!(seen(&consumer), (vec![2], vec![]));
}

#[test]
fn what_becomes_known_late_is_delivered_at_the_horizon() {
    let (mut top, mut for_top) = instance(4, PATIENT);
    let (mut bottom, mut for_bottom) = instance(4, PATIENT);
    let mut horizon = Horizon::new();
    perceive(&mut bottom, 1, 30);
    horizon.consume(time(40), [&mut for_top, &mut for_bottom]);
    top.announce(time(25));
    perceive(&mut bottom, 2, 31);
    horizon.consume(time(41), [&mut for_top, &mut for_bottom]);
    assert_eq!(
        seen(&for_bottom),
        (vec![], vec![2]),
        "the announcement counts at the horizon"
    );
    complete(&mut top, 1, 25);
    horizon.consume(time(42), [&mut for_top, &mut for_bottom]);
    let projection = for_top.project(|value| value);
    let late = PerceptionInput::new(&projection)
        .persistent
        .items()
        .next()
        .expect("delivered");
    assert_eq!((late.timestamp, late.order), (time(25), time(30)));
    assert_eq!(
        for_top.report(),
        QueueCounts {
            delivered: 1,
            late: 1,
            ..QueueCounts::default()
        }
    );
    assert_eq!(seen(&for_bottom), (vec![2], vec![]));
}

#[test]
fn an_announcement_that_is_too_old_is_not_waited_for_and_its_completion_expired() {
    let (mut top, mut for_top) = instance(4, Duration::from_nanos(10));
    let (mut bottom, mut for_bottom) = instance(4, Duration::from_nanos(1000));
    let mut horizon = Horizon::new();
    top.announce(time(100));
    perceive(&mut bottom, 1, 105);
    horizon.consume(time(110), [&mut for_top, &mut for_bottom]);
    assert_eq!(seen(&for_bottom), (vec![], vec![1]), "as old as allowed");
    horizon.consume(time(111), [&mut for_top, &mut for_bottom]);
    assert_eq!(seen(&for_bottom), (vec![1], vec![]));
    assert_eq!(
        for_top.report(),
        QueueCounts::default(),
        "nothing is delivered yet"
    );
    complete(&mut top, 1, 100);
    horizon.consume(time(112), [&mut for_top, &mut for_bottom]);
    assert_eq!(seen(&for_top), (vec![1], vec![]));
    let counts = QueueCounts {
        delivered: 1,
        late: 1,
        expired: 1,
        ..QueueCounts::default()
    };
    assert_eq!(for_top.report(), counts);
    assert_eq!(horizon.delivered(), time(105));
}

#[test]
fn an_expired_announcement_that_is_abandoned_leaves_no_trace_on_the_next_cycle() {
    let (mut writer, mut consumer) = instance(4, Duration::from_nanos(10));
    let mut horizon = Horizon::new();
    writer.announce(time(100));
    horizon.consume(time(200), [&mut consumer]);
    writer.abandon();
    perceive(&mut writer, 1, 201);
    horizon.consume(time(210), [&mut consumer]);
    let counts = QueueCounts {
        delivered: 1,
        abandoned: 1,
        ..QueueCounts::default()
    };
    assert_eq!(consumer.report(), counts);
}

#[test]
fn a_full_window_moves_the_horizon_and_loses_nothing() {
    let (mut stalled, mut for_stalled) = instance(4, PATIENT);
    let (mut writer, mut consumer) = instance(4, PATIENT);
    let mut horizon = Horizon::new();
    stalled.announce(time(1));
    let mut delivered = Vec::new();
    for number in 1..=50 {
        perceive(&mut writer, number, 10 * number);
        horizon.consume(time(10 * number), [&mut for_stalled, &mut consumer]);
        let (persistent, transient) = seen(&consumer);
        assert!(persistent.len() + transient.len() <= 4);
        delivered.extend(persistent);
    }
    assert_eq!(delivered, (1..=47).collect::<Vec<_>>());
    complete(&mut stalled, 1, 1);
    horizon.consume(time(501), [&mut for_stalled, &mut consumer]);
    assert_eq!(seen(&for_stalled), (vec![1], vec![]));
    assert_eq!(for_stalled.report().late, 1);
    delivered.extend(seen(&consumer).0);
    assert_eq!(delivered, (1..=50).collect::<Vec<_>>());
    assert_eq!(
        consumer.report(),
        QueueCounts {
            delivered: 50,
            ..QueueCounts::default()
        }
    );
}

#[test]
fn what_finds_a_full_window_waits_for_room() {
    let (mut stalled, mut for_stalled) = instance(4, PATIENT);
    let (mut writer, mut consumer) = instance(4, PATIENT);
    let mut horizon = Horizon::new();
    stalled.announce(time(1));
    (1..=3).for_each(|number| perceive(&mut writer, number, 10 * number));
    horizon.consume(time(100), [&mut for_stalled, &mut consumer]);
    assert_eq!(seen(&consumer), (vec![], vec![1, 2, 3]));
    (4..=5).for_each(|number| perceive(&mut writer, number, 10 * number));
    horizon.consume(time(101), [&mut for_stalled, &mut consumer]);
    assert_eq!(
        seen(&consumer),
        (vec![1, 2], vec![3, 4]),
        "room for 5 and for one more"
    );
    horizon.consume(time(102), [&mut for_stalled, &mut consumer]);
    assert_eq!(seen(&consumer), (vec![], vec![3, 4, 5]));
    assert_eq!(
        consumer.report(),
        QueueCounts {
            delivered: 2,
            ..QueueCounts::default()
        }
    );
}

#[test]
fn a_consumer_that_does_not_cycle_loses_the_oldest_and_counts_them() {
    let (mut writer, mut consumer) = instance(4, PATIENT);
    let mut horizon = Horizon::new();
    (1..=100).for_each(|number| perceive(&mut writer, number, number));
    let mut delivered = Vec::new();
    for now in 200..203 {
        horizon.consume(time(now), [&mut consumer]);
        delivered.extend(seen(&consumer).0);
    }
    assert_eq!(delivered, [96, 97, 98, 99, 100]);
    let counts = QueueCounts {
        delivered: 5,
        dropped: 95,
        ..QueueCounts::default()
    };
    assert_eq!(consumer.report(), counts);
}

#[test]
fn consumers_have_their_own_pace_and_their_own_horizon() {
    let (mut writer, [], [fast, slow]) = buffer::<u64, 0, 2>([4, 8]);
    let (mut fast, mut slow) = (Consumer::new(fast, PATIENT), Consumer::new(slow, PATIENT));
    let (mut for_fast, mut for_slow) = (Horizon::new(), Horizon::new());
    let (mut seen_fast, mut seen_slow) = (Vec::new(), Vec::new());
    for number in 1..=60 {
        perceive(&mut writer, number, number);
        for_fast.consume(time(number), [&mut fast]);
        seen_fast.extend(seen(&fast).0);
        if number % 5 == 0 {
            for_slow.consume(time(number), [&mut slow]);
            seen_slow.extend(seen(&slow).0);
        }
    }
    assert_eq!(seen_fast, (1..=60).collect::<Vec<_>>());
    assert_eq!(seen_fast, seen_slow);
}

#[test]
fn instances_of_one_cycler_are_sorted_by_order_then_manifest() {
    let (mut top, mut for_top) = instance(4, PATIENT);
    let (mut bottom, mut for_bottom) = instance(4, PATIENT);
    let (mut horizon, mut interleaving) = (Horizon::new(), Interleaving::new());
    for (number, timestamp) in [(1, 10), (2, 20), (3, 40)] {
        perceive(&mut top, number, timestamp);
    }
    for (number, timestamp) in [(101, 20), (102, 30)] {
        perceive(&mut bottom, number, timestamp);
    }
    bottom.announce(time(40));
    horizon.consume(time(50), [&mut for_top, &mut for_bottom]);
    interleaving.merge([&for_top, &for_bottom]);
    let input = PerceptionInput::new(&Interleaved {
        order: &interleaving,
        instances: [
            &for_top.project(|value| *value),
            &for_bottom.project(|value| *value),
        ],
    })
    .persistent
    .iter()
    .map(|(timestamp, value)| (timestamp.as_nanos(), value))
    .collect::<Vec<_>>();
    assert_eq!(input, [(10, 1), (20, 2), (20, 101), (30, 102)]);
}

#[test]
fn what_came_late_together_is_sorted_by_capture() {
    let (mut ear, mut for_ear) = instance(4, PATIENT);
    let (mut top, mut for_top) = instance(4, PATIENT);
    let (mut bottom, mut for_bottom) = instance(4, PATIENT);
    let mut horizon = Horizon::new();
    perceive(&mut ear, 1, 30);
    horizon.consume(time(31), [&mut for_ear, &mut for_top, &mut for_bottom]);
    perceive(&mut top, 1, 20);
    perceive(&mut bottom, 2, 10);
    horizon.consume(time(40), [&mut for_ear, &mut for_top, &mut for_bottom]);
    let mut order = Interleaving::new();
    order.merge([&for_top, &for_bottom]);
    let both = Interleaved {
        order: &order,
        instances: [
            &for_top.project(|value| *value),
            &for_bottom.project(|value| *value),
        ],
    };
    let input = PerceptionInput::new(&both);
    let values: Vec<_> = input.persistent.iter().collect();
    assert_eq!(values, [(time(10), 2), (time(20), 1)]);
    assert!(input.persistent.items().all(|item| item.order == time(30)));
}
