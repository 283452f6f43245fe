//! Every interleaving of a writer, readers and consumers, up to a number of preemptions.
//!
//! Each view is looked at twice, when it is taken and just before it is let go: loom notices a
//! write between or beside the two.

use std::time::Duration;

use framework::Timestamp;
use framework_loom::buffer::{Queue, Reader, Writer, buffer};
use framework_loom::temporal::{Consumer, Horizon};
use loom::thread::spawn;

fn time(nanos: u64) -> Timestamp {
    Timestamp::from_nanos(nanos)
}

fn write(writer: &mut Writer<[u64; 2]>, cycle: u64) {
    writer.announce(time(cycle));
    *writer.slots().0 = [cycle; 2];
    writer.complete(cycle, time(cycle));
}

fn write_cycles(mut writer: Writer<[u64; 2]>, cycles: u64) {
    (1..=cycles).for_each(|cycle| write(&mut writer, cycle));
}

/// Takes the newest and looks at it twice; its cycle.
fn read(reader: &mut Reader<[u64; 2]>) -> u64 {
    reader.take();
    let cycle = reader.view().cycle();
    assert_eq!(*reader.view().value(), [cycle; 2]);
    assert_eq!(reader.view().cycle(), cycle);
    cycle
}

/// Takes the next cycle if there is one, looks at it twice and lets it go; its number.
fn consume(queue: &mut Queue<[u64; 2]>) -> Option<u64> {
    let cycle = queue.take()?.cycle;
    let entry = queue.get(0).expect("taken");
    assert_eq!((entry.value, entry.timestamp), ([cycle; 2], time(cycle)));
    queue.release(1);
    Some(cycle)
}

fn explore(preemptions: usize, model: impl Fn() + Sync + Send + 'static) {
    let mut builder = loom::model::Builder::new();
    builder.preemption_bound = Some(preemptions);
    builder.check(model);
}

#[test]
fn a_reader_sees_whole_cycles_in_order() {
    explore(6, || {
        let (writer, [mut reader], []) = buffer::<[u64; 2], 1, 0>([]);
        let writing = spawn(move || write_cycles(writer, 3));
        let mut last = 0;
        for _ in 0..2 {
            let cycle = read(&mut reader);
            assert!(cycle >= last);
            last = cycle;
        }
        writing.join().expect("the writer does not panic");
        assert_eq!(read(&mut reader), 3);
    });
}

#[test]
fn two_readers_share_a_slot() {
    explore(5, || {
        let (writer, [mut here, mut there], []) = buffer::<[u64; 2], 2, 0>([]);
        let writing = spawn(move || write_cycles(writer, 2));
        let reading = spawn(move || read(&mut there));
        assert!(read(&mut here) <= 2);
        assert!(reading.join().expect("the reader does not panic") <= 2);
        writing.join().expect("the writer does not panic");
    });
}

#[test]
fn a_consumer_takes_each_cycle_once_or_counts_it() {
    explore(4, || {
        let (writer, [], [mut queue]) = buffer::<[u64; 2], 0, 1>([1]);
        let writing = spawn(move || write_cycles(writer, 4));
        let mut taken = Vec::new();
        (0..2).for_each(|_| taken.extend(consume(&mut queue)));
        writing.join().expect("the writer does not panic");
        taken.extend(std::iter::from_fn(|| consume(&mut queue)));
        assert!(taken.is_sorted_by(|before, after| before < after));
        assert_eq!(taken.last(), Some(&4));
        assert_eq!(taken.len() as u64 + queue.dropped(), 4);
    });
}

#[test]
fn two_consumers_take_every_cycle_for_which_they_have_room() {
    explore(5, || {
        let (writer, [], [mut here, mut there]) = buffer::<[u64; 2], 0, 2>([1, 1]);
        let writing = spawn(move || write_cycles(writer, 2));
        let consuming = spawn(move || {
            let first = consume(&mut there);
            (first, there)
        });
        let first = consume(&mut here);
        writing.join().expect("the writer does not panic");
        let (there_first, mut there) = consuming.join().expect("the consumer does not panic");
        for (first, queue) in [(first, &mut here), (there_first, &mut there)] {
            let rest = std::iter::from_fn(|| consume(queue));
            assert_eq!(first.into_iter().chain(rest).collect::<Vec<_>>(), [1, 2]);
            assert_eq!(queue.dropped(), 0);
        }
    });
}

#[test]
fn what_is_not_announced_any_more_can_be_taken() {
    explore(8, || {
        let (mut writer, [], [mut queue]) = buffer::<[u64; 2], 0, 1>([2]);
        writer.announce(time(1));
        let writing = spawn(move || {
            *writer.slots().0 = [1; 2];
            writer.complete(1, time(1));
            writer.announce(time(2));
            writer.abandon();
        });
        // Withdrawn, or the next announcement: either way the first cycle is complete.
        if queue.announced() != Some(time(1)) {
            assert_eq!(consume(&mut queue), Some(1));
        }
        writing.join().expect("the writer does not panic");
    });
}

#[test]
fn a_reader_and_a_consumer_share_a_slot() {
    explore(3, || {
        let (writer, [mut reader], [mut queue]) = buffer::<[u64; 2], 1, 1>([1]);
        let writing = spawn(move || write_cycles(writer, 3));
        let reading = spawn(move || read(&mut reader));
        consume(&mut queue);
        writing.join().expect("the writer does not panic");
        reading.join().expect("the reader does not panic");
    });
}

#[test]
fn what_is_announced_in_time_is_never_late() {
    explore(5, || {
        let (mut first, [], [for_first]) = buffer::<[u64; 2], 0, 1>([2]);
        let (mut second, [], [for_second]) = buffer::<[u64; 2], 0, 1>([2]);
        let mut for_first = Consumer::new(for_first, Duration::MAX);
        let mut for_second = Consumer::new(for_second, Duration::MAX);
        first.announce(time(1));
        let writing = spawn(move || {
            write(&mut second, 2);
            first.complete(1, time(1));
        });
        let mut horizon = Horizon::new();
        horizon.consume(time(3), [&mut for_first, &mut for_second]);
        writing.join().expect("the writers do not panic");
        horizon.consume(time(4), [&mut for_first, &mut for_second]);
        for counts in [for_first.report(), for_second.report()] {
            assert_eq!((counts.delivered, counts.late, counts.dropped), (1, 0, 0));
        }
    });
}
