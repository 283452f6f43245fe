//! Values that are handed on by handle: who has one keeps its value, whatever else is filled.

use std::time::Duration;

use framework::testing::at_millis;
use framework::{Clear, CountingAllocator, History, Leased, Pool, buffer};
use proptest::prelude::*;

#[global_allocator]
static ALLOCATOR: CountingAllocator = CountingAllocator;

#[derive(Clone, Debug)]
enum Step {
    Fill,
    Clone(usize),
    Drop(usize),
}

fn step() -> impl Strategy<Value = Step> {
    prop_oneof![
        3 => Just(Step::Fill),
        1 => any::<usize>().prop_map(Step::Clone),
        3 => any::<usize>().prop_map(Step::Drop),
    ]
}

proptest! {
    /// Against a list of what each handle was leased with.
    #[test]
    fn a_value_is_free_exactly_when_it_has_no_handle(
        count in 0_usize..5,
        steps in prop::collection::vec(step(), 0..60),
    ) {
        let mut pool = Pool::new(count, || 0);
        let mut handles: Vec<(usize, Leased<usize>)> = Vec::new();
        let mut most_leased = 0;
        for (number, step) in steps.into_iter().enumerate() {
            match step {
                Step::Fill => {
                    let mut leased: Vec<usize> = handles.iter().map(|(number, _)| *number).collect();
                    leased.dedup();
                    leased.sort_unstable();
                    leased.dedup();
                    let free = pool.free();
                    prop_assert_eq!(free.is_ok(), leased.len() < count);
                    if let Ok(mut free) = free {
                        *free = number;
                        handles.push((number, free.lease()));
                        most_leased = most_leased.max(leased.len() + 1);
                    }
                    prop_assert_eq!(pool.made(), most_leased, "no more than had handles at once");
                }
                Step::Clone(index) if !handles.is_empty() => {
                    handles.push(handles[index % handles.len()].clone());
                }
                Step::Drop(index) if !handles.is_empty() => {
                    handles.swap_remove(index % handles.len());
                }
                Step::Clone(_) | Step::Drop(_) => {}
            }
            for (number, handle) in &handles {
                prop_assert_eq!(number, &**handle);
            }
        }
    }
}

/// An image goes through a slot to another instance and through a history, and is written and copied nowhere.
#[test]
fn images_pass_slots_and_histories_by_handle() {
    // Three slots, the history's last second and the one before, and the cycle's own.
    let mut pool = Pool::new(3 + 32 + 1, || vec![0_u8; 640 * 480 * 2]);
    let (mut writer, [mut reader], []) = buffer::<Option<Leased<Vec<u8>>>, 1, 0>([]);
    let mut history = History::new(Duration::from_secs(1));
    let mut allocated = None;
    for cycle in 1..200_u64 {
        let before = CountingAllocator::of_this_thread().expect("it is installed");
        let output = writer.slots().0;
        output.clear();
        let mut image = pool.free().expect("there are enough");
        image[0] = cycle as u8;
        *output = Some(image.lease());
        history.push(at_millis(cycle * 33), output);
        let written = output.clone().expect("it was leased");
        writer.complete(cycle, at_millis(cycle * 33));
        reader.take();
        let read = reader.view().value().as_ref().expect("it was written");
        assert!(read.is_same(&written), "cycle {cycle}");
        assert_eq!(read[0], cycle as u8);
        let after = CountingAllocator::of_this_thread().expect("it is installed");
        // The history has its room by then.
        if cycle > 100 {
            allocated = Some(allocated.unwrap_or(0) + after - before);
        }
    }
    assert_eq!(allocated, Some(0));
}

#[test]
fn a_pool_without_a_free_value_says_so() {
    let mut pool = Pool::new(1, || 7);
    let leased = pool.free().map(|free| free.lease());
    assert_eq!(leased.as_deref(), Ok(&7));
    let error = framework::Error::from(pool.free().map(|_| ()).unwrap_err());
    assert!(error.is_no_event(), "a setup node starts over: {error}");
    drop(leased);
    assert!(pool.free().is_ok());
}

#[test]
fn a_value_that_was_not_leased_comes_again_as_it_was_left() {
    let mut pool = Pool::new(3, || 0);
    let first = pool.free().map(|free| free.lease());
    *pool.free().expect("there are three") = 5;
    assert_eq!(*pool.free().expect("there are three"), 5);
    drop(first);
    assert_eq!(*pool.free().expect("there are three"), 5);
    assert_eq!(pool.made(), 2);
}

#[test]
fn serde_sees_the_value_and_not_the_handle() {
    let leased = Leased::of(vec![1, 2]);
    let text = serde_json::to_string(&leased).expect("a list is JSON");
    assert_eq!(text, "[1,2]");
    let read: Leased<Vec<i32>> = serde_json::from_str(&text).expect("it was written so");
    assert_eq!(read, leased);
    assert!(!read.is_same(&leased));
}
