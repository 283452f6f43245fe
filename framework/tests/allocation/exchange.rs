//! In the steady state the data exchange allocates nothing.

use std::hint::black_box;
use std::time::Duration;

use framework::{
    Consumer, HistoricInput, History, Horizon, Interleaved, Interleaving, PerceptionInput,
    Timestamp, Writer, buffer, interleave,
};

use crate::counting::allocations;

const PERIOD: u64 = 10;

fn time(cycle: u64) -> Timestamp {
    Timestamp::from_nanos(PERIOD * cycle)
}

fn write(writer: &mut Writer<Vec<u64>>, cycle: u64) {
    writer.announce(time(cycle));
    let (values, _previous) = writer.slots();
    values.clear();
    values.extend(cycle..cycle + 8);
    writer.complete(cycle, time(cycle));
}

#[test]
fn nothing_is_allocated_after_the_first_rounds() {
    let (mut top, [mut reader], [for_top]) = buffer::<Vec<u64>, 1, 1>([4]);
    let (mut bottom, [], [for_bottom]) = buffer([4]);
    let mut for_top = Consumer::new(for_top, Duration::from_nanos(4 * PERIOD));
    let mut for_bottom = Consumer::new(for_bottom, Duration::MAX);
    let (mut horizon, mut interleaving) = (Horizon::new(), Interleaving::new());
    let mut history = History::new(Duration::from_nanos(7 * PERIOD));
    let mut allocated = 0;
    let mut seen = 0;
    for cycle in 1..=1000 {
        if cycle == 100 {
            allocated = allocations();
        }
        // Now and then one instance is late, so that windows fill and announcements expire.
        match cycle % 20 {
            0 => top.announce(time(cycle)),
            1..6 => {}
            6 => top.complete(cycle, time(cycle - 6)),
            _ => write(&mut top, cycle),
        }
        write(&mut bottom, cycle);
        reader.take();
        horizon.consume(time(cycle), [&mut for_top, &mut for_bottom]);
        interleaving.merge([&for_top, &for_bottom]);
        let (first, second) = (for_top.project(|v| v), for_bottom.project(|v: &Vec<u64>| v));
        let both = Interleaved {
            order: &interleaving,
            instances: [&first, &second],
        };
        let input = PerceptionInput::new(&both);
        seen += input
            .persistent
            .iter()
            .map(|(_, values)| values.len())
            .sum::<usize>();
        let by_hand = [PerceptionInput::new(&first), PerceptionInput::new(&second)];
        black_box(interleave(by_hand.map(|input| input.transient)).count());
        for_top.references("Top", &mut |reference| {
            black_box(reference);
        });
        let value = reader.view().value();
        let past = history.project(|values| values);
        let historic = HistoricInput::new(&past, time(cycle), value);
        black_box((historic.get(time(cycle - 1)), historic.iter().count()));
        history.push(time(cycle), value);
    }
    assert_eq!(allocations() - allocated, 0);
    assert!(seen > 10_000, "{seen}");
    assert!(for_top.report().expired > 40, "{:?}", for_top.report());
    assert!(
        for_bottom.report().delivered > 990,
        "{:?}",
        for_bottom.report()
    );
}
