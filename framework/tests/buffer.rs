//! Slots that one writer fills in place and any number of readers and queues share.

use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use framework::{
    Consumer, Horizon, PerceptionInput, Queue, Reader, Timestamp, Writer, buffer, buffer_of,
};

fn time(nanos: u64) -> Timestamp {
    Timestamp::from_nanos(nanos)
}

fn write(writer: &mut Writer<u64>, cycle: u64) {
    writer.announce(time(10 * cycle));
    *writer.slots().0 = cycle;
    writer.complete(cycle, time(10 * cycle));
}

fn take_all(queue: &mut Queue<u64>) -> Vec<u64> {
    let mut taken = Vec::new();
    while let Some(entry) = queue.take() {
        taken.push(entry.value);
        queue.release(1);
    }
    taken
}

#[test]
fn before_the_first_cycle_there_is_the_default_and_nothing_latest() {
    let (mut writer, [mut reader], []) = buffer::<u64, 1, 0>([]);
    for _ in 0..2 {
        assert_eq!((*reader.view(), reader.view().cycle()), (0, 0));
        assert_eq!(reader.view().written(), None);
        assert_eq!(reader.view().latest(time(5), |value| *value), None);
        reader.take();
    }
    *writer.slots().0 = 7;
    writer.abandon();
    reader.take();
    assert_eq!(reader.view().written(), None, "not complete");
}

#[test]
fn latest_tells_age_and_whether_it_is_new() {
    let (mut writer, [mut reader], []) = buffer::<u64, 1, 0>([]);
    write(&mut writer, 1);
    reader.take();
    let latest = reader
        .view()
        .latest(time(25), |value| value)
        .expect("a cycle is complete");
    assert_eq!(
        (*latest.value, latest.timestamp, latest.cycle),
        (1, time(10), 1)
    );
    assert_eq!(
        (latest.age, latest.is_new),
        (Duration::from_nanos(15), true)
    );
    reader.take();
    let latest = reader
        .view()
        .latest(time(5), |value| value)
        .expect("still there");
    assert_eq!((latest.age, latest.is_new), (Duration::ZERO, false));
    write(&mut writer, 2);
    assert_eq!(*reader.view(), 1, "nothing changes between two takes");
    reader.take();
    assert!(
        reader
            .view()
            .latest(time(30), |value| *value)
            .is_some_and(|latest| latest.is_new)
    );
}

#[test]
fn a_type_without_default_starts_as_it_is_told() {
    struct Parameters(u32);
    let (mut writer, [reader], []) = buffer_of::<_, 1, 0>(|| Parameters(3), []);
    assert_eq!(reader.view().0, 3);
    let (writing, newest) = writer.slots();
    assert_eq!((writing.0, newest.0), (3, 3));
}

#[test]
fn the_writer_sees_what_it_wrote_last_and_writes_elsewhere() {
    let (mut writer, [], []) = buffer::<u64, 0, 0>([]);
    for cycle in 1..=5 {
        write(&mut writer, cycle);
        let (writing, newest) = writer.slots();
        assert_eq!(*newest, cycle);
        assert!(*writing < cycle);
        assert_eq!(writer.newest().cycle, cycle);
    }
}

#[test]
fn what_a_reader_holds_stays_while_the_writer_laps_it() {
    let (mut writer, [mut slow, mut fast], []) = buffer::<u64, 2, 0>([]);
    write(&mut writer, 1);
    slow.take();
    for cycle in 2..=100 {
        write(&mut writer, cycle);
        fast.take();
        assert_eq!((*slow.view(), *fast.view()), (1, cycle));
    }
    slow.take();
    assert_eq!(*slow.view(), 100);
}

#[test]
fn forty_readers_and_consumers_share_the_slots() {
    let (mut writer, mut readers, mut queues) = buffer::<u64, 20, 20>([2; 20]);
    for cycle in 1..=200 {
        write(&mut writer, cycle);
        for (index, reader) in readers.iter_mut().enumerate() {
            if cycle % (index as u64 + 1) == 0 {
                reader.take();
            }
            assert_eq!(*reader.view(), cycle - cycle % (index as u64 + 1));
        }
        for queue in &mut queues {
            assert_eq!(take_all(queue), [cycle]);
        }
    }
    assert!(queues.iter().all(|queue| queue.dropped() == 0));
}

#[test]
fn a_stalled_consumer_costs_the_others_nothing() {
    let (mut writer, [mut reader], [mut stalled, mut queue]) = buffer::<u64, 1, 2>([3, 2]);
    for cycle in 1..=50 {
        write(&mut writer, 2 * cycle - 1);
        write(&mut writer, 2 * cycle);
        reader.take();
        assert_eq!(take_all(&mut queue), [2 * cycle - 1, 2 * cycle]);
        if cycle == 1 {
            while stalled.take().is_some() {}
        }
    }
    assert_eq!(queue.dropped(), 0);
    assert_eq!(
        (0..2)
            .map(|index| stalled.get(index).expect("kept").value)
            .sum::<u64>(),
        3
    );
    assert_eq!(stalled.len(), 2);
    stalled.release(2);
    let rest = take_all(&mut stalled);
    assert_eq!(rest.last(), Some(&100));
    assert_eq!(2 + rest.len() as u64 + stalled.dropped(), 100);
}

#[test]
fn the_writer_takes_a_free_slot_before_one_that_is_queued() {
    let (mut writer, [], [mut queue]) = buffer::<u64, 0, 1>([3]);
    (1..=2).for_each(|cycle| write(&mut writer, cycle));
    while queue.take().is_some() {}
    queue.release(1);
    // One is kept: two more fit beside the newest, so the first of these four is lost.
    (3..=6).for_each(|cycle| write(&mut writer, cycle));
    queue.release(1);
    write(&mut writer, 7);
    assert_eq!(take_all(&mut queue), [4, 5, 6, 7]);
    assert_eq!(queue.dropped(), 1);
}

#[test]
fn a_queue_that_is_gone_keeps_no_slot() {
    let (mut writer, [], [mut gone, mut queue]) = buffer::<u64, 0, 2>([2, 1]);
    write(&mut writer, 1);
    write(&mut writer, 2);
    while gone.take().is_some() {}
    drop(gone);
    take_all(&mut queue);
    // All of the five slots but the one being written are there for the other queue.
    (3..=6).for_each(|cycle| write(&mut writer, cycle));
    assert_eq!(take_all(&mut queue), [3, 4, 5, 6]);
}

#[test]
fn an_announcement_is_withdrawn_once_by_completion_abandoning_or_the_end() {
    let (mut writer, [], [mut queue]) = buffer::<u64, 0, 1>([4]);
    assert_eq!(queue.announced(), None);
    writer.announce(time(1));
    assert_eq!(queue.announced(), Some(time(1)));
    writer.complete(1, time(1));
    assert_eq!((queue.announced(), writer.abandoned()), (None, 0));
    writer.announce(time(2));
    writer.abandon();
    writer.abandon();
    assert_eq!((queue.announced(), writer.abandoned()), (None, 1));
    writer.announce(time(3));
    writer.announce(time(4));
    assert_eq!((queue.announced(), writer.abandoned()), (Some(time(4)), 2));
    drop(writer);
    assert_eq!((queue.announced(), queue.abandoned()), (None, 3));
    assert_eq!(queue.take().map(|entry| entry.cycle), Some(1));
}

#[test]
fn a_window_of_zero_counts_as_one() {
    let (mut writer, [], [mut queue]) = buffer::<u64, 0, 1>([0]);
    write(&mut writer, 1);
    assert_eq!(take_all(&mut queue), [1]);
}

const CYCLES: u64 = 300_000;

fn write_many(mut writer: Writer<[u64; 32]>, is_done: &AtomicBool) {
    for cycle in 1..=CYCLES {
        writer.announce(time(cycle));
        if cycle % 7 == 0 {
            writer.abandon();
            writer.announce(time(cycle));
        }
        writer.slots().0.fill(cycle);
        writer.complete(cycle, time(cycle));
    }
    is_done.store(true, Ordering::Release);
}

fn read_until(mut reader: Reader<[u64; 32]>, is_done: &AtomicBool) {
    let mut last = 0;
    while !is_done.load(Ordering::Acquire) {
        reader.take();
        let view = reader.view();
        assert!(view.cycle() >= last, "never back in time");
        assert!(
            view.iter().all(|value| *value == view.cycle()),
            "never half"
        );
        last = view.cycle();
    }
    reader.take();
    assert_eq!(reader.view().cycle(), CYCLES);
}

fn consume_all(queue: Queue<[u64; 32]>, pause: u32) {
    let mut consumer = Consumer::new(queue, Duration::MAX);
    let mut horizon = Horizon::new();
    let (mut last, mut delivered) = (0, 0);
    while last < CYCLES {
        horizon.consume(Timestamp::NEVER, [&mut consumer]);
        let projection = consumer.project(|values| values);
        for item in PerceptionInput::new(&projection).persistent.items() {
            assert!(item.cycle > last && item.order == time(item.cycle));
            assert!(
                item.value.iter().all(|value| *value == item.cycle),
                "never half"
            );
            last = item.cycle;
            delivered += 1;
        }
        (0..pause).for_each(|_| std::hint::spin_loop());
    }
    let counts = consumer.report();
    assert_eq!(
        (counts.delivered, counts.late, counts.expired),
        (delivered, 0, 0)
    );
    assert_eq!(counts.delivered + counts.dropped, CYCLES);
    assert_eq!(counts.abandoned, CYCLES / 7);
}

#[test]
fn threads_see_whole_cycles_in_order_and_count_what_they_miss() {
    let (writer, readers, [near, far]) = buffer::<[u64; 32], 2, 2>([4, 2]);
    let is_done = AtomicBool::new(false);
    std::thread::scope(|scope| {
        scope.spawn(|| write_many(writer, &is_done));
        for reader in readers {
            scope.spawn(|| read_until(reader, &is_done));
        }
        scope.spawn(|| consume_all(far, 1000));
        consume_all(near, 0);
    });
}
