//! What cyclers write is what readers find, however the file ended.

mod description;
mod files;
mod late;
mod layouts;
mod readers;
mod slow;
mod small;
mod support;

use std::os::unix::fs::MetadataExt as _;
use std::panic::AssertUnwindSafe;
use std::path::Path;
use std::time::{Duration, Instant};

use hulkgen_recording::{Frame, Full, Recorded, Recorder, Recording, Settings, Track, Way};
use proptest::prelude::*;

use description::{FRAMES, description, settings};
use support::{drawn_places, frame, record};

/// A recording of one instance.
fn start_one(path: &Path) -> (Recorder, Track) {
    let started = Recorder::start(path, description(), &["Control"], settings());
    let (recorder, mut tracks) = started.expect("it is new");
    (recorder, tracks.pop().expect("one was asked for"))
}

/// Cycles of the frames in all chunks; each chunk has every value that its frames refer to, once.
fn cycles(recording: &Recording) -> Vec<u32> {
    let mut cycles = Vec::new();
    for chunk in &recording.chunks {
        let mut values = Vec::new();
        for message in chunk.messages() {
            let number = std::str::from_utf8(message.data).expect("digits");
            let number: u32 = number.parse().expect("digits");
            assert_eq!(number, message.sequence);
            if message.channel == 2 {
                assert!(!values.contains(&number), "{number} stands twice");
                values.push(number);
            } else {
                assert!(
                    values.contains(&(number / 3)),
                    "{number} cannot be replayed"
                );
                cycles.push(number);
            }
        }
    }
    cycles
}

#[test]
fn everything_is_found_again() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.mcap");
    // Nothing was dropped for good, but the recording counts each time that a frame found no block.
    record(&path, 2000, 20, settings());
    let recording = Recording::open(&path).expect("it can be read");
    assert_eq!(recording.way, Way::Whole);
    assert!(recording.chunks.len() > 5);
    assert_eq!(cycles(&recording), Vec::from_iter(0..2000));
    let own = description();
    let channels = recording.channels.iter().map(|(_, channel)| &channel.topic);
    assert!(channels.eq(own.channels.iter().map(|channel| &channel.topic)));
    assert_eq!(recording.schemas, [(1, own.schemas[0].clone())]);
    assert_eq!(recording.attachments, own.attachments);
    assert_eq!(recording.metadata("run"), own.metadata.first());
}

#[test]
fn nothing_is_overwritten() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.mcap");
    assert!(record(&path, 10, 4, settings()));
    let again = Recorder::start(&path, description(), &[], settings());
    assert!(again.is_err());
    assert!(
        Recording::open(&path)
            .expect("it is still there")
            .is_complete()
    );
}

/// So long that nothing is taken from a track that has no frame meanwhile.
const LONG: Duration = Duration::from_secs(600);

#[test]
fn a_block_is_handed_over_when_its_frames_are_old() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.mcap");
    let settings = Settings {
        longest: LONG,
        ..settings()
    };
    let (recorder, mut tracks) =
        Recorder::start(&path, description(), &["Control"], settings).expect("it is new");
    let mut track = tracks.pop().expect("one was asked for");
    // By their own time, which does not go back; and if it did, nothing would be lost.
    let times = [5.0, 5.9, 6.0, 4.0, 6.9, 7.1, 7.2];
    let firsts = times.map(|time| {
        let time = (time * LONG.as_nanos() as f64) as u64;
        let mut is_first = false;
        let recorded = track.frame::<Full>(time, 0, |frame| {
            is_first = frame.is_first();
            frame.message(FRAMES, 0, time, |writing| writing.put(b"0"))
        });
        assert_eq!(recorded, Recorded::Whole);
        is_first
    });
    assert_eq!(firsts, [true, false, true, false, false, true, false]);
    drop(track);
    assert!(recorder.end().is_complete);
}

#[test]
fn what_was_recorded_last_is_handed_over_though_nothing_more_is_wanted() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.mcap");
    let settings = Settings {
        longest: LONG,
        // Each block is a chunk at once.
        chunk_bytes: 1,
        ..settings()
    };
    let (recorder, mut tracks) =
        Recorder::start(&path, description(), &["Control"], settings).expect("it is new");
    let mut track = tracks.pop().expect("one was asked for");
    let time = |tenths: u64| tenths * LONG.as_nanos() as u64 / 10;
    let record = |track: &mut Track, tenths: u64| {
        let mut is_first = false;
        let recorded = track.frame::<Full>(time(tenths), 0, |frame| {
            is_first = frame.is_first();
            frame.message(FRAMES, tenths as u32, tenths, |writing| writing.put(b"0"))
        });
        assert_eq!(recorded, Recorded::Whole);
        is_first
    };
    let pass = |track: &mut Track, tenths: u64| track.pass(time(tenths));
    // Nothing is there yet.
    pass(&mut track, 49);
    assert!(record(&mut track, 50));
    pass(&mut track, 59);
    assert!(!record(&mut track, 59), "it was not old");
    pass(&mut track, 60);
    await_frames(&path, &[&[50, 59]]);
    // Nothing is there any more.
    pass(&mut track, 61);
    pass(&mut track, 90);
    // Back in time: what waits is as old as its first frame says.
    assert!(record(&mut track, 40));
    pass(&mut track, 30);
    assert!(!record(&mut track, 45));
    pass(&mut track, 50);
    await_frames(&path, &[&[50, 59], &[40, 45]]);
    assert!(record(&mut track, 51));
    drop(track);
    assert!(recorder.end().is_complete);
    await_frames(&path, &[&[50, 59], &[40, 45], &[51]]);
}

/// A message of the channel of frames in each, of this cycle.
fn write(frame: &mut hulkgen_recording::Frame<'_>, cycle: u32) -> Result<(), Full> {
    frame.message(FRAMES, cycle, 0, |writing| writing.put(b"0"))
}

#[test]
fn a_cycle_that_hangs_keeps_no_frame_to_itself() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.mcap");
    let settings = Settings {
        longest: Duration::from_millis(50),
        chunk_bytes: 1,
        ..settings()
    };
    let (recorder, mut tracks) =
        Recorder::start(&path, description(), &["Control"], settings).expect("it is new");
    let mut track = tracks.pop().expect("one was asked for");
    // By their own time no block becomes old.
    let record = |track: &mut Track, cycle: u32| {
        let mut is_first = false;
        let recorded = track.frame::<Full>(0, 64, |frame| {
            is_first = frame.is_first();
            write(frame, cycle)
        });
        assert_eq!(recorded, Recorded::Whole);
        is_first
    };
    let end = |track: &mut Track, cycle: u32| {
        let ended = track.end::<Full>(0, |frame| write(frame, cycle));
        assert_eq!(ended, Recorded::Whole);
    };
    assert!(record(&mut track, 1));
    end(&mut track, 1);
    record(&mut track, 2);
    await_messages(&path, &[1, 1, 2]);
    // It went on: the next one refers to nothing before it.
    end(&mut track, 2);
    assert!(record(&mut track, 3));
    end(&mut track, 3);
    // So it is where an instance has nothing to do.
    await_messages(&path, &[1, 1, 2, 2, 3, 3]);
    assert!(record(&mut track, 4));
    let counts = track.counts().clone();
    // Nobody hands this one over.
    std::mem::forget(track);
    assert!(recorder.end().is_complete);
    assert_eq!((counts.recorded(), counts.missing()), (4, 0));
    await_messages(&path, &[1, 1, 2, 2, 3, 3, 4]);
}

/// Waits until the file has these frames, by chunk, and no others.
fn await_frames(path: &Path, expected: &[&[u32]]) {
    await_chunks(path, |found| found == expected);
}

/// Waits until the file has these messages, in whichever chunks, and no others.
fn await_messages(path: &Path, expected: &[u32]) {
    await_chunks(path, |found| found.concat() == expected);
}

fn await_chunks(path: &Path, is_expected: impl Fn(&[Vec<u32>]) -> bool) {
    let begun = Instant::now();
    loop {
        let recording = Recording::open(path).expect("its beginning is there");
        let found: Vec<Vec<_>> = recording
            .chunks
            .iter()
            .map(|chunk| chunk.messages().map(|message| message.sequence).collect())
            .collect();
        if is_expected(&found) {
            return;
        }
        let is_late = begun.elapsed() > Duration::from_secs(20);
        assert!(!is_late, "{found:?}");
        std::thread::sleep(Duration::from_millis(1));
    }
}

#[test]
fn a_frame_that_does_not_fit_begins_the_next_block() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.mcap");
    let (recorder, mut track) = start_one(&path);
    let mut firsts = Vec::new();
    for cycle in 0..5 {
        let recorded = track.frame(cycle, 0, |frame| {
            let is_first = frame.is_first();
            let written: Result<(), Full> =
                frame.message(FRAMES, 0, cycle, |writing| writing.put(&[b'0'; 1500]));
            if written.is_ok() {
                firsts.push(is_first);
            }
            written
        });
        assert_eq!(recorded, Recorded::Whole);
    }
    assert_eq!(firsts, [true, false, true, false, true]);
    let large = track.frame(9, 0, |frame| {
        frame.message(FRAMES, 9, 9, |writing| writing.put(&[b'0'; 5000]))
    });
    assert_eq!(large, Recorded::<Full>::Dropped);
    assert_eq!(
        (track.counts().recorded(), track.counts().dropped()),
        (5, 1)
    );
    drop(track);
    let ended = recorder.end();
    assert!(!ended.is_complete && ended.error.is_none());
    let recording = Recording::open(&path).expect("it can be read");
    assert!(!recording.is_complete());
    let end = recording.metadata("end").expect("it ended");
    let dropped = ("Control.dropped".to_owned(), "1".to_owned());
    assert!(end.entries.contains(&dropped));
}

#[test]
fn what_cannot_be_encoded_is_no_frame() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.mcap");
    let (recorder, mut track) = start_one(&path);
    assert_eq!(frame(&mut track, 0, 1), Recorded::Whole);
    let failed = track.frame(1, 0, |frame| {
        frame.message(FRAMES, 1, 1, |writing| writing.put(b"1"))?;
        Err("no number".to_owned()).or_else(|error: String| match error.as_str() {
            "" => Ok(()),
            _ => Err(Failure(error)),
        })
    });
    assert_eq!(failed, Recorded::Failed(Failure("no number".to_owned())));
    assert_eq!(frame(&mut track, 2, 1), Recorded::Whole);
    drop(track);
    assert!(!recorder.end().is_complete);
    let recording = Recording::open(&path).expect("it can be read");
    assert_eq!(cycles(&recording), [0, 2]);
}

/// As the code of a value that somebody wrote may.
fn panicking(_: &mut Frame<'_>) -> Result<(), Full> {
    std::panic::resume_unwind(Box::new("no number"))
}

#[test]
fn what_panics_while_it_is_encoded_is_no_frame_and_the_frames_before_it_stay() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.mcap");
    let (recorder, mut track) = start_one(&path);
    assert_eq!(frame(&mut track, 0, 1), Recorded::Whole);
    let catch = |write: &mut dyn FnMut() -> Recorded<Full>| {
        std::panic::catch_unwind(AssertUnwindSafe(write)).expect_err("it panics");
    };
    catch(&mut || track.frame(1, 0, panicking));
    assert_eq!(frame(&mut track, 2, 1), Recorded::Whole);
    catch(&mut || track.end(2, panicking));
    assert_eq!(frame(&mut track, 3, 1), Recorded::Whole);
    assert_eq!(track.counts().failed(), 2);
    drop(track);
    assert!(!recorder.end().is_complete);
    let recording = Recording::open(&path).expect("it can be read");
    assert_eq!(cycles(&recording), [0, 2, 3]);
}

#[derive(Debug, PartialEq, Eq)]
struct Failure(String);

impl From<Full> for Failure {
    fn from(_: Full) -> Self {
        Self("full".to_owned())
    }
}

#[test]
fn the_end_of_a_cycle_stands_behind_its_frame() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.mcap");
    let (recorder, mut track) = start_one(&path);
    for cycle in 0..500 {
        // What was kept free is enough, wherever the block ends.
        while frame(&mut track, cycle, 3) != Recorded::Whole {
            std::thread::sleep(Duration::from_millis(1));
        }
        let ended = track.end::<Full>(u64::from(cycle), |frame| {
            frame.message(FRAMES, cycle, u64::from(cycle), |writing| {
                writing.put(cycle.to_string().as_bytes())
            })
        });
        assert_eq!(ended, Recorded::Whole);
    }
    drop(track);
    recorder.end();
    let recording = Recording::open(&path).expect("it can be read");
    let twice = (0..500).flat_map(|cycle| [cycle, cycle]);
    assert!(cycles(&recording).into_iter().eq(twice));
}

#[test]
fn frames_without_a_block_are_dropped_and_counted() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.mcap");
    let (recorder, mut tracks) = Recorder::start(
        &path,
        description(),
        &["One", "Other"],
        Settings {
            blocks: 1,
            ..settings()
        },
    )
    .expect("it is new");
    let [one, other] = tracks.as_mut_slice() else {
        panic!("two were asked for");
    };
    // The only block is with one of the two.
    assert_eq!(frame(one, 0, 1), Recorded::Whole);
    for cycle in 0..7 {
        assert_eq!(frame(other, cycle, 1), Recorded::Dropped);
    }
    let counts: Vec<_> = recorder
        .counts()
        .map(|(name, counts)| (name.to_owned(), counts.recorded(), counts.dropped()))
        .collect();
    assert_eq!(
        counts,
        [("One".to_owned(), 1, 0), ("Other".to_owned(), 0, 7)]
    );
    drop(tracks);
    assert!(!recorder.end().is_complete);
}

#[test]
fn a_cut_file_has_all_chunks_before_the_cut() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.mcap");
    record(&path, 1500, 20, settings());
    let bytes = std::fs::read(&path).expect("it was written");
    let whole = Recording::read(&bytes).expect("it can be read");
    let all = cycles(&whole);
    let boundaries = whole.chunks.iter().map(|chunk| chunk.offset as usize);
    let boundaries: Vec<_> = boundaries.collect();
    for cut in drawn_places(8..bytes.len()).chain(boundaries.iter().copied()) {
        let recording = Recording::read(&bytes[..cut]).expect("its beginning is there");
        assert_ne!(recording.way, Way::Whole);
        let found = cycles(&recording);
        assert_eq!(found, all[..found.len()]);
        // The last record of a chunk ends before the next one's first.
        let before = boundaries.iter().filter(|offset| **offset < cut).count();
        assert!(recording.chunks.len() + 1 >= before, "cut at {cut}");
    }
}

#[test]
fn a_budget_makes_a_ring() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.mcap");
    // Digits that differ, so that compression does not hide the ring.
    let budget = 64 << 10;
    record(
        &path,
        60_000,
        1,
        Settings {
            budget,
            ..settings()
        },
    );
    let recording = Recording::open(&path).expect("it can be read");
    assert_eq!(recording.way, Way::Whole);
    assert!(recording.gone > 10, "{} chunks are gone", recording.gone);
    let found = cycles(&recording);
    let first = *found.first().expect("the newest are there");
    assert!(first > 0);
    assert_eq!(found, Vec::from_iter(first..60_000));
    let end = &recording.metadata("end").expect("it ended").entries;
    let overwritten = end.iter().find(|(key, _)| key.ends_with(".overwritten"));
    let (_, overwritten) = overwritten.expect("it is counted");
    assert_eq!(*overwritten, first.to_string());
    let file = std::fs::metadata(&path).expect("it was written");
    let on_disk = file.blocks() * 512;
    assert!(
        on_disk < 3 * budget + (recording.gone * 4096),
        "{on_disk} bytes are on the disk"
    );
    assert!(on_disk < file.len(), "{} bytes are in the file", file.len());
}

proptest! {
    #[test]
    fn any_bytes_are_read_or_refused(bytes in proptest::collection::vec(any::<u8>(), 0..400), flips in proptest::collection::vec((0_usize..6000, any::<u8>()), 0..4)) {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("run.mcap");
        record(&path, 100, 5, settings());
        let mut file = std::fs::read(&path).expect("it was written");
        for (place, value) in flips {
            if let Some(byte) = file.get_mut(place) {
                *byte = value;
            }
        }
        let read = |bytes: &[u8]| {
            if let Ok(recording) = Recording::read(bytes) {
                recording.chunks.iter().for_each(|chunk| {
                    chunk.messages().count();
                });
            }
        };
        read(&file);
        read(&bytes);
        file.splice(40.min(file.len()).., bytes);
        read(&file);
    }
}
