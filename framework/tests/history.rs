//! The past of one output: what a cycle finds there by time.

use std::time::Duration;

use framework::{HistoricInput, History, Timestamp};

fn time(nanos: u64) -> Timestamp {
    Timestamp::from_nanos(nanos)
}

fn history(reach: u64, timestamps: impl IntoIterator<Item = u64>) -> History<u64> {
    let mut history = History::new(Duration::from_nanos(reach));
    for timestamp in timestamps {
        history.push(time(timestamp), &timestamp);
    }
    history
}

fn values(history: &History<u64>) -> Vec<u64> {
    let past = history.project(|value| *value);
    let mut all: Vec<_> = HistoricInput::new(&past, Timestamp::NEVER, 0)
        .iter()
        .collect();
    all.pop();
    assert!(
        all.iter()
            .all(|(timestamp, value)| *timestamp == time(*value))
    );
    all.into_iter().map(|(_, value)| value).collect()
}

#[test]
fn the_first_cycle_has_only_itself() {
    let history = history(100, []);
    let past = history.project(|value| value);
    let input = HistoricInput::new(&past, time(5), &7);
    assert_eq!(input.get(time(4)), None);
    assert_eq!(input.get(time(5)), Some(&7));
    assert_eq!(input.get(Timestamp::NEVER), Some(&7));
    assert_eq!(input.iter().collect::<Vec<_>>(), [(time(5), &7)]);
    assert_eq!(input.len(), 1);
}

#[test]
fn get_finds_the_value_at_or_last_before_a_time() {
    let history = history(100, [10, 20, 30]);
    let past = history.project(|value| value);
    let input = HistoricInput::new(&past, time(40), &40);
    let found = |nanos| input.get(time(nanos)).copied();
    assert_eq!([9, 10, 19, 20, 29, 30, 39, 40, 41].map(found), {
        [
            None,
            Some(10),
            Some(10),
            Some(20),
            Some(20),
            Some(30),
            Some(30),
            Some(40),
            Some(40),
        ]
    });
    let all: Vec<_> = input.iter().map(|(_, value)| *value).collect();
    assert_eq!(all, [10, 20, 30, 40]);
    assert_eq!(input.iter().next_back(), Some((time(40), &40)));
}

#[test]
fn get_finds_as_much_of_a_long_past_as_of_a_short_one() {
    for length in 0..70 {
        let history = history(1000, (1..=length).map(|step| 10 * step));
        let past = history.project(|value| *value);
        let now = 10 * (length + 1);
        let input = HistoricInput::new(&past, time(now), now);
        for nanos in 0..now {
            let last = nanos / 10 * 10;
            assert_eq!(input.get(time(nanos)), (last > 0).then_some(last));
        }
    }
}

#[test]
fn an_optional_part_of_the_output_is_seen_as_such() {
    let mut history = History::new(Duration::from_nanos(100));
    history.push(time(1), &Some(String::from("a")));
    history.push(time(2), &None);
    let past = history.project(|value| value.as_deref());
    let input = HistoricInput::new(&past, time(3), Some("c"));
    assert_eq!(
        [1, 2, 3].map(|at| input.get(time(at))),
        [Some(Some("a")), Some(None), Some(Some("c"))]
    );
}

#[test]
fn it_keeps_what_is_in_reach_and_the_one_before() {
    assert_eq!(
        values(&history(20, (1..=10).map(|step| 10 * step))),
        [80, 90, 100]
    );
    assert_eq!(
        values(&history(25, (1..=10).map(|step| 10 * step))),
        [70, 80, 90, 100]
    );
    assert_eq!(values(&history(0, (1..=10).map(|step| 10 * step))), [100]);
    assert_eq!(values(&history(20, [10, 20, 30, 1000])), [30, 1000]);
}

#[test]
fn what_it_keeps_does_not_depend_on_how_large_it_has_become() {
    let burst = (0..50).map(|step| 1000 + step);
    let slow = (1..=20).map(|step| 2000 + 10 * step);
    assert_eq!(
        values(&history(30, burst.chain(slow.clone()))),
        values(&history(30, slow))
    );
}

#[test]
fn it_grows_in_the_middle_of_a_round() {
    let mut model = Vec::new();
    let mut history = History::new(Duration::from_nanos(40));
    let mut now = 1000_u64;
    for step in 0..300_u64 {
        // Phases of few and of many values in reach.
        now += if step / 30 % 2 == 0 { 20 } else { 3 };
        history.push(time(now), &now);
        model.push(now);
        let first = model.iter().rposition(|kept| kept + 40 <= now).unwrap_or(0);
        assert_eq!(values(&history), model[first..]);
    }
}

#[test]
fn clearing_forgets_everything() {
    let mut history = history(100, [10, 20]);
    history.clear();
    assert!(history.is_empty());
    history.push(time(5), &5);
    assert_eq!((values(&history), history.len()), (vec![5], 1));
}
