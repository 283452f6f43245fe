//! A cycler that records allocates nothing.

#[path = "../../tests/allocation/counting.rs"]
mod counting;
#[path = "recording/description.rs"]
mod description;

use std::sync::Arc;
use std::time::Duration;

use hulkgen_recording::{Late, Recorded, Recorder, Settings};

use counting::allocations;
use description::{FRAMES, VALUES, description, settings};

/// As large as the writer likes.
struct Large;

impl Late for Large {
    fn write(&self, bytes: &mut Vec<u8>) -> bool {
        bytes.extend_from_slice(&[0; 100]);
        true
    }
}

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
    let (mut whole, mut left) = (0, 0);
    let value = Arc::new(Large);
    let before = allocations();
    for cycle in 0..2000 {
        let recorded = track.frame(cycle, 64, |frame| {
            frame.message(VALUES, 0, cycle, |writing| writing.put(b"0"))?;
            frame.message(FRAMES, cycle as u32, cycle, |writing| {
                // In every third frame, until there is no room for it.
                if cycle % 3 == 0 && writing.leave(b"0", value.clone()) {
                    left += 1;
                    return Ok(());
                }
                writing.put(b"0")
            })
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
    assert!(left >= 3, "{left} of them left something to the writer");
}
