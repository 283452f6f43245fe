//! Creation of a buffer: slots, their writer, readers and queues.

use super::queue::Queue;
use super::reader::Reader;
use super::slots::{Parties, Slots};
use super::sync::Arc;
use super::word::{CONSUMERS, READERS};
use super::writer::Writer;

/// Creates the slots of one instance for `R` readers of the newest cycle and one queue per window.
///
/// A window is how many cycles a consumer can keep; 0 counts as 1. Both numbers follow from the
/// pattern: `let (writer, [for_vision], []) = buffer([]);`
pub fn buffer<T: Default, const R: usize, const C: usize>(
    windows: [usize; C],
) -> (Writer<T>, [Reader<T>; R], [Queue<T>; C]) {
    buffer_of(T::default, windows)
}

/// As [`buffer`] for a type without default: every slot starts as `initial` makes it.
pub fn buffer_of<T, const R: usize, const C: usize>(
    initial: impl FnMut() -> T,
    windows: [usize; C],
) -> (Writer<T>, [Reader<T>; R], [Queue<T>; C]) {
    starting_at(0, initial, windows)
}

/// A buffer whose next cycle has the sequence number after `first`.
pub(super) fn starting_at<T, const R: usize, const C: usize>(
    first: u32,
    initial: impl FnMut() -> T,
    windows: [usize; C],
) -> (Writer<T>, [Reader<T>; R], [Queue<T>; C]) {
    const {
        assert!(R <= READERS, "the word of a slot counts no more readers");
        assert!(C <= CONSUMERS, "the word of a slot names no more consumers")
    };
    let windows = windows.map(|window| window.max(1));
    let count = 2 + R + windows.iter().sum::<usize>();
    let (slots, pen) = Slots::new(initial, count, first, Parties::of::<R, C>());
    let slots = Arc::new(slots);
    let readers = std::array::from_fn(|_| Reader::new(slots.clone()));
    let mut consumer = 0..;
    let queues = windows.map(|window| {
        let consumer = consumer.next().unwrap_or_default();
        Queue::new(slots.clone(), consumer, first.wrapping_add(1), window)
    });
    (Writer::new(slots, pen), readers, queues)
}

#[cfg(test)]
mod tests {
    use super::{Queue, starting_at};
    use crate::time::Timestamp;

    #[test]
    fn sequence_numbers_may_start_over() {
        let (mut writer, [mut reader], [mut queue, mut stalled]) =
            starting_at::<u64, 1, 2>(u32::MAX - 3, u64::default, [2, 2]);
        let mut cycle_to = |last, queue: &mut Queue<u64>| {
            for cycle in writer.newest().cycle + 1..=last {
                *writer.slots().0 = cycle;
                writer.complete(cycle, Timestamp::from_nanos(cycle));
                reader.take();
                assert_eq!((reader.view().cycle(), *reader.view()), (cycle, cycle));
                assert_eq!(take_all(queue), [cycle]);
            }
        };
        // The fourth cycle has number 0; of seven slots one is being written.
        cycle_to(8, &mut queue);
        assert_eq!(take_all(&mut stalled), [3, 4, 5, 6, 7, 8]);
        cycle_to(100, &mut queue);
        assert_eq!(take_all(&mut stalled), [95, 96, 97, 98, 99, 100]);
        assert_eq!((queue.dropped(), stalled.dropped()), (0, 88));
    }

    fn take_all(queue: &mut Queue<u64>) -> Vec<u64> {
        let mut taken = Vec::new();
        while let Some(entry) = queue.take() {
            taken.push(entry.value);
            queue.release(1);
        }
        taken
    }
}
