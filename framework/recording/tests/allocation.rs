//! A cycler that records allocates nothing.

#[path = "../../tests/allocation/counting.rs"]
mod counting;
#[path = "recording/description.rs"]
mod description;

use std::time::Duration;

use hulkgen_recording::{Recorded, Recorder, Settings};

use counting::allocations;
use description::{FRAMES, VALUES, description, settings};

#[test]
fn frames_allocate_nothing() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.mcap");
    let settings = Settings {
        blocks: 64,
        longest: Duration::from_nanos(50),
        ..settings()
    };
    let (_recorder, mut tracks) =
        Recorder::start(&path, description(), &["Control"], settings).expect("it is new");
    let mut track = tracks.pop().expect("one was asked for");
    let mut whole = 0;
    let before = allocations();
    for cycle in 0..2000 {
        let recorded = track.frame(cycle, 64, |frame| {
            frame.message(VALUES, 0, cycle, |writing| writing.put(b"0"))?;
            frame.message(FRAMES, cycle as u32, cycle, |writing| writing.put(b"0"))
        });
        whole += u32::from(recorded == Recorded::Whole);
        track.end(cycle, |frame| {
            frame.message(FRAMES, cycle as u32, cycle, |writing| writing.put(b"0"))
        });
        // Of every fiftieth cycle, it hands the block over.
        track.pass(cycle + 1);
    }
    assert_eq!(allocations() - before, 0);
    assert!(whole > 100, "{whole} frames were recorded");
}
