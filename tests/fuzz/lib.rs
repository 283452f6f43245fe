//! What the three targets have in common: half of the mutations are libFuzzer's, half know words and lines.

#[path = "../fuzzed.rs"]
pub mod fuzzed;

use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::sync::{Mutex, OnceLock};
use std::thread;

use libfuzzer_sys::fuzzer_mutate;

pub use fuzzed::Input;
use fuzzed::{Random, judge, mutated, on_deep_stack};

/// The thread that judges, for its stack and for what it need not do again.
struct Judge {
    texts: SyncSender<String>,
    judged: Receiver<()>,
}

static JUDGE: OnceLock<Mutex<Judge>> = OnceLock::new();

fn start(input: Input) -> Mutex<Judge> {
    let (texts, received) = sync_channel(0);
    let (done, judged) = sync_channel(1);
    thread::spawn(move || {
        let mut first = true;
        let next = move || {
            if !std::mem::take(&mut first) {
                done.send(()).ok()?;
            }
            received.recv().ok()
        };
        on_deep_stack(|| judge(input, next));
    });
    Mutex::new(Judge { texts, judged })
}

/// One execution. A panic ends the search, and libFuzzer keeps the text.
pub fn execute(input: Input, bytes: &[u8]) {
    let text = String::from_utf8_lossy(bytes).into_owned();
    let judge = JUDGE.get_or_init(|| start(input));
    let judge = judge.lock().expect("one thread executes");
    judge
        .texts
        .send(text)
        .expect("a panic has ended the search");
    judge.judged.recv().expect("a panic has ended the search");
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
