//! How often threads allocate, where the allocator that counts is installed: a program installs it.
#![expect(unsafe_code, reason = "the trait of allocators is unsafe")]

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;
use std::sync::atomic::{AtomicBool, Ordering};

thread_local! {
    // Constant and without `Drop`: to use it allocates nothing, also while a thread starts or ends.
    static SO_FAR: Cell<u64> = const { Cell::new(0) };
}

static IS_INSTALLED: AtomicBool = AtomicBool::new(false);

/// The system's allocator, which counts for each thread how often it is asked for memory. Reports then tell it by node.
///
/// ```
/// # // The test of this text has a process of its own.
/// #[cfg(debug_assertions)]
/// #[global_allocator]
/// static ALLOCATOR: framework::CountingAllocator = framework::CountingAllocator;
/// ```
#[derive(Clone, Copy, Debug, Default)]
pub struct CountingAllocator;

impl CountingAllocator {
    /// How often this thread was given memory, new or in place of old, since it started; `None` where nobody counts.
    pub fn of_this_thread() -> Option<u64> {
        // Relaxed: set before `main` by whatever allocates first.
        IS_INSTALLED.load(Ordering::Relaxed).then(so_far)
    }
}

/// How often this thread was given memory; 0 where nobody counts.
#[inline]
pub(crate) fn so_far() -> u64 {
    SO_FAR.get()
}

#[inline]
fn count() {
    let before = SO_FAR.get();
    SO_FAR.set(before + 1);
    if before == 0 {
        IS_INSTALLED.store(true, Ordering::Relaxed);
    }
}

// SAFETY: the system's allocator does everything; counting touches nothing but a number of the thread and a flag.
unsafe impl GlobalAlloc for CountingAllocator {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        count();
        // SAFETY: as the caller promises.
        unsafe { System.alloc(layout) }
    }

    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        count();
        // SAFETY: as the caller promises.
        unsafe { System.alloc_zeroed(layout) }
    }

    unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        count();
        // SAFETY: as the caller promises.
        unsafe { System.realloc(pointer, layout, size) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        // SAFETY: as the caller promises.
        unsafe { System.dealloc(pointer, layout) }
    }
}
