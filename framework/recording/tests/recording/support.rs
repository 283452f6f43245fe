//! A recording of counted frames, each behind a value that every third frame shares.

use std::ops::Range;
use std::path::Path;
use std::time::Duration;

use hulkgen_recording::{Full, Recorded, Recorder, Settings, Track};

use crate::description::{FRAMES, VALUES, description};

/// A value of another instance, then the frame that refers to it.
pub(crate) fn frame(track: &mut Track, cycle: u32, length: usize) -> Recorded<Full> {
    let time = u64::from(cycle) * 1000;
    track.frame(time, 64, |frame| {
        frame.message(VALUES, cycle / 3, time, |writing| {
            writing.put((cycle / 3).to_string().as_bytes())
        })?;
        frame.message(FRAMES, cycle, time, |writing| {
            writing.put(format!("{cycle:0length$}").as_bytes())
        })
    })
}

/// So many frames of one instance; waits where the disk is slower.
pub(crate) fn record(path: &Path, frames: u32, length: usize, settings: Settings) -> bool {
    let (recorder, mut tracks) =
        Recorder::start(path, description(), &["Control"], settings).expect("it is new");
    let mut track = tracks.pop().expect("one was asked for");
    for cycle in 0..frames {
        while frame(&mut track, cycle, length) != Recorded::Whole {
            std::thread::sleep(Duration::from_millis(1));
        }
    }
    drop(track);
    recorder.end().is_complete
}

/// 500 places that a seed draws, where a file may be cut; `HULKGEN_FUZZ_SEED` is another seed.
pub(crate) fn drawn_places(of: Range<usize>) -> impl Iterator<Item = usize> {
    let seed = std::env::var("HULKGEN_FUZZ_SEED");
    let seed: u64 = seed.map_or(1, |seed| seed.parse().expect("a seed is a number"));
    // Shown where the test fails.
    println!("cut at 500 places of HULKGEN_FUZZ_SEED={seed}");
    let mut state = seed;
    // SplitMix64 (Steele, Lea and Flood, 2014).
    std::iter::repeat_with(move || {
        state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mixed = (state ^ (state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        of.start + (mixed ^ (mixed >> 31)) as usize % of.len()
    })
    .take(500)
}
