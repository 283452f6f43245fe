//! What the three targets have in common: half of the mutations are libFuzzer's, half know words and lines.

use libfuzzer_sys::fuzzer_mutate;

#[path = "../fuzzed.rs"]
pub mod fuzzed;

pub use fuzzed::Input;
use fuzzed::{Random, answer, mutated, on_deep_stack};

/// One execution. A panic ends the search, and libFuzzer keeps the text.
pub fn execute(input: Input, bytes: &[u8]) {
    let text = String::from_utf8_lossy(bytes);
    on_deep_stack(|| answer(input, &text));
}

/// The next text made of `data[..size]`; its size.
pub fn mutate(input: Input, data: &mut [u8], size: usize, most: usize, seed: u32) -> usize {
    if seed.is_multiple_of(2) {
        return fuzzer_mutate(data, size, most);
    }
    let text = String::from_utf8_lossy(&data[..size]).into_owned();
    let text = mutated(&text, &[input.honest()], &mut Random::new(seed.into()));
    let size = text.floor_char_boundary(most.min(data.len()));
    data[..size].copy_from_slice(&text.as_bytes()[..size]);
    size
}
