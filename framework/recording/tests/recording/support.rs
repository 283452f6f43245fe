//! A recording of counted frames, each behind a value that every third frame shares.

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
