#![no_main]

use hulkgen_fuzz::{Input, execute, mutate};
use libfuzzer_sys::{fuzz_mutator, fuzz_target};

fuzz_target!(|bytes: &[u8]| execute(Input::Manifest, bytes));

fuzz_mutator!(|data: &mut [u8], size: usize, most: usize, seed: u32| {
    mutate(Input::Manifest, data, size, most, seed)
});
