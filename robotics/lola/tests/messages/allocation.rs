//! Reading and writing messages takes no heap once the buffers have their size.

use framework::CountingAllocator;

use crate::wire::{sample_command, sample_state};
use lola::{Command, command, state};

#[global_allocator]
static ALLOCATOR: CountingAllocator = CountingAllocator;

fn allocations(work: impl FnOnce()) -> u64 {
    let so_far = || CountingAllocator::of_this_thread().expect("it is installed");
    let before = so_far();
    work();
    so_far() - before
}

#[test]
fn a_state_is_read_and_written_without_heap() {
    let mut bytes = Vec::new();
    state::encode(&sample_state(), &mut bytes).unwrap();
    let taken = allocations(|| {
        let state = state::decode(&bytes).unwrap();
        state::encode(&state, &mut bytes).unwrap();
    });
    assert_eq!(taken, 0);
}

#[test]
fn a_command_is_read_and_written_without_heap() {
    let mut bytes = Vec::new();
    command::encode(&sample_command(), &mut bytes);
    let taken = allocations(|| {
        let mut command = Command::default();
        command::decode(&bytes, &mut command).unwrap();
        command::encode(&command, &mut bytes);
    });
    assert_eq!(taken, 0);
}

#[test]
fn garbled_bytes_are_refused_without_heap() {
    let bytes = [0xc1; 896];
    assert_eq!(allocations(|| assert!(state::decode(&bytes).is_err())), 0);
}
