//! Counts what the calling thread allocates. Not the process: the test harness's own thread allocates whenever it likes.

use framework::CountingAllocator;

#[global_allocator]
static ALLOCATOR: CountingAllocator = CountingAllocator;

/// How often this thread has allocated since it started.
pub(crate) fn allocations() -> u64 {
    CountingAllocator::of_this_thread().expect("it is installed")
}
