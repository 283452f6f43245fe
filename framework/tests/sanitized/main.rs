//! The slots over memory that every cycle frees and allocates anew: who overwrites what is still read uses it after free.
//! All of it comes from the allocator that counts.
//!
//! Includes every source of the workspace with unsafe code and needs nothing else, so that `.ci/sanitize` can compile it
//! with AddressSanitizer in seconds, once as it is and once with slots that are claimed while somebody holds them.
#![expect(
    dead_code,
    unreachable_pub,
    unused_imports,
    reason = "the sources are those of a library"
)]

use std::sync::atomic::{AtomicBool, Ordering};

use buffer::{Queue, Reader, Writer, buffer};
use time::Timestamp;

/// Only the timestamp, as the buffer uses it.
mod time {
    use std::ops::Sub;
    use std::time::Duration;

    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
    pub struct Timestamp(u64);

    impl Timestamp {
        pub const ZERO: Self = Self(0);
        pub const NEVER: Self = Self(u64::MAX);

        pub const fn from_nanos(nanos: u64) -> Self {
            Self(nanos)
        }

        pub const fn as_nanos(self) -> u64 {
            self.0
        }
    }

    impl Sub for Timestamp {
        type Output = Duration;

        fn sub(self, earlier: Self) -> Duration {
            Duration::from_nanos(self.0.saturating_sub(earlier.0))
        }
    }
}

#[path = "../../src/buffer"]
mod buffer {
    mod create;
    mod queue;
    mod reader;
    mod slots;
    mod sync;
    mod view;
    mod word;
    mod writer;

    pub use create::{buffer, buffer_of};
    pub use queue::Queue;
    pub use reader::Reader;
    pub use slots::Entry;
    pub use view::{Latest, View};
    pub use writer::Writer;
}

#[path = "../../src/timing"]
mod timing {
    mod allocations;
    mod ticks;

    pub use allocations::CountingAllocator;
}

#[global_allocator]
static ALLOCATOR: timing::CountingAllocator = timing::CountingAllocator;

type Pages = Vec<u64>;

/// Frees what the slot held.
fn write(writer: &mut Writer<Pages>, cycle: u64) {
    writer.announce(Timestamp::from_nanos(cycle));
    *writer.slots().0 = vec![cycle; 1 + (cycle % 61) as usize];
    writer.complete(cycle, Timestamp::from_nanos(cycle));
}

fn assert_whole(pages: &[u64], cycle: u64) {
    assert!(pages.iter().all(|word| *word == cycle), "cycle {cycle}");
}

#[test]
fn what_is_held_is_not_overwritten() {
    let (mut writer, [mut reader], []) = buffer::<Pages, 1, 0>([]);
    write(&mut writer, 1);
    reader.take();
    let pages = reader.view().value().as_slice();
    (2..100).for_each(|cycle| write(&mut writer, cycle));
    assert_whole(pages, 1);
}

#[test]
fn what_was_taken_is_not_overwritten() {
    let (mut writer, [], [mut queue]) = buffer::<Pages, 0, 1>([3]);
    write(&mut writer, 1);
    assert_eq!(queue.take().map(|entry| entry.cycle), Some(1));
    let pages = queue.get(0).expect("it was taken").value.as_slice();
    (2..100).for_each(|cycle| write(&mut writer, cycle));
    assert_whole(pages, 1);
}

#[test]
fn memory_that_grows_and_shrinks_is_counted_and_whole() {
    let before = timing::CountingAllocator::of_this_thread().expect("it is installed");
    let mut pages = vec![0_u64; 7];
    (1..1000).for_each(|word| pages.push(word));
    pages.truncate(100);
    pages.shrink_to_fit();
    assert_eq!(pages.last(), Some(&93));
    let after = timing::CountingAllocator::of_this_thread().expect("it is installed");
    assert!(after - before >= 3, "{} allocations", after - before);
}

fn read(mut reader: Reader<Pages>, is_over: &AtomicBool) {
    while !is_over.load(Ordering::Relaxed) {
        reader.take();
        let cycle = reader.view().cycle();
        assert_whole(&reader.view(), cycle);
        std::thread::yield_now();
        assert_whole(&reader.view(), cycle);
    }
}

fn consume(mut queue: Queue<Pages>, is_over: &AtomicBool) {
    while !is_over.load(Ordering::Relaxed) {
        while let Some(entry) = queue.take() {
            assert_whole(&entry.value, entry.cycle);
        }
        for index in 0..queue.len() {
            let entry = queue.get(index).expect("it is held");
            assert_whole(&entry.value, entry.cycle);
        }
        queue.release(queue.len().div_ceil(2));
    }
}

#[test]
fn threads_that_read_at_full_speed_never_see_what_is_freed() {
    let (mut writer, readers, queues) = buffer::<Pages, 2, 2>([1, 8]);
    let is_over = AtomicBool::new(false);
    let is_over = &is_over;
    std::thread::scope(|scope| {
        for reader in readers {
            scope.spawn(move || read(reader, is_over));
        }
        for queue in queues {
            scope.spawn(move || consume(queue, is_over));
        }
        (1..100_000).for_each(|cycle| write(&mut writer, cycle));
        is_over.store(true, Ordering::Relaxed);
    });
}
