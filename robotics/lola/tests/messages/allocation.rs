//! Reading and writing messages takes no heap once the buffers have their size.

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

use crate::wire::{sample_command, sample_state};
use lola::{Command, command, state};

thread_local! {
    static ALLOCATIONS: Cell<usize> = const { Cell::new(0) };
}

struct Counting;

#[expect(unsafe_code, reason = "counting allocations takes an allocator")]
// SAFETY: every call goes to the system's allocator unchanged.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        ALLOCATIONS.set(ALLOCATIONS.get() + 1);
        // SAFETY: the caller's promises are passed on.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        // SAFETY: the caller's promises are passed on.
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

fn allocations(work: impl FnOnce()) -> usize {
    let before = ALLOCATIONS.get();
    work();
    ALLOCATIONS.get() - before
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
