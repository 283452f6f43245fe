//! For its readers a stub is the instance that it stands in for.

use std::time::Duration;

use super::*;
use crate::buffer::{Queue, Reader, buffer};
use crate::temporal::{Consumer, Horizon, PerceptionInput, QueueCounts};

fn time(nanos: u64) -> Timestamp {
    Timestamp::from_nanos(nanos)
}

/// A stub in a world where it is `now`, and those who read it.
fn stub(now: u64) -> (Stub<u64>, Clock, Reader<u64>, Queue<u64>) {
    let (writer, [reader], [queue]) = buffer([4]);
    let clock = Clock::stepped();
    clock.advance_to(time(now));
    (
        Stub::new("Eye", writer, clock.clone()),
        clock,
        reader,
        queue,
    )
}

/// Persistent and transient values of a cycle at `now`.
fn consumed(horizon: &mut Horizon, eye: &mut Consumer<u64>, now: u64) -> [Vec<(u64, u64)>; 2] {
    horizon.consume(time(now), [&mut *eye]);
    let projection = eye.project(|value| value);
    let input = PerceptionInput::new(&projection);
    let values = |(at, value): (Timestamp, &u64)| (at.as_nanos(), *value);
    [
        input.persistent.iter().map(values).collect(),
        input.transient.iter().map(values).collect(),
    ]
}

#[test]
fn nothing_was_written_before_it_is_fed() {
    let (mut eye, _, mut reader, _) = stub(20);
    reader.take();
    assert_eq!((*reader.view(), reader.view().written()), (0, None));
    eye.feed(time(10), 7).expect("the time has come");
    reader.take();
    let latest = reader.view().latest(time(25), |value| *value);
    let latest = latest.expect("it was fed");
    assert_eq!((latest.value, latest.cycle, latest.is_new), (7, 1, true));
    assert_eq!(latest.timestamp, time(10));
    assert_eq!(latest.age, Duration::from_nanos(15));
    assert_eq!(eye.instance(), "Eye");
}

#[test]
fn who_reads_in_order_of_time_waits_for_what_is_announced() {
    let (mut eye, clock, _, queue) = stub(20);
    let mut consumer = Consumer::new(queue, Duration::from_secs(1));
    let mut horizon = Horizon::new();
    eye.feed(time(10), 1).expect("the time has come");
    eye.announce(time(20)).expect("the time has come");
    assert_eq!(
        consumed(&mut horizon, &mut consumer, 25),
        [vec![(10, 1)], vec![]]
    );
    clock.advance_to(time(40));
    assert_eq!(
        consumed(&mut horizon, &mut consumer, 40),
        [vec![], vec![]],
        "it is waited for"
    );
    eye.complete(2).expect("it is announced");
    assert_eq!(
        consumed(&mut horizon, &mut consumer, 45),
        [vec![(20, 2)], vec![]]
    );
    eye.announce(time(30)).expect("the time has come");
    eye.abandon();
    eye.feed(time(40), 4).expect("the time has come");
    assert_eq!(
        consumed(&mut horizon, &mut consumer, 50),
        [vec![(40, 4)], vec![]]
    );
    let expected = QueueCounts {
        delivered: 3,
        abandoned: 1,
        ..QueueCounts::default()
    };
    assert_eq!(consumer.report(), expected);
}

#[test]
fn what_cannot_be_is_refused_and_changes_nothing() {
    let (mut eye, clock, mut reader, _) = stub(20);
    let said = |result: Result<()>| result.expect_err("it cannot be").to_string();
    assert_eq!(
        said(eye.feed(time(21), 1)),
        "`Eye` cannot have data of 0.000000021 s: it is 0.000000020 s; let the robot run until then first"
    );
    assert_eq!(
        said(eye.complete(1)),
        "`Eye` has announced no cycle to complete"
    );
    reader.take();
    assert_eq!(reader.view().written(), None);
    eye.feed(time(20), 2).expect("the time has come");
    clock.advance_to(time(30));
    assert_eq!(
        said(eye.feed(time(20), 3)),
        "`Eye` cannot have data of 0.000000020 s after that of 0.000000020 s: feed it in order of time"
    );
    eye.announce(time(25)).expect("the time has come");
    assert_eq!(
        said(eye.feed(time(30), 3)),
        "`Eye` has announced a cycle: complete or abandon it before the one at 0.000000030 s"
    );
    eye.complete(4).expect("it is announced");
    reader.take();
    let written = reader.view().latest(time(30), |value| *value);
    let written = written.expect("it was fed");
    assert_eq!((written.value, written.cycle), (4, 2));
}
